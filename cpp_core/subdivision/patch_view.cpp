#include "subdivision/patch_view.h"

#include <algorithm>
#include <numeric>

#include "numerics/linear_program.h"

namespace starcell {
namespace {

constexpr std::size_t max_mixed = 8;
// How often a box is halved to find out what of it a surface reaches.
constexpr int max_halvings = 2;
// A kink's slopes one by one, if they are no more: a box about all of them has corners that are far from any.
constexpr std::size_t most_slopes_each = 16;

}  // namespace

PatchView::PatchView(const Patches& patches, const Box3& box) : patches_(patches), box_(box) {
  const Vec3 center = box.center(), reach = 0.5 * box.sizes();
  expansions_.reserve(patches.size());
  const Rounding rounding;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    expansions_.push_back(patches.at(k).expand(center, reach));
    const int sign = certain_sign(expansions_[k].range());
    if (sign == 0) mixed_.push_back(k);
    if (sign < 0) fixed_ |= Sides{1} << k;
  }
  for (std::size_t i = 0; i < mixed_.size(); ++i)
    for (std::size_t j = i + 1; j < mixed_.size(); ++j) compare(mixed_[i], mixed_[j]);
}

// F_l + c F_k of one sign rules out that both have the opposite one (c > 0), or opposite ones (c < 0); closed, so they have no
// common zero either. The c that cancels the gradients decides most.
void PatchView::compare(std::size_t k, std::size_t l) {
  const Expansion &f = expansions_[k], &g = expansions_[l];
  const auto exclude = [&](double c, int sign) {
    const bool l_negative = sign > 0;
    const bool k_negative = c > 0 ? l_negative : !l_negative;
    excluded_[k][l] |= 1u << (2 * k_negative + l_negative);
    excluded_[l][k] |= 1u << (2 * l_negative + k_negative);
  };
  if (const Surface &one = patches_.at(k), &other = patches_.at(l); one.form && other.form)
    if (const auto apart = other.form->constant_difference(*one.form)) return *apart != 0 ? exclude(-1, *apart > 0 ? 1 : -1) : void();
  const Vec3 gf = f.gradient.middle(), gg = g.gradient.middle();
  const double square = gf.squaredNorm();
  if (!(square > 0)) return;
  const double c = -gf.dot(gg) / square;
  if (c == 0) return;
  const int sign = certain_sign(combine(c, f, 1, g).range());
  if (sign != 0) exclude(c, sign);
}

bool PatchView::compare_threes() {
  if (mixed_.size() > max_mixed) return false;
  const Rounding rounding;
  bool any = false;
  for (std::size_t i = 0; i < mixed_.size(); ++i)
    for (std::size_t j = i + 1; j < mixed_.size(); ++j)
      for (std::size_t k = j + 1; k < mixed_.size(); ++k) any = compare(mixed_[i], mixed_[j], mixed_[k]) || any;
  return any;
}

// As for two: the combination in which the gradients cancel, if they lie in a plane.
bool PatchView::compare(std::size_t k, std::size_t l, std::size_t m) {
  const std::array<std::size_t, 3> three{k, l, m};
  std::array<Vec3, 3> g, across;
  for (std::size_t i = 0; i < 3; ++i) g[i] = expansions_[three[i]].gradient.middle();
  for (std::size_t i = 0; i < 3; ++i) across[i] = g[(i + 1) % 3].cross(g[(i + 2) % 3]);
  const Vec3& widest = *std::max_element(across.begin(), across.end(), [](const Vec3& u, const Vec3& v) { return u.squaredNorm() < v.squaredNorm(); });
  std::array<double, 3> weight;
  for (std::size_t i = 0; i < 3; ++i) weight[i] = across[i].dot(widest);
  if (!(std::abs(weight[0]) > 0 && std::abs(weight[1]) > 0 && std::abs(weight[2]) > 0)) return false;
  const double largest = std::max({std::abs(weight[0]), std::abs(weight[1]), std::abs(weight[2])});
  const Expansion two = combine(weight[0] / largest, expansions_[k], weight[1] / largest, expansions_[l]);
  const int sign = certain_sign(combine(1, two, weight[2] / largest, expansions_[m]).range());
  if (sign == 0) return false;
  Sides mask = 0, negative = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    mask |= Sides{1} << three[i];
    if ((weight[i] > 0) == (sign > 0)) negative |= Sides{1} << three[i];
  }
  excluded_threes_.emplace_back(mask, negative);
  return true;
}

