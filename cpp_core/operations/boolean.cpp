#include "operations/boolean.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "certificate/topology.h"
#include "contouring/contour.h"
#include "contouring/flat_regions.h"
#include "contouring/float_gaps.h"
#include "operations/operands.h"
#include "solids/errors.h"
#include "subdivision/grazes.h"
#include "subdivision/root_box.h"
#include "subdivision/subdivide.h"

namespace starcell {
namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count(); }
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Cells stay this many grid units wide.
constexpr int smallest_cell_bits = 4;
constexpr int most_rounds = 24;
constexpr int patient_rounds = 4;
// How often another position of the grid is tried, and up to how many leaves.
constexpr int most_attempts = 5;
constexpr std::size_t small_tree = 5000;
constexpr std::ptrdiff_t few_planes = 64;
constexpr std::size_t least_leaves = 12;
// How often operands are moved when cells stay open, and how many deep cells the attempt before may cost.
constexpr int most_retries = 2;
constexpr std::size_t most_deep_unmoved = 5000;

struct Tolerances {
  double error;     // asked for, in all
  double contact;
  double inputs;    // largest deflection of an operand
  double cells;     // what contouring may deviate
  double pull;
};

Tolerances split_error(const Options& options, const Box3& box, const std::vector<PolyhedronPtr>& solids) {
  Tolerances t;
  const double length = longest_side(box);
  t.error = options.error.value_or(length / 128);
  if (!(t.error > 0)) throw std::invalid_argument("error: must be greater than 0");
  t.contact = options.contact.value_or(std::isinf(t.error) ? length / 12800 : t.error / 100);
  if (!(t.contact > 0) || std::isinf(t.contact)) throw std::invalid_argument("contact: must be greater than 0 and finite");
  t.inputs = 0;
  for (const auto& solid : solids) t.inputs = std::max(t.inputs, solid->provenance().deflection);
  // Rounding of plane equations and of the apexes: far above what double arithmetic can lose on coordinates this large.
  const double rounding = 4e-12 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  t.inputs += rounding;
  t.cells = t.error - t.inputs;
  if (!(t.cells > 0))
    throw std::invalid_argument("error: " + std::to_string(t.error) + " is not larger than the deflection of a tessellated operand, " +
                                std::to_string(t.inputs) + "; read that operand with a smaller error");
  return t;
}

void add_statistics(const Statistics& s, Certificate& c) {
  const auto put = [&](const char* name, const std::atomic<std::size_t>& n) {
    c.statistics[name] = static_cast<double>(n.load());
  };
  put("cells", s.cells), put("leaves", s.leaves), put("max_depth", s.max_depth);
  put("faces.link", s.face_link), put("faces.planes", s.face_planes), put("faces.split", s.face_split);
  put("faces.cone", s.face_cone), put("voxels.link", s.voxel_link), put("voxels.cone", s.voxel_cone);
  put("voxels.planes", s.voxel_planes), put("voxels.star", s.voxel_star), put("voxels.complex_cell", s.voxel_complex);
  put("guard_tests.witness", s.guard_witness), put("guard_tests.linear_program", s.guard_program);
  put("guard_tests.failed", s.guard_failed);
}

class Evaluation {
 public:
  Evaluation(const Expression& expression, const Options& options)
      : options_(options), box_(expression.bounding_box()), operands_(gather_operands(expression, padded(box_))),
        tolerances_(split_error(options, box_, operands_.solids)) {}

  Result run() {
    Certificate& c = result_.certificate;
    c.requested_error = tolerances_.error;
    c.contact_tolerance = tolerances_.contact;
    for (const auto& solid : operands_.solids)
      if (solid->provenance().deflection > 0)
        c.tessellated.emplace_back(solid->provenance().name, solid->provenance().deflection);
    c.error_bound = tolerances_.inputs;
    if (!box_.isEmpty() && box_.sizes().maxCoeff() > 0) mesh();
    count_topology(result_.vertices, result_.triangles, c);
    add_statistics(statistics_, c);
    c.statistics["triangles"] = static_cast<double>(result_.triangles.size());
    c.statistics["vertices"] = static_cast<double>(result_.vertices.size());
    c.statistics["seconds"] = total_.lap();
    tell(1.0, "done");
    return std::move(result_);
  }

