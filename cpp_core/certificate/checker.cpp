#include "certificate/checker.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "certificate/checker_cgal.h"
#include "certificate/checker_mesh.h"

namespace starcell {
namespace {

using namespace checker;

constexpr std::size_t most_triangles = 400'000;  // above, the exact Boolean and the distance take too long
constexpr double rounding = 1e-11;               // of the largest coordinate: what double arithmetic can lose here
constexpr double coarsest_precision = 1e-3;      // of the diagonal: finer ones make the Hausdorff distance take for ever

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream out;
  out.precision(6);
  (out << ... << parts);
  return out.str();
}

std::string list(const std::vector<int>& numbers) {
  std::string text = "[";
  for (const int n : numbers) text += (text.size() > 1 ? ", " : "") + std::to_string(n);
  return text + "]";
}

Answer answer(bool holds) { return holds ? Answer::yes : Answer::no; }

class Check {
 public:
  explicit Check(const CertificateFile& file) : file_(file), c_(file.certificate) {}

  CheckReport run() {
    add("file", Answer::yes,
        sentence("well formed: ", file_.operands.size(), " operands, ", file_.half_spaces.size(), " half-spaces, ",
                 file_.result.triangles.size(), " triangles"));
    check_operands();
    const bool manifold = check_manifold();
    if (manifold) {
      add("embedded", bounds_a_volume(file_.result));
      add("embedded in float32", embedded(rounded_to_float32(file_.result)));
      check_counts();
    } else {
      for (const char* name : {"embedded", "embedded in float32", "counts"})
        add(name, Answer::unknown, "the result is no manifold");
    }
    check_against_exact(manifold);
    check_fields();
    return std::move(report_);
  }

 private:
  void add(std::string name, Answer holds, std::string detail) {
    report_.claims.push_back({std::move(name), holds, std::move(detail)});
  }
  void add(std::string name, const Finding& finding) { add(std::move(name), finding.answer, finding.detail); }

  void check_operands() {
    for (std::size_t k = 0; k < file_.operands.size(); ++k) {
      const StoredOperand& operand = file_.operands[k];
      const std::string defect = manifold_defect(operand.mesh);
      const Finding finding = defect.empty() ? bounds_a_volume(operand.mesh) : Finding{Answer::no, defect};
      if (finding.answer == Answer::yes) continue;
      operands_hold_ = finding.answer;
      return add("operands", finding.answer, sentence("operand ", k, " '", operand.name, "': ", finding.detail));
    }
    add("operands", Answer::yes, "closed, embedded, oriented");
  }

  bool check_manifold() {
    const std::string defect = manifold_defect(file_.result);
    add("manifold", answer(defect.empty()), defect.empty() ? "closed, manifold, oriented" : defect);
    return defect.empty();
  }

  void check_counts() {
    const Counted counted = count(file_.result);
    std::vector<int> mine = counted.genus, claimed = c_.genus;
    // Components of equal volume have no order.
    for (std::size_t first = 0, last; claimed.size() == mine.size() && first < mine.size(); first = last) {
      for (last = first + 1; last < mine.size() && counted.volume[last] >= counted.volume[last - 1] * (1 - 1e-9);) ++last;
      std::sort(mine.begin() + first, mine.begin() + last);
      std::sort(claimed.begin() + first, claimed.begin() + last);
    }
    const bool same = mine == claimed && c_.components == static_cast<int>(mine.size()) &&
                      c_.euler_characteristic == counted.euler_characteristic;
    add("counts", answer(same),
        sentence("counted ", mine.size(), " components, genus ", list(counted.genus), ", Euler characteristic ",
                 counted.euler_characteristic, "; claimed ", c_.components, ", ", list(c_.genus), ", ",
                 c_.euler_characteristic));
  }

  std::string why_no_exact(bool manifold) const {
    if (!manifold) return "the result is no manifold";
    if (c_.verdict == Verdict::unresolved) return "the verdict is unresolved: nothing is claimed";
    if (operands_hold_ != Answer::yes) return "an operand is no closed, embedded solid";
    std::size_t triangles = file_.result.triangles.size();
    bool measurable = in_range(file_.result);
    for (const StoredOperand& operand : file_.operands) {
      triangles += operand.mesh.triangles.size();
      measurable = measurable && in_range(operand.mesh);
    }
    for (const HalfSpace& h : file_.half_spaces)
      measurable = measurable && in_range(h.point) && in_range(h.normal / h.normal.cwiseAbs().maxCoeff());
    if (!measurable) return "a coordinate is too large or too small for CGAL";
    if (triangles > most_triangles) return sentence("too large: ", triangles, " triangles, at most ", most_triangles);
    return "";
  }

  void check_against_exact(bool manifold) {
    std::string reason = why_no_exact(manifold);
    ExactBoolean exact;
    if (reason.empty()) {
      exact = exact_boolean(file_);
      if (!exact.known) reason = exact.reason;
      // Corefinement answers some inputs wrongly rather than not at all; then it is no judge.
      else if (const std::string defect = manifold_defect(exact.mesh); !defect.empty())
        reason = "CGAL's exact result is no manifold: " + defect;
    }
    if (!reason.empty()) {
      for (const char* name : {"topology", "distance", "volume"}) add(name, Answer::unknown, reason);
      return;
    }
    if (c_.verdict == Verdict::contact) {
      for (const char* name : {"topology", "distance"})
        add(name, Answer::unknown, "claimed of an input moved by at most the contact tolerance, not of the input itself");
    } else {
      check_topology(exact.mesh);
      check_distance(exact.mesh);
    }
    check_volume(exact.mesh);
  }

