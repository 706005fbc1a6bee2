// Where distance grows, and how it bends: normals of what is in sight, as boxes and as caps; second derivatives where feet are unique.
#include "distance/distance_surface.h"

#include "distance/distance_terms.h"

namespace starcell {

using namespace distance;

// Which way its distance grows from a face in the box: outward, unless the face is of a sheet and the box behind it (0: both).
int DistanceSurface::side_of(std::uint32_t face, const Vec3& center, const Vec3& reach) const {
  if (!sheet_) return 1;
  const MeshFeatures::Face& shape = features_->faces[face];
  const Vec3 from = center - features_->corner(face, 0);
  const double height = shape.normal.dot(from), h = spread(shape.normal, reach) + rounding_at(center) + shape.loss * (from.norm() + reach.norm());
  return height > h ? 1 : height < -h ? -1 : 0;
}

// Of s, wherever the feature is nearest in the box.
Interval3 DistanceSurface::normals(const Local& feature, const Sight& sight, const Vec3& center, const Vec3& reach) const {
  const MeshFeatures& f = *features_;
  if (feature.kind == Kind::face) {
    const int facing = side_of(feature.id, center, reach);
    return facing == 0 ? any_direction() : around(facing * f.faces[feature.id].normal, f.faces[feature.id].loss);
  }
  const bool is_edge = feature.kind == Kind::edge;
  const Bend bend = is_edge ? f.edges[feature.id].bend : f.vertices[feature.id].bend;
  const Cap& cap = is_edge ? f.edges[feature.id].cap : f.vertices[feature.id].cap;
  int side = side_;
  if (side == 0 && feature.interior) side = bend == Bend::convex ? 1 : bend == Bend::concave ? -1 : 0;
  Interval3 result = any_direction();
  if (side != 0) {
    const Vec3 w = away(feature, center);
    const Vec3 t = is_edge ? f.edges[feature.id].along : Vec3::Zero();
    const double loss = rounding_at(center) + 8 * ulp * (center.norm() + features_->scale() + reach.norm());
    const double far = w.norm(), radius = reach.norm();
    const Interval distance(std::max(sight.least, -(loss + radius - far)), std::min(far + radius + loss, sight.foot.high + radius));
    if (distance.lower() > 0) {
      const auto component = [&](int k) {
        double reached = loss;
        for (int j = 0; j < 3; ++j) reached += std::abs((j == k ? 1.0 : 0.0) - t[k] * t[j]) * reach[j] * (1 + 1e-12);
        return common(Interval(-1, 1), Interval(static_cast<double>(side)) * around(w[k], reached) / distance);
      };
      result = {component(0), component(1), component(2)};
    }
  }
  // All its faces are there. If they bend one way, what is nearest to it lies among their normals. In any case they form a graph over
  // the cap's axis, as steep as the cap is wide; the solid there holds the cone under that, and what is polar to a cone about the axis
  // is a cone about it: the cap. (A part may be reached from its back, and only what bends both ways.)
  const bool one_way = bend == Bend::convex || bend == Bend::concave;
  if (!sheet_ && feature.interior && cap.radius < 1.4 && (one_way || !split_)) {
    const Interval3 c = around(cap.axis, cap.radius * (1 + 1e-12));
    result = {common(c.x, result.x), common(c.y, result.y), common(c.z, result.z)};   // nothing in common: it is nearest nowhere
  }
  return result;
}

// The same, as a cap about the direction from the feature to the box's centre: nothing in the box is farther off that than the box's
// radius.
SlopeCap DistanceSurface::cap(const Local& feature, const Sight& sight, const Vec3& center, const Vec3& reach) const {
  const MeshFeatures& f = *features_;
  const SlopeCap none{Vec3::UnitX(), Interval(-1), Interval(0)};
  if (feature.kind == Kind::face) {
    const int facing = side_of(feature.id, center, reach);
    if (facing == 0) return none;
    return {facing * f.faces[feature.id].normal, Interval(1 - f.faces[feature.id].loss, 1), Interval(0, f.faces[feature.id].loss)};
  }
  if (side_ == 0 || !(sight.least > 0)) return none;
  const Vec3 w = away(feature, center);
  const double loss = rounding_at(center) + 8 * ulp * (center.norm() + f.scale() + reach.norm());
  const Interval sine = Interval(reach.norm() + loss) / (Interval(w.norm()) - loss);
  if (!(w.norm() > loss) || !(sine.upper() < 1) || !(sine.lower() > 0)) return none;
  const Vec3 axis = side_ * w / w.norm();
  return {axis, square_root(Interval(1.0) - squared(Interval(sine.upper()))), Interval(sine.upper())};
}

bool DistanceSurface::coplanar(const Sight& sight) const {
  if (sight.seen.empty()) return false;
  const MeshFeatures& f = *features_;
  const Local& first = *sight.seen.front();
  for (const Local* feature : sight.seen) {
    if (feature->kind != Kind::face) return false;
    const MeshFeatures::Face &p = f.faces[first.id], &q = f.faces[feature->id];
    if (feature->id != first.id && (p.normal - q.normal).norm() > 1e-11) return false;
    for (int k = 0; k < 3; ++k)
      if (std::abs(p.normal.dot(f.corner(feature->id, k) - f.corner(first.id, 0))) > 1e-12 * f.scale()) return false;
  }
  return true;
}

// One feature is one smooth distance. Otherwise: if all faces here are behind each other's planes, and every feature in sight has all
// its faces here, a nearest point is the projection to the convex polyhedron of those planes, and so unique.
bool DistanceSurface::unique_feet(const Sight& sight) const {
  if (sight.seen.size() == 1 || coplanar(sight)) return true;
  return all_behind_ && std::all_of(sight.seen.begin(), sight.seen.end(), [](const Local* feature) { return feature->interior; });
}

void DistanceSurface::bend(Expansion& e, const Sight& sight, const std::vector<Interval3>& normals) const {
  const bool flat = std::all_of(sight.seen.begin(), sight.seen.end(), [](const Local* feature) { return feature->kind == Kind::face; });
  const bool unique = unique_feet(sight) && (side_ != 0 || coplanar(sight));
  e.smooth = unique && (flat || sight.least > 0);
  if (side_ == 0 || !(sight.least > 0)) {
    if (flat && unique) e.bend = Interval(0.0);
    return;
  }
  const double most = flat ? 0.0 : (Interval(1.0) / sight.least).upper();
  const double least = unique ? 0.0 : -infinity;
  e.bend = side_ > 0 ? Interval(least, most) : Interval(-most, -least);
  if (!e.smooth) return;
  // Second derivatives: (1 - t t - n n) / distance about an edge, (1 - n n) / distance about a vertex, 0 on a face.
  bool any = false;
  for (std::size_t i = 0; i < sight.seen.size(); ++i) {
    const Local& feature = *sight.seen[i];
    IntervalSymmetric h;
    if (feature.kind != Kind::face) {
      const Vec3 t = feature.kind == Kind::edge ? features_->edges[feature.id].along : Vec3::Zero();
      const Interval3 n = normals[i], axis = around(t, 8 * ulp);
      const Interval scale = Interval(static_cast<double>(side_)) / Interval(sight.least, (Interval(sight.foot.high) + e.reach.norm() * (1 + 4 * ulp)).upper());
      const auto diagonal = [&](int k) {
        const Interval x = Interval(1.0) - squared(axis[k]) - squared(n[k]);
        return scale * Interval(std::max(0.0, x.lower()), std::max(0.0, x.upper()));
      };
      const auto mixed = [&](int j, int k) { return scale * (-(axis[j] * axis[k]) - n[j] * n[k]); };
      h = {diagonal(0), diagonal(1), diagonal(2), mixed(0, 1), mixed(0, 2), mixed(1, 2)};
    }
    e.hessian = !any ? h : IntervalSymmetric{hull(e.hessian.xx, h.xx), hull(e.hessian.yy, h.yy), hull(e.hessian.zz, h.zz),
                                             hull(e.hessian.xy, h.xy), hull(e.hessian.xz, h.xz), hull(e.hessian.yz, h.yz)};
    any = true;
  }
}

}  // namespace starcell
