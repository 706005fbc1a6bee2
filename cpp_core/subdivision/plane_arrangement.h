// The arrangement of a cell's supporting planes: which convex polygons of them bound E.
//
// Ground that V-planes stands on. Points are named by three planes through them, so that equal points are equal names; every
// sign that splits a polygon is certified by interval arithmetic on such points. More than three planes meet in the operands'
// own vertices: those lie on the planes of their facets because they are their corners, whatever arithmetic says, and take
// their name from the first three.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

#include "subdivision/local_planes.h"

namespace starcell {

/// A point on three planes, ascending labels: below the plane count surfaces, then the six sides of the cell (lower x, upper
/// x, lower y, ...).
using PointName = std::array<int, 3>;

/// edge[k] is the plane that cuts out the edge from corner k to k+1. Corners run counter-clockwise about the plane's normal.
struct PlanePolygon {
  int plane = 0;
  std::vector<int> corner;   ///< indices of points
  std::vector<int> edge;
  std::vector<signed char> side;  ///< per plane: which side of it the polygon lies on; 0 for its own
  bool positive_inside = false;   ///< E's solid is on the plane's positive side
};

class PlaneArrangement {
 public:
  PlaneArrangement(const Restriction& restriction, const CellProblem& problem, const LocalPlanes& local)
      : restriction_(restriction), problem_(problem), local_(local), box_(box_of(restriction.grid(), problem.cell)) {}

  /// Cuts every plane by all others and keeps the polygons of E. False: too many planes, or some sign is uncertain.
  bool build(std::size_t max_planes);

  int count() const { return static_cast<int>(surfaces_.size()); }
  const std::vector<std::uint32_t>& surfaces() const { return surfaces_; }
  const std::vector<PlanePolygon>& polygons() const { return polygons_; }
  /// Two walls of one candidate solid, nearer to each other than rounding tells: what is between them is not among the polygons.
  bool touching() const { return touching_; }
  const PointName& name(int point) const { return names_[point]; }
  Vec3 place(int point) const { return points_[point].middle() + box_.min(); }
  /// Is the polygon on the positive side of a plane that does not carry it?
  static bool above(const PlanePolygon& polygon, int plane) { return polygon.side[plane] > 0; }

 private:
  struct Plane {
    Interval n[3];
    Interval d;   // relative to the cell's lower corner
  };
  // A vertex of an operand in the cell with more than three planes around it.
  struct Star {
    std::uint32_t vertex;
    std::vector<int> planes;   // ascending
    bool has(int plane) const { return std::binary_search(planes.begin(), planes.end(), plane); }
  };

  static Interval value(const Plane& p, const Interval3& x) { return p.n[0] * x.x + p.n[1] * x.y + p.n[2] * x.z - p.d; }
  void make_planes();
  bool solve(const PointName& name, Interval3& x) const;
  int point(const PointName& name);
  bool start_polygon(int i, PlanePolygon& polygon);
  bool turn_to_normal(PlanePolygon& polygon) const;
  Interval3 local(std::uint32_t vertex) const;
  void find_stars();
  std::optional<int> star_of(const PointName& name) const;
  std::optional<int> side_of(int point, int plane) const;
  void find_reach();
  bool reaches(int i, int j, int side) const { return reach_[static_cast<std::size_t>(i) * surfaces_.size() + static_cast<std::size_t>(j)] & (side > 0 ? 1 : 2); }
  bool cut_plane(int i);
  bool split(PlanePolygon& part, int j, std::vector<PlanePolygon>& out);
  bool keep_boundary();
  bool certainly_inside(const PlanePolygon& polygon, const Vec3& middle);
  struct Cover {
    Membership flips = 0;      // solids whose facets cover the point
    Membership opposed = 0;    // candidates among them with facets of both senses there
  };
  Cover covering(int plane, const Vec3& x) const;
  bool holds_around(std::size_t slot, const Vec3& x) const;
  bool opposed_at(const Vec3& x, std::initializer_list<int> planes) const;
  void look_between_walls();
  bool candidates_beside(const PlanePolygon& polygon, const Vec3& middle, Membership opposed, Membership& around, Membership& flips);
  std::uint32_t surface_of(std::uint32_t facet) const { return local_.of(restriction_.table().surface[facet]); }

  const Restriction& restriction_;
  const CellProblem& problem_;
  const LocalPlanes& local_;
  const Box3 box_;
  std::vector<std::uint32_t> surfaces_;
  std::vector<Plane> planes_;
  std::vector<int> corner_sign_;
  std::vector<char> reach_;   // per plane i and j: bit 0, 1: facets of i may reach to the positive, negative side of j
  std::vector<Star> stars_;
  std::map<PointName, int> index_;
  std::vector<Interval3> points_;
  std::vector<int> point_star_;   // which star's vertex a point is, or -1
  std::vector<PointName> names_;
  std::vector<PlanePolygon> polygons_;
  bool touching_ = false;
};

}  // namespace starcell
