#include "configuration_space/convex_pieces.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>

#include "solids/errors.h"

namespace starcell {
namespace {

using K = CGAL::Exact_predicates_exact_constructions_kernel;
using P = K::Point_2;

using Polygon = std::vector<P>;

// How many reflex corners are tried for the shortest cut.
constexpr std::size_t most_tries = 64;

std::size_t next(const Polygon& p, std::size_t k) { return k + 1 < p.size() ? k + 1 : 0; }
std::size_t previous(const Polygon& p, std::size_t k) { return k > 0 ? k - 1 : p.size() - 1; }

// Corners at which nothing turns go: the sides beside them are one.
void merge_flat_sides(Polygon& p) {
  for (std::size_t k = 0; k < p.size();)
    if (p.size() > 3 && CGAL::collinear(p[previous(p, k)], p[k], p[next(p, k)]))
      p.erase(p.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
}

struct Cut {
  std::size_t side;    ///< on which it ends
  bool at_corner;      ///< where that side begins
  P place;
  K::FT length;        ///< squared
};

// Is the point in the corner's angle, inside the polygon near it?
bool sees(const Polygon& p, std::size_t corner, const P& from) {
  const P &a = p[previous(p, corner)], &b = p[corner], &c = p[next(p, corner)];
  const bool left_of_first = CGAL::orientation(a, b, from) != CGAL::RIGHT_TURN, left_of_second = CGAL::orientation(b, c, from) != CGAL::RIGHT_TURN;
  return CGAL::orientation(a, b, c) == CGAL::RIGHT_TURN ? left_of_first || left_of_second : left_of_first && left_of_second;
}

// Where the ray from a point away from `back` meets the polygon first, from inside: cuts to holes are sides twice, once in either sense.
Cut first_hit(const Polygon& p, const P& from, const P& back) {
  const K::Vector_2 way = from - back;
  std::optional<Cut> best;
  for (std::size_t s = 0; s < p.size(); ++s) {
    const P &a = p[s], &b = p[next(p, s)];
    if (a == from || b == from) continue;
    const auto side_a = CGAL::orientation(back, from, a), side_b = CGAL::orientation(back, from, b);
    P place;
    bool at_corner = false;
    if (side_a == CGAL::COLLINEAR)
      place = a, at_corner = true;
    else if (side_b == CGAL::COLLINEAR || side_a == side_b)
      continue;   // its end is the next one's beginning
    else {
      const K::FT ha = CGAL::determinant(way, a - from), hb = CGAL::determinant(way, b - from);
      place = a + (b - a) * (ha / (ha - hb));
    }
    if (CGAL::sign((place - from) * way) != CGAL::POSITIVE) continue;
    if (at_corner ? !sees(p, s, from) : CGAL::orientation(a, b, from) != CGAL::LEFT_TURN) continue;
    const K::FT length = CGAL::squared_distance(from, place);
    if (!best || length < best->length) best = Cut{s, at_corner, place, length};
  }
  return *best;   // the polygon is about the point
}

std::pair<Polygon, Polygon> cut_along(const Polygon& p, std::size_t corner, const Cut& c) {
  Polygon one, other;
  // From the corner along the polygon to the hit, and back to the corner.
  for (std::size_t i = corner; !(c.at_corner && i == c.side); i = next(p, i)) {
    one.push_back(p[i]);
    if (i == c.side) break;
  }
  one.push_back(c.place);
  // From the hit along the polygon to the corner, and to the hit.
  other.push_back(c.place);
  for (std::size_t i = next(p, c.side); i != corner; i = next(p, i)) other.push_back(p[i]);
  other.push_back(p[corner]);
  return {std::move(one), std::move(other)};
}

// One ring, which runs along cuts from the polygon to its holes and back. The hole that reaches farthest is first: what a ray on from there meets is no hole that
// is not joined yet (Eberly's order).
Polygon with_holes_joined(Polygon outer, std::vector<Polygon> holes) {
  const auto farthest = [](const Polygon& hole) { return std::max_element(hole.begin(), hole.end()) - hole.begin(); };
  std::sort(holes.begin(), holes.end(), [&](const Polygon& g, const Polygon& h) { return h[static_cast<std::size_t>(farthest(h))] < g[static_cast<std::size_t>(farthest(g))]; });
  for (Polygon& hole : holes) {
    std::rotate(hole.begin(), hole.begin() + farthest(hole), hole.end());
    const Cut cut = first_hit(outer, hole.front(), hole.back());
    Polygon way;
    if (!cut.at_corner) way.push_back(cut.place);
    way.insert(way.end(), hole.begin(), hole.end());
    way.push_back(hole.front());
    way.push_back(cut.place);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(cut.side) + 1, way.begin(), way.end());
    merge_flat_sides(outer);
  }
  return outer;
}

class Decomposition {
 public:
  explicit Decomposition(PieceTree& tree) : tree_(tree) {}

