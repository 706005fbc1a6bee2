#include "repair/exact_arrangement.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "repair/meeting_triangles.h"
#include "solids/disjoint_sets.h"
#include "solids/triangle_pair.h"

namespace starcell {
namespace {

using K = ExactKernel;
struct Name {
  std::int64_t number = -1;   ///< -1: none yet
};
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<Name, K>;
using Cut = CGAL::Constrained_Delaunay_triangulation_2<
    K, CGAL::Triangulation_data_structure_2<Vertex, CGAL::Constrained_triangulation_face_base_2<K>>, CGAL::Exact_intersections_tag>;

constexpr int steps_to_a_pause = 64;

// What two triangles have in common: its corners, and if it is no point, all its sides.
struct Common {
  std::vector<ExactPoint> corners;
  bool flat = false;   // a part of their plane
};

Common common_of(const K::Triangle_3& s, const K::Triangle_3& t) {
  Common common;
  const auto met = CGAL::intersection(s, t);
  if (!met) return common;
  if (const auto* p = boost::get<ExactPoint>(&*met)) common.corners = {*p};
  else if (const auto* segment = boost::get<K::Segment_3>(&*met)) common.corners = {segment->source(), segment->target()};
  else if (const auto* triangle = boost::get<K::Triangle_3>(&*met)) common = {{(*triangle)[0], (*triangle)[1], (*triangle)[2]}, true};
  else if (const auto* polygon = boost::get<std::vector<ExactPoint>>(&*met)) common = {*polygon, true};
  return common;
}

// A plane seen along the axis that it faces most: exact both ways.
class View {
 public:
  View(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) : on_(a), normal_(CGAL::cross_product(b - a, c - a)) {
    for (int k = 1; k < 3; ++k)
      if (CGAL::abs(normal_[k]) > CGAL::abs(normal_[axis_])) axis_ = k;
  }
  int axis() const { return axis_; }
  /// Does the plane's own side face along the axis?
  bool along() const { return normal_[axis_] > 0; }
  K::Point_2 flat(const ExactPoint& p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }
  ExactPoint lifted(const K::Point_2& p) const {
    const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    std::array<K::FT, 3> x;
    x[u] = p.x(), x[v] = p.y();
    x[axis_] = on_[axis_] - (normal_[u] * (p.x() - on_[u]) + normal_[v] * (p.y() - on_[v])) / normal_[axis_];
    return {x[0], x[1], x[2]};
  }

 private:
  ExactPoint on_;
  K::Vector_3 normal_;
  int axis_ = 0;
};

struct Piece {
  Triangle corners;
  int times;   ///< how often the chain runs along it; > 0
};

class Arrangement {
 public:
  Arrangement(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, const std::function<void()>& pause) : pause_(pause), doubles_(points), triangles_(triangles) {
    for (const Vec3& p : points) points_.emplace_back(p.x(), p.y(), p.z());
    std::erase_if(triangles_, [&](const Triangle& t) { return has_no_area(points[t[0]], points[t[1]], points[t[2]]); });
  }

  ExactSurface boundary() {
    cut_all();
    return kept();
  }

 private:
  K::Triangle_3 exact(std::uint32_t t) const { return {points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]}; }

  void step() {
    if (++steps_ % steps_to_a_pause == 0) pause_();
  }

  std::int64_t number_of(const ExactPoint& p) {
    const auto [at, fresh] = numbers_.emplace(p, static_cast<std::int64_t>(points_.size()));
    if (fresh) points_.push_back(p);
    return at->second;
  }

  void cut_all() {
    DisjointSets planes(triangles_.size());   // triangles that overlap on their plane
    std::vector<std::vector<Common>> cuts(triangles_.size());
    std::vector<char> met(triangles_.size(), 0);
    for (const auto& [s, t] : meeting_triangles(doubles_, triangles_)) {
      step();
      const Common common = common_of(exact(s), exact(t));
      met[s] = met[t] = 1;
      if (common.flat) planes.join(s, t);
      else if (!common.corners.empty()) cuts[s].push_back(common), cuts[t].push_back(common);
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (met[t])
        for (const std::uint32_t v : triangles_[t]) numbers_.emplace(points_[v], v);
    std::map<std::uint32_t, std::vector<std::uint32_t>> members;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (met[t]) members[planes.root(t)].push_back(t);
      else pieces_.push_back({triangles_[t], 1});
    }
    for (const auto& [root, together] : members) cut(together, cuts);
  }