  void check_topology(const StoredMesh& exact) {
    std::vector<int> theirs = count(exact).genus, mine = count(file_.result).genus;
    std::sort(theirs.begin(), theirs.end());
    std::sort(mine.begin(), mine.end());
    add("topology", answer(theirs == mine),
        sentence("the exact Boolean has ", theirs.size(), " components, genera ", list(theirs), "; the result ", mine.size(),
                 ", ", list(mine)));
  }

  /// What contouring may deviate from the exact Boolean of the operands as they are stored.
  double bound_without_deflection() const {
    if (std::isinf(c_.error_bound)) return c_.error_bound;
    double deflection = 0;
    for (const StoredOperand& operand : file_.operands) deflection = std::max(deflection, operand.deflection);
    return std::max(0.0, c_.error_bound - deflection);
  }

  double scale(const StoredMesh& exact) const {
    return std::max(largest_coordinate(exact), largest_coordinate(file_.result));
  }

  void check_distance(const StoredMesh& exact) {
    if (exact.triangles.empty() || file_.result.triangles.empty()) {
      const bool both = exact.triangles.empty() && file_.result.triangles.empty();
      return add("distance", answer(both), both ? "both are empty" : "one of the exact Boolean and the result is empty");
    }
    const double bound = bound_without_deflection();
    if (std::isinf(bound)) return add("distance", Answer::yes, "the bound is infinite: nothing is claimed");
    try {
      measure_distance(exact, bound);
    } catch (const std::exception& error) {
      add("distance", Answer::unknown, std::string("CGAL gave up: ") + error.what());
    }
  }

  void measure_distance(const StoredMesh& exact, double bound) {
    const double slack = rounding * scale(exact);
    const double vertices = vertex_distance(file_.result, exact);
    if (vertices > bound + slack)
      return add("distance", Answer::no, sentence("a vertex is ", vertices, " away; bound ", bound, ", rounding ", slack));
    Box3 box;
    for (const Vec3& p : exact.vertices) box.extend(p);
    const double precision = std::max(bound / 20, coarsest_precision * box.diagonal().norm());
    const double distance = hausdorff_distance(file_.result, exact, precision);
    add("distance", answer(distance <= bound + precision + slack),
        sentence("vertices at most ", vertices, ", surfaces ", distance, " with precision ", precision, "; bound ", bound,
                 ", rounding ", slack));
  }

  void check_volume(const StoredMesh& exact) {
    const double bound = bound_without_deflection();
    if (std::isinf(bound)) return add("volume", Answer::yes, "the bound is infinite: nothing is claimed");
    const double theirs = exact.triangles.empty() ? 0 : volume(exact);
    const double mine = file_.result.triangles.empty() ? 0 : volume(file_.result);
    const double distance = bound + rounding * scale(exact);
    const double allowed = std::max(collar(exact, distance), collar(file_.result, distance));
    add("volume", answer(std::abs(theirs - mine) <= allowed),
        sentence("the exact Boolean has ", theirs, ", the result differs by ", std::abs(theirs - mine), "; allowed ",
                 allowed));
  }

  void check_fields() {
    const bool asked =
        (!file_.error || *file_.error == c_.requested_error) && (!file_.contact || *file_.contact == c_.contact_tolerance);
    const bool within = c_.verdict == Verdict::unresolved || c_.error_bound <= c_.requested_error;
    add("error bound", answer(within && asked),
        sentence(c_.error_bound, within ? " is within " : " is above ", c_.requested_error,
                 asked ? "" : ", but the options ask for something else"));
    const bool listed = c_.verdict == Verdict::exact     ? c_.contacts.empty() && c_.unresolved.empty()
                        : c_.verdict == Verdict::contact ? !c_.contacts.empty() && c_.unresolved.empty()
                                                         : !c_.unresolved.empty();
    add("verdict", answer(listed),
        sentence(to_string(c_.verdict), " with ", c_.contacts.size(), " contacts and ", c_.unresolved.size(),
                 " unresolved cells"));
    std::vector<std::pair<std::string, double>> tessellated, claimed = c_.tessellated;
    for (const StoredOperand& operand : file_.operands)
      if (operand.deflection > 0) tessellated.emplace_back(operand.name, operand.deflection);
    std::sort(tessellated.begin(), tessellated.end());
    std::sort(claimed.begin(), claimed.end());
    add("tessellated", answer(tessellated == claimed),
        sentence(tessellated.size(), " operands are approximations, ", claimed.size(), " are declared"));
  }

  const CertificateFile& file_;
  const Certificate& c_;
  Answer operands_hold_ = Answer::yes;
  CheckReport report_;
};

}  // namespace

bool CheckReport::ok() const {
  return std::none_of(claims.begin(), claims.end(), [](const Claim& claim) { return claim.holds == Answer::no; });
}

bool CheckReport::complete() const {
  return std::all_of(claims.begin(), claims.end(), [](const Claim& claim) { return claim.holds == Answer::yes; });
}

CheckReport check_certificate(const CertificateFile& file) { return Check(file).run(); }

CheckReport check_certificate(const std::filesystem::path& path) { return check_certificate(read_certificate(path)); }

}  // namespace starcell