  /// The outer ring anticlockwise, holes clockwise.
  void add(const PlanarPolygon& polygon) {
    Polygon whole = ring(polygon.outer);
    std::vector<Polygon> holes;
    for (const Ring& hole : polygon.holes) holes.push_back(ring(hole));
    leaves_.clear();
    tree_.roots.push_back(node(with_holes_joined(std::move(whole), std::move(holes))));
    find_seams();
  }

 private:
  Polygon ring(const Ring& given) {
    Polygon p;
    for (const Point2& c : given) p.emplace_back(c[0], c[1]);
    merge_flat_sides(p);
    for (std::size_t k = 0; k < p.size(); ++k) side(p[k], p[next(p, k)]);   // before cuts, so that lines are known by the polygon's own corners
    return p;
  }

  std::uint32_t node(Polygon p) {
    const auto at = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    std::vector<std::size_t> reflex;
    for (std::size_t k = 0; k < p.size(); ++k)
      if (CGAL::orientation(p[previous(p, k)], p[k], p[next(p, k)]) == CGAL::RIGHT_TURN) reflex.push_back(k);
    if (reflex.empty()) {
      tree_.nodes[at].hull = piece(p);
      leaves_.emplace_back(at, std::move(p));
      return at;
    }
    find_hull(p, tree_.nodes[at]);
    const auto [corner, cut] = best_cut(p, reflex);
    auto [one, other] = cut_along(p, corner, cut);
    p.clear();
    merge_flat_sides(one);
    merge_flat_sides(other);
    const std::uint32_t left = node(std::move(one)), right = node(std::move(other));
    tree_.nodes[at].children = {left, right};
    return at;
  }

  // Rather not one that ends in a corner; of others the shortest: what is cut off then is a part that sticks out, a tooth at its root.
  static std::pair<std::size_t, Cut> best_cut(const Polygon& p, const std::vector<std::size_t>& reflex) {
    std::optional<std::pair<std::size_t, Cut>> best;
    const std::size_t step = (reflex.size() + most_tries - 1) / most_tries;
    for (std::size_t r = 0; r < reflex.size(); r += step)
      for (const std::size_t back : {previous(p, reflex[r]), next(p, reflex[r])}) {
        Cut cut = first_hit(p, p[reflex[r]], p[back]);
        if (!best || (cut.at_corner != best->second.at_corner ? !cut.at_corner : cut.length < best->second.length)) best.emplace(reflex[r], std::move(cut));
      }
    return *best;
  }

  // Between two corners that are also the hull's there is a side of it, or a pocket. A corner from which a cut goes to a hole comes twice.
  void find_hull(const Polygon& p, PieceNode& node) {
    std::vector<P> hull;
    CGAL::convex_hull_2(p.begin(), p.end(), std::back_inserter(hull));
    node.hull = piece(hull);
    std::vector<std::size_t> on_hull;
    const std::set<P> corners(hull.begin(), hull.end());
    for (std::size_t k = 0; k < p.size(); ++k)
      if (corners.contains(p[k])) on_hull.push_back(k);
    for (std::size_t h = 0; h < on_hull.size(); ++h) {
      const std::size_t from = on_hull[h], to = on_hull[(h + 1) % on_hull.size()];
      Polygon chain{p[from]}, pocket;
      for (std::size_t k = next(p, from); k != to; k = next(p, k)) chain.push_back(p[k]);
      chain.push_back(p[to]);
      CGAL::convex_hull_2(chain.begin(), chain.end(), std::back_inserter(pocket));
      if (pocket.size() > 2) node.pockets.push_back(piece(pocket));
    }
  }