bool PatchView::feasible(Sides sides) const {
  for (const auto& [mask, negative] : excluded_threes_)
    if ((sides & mask) == negative) return false;
  for (std::size_t i = 0; i < mixed_.size(); ++i)
    for (std::size_t j = i + 1; j < mixed_.size(); ++j) {
      const std::size_t k = mixed_[i], l = mixed_[j];
      if (excluded_[k][l] >> (2 * (sides >> k & 1) + (sides >> l & 1)) & 1) return false;
    }
  return true;
}

// The sign of F_l on F_k = 0 if it is certain, else 0.
int PatchView::side_on(std::size_t k, std::size_t l) const {
  const std::uint8_t e = excluded_[k][l];
  if (e & 0b1010) return 1;    // the negative side of l is excluded with some side of k
  if (e & 0b0101) return -1;
  return 0;
}

template <class Visit>
void PatchView::for_feasible(Visit visit) const {
  for (Sides m = 0; m < Sides{1} << mixed_.size(); ++m) {
    Sides sides = fixed_;
    for (std::size_t i = 0; i < mixed_.size(); ++i)
      if (m >> i & 1) sides |= Sides{1} << mixed_[i];
    if (feasible(sides)) visit(sides);
  }
}

// Where two patches meet, and no third one is, all four combinations of their sides occur with the others' sides as they are.
bool PatchView::linked(std::size_t k, std::size_t l) const {
  if (excluded_[k][l] != 0) return false;
  const Sides a = Sides{1} << k, b = Sides{1} << l;
  bool both = false;
  for_feasible([&](Sides sides) {
    if (both || (sides & (a | b)) || !feasible(sides | a) || !feasible(sides | b) || !feasible(sides | a | b)) return;
    const bool none = patches_.value(sides), in_a = patches_.value(sides | a), in_b = patches_.value(sides | b), all = patches_.value(sides | a | b);
    both = (none != in_a || in_b != all) && (none != in_b || in_a != all);
  });
  return both;
}

bool PatchView::constant() const {
  if (mixed_.size() > max_mixed) return false;
  bool any_in = false, any_out = false;
  for_feasible([&](Sides sides) { (patches_.value(sides) ? any_in : any_out) = true; });
  return !(any_in && any_out);
}

std::optional<std::vector<PatchClass>> PatchView::classes() const {
  if (mixed_.size() > max_mixed) return std::nullopt;
  std::array<int, max_patches> sense{};
  bool both = false;
  for_feasible([&](Sides sides) {
    const bool value = patches_.value(sides);
    for (const std::size_t k : mixed_) {
      const Sides bit = Sides{1} << k;
      if (!(sides & bit) || !feasible(sides & ~bit)) continue;
      const bool beyond = patches_.value(sides & ~bit);
      if (value == beyond) continue;
      const int s = value ? 1 : -1;
      both = both || sense[k] == -s;
      sense[k] = s;
    }
  });
  if (both) return std::nullopt;
  std::vector<PatchClass> classes;
  std::array<bool, max_patches> taken{};
  for (const std::size_t seed : mixed_) {
    if (sense[seed] == 0 || taken[seed]) continue;
    PatchClass c;
    c.patches.push_back(seed);
    taken[seed] = true;
    for (std::size_t i = 0; i < c.patches.size(); ++i)
      for (const std::size_t l : mixed_)
        if (sense[l] != 0 && !taken[l] && linked(c.patches[i], l)) c.patches.push_back(l), taken[l] = true;
    std::sort(c.patches.begin(), c.patches.end());
    for (const std::size_t k : c.patches) c.sense.push_back(sense[k]);
    if (c.patches.size() > max_class || !tabulate(c)) return std::nullopt;
    classes.push_back(std::move(c));
  }
  return classes;
}