 private:
  // Attempts start over; what is reported never goes back.
  bool report_progress(double done, const std::string& stage) {
    reported_ = std::max(reported_, done);
    return !options_.progress || options_.progress(reported_, stage);
  }

  void tell(double done, const std::string& stage) {
    if (!report_progress(done, stage)) throw CancelledError("The run was cancelled.");
  }

  static Box3 padded(const Box3& box) {
    if (box.isEmpty()) return Box3(Vec3::Zero(), Vec3::Ones());
    const Vec3 m = Vec3::Constant(2 * longest_side(box) + 1e-300);
    return {box.min() - m, box.max() + m};
  }

  // One run of the engine, before its mesh is taken over.
  struct Run {
    Grid grid;
    Contour contour;
    std::vector<Box3> unresolved, contacts;
    std::vector<Graze> suspects;   // unresolved cells that several operands reach
    double operands_moved = 0;
    std::size_t leaves = 0;
    bool exhausted = false;        // a budget ran out: another try would only cost more
    bool grazes = false;           // exactness was lost to the position of the grid
  };

  void mesh() {
    Certificate& c = result_.certificate;
    const double step = float_step(box_);
    const double identical = std::min(tolerances_.contact, 8 * step);
    FacetTable table = gather_facets(operands_.solids, identical);
    std::vector<Graze> grazes = std::move(table.grazes);
    c.statistics["seconds.prepare"] = watch_.lap();
    // As they are first: most contacts are told by the planes through them. What stays open at the smallest cells is tried
    // again with the operands moved off each other: any position is as good within the contact tolerance, and a generic one
    // comes to an end. Cells that stayed open name contacts that no vertex or edge showed.
    Run best = subdivide(table, 0);
    for (int retry = 0; retry <= most_retries && !best.unresolved.empty() && !out_of_budget(best); ++retry) {
      std::vector<Graze> all = grazes;
      if (retry > 0 || grazes.empty()) all.insert(all.end(), best.suspects.begin(), best.suspects.end());
      const double moved = move_apart(table, all, identical, retry);
      if (moved == 0) continue;
      Run next = subdivide(table, moved);
      if (next.unresolved.size() >= best.unresolved.size()) continue;
      grazes = std::move(all);
      best = std::move(next);
    }
    for (const Graze& g : grazes) {
      const Vec3 margin = Vec3::Constant(tolerances_.contact);
      best.contacts.emplace_back(g.place - margin, g.place + margin);
    }
    tell(0.9, "merging flat regions");
    finish(best);
    c.statistics["seconds.merge"] = watch_.lap();
  }

  // Budgets that the user set hold for all attempts together; ours are there to end one that leads nowhere.
  bool out_of_budget(const Run& run) const {
    const Budget& budget = options_.budget;
    return run.exhausted && (budget.max_cells > 0 || budget.max_bytes > 0 || !std::isinf(budget.max_seconds));
  }

  // Tries another position of the grid where the first one is unlucky and the tree small enough; keeps the smallest tree.
  Run subdivide(const FacetTable& table, double moved) {
    const bool few = few_surfaces(table);
    Run best = subdivide_once(table, moved, 0);
    for (int attempt = 1; attempt < most_attempts && (best.grazes || (few && best.leaves > least_leaves)); ++attempt) {
      Run next = subdivide_once(table, moved, attempt);
      if (next.unresolved.size() > best.unresolved.size() || (next.grazes && !best.grazes)) continue;
      if ((best.grazes && !next.grazes) || next.leaves < best.leaves) best = std::move(next);
    }
    return best;
  }

  // A polytope-like input: a better grid costs little to find and halves the tree.
  static bool few_surfaces(const FacetTable& table) {
    std::vector<std::uint32_t> ids = table.surface;
    std::sort(ids.begin(), ids.end());
    return std::unique(ids.begin(), ids.end()) - ids.begin() <= few_planes;
  }

