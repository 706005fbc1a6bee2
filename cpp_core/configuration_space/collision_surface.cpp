#include "configuration_space/collision_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>

namespace starcell {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// More sides than this are not looked at one by one in a cell: it has to be smaller.
constexpr std::size_t most_sides = 12;
// Pieces are looked into once angles vary by less than this, in radians, and places by less than this many of their radii: before, most of their functions may matter.
constexpr double narrow = 0.8, near = 4;

Interval least(const Interval& a, const Interval& b) { return {std::min(a.lower(), b.lower()), std::min(a.upper(), b.upper())}; }
Interval greatest(const Interval& a, const Interval& b) { return {std::max(a.lower(), b.lower()), std::max(a.upper(), b.upper())}; }

Interval3 anything() {
  const Interval all(-infinity, infinity);
  return {all, all, all};
}

Expansion constant(double value, const Vec3& reach) {
  const Interval none(0.0);
  Expansion e;
  e.reach = reach;
  e.value = value;
  e.gradient = e.slope = {none, none, none};
  e.hessian = {none, none, none, none, none, none};
  e.steepest = 0;
  return e;
}

}  // namespace

struct CollisionSurface::Place {
  Place(const std::vector<Body>& bodies, const Vec3& shift, const Vec3& center, const Vec3& reach) : reach(reach) {
    const Interval3 at = enclose(center) - enclose(shift);
    for (const Body& body : bodies) frames.push_back(body.frame->expand(at, reach));
  }
  Vec3 reach;
  std::vector<FrameFunctions> frames;
};

// References stay, whatever is added.
class CollisionSurface::Sides {
 public:
  template <class Make>
  const std::vector<Side>& of(const Contenders& c, const Make& make) {
    Shelf& shelf = shelves_[(c.moving * 31 + c.fixed * 17 + c.moving_pocket + c.fixed_pocket) % shelves_.size()];
    {
      const std::lock_guard<std::mutex> lock(shelf.guard);
      if (const auto at = shelf.sides.find(c); at != shelf.sides.end()) return at->second;
    }
    std::vector<Side> made = make(c);
    const std::lock_guard<std::mutex> lock(shelf.guard);
    return shelf.sides.try_emplace(c, std::move(made)).first->second;
  }

 private:
  struct Shelf {
    std::mutex guard;
    std::map<Contenders, std::vector<Side>> sides;
  };
  std::array<Shelf, 64> shelves_;
};

CollisionSurface::CollisionSurface(std::vector<Body> bodies) : sides_(std::make_shared<Sides>()), shift_(Vec3::Zero()) {
  for (std::uint32_t b = 0; b < bodies.size(); ++b)
    for (const std::uint32_t i : bodies[b].moving->roots)
      for (const std::uint32_t j : bodies[b].fixed->roots) entries_.push_back({b, i, j, {{b, i, j, false, {}}}});
  bodies_ = std::make_shared<const std::vector<Body>>(std::move(bodies));
  for (const Entry& e : entries_) pairs_.push_back(&e.pairs.front());
}

CollisionSurface::CollisionSurface(const CollisionSurface& of, const Vec3& shift, std::vector<Entry> entries)
    : bodies_(of.bodies_), sides_(of.sides_), shift_(shift), entries_(std::move(entries)) {
  for (const Entry& e : entries_)
    for (const Pair& p : e.pairs) pairs_.push_back(&p);
}

CollisionSurface::CollisionSurface(const CollisionSurface& of, Pair alone) : bodies_(of.bodies_), sides_(of.sides_), shift_(of.shift_) {
  entries_.push_back({alone.body, alone.moving, alone.fixed, {}});
  entries_[0].pairs.push_back(std::move(alone));
  pairs_.push_back(&entries_[0].pairs[0]);
}