std::optional<std::vector<PatchClass>> PatchView::seen_classes(int flat_axis, Statistics& statistics) const {
  auto found = classes();
  if (!found) return std::nullopt;
  for (PatchClass& c : *found) {
    const auto u = direction(c, flat_axis, statistics);
    if (!u) return std::nullopt;
    c.direction = *u;
  }
  return found;
}

// E's value near the class's surfaces, as a function of the class's sides alone: the other patches' sides are fixed there, or of no
// influence, or such that the class is not E at all. What no feasible sides say is filled in so that the value never rises outward.
bool PatchView::tabulate(PatchClass& c) const {
  const std::size_t n = c.patches.size();
  Sides own = 0, others = 0, other_sides = 0;   // others: of certain side on all of the class's surfaces
  for (const std::size_t k : c.patches) own |= Sides{1} << k;
  for (const std::size_t l : mixed_) {
    if (own >> l & 1) continue;
    const int side = side_on(c.patches.front(), l);
    if (side == 0 || !std::all_of(c.patches.begin(), c.patches.end(), [&](std::size_t k) { return side_on(k, l) == side; })) continue;
    others |= Sides{1} << l;
    if (side < 0) other_sides |= Sides{1} << l;
  }
  // Per context, the other patches' sides: which of the class's sides occur, and their values.
  struct Context {
    Sides sides;
    std::uint64_t seen = 0, value = 0;
  };
  std::vector<Context> contexts;
  for_feasible([&](Sides sides) {
    if ((sides & others) != other_sides) return;
    auto context = std::find_if(contexts.begin(), contexts.end(), [&](const Context& x) { return x.sides == (sides & ~own); });
    if (context == contexts.end()) context = contexts.insert(contexts.end(), {sides & ~own, 0, 0});
    std::size_t a = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (sides >> c.patches[i] & 1) a |= std::size_t{1} << i;
    context->seen |= std::uint64_t{1} << a;
    if (patches_.value(sides)) context->value |= std::uint64_t{1} << a;
  });
  std::uint64_t known = 0;
  for (const Context& x : contexts) {
    if (x.value == 0 || x.value == x.seen) continue;
    if ((known & x.seen & (c.value ^ x.value)) != 0) return false;
    known |= x.seen;
    c.value |= x.value;
  }
  // Bits of the inner sides: a is farther out than b if its inner sides are among b's.
  std::size_t inner = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (c.sense[i] > 0) inner |= std::size_t{1} << i;
  const auto inner_sides = [&](std::size_t a) { return ~(a ^ inner); };
  const std::size_t all = std::size_t{1} << n;
  std::uint64_t value = 0;
  for (std::size_t a = 0; a < all; ++a) {
    bool rises = false;
    for (std::size_t b = 0; b < all; ++b) {
      const bool b_within = (inner_sides(a) & ~inner_sides(b) & (all - 1)) == 0;
      rises = rises || (b_within && (known >> b & 1) && !(c.value >> b & 1));
    }
    if (rises && (known >> a & 1) && (c.value >> a & 1)) return false;
    if (!rises) value |= std::uint64_t{1} << a;
  }
  c.value = value;
  return true;
}

bool PatchView::sees(const PatchClass& c, const Vec3& u) const {
  const Rounding rounding;
  for (std::size_t i = 0; i < c.patches.size(); ++i) {
    const Vec3 n = c.sense[i] * u;
    if (certain_sign(expansions_[c.patches[i]].along(n)) <= 0 && !faces(c.patches[i], n, box_, 0)) return false;
  }
  return true;
}

