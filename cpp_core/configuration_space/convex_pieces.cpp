#include "configuration_space/convex_pieces.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <optional>
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
  std::size_t corner;  ///< a reflex one
  std::size_t side;    ///< on which it ends
  bool at_corner;      ///< where that side begins
  P place;
  K::FT length;        ///< squared
};

// Where the ray from corner k away from `back` meets the polygon first.
Cut first_hit(const Polygon& p, std::size_t k, const P& back) {
  const P& from = p[k];
  const K::Vector_2 way = from - back;
  std::optional<Cut> best;
  for (std::size_t s = 0; s < p.size(); ++s) {
    const P &a = p[s], &b = p[next(p, s)];
    if (s == k || next(p, s) == k) continue;
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
    const K::FT length = CGAL::squared_distance(from, place);
    if (!best || length < best->length) best = Cut{k, s, at_corner, place, length};
  }
  return *best;   // the polygon is about the corner
}

std::pair<Polygon, Polygon> cut_along(const Polygon& p, const Cut& c) {
  Polygon one, other;
  // From the corner along the polygon to the hit, and back to the corner.
  for (std::size_t i = c.corner; !(c.at_corner && i == c.side); i = next(p, i)) {
    one.push_back(p[i]);
    if (i == c.side) break;
  }
  one.push_back(c.place);
  // From the hit along the polygon to the corner, and to the hit.
  other.push_back(c.place);
  for (std::size_t i = next(p, c.side); i != c.corner; i = next(p, i)) other.push_back(p[i]);
  other.push_back(p[c.corner]);
  return {std::move(one), std::move(other)};
}

class Decomposition {
 public:
  explicit Decomposition(PieceTree& tree) : tree_(tree) {}

  void add(const Ring& ring) {
    Polygon whole;
    for (const Point2& p : ring) whole.emplace_back(p[0], p[1]);
    merge_flat_sides(whole);
    for (std::size_t k = 0; k < whole.size(); ++k) side(whole[k], whole[next(whole, k)]);   // first, so that lines are known by the polygon's own corners
    leaves_.clear();
    tree_.roots.push_back(node(std::move(whole)));
    find_seams();
  }

 private:
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
    auto [one, other] = cut_along(p, best_cut(p, reflex));
    p.clear();
    merge_flat_sides(one);
    merge_flat_sides(other);
    const std::uint32_t left = node(std::move(one)), right = node(std::move(other));
    tree_.nodes[at].children = {left, right};
    return at;
  }

  // Rather not one that ends in a corner; of others the shortest: what is cut off then is a part that sticks out, a tooth at its root.
  static Cut best_cut(const Polygon& p, const std::vector<std::size_t>& reflex) {
    std::optional<Cut> best;
    const std::size_t step = (reflex.size() + most_tries - 1) / most_tries;
    for (std::size_t r = 0; r < reflex.size(); r += step)
      for (const std::size_t back : {previous(p, reflex[r]), next(p, reflex[r])}) {
        Cut cut = first_hit(p, reflex[r], p[back]);
        if (!best || (cut.at_corner != best->at_corner ? !cut.at_corner : cut.length < best->length)) best = std::move(cut);
      }
    return *best;
  }

  void find_hull(const Polygon& p, PieceNode& node) {
    std::vector<P> hull;
    CGAL::convex_hull_2(p.begin(), p.end(), std::back_inserter(hull));
    node.hull = piece(hull);
    std::map<P, std::size_t> index;
    for (std::size_t k = 0; k < p.size(); ++k) index.emplace(p[k], k);
    for (std::size_t h = 0; h < hull.size(); ++h) {
      const std::size_t from = index.at(hull[h]), to = index.at(hull[(h + 1) % hull.size()]);
      Polygon chain, pocket;
      for (std::size_t k = from; k != to; k = next(p, k)) chain.push_back(p[k]);
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

}  // namespace

PieceTree piece_tree(const std::vector<Ring>& polygons, const char* what) {
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