  Run subdivide_once(const FacetTable& table, double moved, int attempt) {
    Certificate& c = result_.certificate;
    Run run;
    run.operands_moved = table.thickest + moved;
    run.grid = choose_grid(box_, table, attempt);
    const Restriction restriction(table, run.grid);
    const AcceptanceSettings settings = acceptance_settings(table, run.grid, moved);
    const Progress progress = [this](double done, const std::string& stage) { return report_progress(done, stage); };
    Reporter reporter(progress, "subdividing", 0, 0.8);
    Subdivision subdivision(restriction, settings, limits_of(run.grid, moved), statistics_, reporter);
    Octree tree = subdivision.build(restriction.root(operands_.expression.simplified(
        std::vector<State>(operands_.solids.size(), State::mixed))));
    c.statistics["seconds.subdivide"] += watch_.lap();
    run.contour = refine_until_good(restriction, subdivision, tree, settings);
    c.statistics["seconds.contour"] += watch_.lap();
    c.statistics["grid_attempts"] += 1;
    run.grazes = grazes_grid(tree, run.contour);
    run.exhausted = subdivision.exhausted();
    report(tree, table, run);
    return run;
  }

  static void report(const Octree& tree, const FacetTable& table, Run& run) {
    for (const Leaf* leaf : tree.leaves()) {
      ++run.leaves;
      const Box3 box = box_of(run.grid, leaf->problem.cell);
      if (leaf->contact) run.contacts.push_back(box);
      if (leaf->resolved) continue;
      run.unresolved.push_back(box);
      const auto& facets = leaf->problem.facets;
      if (facets.empty()) continue;
      const std::uint32_t first = table.operand_of(facets.front()), last = table.operand_of(facets.back());
      if (first != last) run.suspects.push_back({first, last, box.center()});
    }
  }

  double scale() const { return std::max(box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff()); }

  AcceptanceSettings acceptance_settings(const FacetTable& table, const Grid& grid, double moved) const {
    AcceptanceSettings settings;
    settings.pull = std::min(0.5 * tolerances_.contact, std::max(0.125 * tolerances_.contact, 16 * grid.step));
    settings.error = tolerances_.cells - 2 * table.thickest - moved;
    // Where V-planes cannot tell a feature's planes apart, smaller cells seldom help. And moved operands cross their own
    // edges at the scale of the move: nothing there is exact in any case.
    settings.smallest_feature = moved > 0 ? settings.error : 0.25 * settings.error;
    settings.criterion = options_.criterion;
    return settings;
  }

  SubdivisionLimits limits_of(const Grid& grid, double moved) const {
    SubdivisionLimits limits;
    limits.max_level = grid.depth - smallest_cell_bits;
    if (options_.budget.max_depth > 0) limits.max_level = std::min(limits.max_level, options_.budget.max_depth);
    limits.max_cells = options_.budget.max_cells > 0 ? options_.budget.max_cells : statistics_.cells.load() + usual_cells();
    limits.max_bytes = options_.budget.max_bytes;
    limits.max_seconds = options_.budget.max_seconds - total_.seconds();
    if (moved == 0) limits.max_deep = most_deep_unmoved;
    limits.deep_size = static_cast<std::uint32_t>(std::min(256 * grid.step / grid.unit, 1e9));
    return limits;
  }

  // Generic inputs need a small part of this. Only operands that touch along curved faces, whose tessellations cross each
  // other everywhere, need more, and those should end while one waits.
  std::size_t usual_cells() const {
    double facets = 0;
    for (const auto& solid : operands_.solids) facets += static_cast<double>(solid->triangles().size());
    const double across = std::isinf(tolerances_.error) ? 1 : longest_side(box_) / tolerances_.error;
    return static_cast<std::size_t>(std::min(5e7, 1.5e6 + 20 * facets + 20 * across * across));
  }

  // Every sheet is on planes through a point, and yet the fans are not E: a crossing or a corner lies within a float32
  // step of a cell's side and was moved. In a small tree another grid is cheaper than the lost exactness (DESIGN §4).
  bool grazes_grid(const Octree& tree, const Contour& contour) const {
    const std::vector<Leaf*> leaves = tree.leaves();
    if (leaves.size() > small_tree || contour.bound <= 1e-11 * scale()) return false;
    for (const Leaf* leaf : leaves) {
      if (!leaf->resolved) return false;
      for (const Sheet& sheet : leaf->sheets)
        if (sheet.contact || sheet.shape == Sheet::Shape::slab || sheet.shape == Sheet::Shape::loose) return false;
    }
    return true;
  }