// Only the slopes on the surface matter: a line along n that leaves the negative side wherever it crosses, crosses once. Parts
// of the box that the surface does not reach are left out.
bool PatchView::faces(std::size_t patch, const Vec3& n, const Box3& box, int depth) const {
  const Surface& surface = patches_.at(patch);
  const Vec3 low = box.min(), middle = box.center(), half = 0.5 * box.sizes();
  for (int part = 0; part < 8; ++part) {
    Vec3 corner = low;
    bool flat = false;   // a face has no upper half along its axis
    for (int k = 0; k < 3; ++k)
      if (part >> k & 1) corner[k] = middle[k], flat = flat || half[k] == 0;
    if (flat) continue;
    const Box3 piece(corner, corner + half);
    const Expansion e = surface.expand(piece.center(), 0.5 * half);
    if (certain_sign(e.range()) != 0 || certain_sign(e.along(n)) > 0) continue;
    if (e.along(n).upper() <= 0 || depth + 1 >= max_halvings || !faces(patch, n, piece, depth + 1)) return false;
  }
  return true;
}

std::optional<Vec3> PatchView::direction(const PatchClass& c, int flat_axis, Statistics& statistics) const {
  const auto flat = [&](Vec3 v) {
    if (flat_axis >= 0) v[flat_axis] = 0;
    return v;
  };
  // The normals where the surfaces are nearest to the middle of the box; at a kink the middle of all slopes.
  Vec3 mean = Vec3::Zero(), middle = Vec3::Zero();
  const auto add = [](Vec3& sum, const Vec3& g) {
    if (g.norm() > 0) sum += g.normalized();
  };
  for (std::size_t i = 0; i < c.patches.size(); ++i) {
    const Surface& surface = patches_.at(c.patches[i]);
    Vec3 g, at = box_.center();
    const double value = surface.value(at, &g);
    if (surface.form && g.squaredNorm() > 0) {
      at -= value / g.squaredNorm() * g;
      at = at.cwiseMax(box_.min()).cwiseMin(box_.max());
      surface.value(at, &g);
    }
    add(mean, c.sense[i] * flat(g));
    const Expansion& e = expansions_[c.patches[i]];
    if (e.slopes.empty()) add(middle, c.sense[i] * flat(e.slope.middle()));
    for (const Interval3& slope : e.slopes) add(middle, c.sense[i] * flat(slope.middle()));
  }
  for (const Vec3& u : {mean, middle})
    if (u.norm() > 0 && sees(c, u.normalized())) {
      count(statistics.guard_witness);
      return u.normalized();
    }
  // The corners of the slopes' boxes stand for all of them; the program's margin is the slack of T§3.5.4. (Of two
  // patches without kinks the bisector is all there is to try.)
  std::vector<Vec3> corners;
  const auto add_corners = [&](const Interval3& slope, int sense) {
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 g;
      for (int k = 0; k < 3; ++k) g[k] = corner >> k & 1 ? slope[k].upper() : slope[k].lower();
      if (flat_axis >= 0 && (corner >> flat_axis & 1)) continue;
      g = sense * flat(g);
      if (g.norm() > 0) corners.push_back(g.normalized());
    }
  };
  for (std::size_t i = 0; i < c.patches.size(); ++i) {
    const Expansion& e = expansions_[c.patches[i]];
    if (e.slopes.empty() || e.slopes.size() > most_slopes_each) add_corners(e.slope, c.sense[i]);
    else
      for (const Interval3& slope : e.slopes) add_corners(slope, c.sense[i]);
  }
  const bool kinks = std::any_of(c.patches.begin(), c.patches.end(), [&](std::size_t k) { return expansions_[k].slopes.size() > 1; });
  if (c.patches.size() > 2 || kinks)
    if (auto u = widest_direction(corners)) {
      *u = flat(*u);
      if (u->norm() > 0 && sees(c, u->normalized())) {
        count(statistics.guard_program);
        return u->normalized();
      }
    }
  count(statistics.guard_failed);
  return std::nullopt;
}

}  // namespace starcell
