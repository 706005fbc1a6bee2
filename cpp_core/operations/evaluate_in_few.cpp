#include "operations/evaluate_in_few.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "certificate/topology.h"
#include "operations/changed_mesh.h"
#include "solids/errors.h"

namespace starcell {
namespace {

// Of the error: what decimation has for certain. A tenth makes most of the triangles go; contouring hardly needs more cells for it.
constexpr double decimation_part = 0.1;
// Of the error: what is nearer than this has nothing to give.
constexpr double near = 1e-3;
// Proofs of few large triangles look at all that were before, again and again. So many looks to a triangle are a few times what most meshes take.
constexpr std::size_t most_looks = 1000;
// Of the progress: contouring's.
constexpr double contouring_until = 0.6;

}  // namespace

Result evaluate_in_few(const Expression& expression, const Options& options, const std::function<void(const Result&)>& contoured) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  if (options.error && std::isinf(*options.error)) {
    Result result = evaluate(expression, options);
    if (contoured) contoured(result);
    return result;
  }
  const auto tell = [&](double done, const char* stage) {
    if (options.progress && !options.progress(done, stage)) throw CancelledError("The run was cancelled.");
  };
  Options first = options;
  first.kept = decimation_part;
  if (options.progress) first.progress = [&](double done, const std::string& stage) { return options.progress(contouring_until * done, stage); };
  Result result = evaluate(expression, first);
  if (contoured) contoured(result);
  const double error = result.certificate.requested_error, bound = result.certificate.error_bound;
  if (result.certificate.verdict != Verdict::unresolved && !result.triangles.empty() && bound > near * error && bound < error) {
    Result few = result;
    double done = 0;
    const auto go_on = [&](double share) {
      done = std::max(done, share);
      tell(contouring_until + (1 - contouring_until) * done, "decimating");
      return seconds() < options.budget.max_seconds;
    };
    // Sheets that float32 would bring together stay as contouring left them.
    if (change(few, std::min(bound, error - bound), "decimating", decimating(1, most_looks), go_on).empty()) result = std::move(few);
    Certificate& c = result.certificate;
    c.statistics["triangles.contoured"] = c.statistics["triangles"];
    count_topology(result.vertices, result.triangles, c);
    c.statistics["triangles"] = static_cast<double>(result.triangles.size());
    c.statistics["vertices"] = static_cast<double>(result.vertices.size());
    c.statistics["seconds"] = seconds();
  }
  tell(1, "done");
  return result;
}

}  // namespace starcell
