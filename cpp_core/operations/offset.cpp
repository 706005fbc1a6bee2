#include "operations/offset.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "numerics/predicates.h"

namespace starcell {
namespace {

// What tessellating an operand may take of the error.
constexpr double tessellation_share = 0.25;
// What the first of two offsets may take.
constexpr double first_share = 0.4;

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

class Offsetting {
 public:
  Offsetting(double error, const Options& options) : error_(error), options_(options) {}

  Expression of(const Expression& e, double r) const {
    using Kind = Expression::Kind;
    switch (e.kind()) {
      case Kind::polyhedron:
        if (r < 0)
          if (const auto planes = planes_of_convex(*e.polyhedron())) return moved_in(e, *planes, r);
        return Expression(OffsetSolid::make(e.polyhedron(), r));
      case Kind::half_space: {
        HalfSpace moved = e.half_space();
        moved.point += r * moved.normal.normalized();
        return Expression(moved);
      }
      case Kind::curved:
        if (const auto closed = closed_form(*e.curved(), r)) return Expression(closed);
        break;
      case Kind::complement: return of(e.operands().front(), -r).complement();
      case Kind::set_union:
        if (r > 0) return Expression::set_union(parts_of(e, r));
        break;
      case Kind::intersection:
        if (r < 0) return Expression::intersection(parts_of(e, r));
        break;
      case Kind::offset: break;
    }
    return Expression(OffsetSolid::make(meshed(e), r));
  }

  /// The solid as a polyhedron: itself, or a certified mesh of it.
  PolyhedronPtr meshed(const Expression& e) const {
    if (e.kind() == Expression::Kind::polyhedron) return e.polyhedron();
    Options options = options_;
    options.error = tessellation_share * error_;
    options.contact.reset();
    Result mesh = evaluate(e, options);
    if (mesh.triangles.empty()) throw std::invalid_argument("solid: it is empty, or has no certified mesh within the error");
    Provenance provenance;
    provenance.name = "mesh of the solid";
    provenance.deflection = mesh.certificate.error_bound;
    return Polyhedron::trusted(std::move(mesh.vertices), std::move(mesh.triangles), std::move(provenance));
  }

 private:
  // One by one where there are closed forms. The others are taken together: their faces may lie on one plane, and so would their
  // offsets' surfaces, which have no identity.
  std::vector<Expression> parts_of(const Expression& e, double r) const {
    std::vector<Expression> result, others;
    for (const Expression& operand : e.operands()) {
      const bool closed = operand.kind() == Expression::Kind::half_space ||
                          (operand.kind() == Expression::Kind::curved && closed_form(*operand.curved(), r));
      if (closed)
        result.push_back(of(operand, r));
      else
        others.push_back(operand);
    }
    if (others.size() == 1) result.push_back(of(others.front(), r));
    if (others.size() > 1) {
      const Expression all = e.kind() == Expression::Kind::set_union ? Expression::set_union(others) : Expression::intersection(others);
      result.push_back(of(Expression(meshed(all)), r));
    }
    return result;
  }

  // The erosion of an intersection is that of its parts, and of a half-space that is the half-space moved: so a convex polyhedron's
  // has flat faces and sharp edges. The solid itself bounds what the half-spaces alone do not.
  static Expression moved_in(const Expression& solid, const std::vector<HalfSpace>& planes, double r) {
    std::vector<Expression> parts{solid};
    for (HalfSpace plane : planes) {
      plane.point += r * plane.normal;
      parts.emplace_back(plane);
    }
    return Expression::intersection(parts);
  }