// The circles' distance from each other, which that of the pieces is not less than; and that of their centres, which are in the pieces' hulls, which it
// does not exceed.
Interval CollisionSurface::circles(const ConvexPiece& m, const ConvexPiece& o, const Place& place, std::uint32_t body) {
  const FrameFunctions& f = place.frames[body];
  const auto at = [&](FrameFunctions::Name origin, double along_cosine, double along_sine, double less) {
    const FrameFunction &t = f.of[origin], &c = f.of[FrameFunctions::cosine], &s = f.of[FrameFunctions::sine];
    Interval x = t.value + c.value * Interval(along_cosine) + s.value * Interval(along_sine) - Interval(less);
    for (int axis = 0; axis < 3; ++axis)
      x += (t.slope[axis] + Interval(along_cosine) * c.slope[axis] + Interval(along_sine) * s.slope[axis]) * Interval(-place.reach[axis], place.reach[axis]);
    return x;
  };
  const Interval dx = at(FrameFunctions::x, m.center[0], -m.center[1], o.center[0]), dy = at(FrameFunctions::y, m.center[1], m.center[0], o.center[1]);
  const Interval distance = square_root(squared(dx) + squared(dy));
  const Interval radii = Interval(m.radius) + o.radius;
  return {(distance - radii).lower(), (distance + radii).upper()};
}

const ConvexPiece& CollisionSurface::moving(const Contenders& c) const {
  const PieceNode& node = (*bodies_)[c.body].moving->nodes[c.moving];
  return c.moving_pocket == Contenders::hull ? node.hull : node.pockets[c.moving_pocket];
}

const ConvexPiece& CollisionSurface::fixed(const Contenders& c) const {
  const PieceNode& node = (*bodies_)[c.body].fixed->nodes[c.fixed];
  return c.fixed_pocket == Contenders::hull ? node.hull : node.pockets[c.fixed_pocket];
}

const std::vector<CollisionSurface::Side>& CollisionSurface::sides_of(const Contenders& c) const {
  return sides_->of(c, [this](const Contenders& missing) { return make_sides(missing); });
}