  // Two leaves of which one has a side that ends where the other's begins, on one line.
  void find_seams() {
    struct End {
      std::uint32_t corner, line;
      bool along;
      auto operator<=>(const End&) const = default;
    };
    std::map<End, std::pair<std::size_t, std::size_t>> begins;   // leaf, side
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const ConvexPiece& hull = tree_.nodes[leaves_[l].first].hull;
      for (std::size_t k = 0; k < hull.sides.size(); ++k) begins[{hull.corners[k].id, hull.sides[k].line, hull.sides[k].along}] = {l, k};
    }
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const ConvexPiece hull = tree_.nodes[leaves_[l].first].hull;   // a copy: nodes are added
      for (std::size_t k = 0; k < hull.sides.size(); ++k) {
        const std::size_t end = k + 1 < hull.corners.size() ? k + 1 : 0;
        const auto other = begins.find({hull.corners[end].id, hull.sides[k].line, hull.sides[k].along});
        if (other == begins.end()) continue;
        // Both without the corner where the seam is: the first from there on, up to before it, then the second.
        const Polygon &p = leaves_[l].second, &q = leaves_[other->second.first].second;
        Polygon both;
        for (std::size_t i = next(p, end); i != end; i = next(p, i)) both.push_back(p[i]);
        for (std::size_t i = next(q, other->second.second); i != other->second.second; i = next(q, i)) both.push_back(q[i]);
        if (both.front() == both.back()) both.pop_back();
        const auto at = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.seams.push_back({leaves_[l].first, leaves_[other->second.first].first, at});
        PieceNode node;
        find_hull(both, node);
        tree_.nodes.push_back(std::move(node));
      }
    }
  }

  ConvexPiece piece(const std::vector<P>& p) {
    ConvexPiece piece;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (std::size_t k = 0; k < p.size(); ++k) {
      const PieceCorner c = corner(p[k]);
      piece.corners.push_back(c);
      piece.sides.push_back(side(p[k], p[k + 1 < p.size() ? k + 1 : 0]));
      low[0] = std::min(low[0], c.x.lower()), high[0] = std::max(high[0], c.x.upper()), low[1] = std::min(low[1], c.y.lower()), high[1] = std::max(high[1], c.y.upper());
    }
    piece.center = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
    for (const PieceCorner& c : piece.corners)
      piece.radius = std::max(piece.radius, (1 + 1e-12) * std::hypot(std::max(std::abs(c.x.lower() - piece.center[0]), std::abs(c.x.upper() - piece.center[0])),
                                                                    std::max(std::abs(c.y.lower() - piece.center[1]), std::abs(c.y.upper() - piece.center[1]))));
    return piece;
  }

  // Corners of polygons that touch, and sides on one line, are one: then what they say of a contact is one function.
  PieceCorner corner(const P& p) {
    const std::uint32_t id = corners_.emplace(p, static_cast<std::uint32_t>(corners_.size())).first->second;
    const auto [x0, x1] = CGAL::to_interval(p.x());
    const auto [y0, y1] = CGAL::to_interval(p.y());
    return {Interval(x0, x1), Interval(y0, y1), id};
  }

  ConvexPiece::Side side(const P& from, const P& to) {
    const K::Vector_2 way = to - from;
    const bool steep = CGAL::abs(way.y()) > CGAL::abs(way.x());
    const K::FT slope = steep ? way.x() / way.y() : way.y() / way.x();
    const K::FT height = steep ? from.x() - slope * from.y() : from.y() - slope * from.x();
    const auto [at, fresh] = lines_.emplace(std::make_tuple(steep, slope, height), std::make_pair(static_cast<std::uint32_t>(tree_.lines.size()), way));
    if (fresh) tree_.lines.push_back({corner(from), corner(to)});
    return {at->second.first, CGAL::sign(way * at->second.second) == CGAL::POSITIVE};
  }

  PieceTree& tree_;
  std::vector<std::pair<std::uint32_t, Polygon>> leaves_;   // of the polygon at hand: nodes
  std::map<P, std::uint32_t> corners_;
  std::map<std::tuple<bool, K::FT, K::FT>, std::pair<std::uint32_t, K::Vector_2>> lines_;
};

[[noreturn]] void refuse(const char* what, std::size_t number, const std::string& why) {
  std::ostringstream text;
  text << what << ": polygon " << number << ' ' << why;
  throw InvalidSolidError(text.str());
}