  // Operands that graze each other are moved apart by less than the contact tolerance: the result is then that of a
  // slightly moved input, and says so. Returns how far; 0 if nothing was moved and the table is as it was.
  double move_apart(FacetTable& table, const std::vector<Graze>& grazes, double identical, int attempt) const {
    if (grazes.empty()) return 0;
    double moved = 0;
    const std::vector<Vec3> shifts = shifts_off_grazes(table, grazes, 0.25 * tolerances_.contact, attempt);
    for (const Vec3& shift : shifts) moved = std::max(moved, shift.norm());
    if (moved > 0) table = gather_facets(operands_.solids, identical, shifts);
    return moved;
  }

  // Contouring names the leaves whose sheets do not serve; they are refined and all is contoured again. Small ones are
  // first relaxed: where sheets nearly touch along a face, splitting would go on for ever.
  Contour refine_until_good(const Restriction& restriction, Subdivision& subdivision, Octree& tree,
                            const AcceptanceSettings& settings) {
    const Grid& grid = restriction.grid();
    Contouring contouring(restriction, tree, {settings.error, settings.pull, [&] { tell(0.8, "contouring"); }});
    for (int round = 0;; ++round) {
      const std::vector<Cell> failed = contouring.round();
      result_.certificate.statistics["contour_rounds"] = round + 1;
      bool changed = false;
      if (round < most_rounds && !subdivision.exhausted())
        for (const Cell& cell : failed) {
          const bool relax = (round >= patient_rounds || grid.length(cell.size) < 4096 * grid.step) && !contouring.is_relaxed(cell);
          if (relax) contouring.relax(cell);
          changed = relax || subdivision.refine(tree, cell) || changed;
        }
      if (!changed) {
        for (const Cell& cell : failed) {
          OctreeNode* node = tree.node_of(cell);
          if (node->leaf) node->leaf->resolved = false;
        }
        return contouring.take();
      }
    }
  }

  // Merges flat regions and takes the mesh over if it is what every verdict promises: closed, manifold, embedded. Only
  // cells that a budget left open can spoil that; then no mesh is better than a wrong one.
  void finish(Run& run) {
    Certificate& c = result_.certificate;
    SurfaceMesh& mesh = run.contour.mesh;
    const FlatMerge merge = merge_flat_regions(mesh, 1e-11 * scale(), [this] { return report_progress(0.9, "merging flat regions"); });
    bool floats_meet = !merge.meeting_as_floats.empty();
    c.error_bound = tolerances_.inputs + run.operands_moved + run.contour.bound + merge.moved;
    c.unresolved = std::move(run.unresolved);
    c.contacts = std::move(run.contacts);
    statistics_.leaves = run.leaves;
    if (merge.embedded && floats_meet) {
      const FloatGaps gaps = open_float_gaps(mesh.vertices, mesh.triangles, std::min(0.05 * tolerances_.error, 64 * run.grid.step));
      c.error_bound += gaps.moved;
      floats_meet = !gaps.opened;
    }
    if (merge.embedded) {
      if (floats_meet) c.unresolved.insert(c.unresolved.end(), merge.meeting_as_floats.begin(), merge.meeting_as_floats.end());
      result_.vertices = std::move(mesh.vertices);
      result_.triangles = std::move(mesh.triangles);
    } else {
      c.error_bound = std::numeric_limits<double>::infinity();
      c.unresolved.push_back(box_of(run.grid, {{0, 0, 0}, std::uint32_t{1} << run.grid.depth, 0}));
    }
    if (!c.contacts.empty()) c.verdict = Verdict::contact;
    if (!c.unresolved.empty()) c.verdict = Verdict::unresolved;
  }

  const Options& options_;
  const Box3 box_;
  const Operands operands_;
  const Tolerances tolerances_;
  Statistics statistics_;
  Stopwatch watch_, total_;
  double reported_ = 0;
  Result result_;
};

}  // namespace

Result evaluate(const Expression& expression, const Options& options) {
  if (options.threads < 0) throw std::invalid_argument("threads: must not be negative");
  if (options.threads == 0) return Evaluation(expression, options).run();
  tbb::task_arena arena(options.threads);
  return arena.execute([&] { return Evaluation(expression, options).run(); });
}

}  // namespace starcell