std::vector<CollisionSurface::Side> CollisionSurface::make_sides(const Contenders& contenders) const {
  const std::uint32_t b = contenders.body;
  const Body& body = (*bodies_)[b];
  const ConvexPiece &m = moving(contenders), &o = fixed(contenders);
  std::vector<Side> sides;
  const auto add = [&](Corners corners) {
    std::vector<std::uint16_t> all(corners.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<std::uint16_t>(k);
    sides.push_back({std::make_shared<const Corners>(std::move(corners)), std::move(all)});
  };
  for (std::size_t s = 0; s < o.sides.size(); ++s) {
    Corners corners;
    for (std::size_t c = 0; c < m.corners.size(); ++c) corners.push_back(moving_corner(b, m, c, *body.fixed, o, s, *body.moving));
    add(std::move(corners));
  }
  for (std::size_t s = 0; s < m.sides.size(); ++s) {
    Corners corners;
    for (std::size_t c = 0; c < o.corners.size(); ++c) corners.push_back(moving_side(b, *body.moving, m, s, o, c, *body.fixed));
    add(std::move(corners));
  }
  return sides;
}

std::optional<std::vector<CollisionSurface::Side>> CollisionSurface::kept_of(const std::vector<Side>& sides, const Place& at, std::uint32_t body) {
  const FrameFunctions& f = at.frames[body];
  std::vector<Side> kept;
  for (const Side& side : sides) {
    Side part{side.all, {}};
    bool behind = false;   // throughout: the pieces are not parted by this side
    for (const std::uint16_t k : side.kept) {
      const ContactFunction& c = (*side.all)[k];
      if (!c.applies(f.angle)) continue;
      const int sign = certain_sign(c.range(f, at.reach));
      if (sign > 0) continue;
      part.kept.push_back(k);
      behind = behind || sign < 0;
    }
    if (part.kept.empty()) return std::nullopt;
    if (!behind) kept.push_back(std::move(part));
  }
  return kept;
}

bool CollisionSurface::apart(const Place& at, const Contenders& c) const {
  return circles(moving(c), fixed(c), at, c.body).lower() > 0 || !kept_of(sides_of(c), at, c.body);
}

bool CollisionSurface::pockets_apart(const Place& at, std::uint32_t body, std::uint32_t i, std::uint32_t j, bool of_moving) const {
  const std::vector<ConvexPiece>& pockets = (of_moving ? (*bodies_)[body].moving->nodes[i] : (*bodies_)[body].fixed->nodes[j]).pockets;
  for (std::uint32_t k = 0; k < pockets.size(); ++k)
    if (!apart(at, of_moving ? Contenders{body, i, j, k, Contenders::hull} : Contenders{body, i, j, Contenders::hull, k})) return false;
  return true;
}

void CollisionSurface::resolve(const Place& at, std::uint32_t body, std::uint32_t i, std::uint32_t j, std::vector<Pair>& found) const {
  std::vector<Pair> leaves;
  to_leaves(at, body, i, j, leaves);
  const bool pieces = leaves.size() > 1 || (leaves.size() == 1 && (leaves[0].moving != i || leaves[0].fixed != j));
  if (pieces && std::all_of(leaves.begin(), leaves.end(), [](const Pair& p) { return p.known; })) {
    if (pockets_apart(at, body, i, j, true) && pockets_apart(at, body, i, j, false)) {
      if (auto sides = kept_of(sides_of({body, i, j}), at, body)) found.push_back({body, i, j, true, std::move(*sides)});
      return;
    }
    join_seams(at, body, leaves);
  }
  std::move(leaves.begin(), leaves.end(), std::back_inserter(found));
}

void CollisionSurface::to_leaves(const Place& at, std::uint32_t body, std::uint32_t i, std::uint32_t j, std::vector<Pair>& found) const {
  const PieceNode &m = (*bodies_)[body].moving->nodes[i], &o = (*bodies_)[body].fixed->nodes[j];
  const Interval distance = circles(m.hull, o.hull, at, body), angle = at.frames[body].angle;
  if (distance.lower() > 0) return;
  const double radii = m.hull.radius + o.hull.radius, varies = distance.upper() - distance.lower() - 2 * radii;
  if (angle.upper() - angle.lower() > narrow || varies > near * radii) {
    found.push_back({body, i, j, false, {}});
    return;
  }
  auto sides = kept_of(sides_of({body, i, j}), at, body);
  if (!sides) return;
  if (m.pockets.empty() && o.pockets.empty()) {
    found.push_back({body, i, j, true, std::move(*sides)});
  } else if (o.pockets.empty() || (!m.pockets.empty() && m.hull.radius >= o.hull.radius)) {
    for (const std::uint32_t child : m.children) to_leaves(at, body, child, j, found);
  } else {
    for (const std::uint32_t child : o.children) to_leaves(at, body, i, child, found);
  }
}

void CollisionSurface::join_seams(const Place& at, std::uint32_t body, std::vector<Pair>& found) const {
  for (const bool of_moving : {true, false}) {
    const auto own = [&](Pair& p) -> std::uint32_t& { return of_moving ? p.moving : p.fixed; };
    const auto others = [&](const Pair& p) { return of_moving ? p.fixed : p.moving; };
    for (const Seam& seam : (of_moving ? (*bodies_)[body].moving : (*bodies_)[body].fixed)->seams)
      for (std::size_t a = 0; a < found.size(); ++a) {
        if (own(found[a]) != seam.first) continue;
        const auto b = std::find_if(found.begin(), found.end(), [&](Pair& p) { return own(p) == seam.second && others(p) == others(found[a]); });
        if (b == found.end()) continue;
        Pair both = found[a];
        own(both) = seam.both;
        if (!pockets_apart(at, body, both.moving, both.fixed, of_moving)) continue;
        auto sides = kept_of(sides_of({body, both.moving, both.fixed}), at, body);
        if (!sides) continue;   // they are apart after all; the pair of pieces says so in smaller boxes
        both.sides = std::move(*sides);
        found[a] = std::move(both);
        found.erase(b);
        a = SIZE_MAX;   // once more from the first: what was erased may have been before it
      }
  }
}

std::vector<CollisionSurface::Entry> CollisionSurface::resolved(const Place& at, bool anew) const {
  std::vector<Entry> result;
  for (const Entry& entry : entries_) {
    Entry next{entry.body, entry.moving, entry.fixed, {}};
    if (anew && entry.pairs.size() > 1) {
      resolve(at, entry.body, entry.moving, entry.fixed, next.pairs);
    } else {
      for (const Pair& p : entry.pairs) {
        if (!p.known)
          resolve(at, p.body, p.moving, p.fixed, next.pairs);
        else if (auto sides = kept_of(p.sides, at, p.body))
          next.pairs.push_back({p.body, p.moving, p.fixed, true, std::move(*sides)});
      }
    }
    if (next.pairs.empty()) continue;
    for (const Pair& p : next.pairs)
      if (p.known && p.sides.empty()) return {{p.body, p.moving, p.fixed, {p}}};
    if (next.pairs.size() == 1) next.moving = next.pairs[0].moving, next.fixed = next.pairs[0].fixed;
    result.push_back(std::move(next));
  }
  return result;
}

SmoothSurfacePtr CollisionSurface::restricted(const Box3& box) const {
  const Rounding rounding;
  const Vec3 center = box.center();
  const Place at(*bodies_, shift_, center, (box.max() - center).cwiseMax(center - box.min()));   // rounded up: all of the box
  return std::shared_ptr<const CollisionSurface>(new CollisionSurface(*this, shift_, resolved(at, true)));
}

SmoothSurfacePtr CollisionSurface::translated(const Vec3& by) const {
  return std::shared_ptr<const CollisionSurface>(new CollisionSurface(*this, shift_ + by, entries_));
}

Expansion CollisionSurface::expand(const Vec3& center, const Vec3& reach) const {
  const Place at(*bodies_, shift_, center, reach);
  const bool known = std::all_of(pairs_.begin(), pairs_.end(), [](const Pair* p) { return p->known; });
  if (known) return expand_known(at);
  // Asked for its sign only: a function of the same sign, in the box's own pairs.
  const CollisionSurface here(*this, shift_, resolved(at, false));
  return std::all_of(here.pairs_.begin(), here.pairs_.end(), [](const Pair* p) { return p->known; }) ? here.expand_known(at) : here.expand_circles(at);
}

// One and the same function wherever it is asked for, in the cell and beside it: nothing is left out for its sign, as what is measured goes by values.
Expansion CollisionSurface::expand_known(const Place& at) const {
  Expansion e;
  e.reach = at.reach;
  if (pairs_.empty() || pairs_[0]->sides.empty()) return constant(pairs_.empty() ? 1 : -1, at.reach);
  // What each is at least and at most in the box; what then never is the least or greatest has no part in it.
  std::vector<std::vector<Interval>> of_sides;
  std::vector<Interval> of_pairs;
  for (const Pair* pair : pairs_) {
    std::vector<Interval>& sides = of_sides.emplace_back();
    for (const Side& side : pair->sides) {
      Interval range(infinity, infinity);
      for (const std::uint16_t k : side.kept) range = least(range, (*side.all)[k].range(at.frames[pair->body], at.reach));
      sides.push_back(range);
    }
    of_pairs.push_back(sides.front());
    for (const Interval& side : sides) of_pairs.back() = greatest(of_pairs.back(), side);
  }
  e.bounds = of_pairs.front();
  for (const Interval& pair : of_pairs) e.bounds = least(e.bounds, pair);
  std::vector<Expansion> active;
  bool any_pair = false;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (of_pairs[p].lower() > e.bounds.upper()) continue;
    const FrameFunctions& f = at.frames[pairs_[p]->body];
    Interval of_pair;
    bool any_side = false;
    for (std::size_t s = 0; s < pairs_[p]->sides.size(); ++s) {
      if (of_sides[p][s].upper() < of_pairs[p].lower()) continue;
      const Side& side = pairs_[p]->sides[s];
      Interval of_side(infinity, infinity);
      for (const std::uint16_t k : side.kept) {
        const ContactFunction& c = (*side.all)[k];
        if (side.kept.size() > 1 && c.range(f, at.reach).lower() > of_sides[p][s].upper()) continue;
        active.push_back(c.expand(f, at.reach));
        of_side = least(of_side, active.back().value);
      }
      of_pair = any_side ? greatest(of_pair, of_side) : of_side;
      any_side = true;
    }
    e.value = any_pair ? least(e.value, of_pair) : of_pair;
    any_pair = true;
  }
  if (active.size() == 1) return active.front();
  e.smooth = false;
  e.slope = active.front().slope;
  e.steepest = 0;
  for (const Expansion& one : active) {
    e.slopes.push_back(one.slope);
    e.slope = hull(e.slope, one.slope);
    e.steepest = std::max(e.steepest, norm(one.slope).upper());
  }
  e.gradient = e.slope;
  return e;
}