  // Balls, tori, and inward cylinders and cones, that were only moved: see moved_in().
  static CurvedSolidPtr closed_form(const CurvedSolid& solid, double r) {
    const std::vector<double>& p = solid.parameters();
    if (!solid.maps().empty()) return nullptr;
    if (solid.kind() == CurvedSolid::Kind::sphere && p[3] + r > 0) return CurvedSolid::sphere({p[0], p[1], p[2]}, p[3] + r);
    if (solid.kind() == CurvedSolid::Kind::torus && p[7] + r > 0 && p[7] + r < p[6])
      return CurvedSolid::torus({p[0], p[1], p[2]}, {p[3], p[4], p[5]}, p[6], p[7] + r);
    if (r < 0 && solid.kind() == CurvedSolid::Kind::cylinder && p[6] + r > 0 && p[7] + 2 * r > 0) {
      const Vec3 axis = Vec3(p[3], p[4], p[5]).normalized();
      return CurvedSolid::cylinder(Vec3(p[0], p[1], p[2]) - r * axis, axis, p[6] + r, p[7] + 2 * r);
    }
    if (r < 0 && solid.kind() == CurvedSolid::Kind::cone) {
      // Radii where the moved cone meets the moved ends.
      const Vec3 axis = Vec3(p[3], p[4], p[5]).normalized();
      const double slope = (p[7] - p[6]) / p[8], in = r * std::sqrt(1 + slope * slope);
      const double radius1 = p[6] - slope * r + in, radius2 = p[7] + slope * r + in, height = p[8] + 2 * r;
      const Vec3 base = Vec3(p[0], p[1], p[2]) - r * axis;
      // The moved cone may end in its tip before it reaches an end.
      if (radius1 > 0 && radius2 <= 0 && slope < 0 && height > 0) return CurvedSolid::cone(base, axis, radius1, 0, -radius1 / slope);
      if (radius2 > 0 && radius1 <= 0 && slope > 0 && height > 0)
        return CurvedSolid::cone(base + (height - radius2 / slope) * axis, axis, 0, radius2, radius2 / slope);
      if (radius1 > 0 && radius2 > 0 && height > 0) return CurvedSolid::cone(base, axis, radius1, radius2, height);
    }
    return nullptr;
  }

  double error_;
  const Options& options_;
};

void check(double value, const char* name) {
  if (!std::isfinite(value) || value == 0) throw std::invalid_argument(std::string(name) + ": must be finite and not 0");
}

// The error asked for, or what it is if it was not: the result's longest side / 128.
double error_for(const Expression& solid, double grown, const Options& options) {
  if (options.error) return *options.error;
  const double length = longest_side(solid.bounding_box()) + 2 * std::max(0.0, grown);
  return length / 128;
}

Options with_error(const Options& options, double error) {
  Options result = options;
  result.error = error;
  return result;
}

// Offset by `first` and back by -first: the first result is the second one's operand.
Prepared twice(const Expression& solid, double first, const Options& options) {
  const double error = error_for(solid, 0, options);
  const Options inner = with_error(options, first_share * error);
  const Prepared one = prepare_offset(solid, first, inner);
  const Offsetting offsetting(error, options);
  Result mesh = evaluate(one.expression, one.options);
  if (mesh.triangles.empty()) return {one.expression, with_error(options, error)};   // it is gone, and stays so
  Provenance provenance;
  provenance.name = first < 0 ? "erosion" : "dilation";
  provenance.deflection = mesh.certificate.error_bound;
  const auto middle = Polyhedron::trusted(std::move(mesh.vertices), std::move(mesh.triangles), std::move(provenance));
  return {offsetting.of(Expression(middle), -first), with_error(options, error)};
}

}  // namespace

Prepared prepare_offset(const Expression& solid, double distance, const Options& options) {
  check(distance, "distance");
  const double error = error_for(solid, distance, options);
  return {Offsetting(error, options).of(solid, distance), with_error(options, error)};
}

Prepared prepare_shell(const Expression& solid, double thickness, const Options& options) {
  check(thickness, "thickness");
  const double error = error_for(solid, thickness, options);
  const Expression moved = Offsetting(error, options).of(solid, thickness);
  return {thickness > 0 ? Expression::difference(moved, solid) : Expression::difference(solid, moved), with_error(options, error)};
}

Prepared prepare_opening(const Expression& solid, double radius, const Options& options) {
  check(radius, "radius");
  if (radius < 0) throw std::invalid_argument("radius: must be positive");
  return twice(solid, -radius, options);
}

Prepared prepare_closing(const Expression& solid, double radius, const Options& options) {
  check(radius, "radius");
  if (radius < 0) throw std::invalid_argument("radius: must be positive");
  return twice(solid, radius, options);
}

}  // namespace starcell
