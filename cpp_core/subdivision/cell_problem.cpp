#include "subdivision/cell_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/predicates.h"
#include "subdivision/candidate_regions.h"
#include "subdivision/grid_line.h"

namespace starcell {
namespace {

std::uint64_t fresh_name() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

std::uint32_t Restriction::slot_of(const CellProblem& problem, std::uint32_t facet) const {
  const auto& solids = problem.expression.solids();
  if (solids.size() == 1) return 0;
  const std::uint32_t operand = table_.operand_of(facet);
  return static_cast<std::uint32_t>(std::lower_bound(solids.begin(), solids.end(), operand) - solids.begin());
}

Membership CellProblem::candidates(const FacetTable& table) const {
  Membership mask = 0;
  if (table.candidates.empty()) return mask;
  for (std::size_t slot = 0; slot < std::min(slots(), max_slots); ++slot)
    if (table.candidate(expression.solids()[slot])) mask |= Membership{1} << slot;
  return mask;
}

Restriction::Restriction(const FacetTable& table, const Grid& grid) : table_(table), grid_(grid), name_(fresh_name()) {}

// A cell's questions come one after the other in one thread: what was learned of its regions is kept until another cell's come.
std::optional<bool> Restriction::candidate_contains(const CellProblem& problem, std::size_t slot, const Vec3& x) const {
  struct Last {
    std::uint64_t restriction = 0;
    std::optional<CandidateRegions> regions;
  };
  thread_local Last last;
  if (last.restriction != name_ || !last.regions || !last.regions->are_of(problem)) {
    last.restriction = name_;
    last.regions.emplace(table_, problem);
  }
  return last.regions->contains(slot, x);
}

State Restriction::candidate_state(const CellProblem& problem, std::size_t slot, const Box3& box, bool any) const {
  const std::uint32_t operand = problem.expression.solids()[slot];
  const CandidateSolid& solid = *table_.candidate(operand);
  const Vec3& shift = table_.shifts[operand];
  if (any) {
    const auto constant = solid.constant(Box3(box.min() - shift, box.max() - shift));
    return constant ? (*constant ? State::inside : State::outside) : State::mixed;
  }
  // Without a facet membership is the same everywhere; places where it is uncertain are few.
  for (const Vec3& at : {Vec3(0.5, 0.5, 0.5), Vec3(0.31, 0.43, 0.59), Vec3(0.67, 0.29, 0.37), Vec3(0.41, 0.73, 0.23), Vec3(0.83, 0.61, 0.79)})
    if (const auto inside = candidate_contains(problem, slot, box.min() + at.cwiseProduct(box.sizes()))) return *inside ? State::inside : State::outside;
  grazes_.store(true, std::memory_order_relaxed);
  return State::outside;
}

bool Restriction::candidate_at(const CellProblem& problem, std::size_t slot, const Vec3& x) const {
  const auto inside = candidate_contains(problem, slot, x);
  if (!inside) grazes_.store(true, std::memory_order_relaxed);
  return inside.value_or(false);
}

const SmoothSurface* Restriction::form_of(const CellProblem& problem, std::size_t slot) const {
  if (!problem.forms.empty() && problem.forms[slot]) return problem.forms[slot].get();
  return table_.surfaces[table_.region(problem.expression.solids()[slot]).surface].form.get();
}

// Most surfaces are as good everywhere: `forms` stays empty where all are.
void Restriction::restrict_forms(CellProblem& problem, const CellProblem* parent, const Box3& box) const {
  for (std::size_t slot = 0; slot < problem.slots(); ++slot) {
    if (!table_.is_region(problem.expression.solids()[slot])) continue;
    const SmoothSurface* form = form_of(parent ? *parent : problem, slot);
    SmoothSurfacePtr here = form ? form->restricted(box) : nullptr;
    if (!here && (!parent || parent->forms.empty() || !parent->forms[slot])) continue;
    problem.forms.resize(problem.slots());
    problem.forms[slot] = here ? std::move(here) : parent->forms[slot];
  }
}

Expansion Restriction::expand(const CellProblem& problem, std::size_t slot, const Vec3& center, const Vec3& reach) const {
  const SmoothSurface* form = form_of(problem, slot);
  return form ? form->expand(center, reach) : table_.surfaces[table_.region(problem.expression.solids()[slot]).surface].expand(center, reach);
}

bool Restriction::region_contains(const CellProblem& problem, std::size_t slot, const Vec3& x) const {
  const Rounding rounding;
  const Interval value = expand(problem, slot, x, Vec3::Zero()).value;
  if (certain_sign(value) == 0) grazes_.store(true, std::memory_order_relaxed);
  return (middle(value) < 0) != table_.region(problem.expression.solids()[slot]).complement;
}

State Restriction::region_state(const CellProblem& problem, std::size_t slot, const Box3& box) const {
  const Rounding rounding;
  const int sign = certain_sign(expand(problem, slot, box.center(), 0.5 * box.sizes()).range());
  if (sign == 0) return State::mixed;
  return (sign < 0) != table_.region(problem.expression.solids()[slot]).complement ? State::inside : State::outside;
}

CellProblem Restriction::root(const LocalExpression& expression) const {
  CellProblem problem;
  problem.cell = {{0, 0, 0}, std::uint32_t{1} << grid_.depth, 0};
  problem.expression = expression;
  problem.at_lower.assign(expression.solids().size(), 0);
  const Box3 box = box_of(grid_, problem.cell);
  restrict_forms(problem, nullptr, box);
  for (std::size_t slot = 0; slot < expression.solids().size(); ++slot) {
    const std::uint32_t operand = expression.solids()[slot];
    if (table_.is_region(operand)) {
      problem.at_lower[slot] = region_contains(problem, slot, box.min());
      continue;
    }
    const bool candidate = table_.candidate(operand) != nullptr;
    for (std::uint32_t f = table_.first[operand]; f < table_.first[operand + 1]; ++f) {
      // Outside far away: parity along the line that leaves the root's lower corner downwards.
      const int sign = line_meets(table_, f, 0, box.min());
      if (!candidate && sign != 0 && crossing_below(table_, f, sign, box.min())) problem.at_lower[slot] ^= 1;
      if (box_meets_facet(table_, f, box)) problem.facets.push_back(f);
    }
  }
  simplify(problem);
  return problem;
}

void Restriction::simplify(CellProblem& problem) const {
  const std::size_t slots = problem.slots();
  std::vector<State> states(slots);
  bool fold = false;
  std::size_t at = 0;
  const Box3 box = box_of(grid_, problem.cell);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (table_.is_region(problem.expression.solids()[slot])) {
      states[slot] = region_state(problem, slot, box);
      fold = fold || states[slot] != State::mixed;
      continue;
    }
    const std::uint32_t end = table_.first[problem.expression.solids()[slot] + 1];
    const std::size_t begin = at;
    while (at < problem.facets.size() && problem.facets[at] < end) {
      if (slots == 1) {
        at = problem.facets.size();
        break;
      }
      at = std::lower_bound(problem.facets.begin() + static_cast<std::ptrdiff_t>(at), problem.facets.end(), end) -
           problem.facets.begin();
    }
    if (table_.candidate(problem.expression.solids()[slot])) {
      states[slot] = candidate_state(problem, slot, box, at > begin);
      fold = fold || states[slot] != State::mixed;
    } else if (at > begin) {
      states[slot] = State::mixed;
    } else {
      states[slot] = problem.at_lower[slot] ? State::inside : State::outside;
      fold = true;
    }
  }
  if (!fold) return;
  LocalExpression next = problem.expression.simplified(states);
  // Solids can also vanish without being constant themselves: an inside union operand makes its siblings irrelevant.
  std::vector<char> at_lower;
  std::vector<SmoothSurfacePtr> forms;
  std::vector<std::uint32_t> facets;
  std::size_t old_slot = 0;
  for (const std::uint32_t solid : next.solids()) {
    while (problem.expression.solids()[old_slot] != solid) ++old_slot;
    at_lower.push_back(problem.at_lower[old_slot]);
    if (!problem.forms.empty()) forms.push_back(problem.forms[old_slot]);
    if (table_.is_region(solid)) continue;
    const auto first = std::lower_bound(problem.facets.begin(), problem.facets.end(), table_.first[solid]);
    const auto last = std::lower_bound(first, problem.facets.end(), table_.first[solid + 1]);
    facets.insert(facets.end(), first, last);
  }
  problem.facets = std::move(facets);
  problem.at_lower = std::move(at_lower);
  problem.forms = std::move(forms);
  problem.expression = std::move(next);
}

std::array<CellProblem, 8> Restriction::children(const CellProblem& parent) const {
  std::array<CellProblem, 8> result;
  std::array<Box3, 8> boxes;
  for (int i = 0; i < 8; ++i) {
    result[i].cell = parent.cell.child(i);
    result[i].expression = parent.expression;
    boxes[i] = box_of(grid_, result[i].cell);
    restrict_forms(result[i], &parent, boxes[i]);
  }
  const std::size_t slots = parent.slots();
  // The children's lower corners are reached from the parent's by seven segments: 0-1, then 0-2 and 1-3, then 0..3 up.
  const Vec3 lower = boxes[0].min(), middle = boxes[7].min();
  std::array<Vec3, 7> from;
  const std::array<int, 7> axis{0, 1, 1, 2, 2, 2, 2};
  for (int s = 0; s < 7; ++s) {
    const int corner = s == 0 ? 0 : s < 3 ? s - 1 : s - 3;
    from[s] = {corner & 1 ? middle[0] : lower[0], corner & 2 ? middle[1] : lower[1], lower[2]};
  }
  std::vector<std::uint8_t> flips(slots, 0);  // bit s: the solid flips along segment s
  // What rounding moved a candidate facet by counts as reached.
  const Vec3 pad = Vec3::Constant(table_.thickest);
  std::size_t slot = 0;
  for (const std::uint32_t f : parent.facets) {
    if (slots > 1)
      while (f >= table_.first[parent.expression.solids()[slot] + 1]) ++slot;
    const bool candidate = table_.candidate(parent.expression.solids()[slot]) != nullptr;
    const Box3 box = candidate ? Box3(table_.box(f).min() - pad, table_.box(f).max() + pad) : table_.box(f);
    int low = 0, high = 0;  // bit k: the facet's box reaches the lower / upper half along axis k
    for (int k = 0; k < 3; ++k) {
      if (box.min()[k] <= middle[k]) low |= 1 << k;
      if (box.max()[k] > middle[k]) high |= 1 << k;
    }
    if ((low ^ high) == 7) {
      result[high].facets.push_back(f);  // its box, and so the facet, meets one child only
    } else {
      for (int i = 0; i < 8; ++i) {
        if ((i & ~high) || (~i & 7 & ~low)) continue;
        if (box_meets_facet(table_, f, candidate ? Box3(boxes[i].min() - pad, boxes[i].max() + pad) : boxes[i])) result[i].facets.push_back(f);
      }
    }
    for (int s = 0; s < 7 && !candidate; ++s) {
      const int a = axis[s], x = (a + 1) % 3, y = (a + 2) % 3;
      if (box.max()[x] <= from[s][x] || box.min()[x] > from[s][x] || box.max()[y] <= from[s][y] ||
          box.min()[y] > from[s][y] || box.max()[a] <= from[s][a] || box.min()[a] > middle[a])
        continue;
      if (segment_crosses(table_, f, a, from[s], middle[a])) flips[slot] ^= static_cast<std::uint8_t>(1 << s);
    }
  }
  for (std::size_t k = 0; k < slots; ++k) {
    if (table_.is_region(parent.expression.solids()[k])) {
      for (int i = 0; i < 8; ++i) result[i].at_lower.push_back(i == 0 ? parent.at_lower[k] : region_contains(result[i], k, boxes[i].min()));
      continue;
    }
    std::array<char, 8> inside{};
    inside[0] = parent.at_lower[k];
    inside[1] = inside[0] ^ (flips[k] & 1);
    inside[2] = inside[0] ^ (flips[k] >> 1 & 1);
    inside[3] = inside[1] ^ (flips[k] >> 2 & 1);
    for (int i = 0; i < 4; ++i) inside[4 + i] = inside[i] ^ (flips[k] >> (3 + i) & 1);
    for (int i = 0; i < 8; ++i) result[i].at_lower.push_back(inside[i]);
  }
  for (CellProblem& child : result) simplify(child);
  return result;
}

std::vector<char> Restriction::membership_at(const CellProblem& problem, const GridPoint& p) const {
  std::vector<char> inside = problem.at_lower;
  Vec3 at = grid_.point(problem.cell.lower);
  const Vec3 target = grid_.point(p);
  for (int axis = 0; axis < 3; ++axis) {
    if (target[axis] == at[axis]) continue;
    std::size_t slot = 0;
    for (const std::uint32_t f : problem.facets) {
      if (problem.slots() > 1)
        while (f >= table_.first[problem.expression.solids()[slot] + 1]) ++slot;
      if (segment_crosses(table_, f, axis, at, target[axis])) inside[slot] ^= 1;
    }
    at[axis] = target[axis];
  }
  for (std::size_t slot = 0; slot < problem.slots(); ++slot) {
    if (table_.is_region(problem.expression.solids()[slot])) inside[slot] = region_contains(problem, slot, target);
    if (table_.candidate(problem.expression.solids()[slot])) inside[slot] = candidate_at(problem, slot, target);
  }
  return inside;
}

Membership Restriction::mask_at(const CellProblem& problem, const GridPoint& p) const {
  const std::vector<char> inside = membership_at(problem, p);
  Membership mask = 0;
  for (std::size_t slot = 0; slot < inside.size(); ++slot)
    if (inside[slot]) mask |= Membership{1} << slot;
  return mask;
}

int Restriction::segment_crosses_facet(std::uint32_t facet, const Vec3& p, const Vec3& x) const {
  const Vec3 &a = table_.corner(facet, 0), &b = table_.corner(facet, 1), &c = table_.corner(facet, 2);
  const int at_p = side_grid(a, b, c, p), at_x = side(a, b, c, x);
  if (at_p == 0 || at_x == 0) return -1;
  if (at_p == at_x) return 0;
  // The line p x against the three edges: one sign all around means through the facet.
  const int s0 = side(p, x, a, b), s1 = side(p, x, b, c), s2 = side(p, x, c, a);
  if (s0 == 0 || s1 == 0 || s2 == 0) return -1;
  return s0 == s1 && s1 == s2;
}

bool Restriction::clear_of(std::uint32_t facet, const Vec3& x, double margin) const {
  const Surface& s = table_.surfaces[table_.surface[facet]];
  if (std::abs(s.normal.dot(x) - s.offset) > margin + s.thickness) return true;
  const Box3 box = table_.box(facet);
  if (box.squaredExteriorDistance(x) > margin * margin * 1.0001) return true;
  // Near the plane, but beside the facet: beyond one of its edges by more than the margin.
  const Vec3 &a = table_.corner(facet, 0), &b = table_.corner(facet, 1), &c = table_.corner(facet, 2);
  const Vec3 n = (b - a).cross(c - a);
  for (int k = 0; k < 3; ++k) {
    const Vec3& p = table_.corner(facet, k);
    const Vec3 outward = (table_.corner(facet, (k + 1) % 3) - p).cross(n);
    const double length = outward.norm();
    if (length > 0 && outward.dot(x - p) > 2 * (margin + s.thickness) * length) return true;
  }
  return false;
}

}  // namespace starcell