// Pairs that are not looked into: how far apart their circles are, and no word of slopes.
Expansion CollisionSurface::expand_circles(const Place& at) const {
  Expansion e = constant(0, at.reach);
  e.value = {infinity, infinity};
  for (const Pair* pair : pairs_) e.value = least(e.value, circles(moving(*pair).hull, fixed(*pair).hull, at, pair->body));
  e.smooth = false;
  e.gradient = e.slope = anything();
  e.steepest = infinity;
  return e;
}

double CollisionSurface::value(const Vec3& x, Vec3* gradient) const {
  const Rounding rounding;
  const Place at(*bodies_, shift_, x, Vec3::Zero());
  if (gradient) gradient->setZero();
  double best = infinity;
  for (const Pair* pair : pairs_) {
    double apart = -infinity;
    Vec3 way = Vec3::Zero();
    for (const Side& side : pair->known ? pair->sides : sides_of({pair->body, pair->moving, pair->fixed})) {
      double nearest = infinity;
      Vec3 g = Vec3::Zero(), one;
      for (const std::uint16_t k : side.kept)
        if (const double v = (*side.all)[k].value(at.frames[pair->body], &one); v < nearest) nearest = v, g = one;
      if (nearest > apart) apart = nearest, way = g;
    }
    if (apart >= best) continue;
    best = apart;
    if (gradient) *gradient = way;
  }
  return std::isfinite(best) ? best : best > 0 ? 1 : -1;
}