  // Triangles on one plane, by their own sides and by what they have in common with others.
  void cut(const std::vector<std::uint32_t>& together, const std::vector<std::vector<Common>>& cuts) {
    const Triangle& first = triangles_[together.front()];
    const View view(points_[first[0]], points_[first[1]], points_[first[2]]);
    Cut plane;
    std::map<std::int64_t, Cut::Vertex_handle> vertices;
    const auto vertex = [&](std::int64_t number) {
      auto& handle = vertices[number];
      if (handle == Cut::Vertex_handle()) {
        handle = plane.insert(view.flat(points_[static_cast<std::size_t>(number)]));
        handle->info().number = number;
      }
      return handle;
    };
    const auto line = [&](std::int64_t from, std::int64_t to) {
      if (from != to) lines_.emplace_back(from, to);
    };
    lines_.clear();
    for (const std::uint32_t t : together) {
      for (int k = 0; k < 3; ++k) line(triangles_[t][k], triangles_[t][(k + 1) % 3]);
      for (const Common& common : cuts[t])
        if (common.corners.size() == 1) vertex(number_of(common.corners[0]));
        else line(number_of(common.corners[0]), number_of(common.corners[1]));
    }
    for (const auto& [from, to] : lines_) vertex(from), vertex(to);   // all named before lines make others
    for (const auto& [from, to] : lines_) step(), plane.insert_constraint(vertex(from), vertex(to));
    for (auto v = plane.finite_vertices_begin(); v != plane.finite_vertices_end(); ++v)
      if (v->info().number < 0) v->info().number = number_of(view.lifted(v->point()));
    for (auto f = plane.finite_faces_begin(); f != plane.finite_faces_end(); ++f) {
      step();
      Piece piece{{}, together.size() == 1 ? (view.along() ? 1 : -1) : covered(*f, together, view)};
      for (int k = 0; k < 3; ++k) piece.corners[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(f->vertex(k)->info().number);
      if (piece.times < 0) std::swap(piece.corners[1], piece.corners[2]), piece.times = -piece.times;
      if (piece.times > 0) pieces_.push_back(piece);
    }
  }

  // How often more the triangles face along the axis there than against it.
  int covered(const Cut::Face& face, const std::vector<std::uint32_t>& together, const View& view) const {
    const K::Point_2 middle = CGAL::centroid(face.vertex(0)->point(), face.vertex(1)->point(), face.vertex(2)->point());
    int times = 0;
    for (const std::uint32_t t : together) {
      const K::Point_2 a = view.flat(points_[triangles_[t][0]]), b = view.flat(points_[triangles_[t][1]]), c = view.flat(points_[triangles_[t][2]]);
      const CGAL::Orientation turn = CGAL::orientation(a, b, c);
      if (CGAL::orientation(a, b, middle) == turn && CGAL::orientation(b, c, middle) == turn && CGAL::orientation(c, a, middle) == turn)
        times += turn == CGAL::LEFT_TURN ? 1 : -1;
    }
    return times;
  }

  ExactSurface kept() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> about;
    for (std::uint32_t p = 0; p < pieces_.size(); ++p)
      for (std::size_t k = 0; k < 3; ++k) about[std::minmax(pieces_[p].corners[k], pieces_[p].corners[(k + 1) % 3])].push_back(p);
    DisjointSets patches(pieces_.size());
    for (const auto& [edge, some] : about)
      if (some.size() == 2) patches.join(some[0], some[1]);
    boxes_.reserve(triangles_.size());
    for (const Triangle& t : triangles_) boxes_.push_back(Box3(doubles_[t[0]]).extend(doubles_[t[1]]).extend(doubles_[t[2]]));
    std::map<std::uint32_t, bool> bounds;
    ExactSurface surface;
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
      const auto [at, fresh] = bounds.try_emplace(patches.root(p), false);
      if (fresh) {
        pause_();
        const int outside = winding_number_before(pieces_[p]);
        at->second = outside <= 0 && outside + pieces_[p].times >= 1;
      }
      if (at->second) surface.triangles.push_back(pieces_[p].corners);
    }
    surface.points = std::move(points_);
    return surface;
  }

