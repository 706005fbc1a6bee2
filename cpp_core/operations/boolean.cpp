#include "operations/boolean.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "certificate/topology.h"
#include "operations/engine_run.h"
#include "solids/errors.h"
#include "subdivision/grazes.h"
#include "subdivision/root_box.h"

namespace starcell {
namespace {

// How often another position of the grid is tried where that may pay: for a smaller tree as long as few leaves are made in
// all, for exactness, and for sheets that the first position left too near to each other for float32.
constexpr int most_attempts = 16;
constexpr std::size_t most_work = 2000;
constexpr int most_exact_attempts = 5;
constexpr int most_float_attempts = 3;
constexpr std::size_t few_places = 300;
constexpr std::size_t triangles_to_a_place = 100;
constexpr std::ptrdiff_t few_planes = 64;
constexpr std::size_t least_leaves = 12;
// How often operands are moved when cells stay open. More open cells than this are no contact at a few places.
constexpr int most_retries = 3;
constexpr std::size_t hopeless = 500;

void add_statistics(const Statistics& s, Certificate& c) {
  const auto put = [&](const char* name, const std::atomic<std::size_t>& n) {
    c.statistics[name] = static_cast<double>(n.load());
  };
  put("cells", s.cells), put("leaves", s.leaves), put("max_depth", s.max_depth);
  put("faces.link", s.face_link), put("faces.planes", s.face_planes), put("faces.split", s.face_split);
  put("faces.cone", s.face_cone), put("faces.star", s.face_star), put("voxels.patches", s.voxel_patches), put("voxels.link", s.voxel_link), put("voxels.cone", s.voxel_cone);
  put("voxels.planes", s.voxel_planes), put("voxels.star", s.voxel_star), put("voxels.complex_cell", s.voxel_complex);
  put("guard_tests.witness", s.guard_witness), put("guard_tests.linear_program", s.guard_program);
  put("guard_tests.failed", s.guard_failed);
}

std::vector<PolyhedronPtr> all_polyhedra(const Operands& operands) {
  std::vector<PolyhedronPtr> all = operands.solids;
  all.insert(all.end(), operands.sources.begin(), operands.sources.end());
  return all;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Evaluation {
 public:
  Evaluation(const Expression& expression, const Options& options)
      : options_(options), box_(expression.bounding_box()), operands_(gather_operands(expression, padded(box_))),
        tolerances_(split_error(options, box_, deflection_of(operands_))),
        progress_([this](double done, const std::string& stage) { return report_progress(done, stage); }),
        engine_(operands_, options, box_, tolerances_, progress_, statistics_, result_.certificate.statistics) {}

  Result run() {
    Certificate& c = result_.certificate;
    c.requested_error = tolerances_.error;
    c.contact_tolerance = tolerances_.contact;
    std::vector<Box3> open_operands, contacts;
    for (const auto& solid : all_polyhedra(operands_)) {
      const Provenance& from = solid->provenance();
      if (from.deflection > 0) c.tessellated.emplace_back(from.name, from.proved_deflection());
      open_operands.insert(open_operands.end(), from.unresolved.begin(), from.unresolved.end());
      contacts.insert(contacts.end(), from.contacts.begin(), from.contacts.end());
    }
    c.error_bound = tolerances_.inputs;
    if (!box_.isEmpty() && box_.sizes().maxCoeff() > 0) mesh();
    if (!contacts.empty()) {
      if (c.verdict == Verdict::exact) c.verdict = Verdict::contact;
      c.contacts.insert(c.contacts.end(), contacts.begin(), contacts.end());
    }
    if (!open_operands.empty()) {   // what was not proved of an operand is not proved of the result
      c.verdict = Verdict::unresolved;
      c.error_bound = std::numeric_limits<double>::infinity();
      c.unresolved.insert(c.unresolved.end(), open_operands.begin(), open_operands.end());
    }
    count_topology(result_.vertices, result_.triangles, c);
    add_statistics(statistics_, c);
    for (const auto& solid : operands_.candidates) c.statistics["candidates"] += static_cast<double>(solid->facets().size());
    c.statistics["triangles"] = static_cast<double>(result_.triangles.size());
    c.statistics["vertices"] = static_cast<double>(result_.vertices.size());
    c.statistics["seconds"] = seconds_since(start_);
    report_progress(1.0, "done");
    return std::move(result_);
  }

 private:
  // Attempts start over; what is reported never goes back.
  bool report_progress(double done, const std::string& stage) {
    reported_ = std::max(reported_, done);
    return !options_.progress || options_.progress(reported_, stage);
  }

  static Box3 padded(const Box3& box) {
    if (box.isEmpty()) return Box3(Vec3::Zero(), Vec3::Ones());
    const Vec3 m = Vec3::Constant(2 * longest_side(box) + 1e-300);
    return {box.min() - m, box.max() + m};
  }

  // A run, where its operands stood, and the contacts that put them there.
  struct Try {
    Run run;
    std::vector<Vec3> shifts;
    std::vector<Graze> grazes;
  };

  void mesh() {
    const std::vector<Graze> grazes = table_at({}).grazes;
    result_.certificate.statistics["seconds.prepare"] = seconds_since(start_);
    Try best = settle(grazes);
    Polish polish = engine_.polish(best.run);
    if (best.run.unresolved.empty()) keep_apart_as_floats(best, polish);
    deliver(best.run, polish, best.grazes);
  }

  // As they are first: most contacts are told by the planes through them. What stays open at the smallest cells, or costs too
  // much, is tried again with the operands moved off each other: any position is as good within the contact tolerance, and a
  // generic one comes to an end. Cells that stayed open name contacts that no vertex or edge showed.
  Try settle(const std::vector<Graze>& grazes) {
    // Curved surfaces may touch without any vertex or edge that shows it.
    const bool look = !grazes.empty() || (!operands_.regions.empty() && operands_.size() > 1);
    Try best{best_run({}, look ? Engine::Effort::a_look : Engine::Effort::usual), {}, grazes};
    bool cut_short = look && !best.run.unresolved.empty();
    if (cut_short && best.run.exhausted && grazes.empty() && is_open(best)) {
      // Many cells, but none at the contact tolerance: nearly a contact, and no reason yet to move anything.
      Run next = best_run({}, Engine::Effort::usual);
      if (next.unresolved.size() < best.run.unresolved.size()) best.run = std::move(next);
      cut_short = false;
    }
    for (int retry = 0; retry < most_retries && is_open(best); ++retry) {
      if (retry > 0 && best.run.unresolved.size() > hopeless) break;
      std::vector<Graze> all = best.grazes;
      if (retry > 0 || grazes.empty()) all.insert(all.end(), best.run.suspects.begin(), best.run.suspects.end());
      const std::vector<Vec3> shifts = shifts_off_grazes(table_at(best.shifts), all, 0.25 * tolerances_.contact, retry);
      if (farthest(shifts) == 0) continue;
      Run next = best_run(shifts, Engine::Effort::usual);
      if (next.unresolved.size() < best.run.unresolved.size()) best = {std::move(next), shifts, std::move(all)};
    }
    if (cut_short && is_open(best)) {
      Run next = best_run({}, Engine::Effort::usual);
      if (next.unresolved.size() < best.run.unresolved.size()) best = {std::move(next), {}, grazes};
    }
    return best;
  }

  bool is_open(const Try& t) const { return !t.run.unresolved.empty() && !out_of_budget(t.run); }

  // Sheets that float32 brings together are a contact that could be told as it was, and operands moved off each other are
  // farther apart; or they run along a plane of the grid, and another position may leave more room between them.
  void keep_apart_as_floats(Try& best, Polish& polish) {
    const auto try_instead = [&](Run next, const std::vector<Vec3>& shifts) {
      if (next.unresolved.size() > best.run.unresolved.size()) return;
      Polish other = engine_.polish(next);
      if (!other.embedded || other.meet_as_floats.size() > polish.meet_as_floats.size()) return;
      if (other.meet_as_floats.size() == polish.meet_as_floats.size() && other.tight >= polish.tight) return;
      best.run = std::move(next);
      best.shifts = shifts;
      polish = std::move(other);
    };
    if (out_of_time()) return;
    if (polish.tight && !best.grazes.empty() && best.shifts.empty()) {
      const std::vector<Vec3> shifts = shifts_off_grazes(table_at({}), best.grazes, 0.25 * tolerances_.contact);
      if (farthest(shifts) > 0) try_instead(best_run(shifts, Engine::Effort::usual), shifts);
    }
    if (polish.meet_as_floats.size() > std::max(few_places, best.run.mesh.triangles.size() / triangles_to_a_place)) return;
    for (int attempt = 0; attempt < most_float_attempts && !polish.meet_as_floats.empty() && !out_of_time(); ++attempt)
      try_instead(engine_.run(table_at(best.shifts), farthest(best.shifts), most_attempts + attempt), best.shifts);
  }

  // The operands' facets where the operands are moved by `shifts`, or as they are if there are none.
  const FacetTable& table_at(const std::vector<Vec3>& shifts) {
    if (!table_ || table_shifts_ != shifts) {
      table_.reset();   // two at once would be the peak of memory
      table_ = gather_facets(operands_.solids, identical(), shifts, operands_.regions, operands_.candidates);
      table_shifts_ = shifts;
    }
    return *table_;
  }

  // What lies this near counts as one: a float32 step and more, unless contacts are finer than that.
  double identical() const { return std::min(tolerances_.contact, 2 * float_step(box_)); }

  static double farthest(const std::vector<Vec3>& shifts) {
    double far = 0;
    for (const Vec3& shift : shifts) far = std::max(far, shift.norm());
    return far;
  }

  // Budgets that the user set hold for all attempts together; ours are there to end one that leads nowhere.
  bool out_of_budget(const Run& run) const {
    const Budget& budget = options_.budget;
    return out_of_time() ||
           (run.exhausted && (budget.max_bytes > 0 || (budget.max_cells > 0 && statistics_.cells.load() >= budget.max_cells)));
  }

  // No attempt is begun any more; what there is is still made a mesh.
  bool out_of_time() const { return seconds_since(start_) >= options_.budget.max_seconds; }

  // Tries another position of the grid where the first one is unlucky and the tree small enough; keeps the smallest tree.
  Run best_run(const std::vector<Vec3>& shifts, Engine::Effort effort) {
    const FacetTable& table = table_at(shifts);
    const double moved = farthest(shifts);
    const bool few = few_surfaces(table);
    Run best = engine_.run(table, moved, 0, effort);
    std::size_t work = best.leaves;
    for (int attempt = 1; attempt < most_attempts && !out_of_time(); ++attempt) {
      const bool smaller = few && best.leaves > least_leaves && work < most_work;
      // One solid alone touches nothing: what is open then is a line of the grid along its surface, as round numbers have it.
      const bool unlucky = best.grazes || (!table.regions.empty() && !best.unresolved.empty() && best.suspects.empty() && !out_of_budget(best));
      if (!smaller && !(unlucky && attempt < most_exact_attempts)) break;
      Run next = engine_.run(table, moved, attempt, effort);
      work += next.leaves;
      if (next.unresolved.size() > best.unresolved.size() || (next.grazes && !best.grazes)) continue;
      if ((best.grazes && !next.grazes) || next.leaves < best.leaves) best = std::move(next);
    }
    return best;
  }

  // A polytope-like input: a better grid costs little to find and halves the tree.
  static bool few_surfaces(const FacetTable& table) {
    std::vector<std::uint32_t> ids = table.surface;
    std::sort(ids.begin(), ids.end());
    return table.regions.empty() && std::unique(ids.begin(), ids.end()) - ids.begin() <= few_planes;
  }

  // Takes the mesh over if it is what every verdict promises: closed, manifold, embedded. Only cells that a budget left open
  // can spoil that; then no mesh is better than a wrong one.
  void deliver(Run& run, const Polish& polish, const std::vector<Graze>& grazes) {
    Certificate& c = result_.certificate;
    statistics_.leaves = run.leaves;
    c.error_bound = tolerances_.inputs + run.bound;
    c.contacts = std::move(run.contacts);
    for (const Graze& g : grazes) {
      const Vec3 margin = Vec3::Constant(tolerances_.contact);
      c.contacts.emplace_back(g.place - margin, g.place + margin);
    }
    c.unresolved = std::move(run.unresolved);
    if (polish.embedded) {
      c.unresolved.insert(c.unresolved.end(), polish.meet_as_floats.begin(), polish.meet_as_floats.end());
      result_.vertices = std::move(run.mesh.vertices);
      result_.triangles = std::move(run.mesh.triangles);
    } else {
      c.error_bound = std::numeric_limits<double>::infinity();
      c.unresolved.push_back(box_of(run.grid, {{0, 0, 0}, std::uint32_t{1} << run.grid.depth, 0}));
    }
    if (!c.contacts.empty()) c.verdict = Verdict::contact;
    if (!c.unresolved.empty()) c.verdict = Verdict::unresolved;
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const Options& options_;
  const Box3 box_;
  const Operands operands_;
  const Tolerances tolerances_;
  Statistics statistics_;
  std::optional<FacetTable> table_;
  std::vector<Vec3> table_shifts_;
  double reported_ = 0;
  Result result_;
  const Progress progress_;
  const Engine engine_;
};

}  // namespace

Result evaluate(const Expression& expression, const Options& options) {
  if (options.threads < 0) throw std::invalid_argument("threads: must not be negative");
  if (options.threads == 0) return Evaluation(expression, options).run();
  tbb::task_arena arena(options.threads);
  return arena.execute([&] { return Evaluation(expression, options).run(); });
}

}  // namespace starcell