std::vector<SmoothSurfacePtr> CollisionSurface::parts() const {
  std::vector<SmoothSurfacePtr> all;
  const auto part = [&](Pair pair) { all.push_back(std::shared_ptr<const CollisionSurface>(new CollisionSurface(*this, std::move(pair)))); };
  if (pairs_.size() > 1)
    for (const Pair* pair : pairs_) part(*pair);
  else if (pairs_.size() == 1 && pairs_[0]->sides.size() > 1)
    for (const Side& side : pairs_[0]->sides) {
      Pair alone = *pairs_[0];
      alone.sides = {side};
      part(std::move(alone));
    }
  return all;
}

bool CollisionSurface::compares(const SmoothSurface& other, bool (ContactFunction::*as)(const ContactFunction&) const) const {
  const auto* o = dynamic_cast<const CollisionSurface*>(&other);
  if (!o || o->bodies_ != bodies_ || o->shift_ != shift_ || o->pairs_.size() != pairs_.size()) return false;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Pair &a = *pairs_[p], &b = *o->pairs_[p];
    if (!a.known || !b.known || a.sides.size() != b.sides.size()) return false;
    for (std::size_t s = 0; s < a.sides.size(); ++s) {
      if (a.sides[s].kept.size() != b.sides[s].kept.size()) return false;
      for (std::size_t k = 0; k < a.sides[s].kept.size(); ++k)
        if (!((*a.sides[s].all)[a.sides[s].kept[k]].*as)((*b.sides[s].all)[b.sides[s].kept[k]])) return false;
    }
  }
  return true;
}

bool CollisionSurface::opposite_of(const SmoothSurface& other) const {
  const bool one = pairs_.size() == 1 && pairs_[0]->sides.size() == 1 && pairs_[0]->sides[0].kept.size() == 1;   // the least of several turned is the greatest of them
  return one && compares(other, &ContactFunction::opposite);
}

bool CollisionSurface::simple() const {
  std::size_t sides = 0;
  for (const Pair* pair : pairs_) {
    if (!pair->known) return false;
    sides += pair->sides.size();
  }
  return sides <= most_sides;
}

}  // namespace starcell