// Anticlockwise, without doubled points.
Ring checked(const Ring& given, const char* what, std::size_t number) {
  Ring ring;
  for (const Point2& p : given) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) refuse(what, number, "has a coordinate that is not finite");
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  }
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() < 3) refuse(what, number, "has fewer than three different corners");
  std::vector<P> points;
  for (const Point2& p : ring) points.emplace_back(p[0], p[1]);
  if (!CGAL::is_simple_2(points.begin(), points.end())) {
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j) {
        const std::size_t i1 = (i + 1) % points.size(), j1 = (j + 1) % points.size();
        const bool beside = i1 == j || j1 == i;
        const K::Segment_2 s(points[i], points[i1]), t(points[j], points[j1]);
        const bool folds = beside && CGAL::collinear(points[i], points[i1], points[i1 == j ? j1 : j]) &&
                           CGAL::sign((points[i1] - points[i]) * (points[j1] - points[j])) == CGAL::NEGATIVE;
        if (beside ? !folds : !CGAL::do_intersect(s, t)) continue;
        std::ostringstream where;
        where << "crosses or touches itself: sides " << i << " and " << j << ", near (" << ring[j][0] << ", " << ring[j][1] << ')';
        refuse(what, number, where.str());
      }
    refuse(what, number, "crosses or touches itself");
  }
  const auto sense = CGAL::orientation_2(points.begin(), points.end());
  if (sense == CGAL::COLLINEAR) refuse(what, number, "has no area");
  if (sense == CGAL::CLOCKWISE) std::reverse(ring.begin(), ring.end());
  return ring;
}

bool inside(const Point2& p, const Ring& ring) {
  std::vector<P> points;
  for (const Point2& c : ring) points.emplace_back(c[0], c[1]);
  return CGAL::bounded_side_2(points.begin(), points.end(), P(p[0], p[1])) == CGAL::ON_BOUNDED_SIDE;
}

bool touch(const Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Point2 &p = a[i], &q = a[(i + 1) % a.size()], &r = b[j], &s = b[(j + 1) % b.size()];
      if (std::max(p[0], q[0]) < std::min(r[0], s[0]) || std::max(r[0], s[0]) < std::min(p[0], q[0])) continue;
      if (std::max(p[1], q[1]) < std::min(r[1], s[1]) || std::max(r[1], s[1]) < std::min(p[1], q[1])) continue;
      if (CGAL::do_intersect(K::Segment_2(P(p[0], p[1]), P(q[0], q[1])), K::Segment_2(P(r[0], r[1]), P(s[0], s[1])))) return true;
    }
  return false;
}

PlanarPolygon checked(const PlanarPolygon& given, const char* what, std::size_t number) {
  PlanarPolygon polygon(checked(given.outer, what, number));
  for (std::size_t h = 0; h < given.holes.size(); ++h) {
    Ring hole = checked(given.holes[h], what, number);
    const std::string name = "has a hole, number " + std::to_string(h) + ", that ";
    if (!inside(hole.front(), polygon.outer) || touch(hole, polygon.outer)) refuse(what, number, name + "is not inside it");
    for (const Ring& other : polygon.holes) {
      if (touch(hole, other)) refuse(what, number, name + "touches another one");
      if (inside(hole.front(), other) || inside(other.front(), hole)) refuse(what, number, name + "is in another one, or about it");
    }
    std::reverse(hole.begin(), hole.end());
    polygon.holes.push_back(std::move(hole));
  }
  return polygon;
}

}  // namespace

PieceTree piece_tree(const std::vector<PlanarPolygon>& polygons, const char* what) {
  PieceTree tree;
  Decomposition decomposition(tree);
  for (std::size_t k = 0; k < polygons.size(); ++k) decomposition.add(checked(polygons[k], what, k));
  return tree;
}

PieceTree segment_piece(double length) {
  PieceTree tree;
  PieceNode link;
  link.hull.corners = {{Interval(0.0), Interval(0.0), 0}, {Interval(length), Interval(0.0), 1}};
  link.hull.sides = {{0, true}, {0, false}};
  link.hull.center = {0.5 * length, 0};
  link.hull.radius = 0.5 * length * (1 + 1e-12);
  tree.lines.push_back({link.hull.corners[0], link.hull.corners[1]});
  tree.nodes.push_back(std::move(link));
  tree.roots.push_back(0);
  return tree;
}

}  // namespace starcell