  // On the side that the piece faces: a ray from amid it, along the axis that it faces most, until one grazes nothing.
  int winding_number_before(const Piece& piece) const {
    const ExactPoint &a = points_[piece.corners[0]], &b = points_[piece.corners[1]], &c = points_[piece.corners[2]];
    const View view(a, b, c);
    for (int attempt = 1;; ++attempt) {
      const K::FT u = K::FT(attempt) / K::FT(3 * attempt + 1), v = K::FT(attempt + 1) / K::FT(3 * attempt + 4);
      if (const auto sum = winding_number_above(a + u * (b - a) + v * (c - a), view.axis())) return view.along() ? *sum : *sum - piece.times;
    }
  }

  // None if the ray meets an edge.
  std::optional<int> winding_number_above(const ExactPoint& x, int axis) const {
    std::array<std::pair<double, double>, 3> near;
    for (int k = 0; k < 3; ++k) near[static_cast<std::size_t>(k)] = CGAL::to_interval(x[k]);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto flat = [&](const ExactPoint& p) { return K::Point_2(p[u], p[v]); };
    const K::Point_2 below = flat(x);
    int sum = 0;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const Box3& box = boxes_[t];
      const auto beside = [&](int k) { return near[static_cast<std::size_t>(k)].first > box.max()[k] || near[static_cast<std::size_t>(k)].second < box.min()[k]; };
      if (beside(u) || beside(v) || near[static_cast<std::size_t>(axis)].first > box.max()[axis]) continue;
      const ExactPoint &a = points_[triangles_[t][0]], &b = points_[triangles_[t][1]], &c = points_[triangles_[t][2]];
      const std::array<CGAL::Orientation, 3> sides{CGAL::orientation(flat(a), flat(b), below), CGAL::orientation(flat(b), flat(c), below),
                                                   CGAL::orientation(flat(c), flat(a), below)};
      const bool left = std::count(sides.begin(), sides.end(), CGAL::RIGHT_TURN) == 0, right = std::count(sides.begin(), sides.end(), CGAL::LEFT_TURN) == 0;
      if (!left && !right) continue;
      if (std::count(sides.begin(), sides.end(), CGAL::COLLINEAR) > 0) {
        if (std::count(sides.begin(), sides.end(), CGAL::COLLINEAR) == 3 && beside_segments(flat(a), flat(b), flat(c), below)) continue;
        return std::nullopt;
      }
      const CGAL::Orientation side = CGAL::orientation(a, b, c, x);   // positive: on the side that it faces
      if (side == CGAL::COPLANAR) continue;                           // the piece's own plane
      const bool above = (side == CGAL::POSITIVE) != left;
      if (above) sum += left ? 1 : -1;
    }
    return sum;
  }

  static bool beside_segments(const K::Point_2& a, const K::Point_2& b, const K::Point_2& c, const K::Point_2& x) {
    const auto on = [&](const K::Point_2& p, const K::Point_2& q) { return CGAL::collinear_are_ordered_along_line(p, x, q); };
    return !on(a, b) && !on(b, c) && !on(c, a);
  }

  const std::function<void()>& pause_;
  const std::vector<Vec3>& doubles_;
  std::vector<ExactPoint> points_;
  std::vector<Triangle> triangles_;
  std::map<ExactPoint, std::int64_t> numbers_;   // of points on triangles that are cut
  std::vector<std::pair<std::int64_t, std::int64_t>> lines_;
  std::vector<Piece> pieces_;
  std::vector<Box3> boxes_;
  int steps_ = 0;
};

}  // namespace

ExactSurface boundary_of_winding(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, const std::function<void()>& pause) {
  return Arrangement(points, triangles, pause).boundary();
}

}  // namespace starcell
