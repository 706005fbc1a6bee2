#include "operations/closed_offset.h"

#include <algorithm>
#include <cmath>

#include "numerics/predicates.h"

namespace starcell {
namespace {

// More planes than this are no few moved half-spaces.
constexpr std::size_t most_planes = 64;

// The supporting half-spaces of a convex polyhedron, each once; none if it is not convex, or has many.
std::optional<std::vector<HalfSpace>> planes_of_convex(const Polyhedron& solid) {
  const auto& points = solid.vertices();
  std::vector<HalfSpace> planes;
  std::vector<Triangle> taken;
  for (const Triangle& t : solid.triangles()) {
    const bool known = std::any_of(taken.begin(), taken.end(), [&](const Triangle& s) {
      return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return side(points[s[0]], points[s[1]], points[s[2]], points[v]) == 0; });
    });
    if (known) continue;
    if (planes.size() == most_planes) return std::nullopt;
    for (const Vec3& p : points)
      if (side(points[t[0]], points[t[1]], points[t[2]], p) > 0) return std::nullopt;
    taken.push_back(t);
    const Vec3 normal = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
    planes.push_back(HalfSpace::make(points[t[0]], normal.normalized()));
  }
  return planes;
}

// The erosion of an intersection is that of its parts, and of a half-space that is the half-space moved: so a convex polyhedron's
// has flat faces and sharp edges. The solid itself bounds what the half-spaces alone do not.
Expression moved_in(const Expression& solid, const std::vector<HalfSpace>& planes, double r) {
  std::vector<Expression> parts{solid};
  for (HalfSpace plane : planes) {
    plane.point += r * plane.normal;
    parts.emplace_back(plane);
  }
  return Expression::intersection(parts);
}

// Of revolution: radii at two heights above a base point. A cylinder has equal ones.
struct Frustum {
  Vec3 base, axis;
  double radius1, radius2, height;

  double slope() const { return (radius2 - radius1) / height; }
  Vec3 at(double z) const { return base + z * axis; }
};

Frustum frustum_of(const CurvedSolid& solid) {
  const std::vector<double>& p = solid.parameters();
  const Vec3 base(p[0], p[1], p[2]), axis = Vec3(p[3], p[4], p[5]).normalized();
  if (solid.kind() == CurvedSolid::Kind::cylinder) return {base, axis, p[6], p[6], p[7]};
  return {base, axis, p[6], p[7], p[8]};
}

CurvedSolidPtr solid_of(const Frustum& f) {
  if (f.radius1 == f.radius2) return CurvedSolid::cylinder(f.base, f.axis, f.radius1, f.height);
  return CurvedSolid::cone(f.base, f.axis, f.radius1, f.radius2, f.height);
}

// Radii where the moved side meets the moved ends; it may end in its tip before it reaches one.
std::optional<Expression> shrunk(const Frustum& f, double r) {
  const double slope = f.slope(), in = r * std::sqrt(1 + slope * slope);
  Frustum moved{f.at(-r), f.axis, f.radius1 - slope * r + in, f.radius2 + slope * r + in, f.height + 2 * r};
  if (!(moved.height > 0)) return std::nullopt;
  if (moved.radius1 > 0 && moved.radius2 <= 0 && slope < 0) {
    moved.height = -moved.radius1 / slope;
    moved.radius2 = 0;
  } else if (moved.radius2 > 0 && moved.radius1 <= 0 && slope > 0) {
    const double height = moved.radius2 / slope;
    moved.base = moved.at(moved.height - height);
    moved.height = height;
    moved.radius1 = 0;
  }
  if (!(std::max(moved.radius1, moved.radius2) > 0) || std::min(moved.radius1, moved.radius2) < 0) return std::nullopt;
  return Expression(solid_of(moved));
}

// In profile the side sweeps a rectangle, of which the moved side's own frustum leaves out a triangle at one rim; on sides no flatter
// than 45 degrees that lies within r of the rim.
std::optional<Expression> grown(const Frustum& f, double r) {
  const double slope = f.slope(), length = std::sqrt(1 + slope * slope);
  if (std::abs(slope) > 1) return std::nullopt;
  for (const double radius : {f.radius1, f.radius2})
    if (radius > 0 && r >= radius) return std::nullopt;   // such a torus meets itself
  const double out = r / length, up = -r * slope / length;
  std::vector<Expression> parts{Expression(solid_of({f.at(up), f.axis, f.radius1 + out, f.radius2 + out, f.height}))};
  if (slope == 0) {
    parts.emplace_back(CurvedSolid::cylinder(f.at(-r), f.axis, f.radius1, f.height + 2 * r));
  } else {
    parts.emplace_back(solid_of(f));
    // The slabs over the ends reach into the solid, no deeper than within r of it: their planes coincide with nothing.
    const double deep = 0.5 * std::min(r, f.height);
    if (f.radius1 > 0) parts.emplace_back(CurvedSolid::cylinder(f.at(-r), f.axis, f.radius1, r + deep));
    if (f.radius2 > 0) parts.emplace_back(CurvedSolid::cylinder(f.at(f.height - deep), f.axis, f.radius2, r + deep));
  }
  for (const auto& [radius, z] : {std::pair{f.radius1, 0.0}, std::pair{f.radius2, f.height}})
    parts.emplace_back(radius > 0 ? CurvedSolid::torus(f.at(z), f.axis, radius, r) : CurvedSolid::sphere(f.at(z), r));
  return Expression::set_union(parts);
}

std::optional<Expression> of_curved(const CurvedSolid& solid, double r) {
  const std::vector<double>& p = solid.parameters();
  if (!solid.maps().empty()) return std::nullopt;
  switch (solid.kind()) {
    case CurvedSolid::Kind::sphere:
      if (p[3] + r > 0) return Expression(CurvedSolid::sphere({p[0], p[1], p[2]}, p[3] + r));
      break;
    case CurvedSolid::Kind::torus:
      if (p[7] + r > 0 && p[7] + r < p[6]) return Expression(CurvedSolid::torus({p[0], p[1], p[2]}, {p[3], p[4], p[5]}, p[6], p[7] + r));
      break;
    case CurvedSolid::Kind::cylinder:
    case CurvedSolid::Kind::cone: return r < 0 ? shrunk(frustum_of(solid), r) : grown(frustum_of(solid), r);
    default: break;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Expression> closed_offset(const Expression& solid, double r) {
  switch (solid.kind()) {
    case Expression::Kind::half_space: {
      HalfSpace moved = solid.half_space();
      moved.point += r * moved.normal.normalized();
      return Expression(moved);
    }
    case Expression::Kind::polyhedron:
      if (r < 0)
        if (const auto planes = planes_of_convex(*solid.polyhedron())) return moved_in(solid, *planes, r);
      return std::nullopt;
    case Expression::Kind::curved: return of_curved(*solid.curved(), r);
    case Expression::Kind::complement:
      if (const auto inner = closed_offset(solid.operands().front(), -r)) return inner->complement();
      return std::nullopt;
    default: return std::nullopt;
  }
}

}  // namespace starcell
