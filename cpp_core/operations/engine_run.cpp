#include "operations/engine_run.h"

#include <algorithm>
#include <cmath>

#include "contouring/flat_regions.h"
#include "contouring/float_gaps.h"
#include "solids/errors.h"
#include "subdivision/root_box.h"

namespace starcell {
namespace {

// Cells stay this many grid units wide.
constexpr int smallest_cell_bits = 4;
// Late rounds are cheap: they mend a few cells where sheets run closely beside each other.
constexpr int most_rounds = 80;
constexpr int patient_rounds = 4;
constexpr std::size_t deep_for_a_look = 5000;
constexpr std::size_t deep_for_a_curved_look = 1000;
// With so many open places, those that float32 closes are not the trouble.
constexpr std::size_t hopeless = 500;
constexpr int levels_below_contact = 6;
// Up to this many leaves another position of the grid is cheaper than the exactness that one lost.
constexpr std::size_t small_tree = 5000;
// A region counts as much as this many facets when a budget of cells is made.
constexpr double regions_as_facets = 1000;

// Adds the seconds of its life to a statistic.
class Timed {
 public:
  explicit Timed(double& seconds) : seconds_(seconds) {}
  ~Timed() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void report(const Octree& tree, const FacetTable& table, Run& run) {
  for (const Leaf* leaf : tree.leaves()) {
    ++run.leaves;
    const Box3 box = box_of(run.grid, leaf->problem.cell);
    if (leaf->contact) run.contacts.push_back(box);
    if (leaf->resolved) continue;
    run.unresolved.push_back(box);
    const auto& solids = leaf->problem.expression.solids();
    if (solids.empty()) continue;
    const auto body = [&](std::uint32_t operand) { return table.is_region(operand) ? table.region(operand).body : operand; };
    if (body(solids.front()) != body(solids.back())) run.suspects.push_back({body(solids.front()), body(solids.back()), box.center()});
  }
}

}  // namespace

bool Engine::out_of_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() >= options_.budget.max_seconds;
}

void Engine::tell(double done, const std::string& stage) const {
  if (progress_ && !progress_(done, stage)) throw CancelledError("The run was cancelled.");
}

Run Engine::run(const FacetTable& table, double moved, int attempt, Effort effort) const {
  Run run;
  run.grid = choose_grid(box_, table, attempt);
  const Restriction restriction(table, run.grid);
  const AcceptanceSettings settings = acceptance_settings(table, run.grid, moved);
  Reporter reporter(progress_, "subdividing", 0, 0.8);
  Subdivision subdivision(restriction, settings, limits(run.grid, effort), statistics_, reporter);
  Octree tree;
  {
    const Timed timed(timings_["seconds.subdivide"]);
    tree = subdivision.build(restriction.root(operands_.expression.simplified(std::vector<State>(operands_.size(), State::mixed))));
  }
  const Timed timed(timings_["seconds.contour"]);
  Contour contour = refine_until_good(restriction, subdivision, tree, settings);
  timings_["grid_attempts"] += 1;
  run.grazes = grazes_grid(tree, contour.bound);
  run.exhausted = subdivision.exhausted();
  run.mesh = std::move(contour.mesh);
  run.bound = table.thickest + moved + contour.bound;
  report(tree, table, run);
  // A grid point on a curved surface: no sign there is certain, so nothing is proved.
  // (Where surfaces touch, small cells' corners lie on both: then no grid is better.)
  if (restriction.grid_grazes() && run.unresolved.empty()) run.grazes = true;
  if (run.grazes && restriction.grid_grazes()) run.unresolved.push_back(box_of(run.grid, {{0, 0, 0}, std::uint32_t{1} << run.grid.depth, 0}));
  return run;
}

Polish Engine::polish(Run& run) const {
  const Timed timed(timings_["seconds.merge"]);
  const GoOn go_on = [this] { return !progress_ || progress_(0.9, "merging flat regions"); };
  FlatMerge merge = merge_flat_regions(run.mesh, 1e-11 * scale(), go_on, [this] { return out_of_time(); });
  run.bound += merge.moved;
  if (!merge.embedded || !merge.depends_on_rounding) return {merge.embedded, {}, false};
  if (run.unresolved.size() > hopeless || out_of_time()) return {true, std::move(merge.meeting_as_floats), true};
  const double most = std::min(0.05 * tolerances_.error, 64 * run.grid.step);
  const FloatGaps gaps = open_float_gaps(run.mesh.vertices, run.mesh.triangles, most, go_on);
  run.bound += gaps.moved;
  if (gaps.opened) return {true, {}, false};
  return {true, std::move(merge.meeting_as_floats), true};
}

AcceptanceSettings Engine::acceptance_settings(const FacetTable& table, const Grid& grid, double moved) const {
  AcceptanceSettings settings;
  settings.pull = std::min(0.5 * tolerances_.contact, std::max(0.125 * tolerances_.contact, 16 * grid.step));
  settings.error = tolerances_.cells - 2 * table.thickest - moved;
  // Where V-planes cannot tell a feature's planes apart, smaller cells seldom help. And moved operands cross their own
  // edges at the scale of the move: nothing there is exact in any case.
  settings.smallest_feature = moved > 0 ? settings.error : 0.25 * settings.error;
  settings.criterion = options_.criterion;
  return settings;
}

SubdivisionLimits Engine::limits(const Grid& grid, Effort effort) const {
  SubdivisionLimits limits;
  limits.max_level = grid.depth - smallest_cell_bits;
  if (options_.budget.max_depth > 0) limits.max_level = std::min(limits.max_level, options_.budget.max_depth);
  limits.max_cells = options_.budget.max_cells > 0 ? options_.budget.max_cells : statistics_.cells.load() + cells_for(effort);
  limits.max_bytes = options_.budget.max_bytes;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  limits.max_seconds = options_.budget.max_seconds - elapsed.count();
  if (effort == Effort::a_look) limits.max_deep = operands_.regions.empty() ? deep_for_a_look : deep_for_a_curved_look;
  limits.deep_size = static_cast<std::uint32_t>(std::min(256 * grid.step / grid.unit, 1e9));
  if (!operands_.regions.empty() && effort == Effort::a_look) {
    // Where curved surfaces touch along a line, cells far below the contact tolerance tell nothing more.
    const double levels = std::log2(grid.length(std::uint32_t{1} << grid.depth) / tolerances_.contact);
    limits.max_level = std::min(limits.max_level, std::max(1, static_cast<int>(levels) + levels_below_contact));
    limits.deep_size = std::max(limits.deep_size, static_cast<std::uint32_t>(std::min(tolerances_.contact / grid.unit, 1e9)));
  }
  return limits;
}

// Generic inputs need a small part of this. Only operands that touch along curved faces, whose tessellations cross each
// other everywhere, need more, and those should end while one waits.
std::size_t Engine::cells_for(Effort effort) const {
  double facets = 0;
  for (const auto& solid : operands_.solids) facets += static_cast<double>(solid->triangles().size());
  for (const auto& solid : operands_.candidates) facets += static_cast<double>(solid->facets().size());
  facets += regions_as_facets * static_cast<double>(operands_.regions.size());
  if (effort == Effort::a_look) return static_cast<std::size_t>(1e5 + 3 * facets);
  const double across = std::isinf(tolerances_.error) ? 1 : longest_side(box_) / tolerances_.error;
  return static_cast<std::size_t>(std::min(5e7, 1.5e6 + 20 * facets + 20 * across * across));
}

// Every sheet is on planes through a point, and yet the fans are not E: a crossing or a corner lies within a float32
// step of a cell's side and was moved. In a small tree another grid is cheaper than the lost exactness (DESIGN §4).
bool Engine::grazes_grid(const Octree& tree, double bound) const {
  const std::vector<Leaf*> leaves = tree.leaves();
  if (leaves.size() > small_tree || bound <= 1e-11 * scale()) return false;
  for (const Leaf* leaf : leaves) {
    if (!leaf->resolved) return false;
    for (const Sheet& sheet : leaf->sheets)
      if (sheet.contact || sheet.shape == Sheet::Shape::slab || sheet.shape == Sheet::Shape::graph || sheet.shape == Sheet::Shape::loose) return false;
  }
  return true;
}

// Contouring names the leaves whose sheets do not serve; they are refined and all is contoured again. Small ones are
// first relaxed: where sheets nearly touch along a face, splitting would go on for ever.
Contour Engine::refine_until_good(const Restriction& restriction, Subdivision& subdivision, Octree& tree,
                                  const AcceptanceSettings& settings) const {
  const Grid& grid = restriction.grid();
  // Cells that subdivision left open stay open: what surrounds them is then only made good as far as it comes easily.
  const std::vector<Leaf*> leaves = tree.leaves();
  const bool open = std::any_of(leaves.begin(), leaves.end(), [](const Leaf* leaf) { return !leaf->resolved; });
  const int rounds = open ? patient_rounds : most_rounds;
  Contouring contouring(restriction, tree, {settings.error, settings.pull, [&] { tell(0.8, "contouring"); }});
  for (int round = 0;; ++round) {
    const std::vector<Cell> failed = contouring.round();
    timings_["contour_rounds"] = round + 1;
    bool changed = false;
    if (round < rounds && !subdivision.exhausted())
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

}  // namespace starcell
