// What can be nearest in a box: the nearest point of the faces, its side, and the features in sight.
#include "distance/distance_surface.h"

#include <cmath>

#include "distance/distance_terms.h"

namespace starcell {

using namespace distance;

// By regions of the triangle's plane (Ericson 2005, 5.1.5), then enclosed whatever rounding did to it: no point of the triangle is
// nearer than min over its corners of g . (x - corner), for any unit vector g.
DistanceSurface::Foot DistanceSurface::foot_at(const Vec3& x, double beyond, double* lows) const {
  const MeshFeatures& f = *features_;
  Foot best;
  double nearest = infinity;
  best.low = infinity;
  const double loss = rounding_at(x);
  // The one in front first, in its place the first.
  for (std::size_t step = 0; step < faces_.size(); ++step) {
    const std::size_t i = step == 0 ? front_ : step == front_ ? 0 : step;
    const std::uint32_t face = faces_[i];
    const MeshFeatures::Face& shape = f.faces[face];
    const double within = nearest + beyond + shape.radius + 4 * loss;
    if ((x - shape.middle).squaredNorm() > within * within) {
      if (lows) lows[i] = infinity;
      continue;
    }
    const auto& [a, b, c] = shape.corners;
    const std::array<Vec3, 3> from{x - a, x - b, x - c};
    std::array<double, 3> along, inward;
    for (std::size_t k = 0; k < 3; ++k) along[k] = from[k].dot(shape.along[k]), inward[k] = from[k].dot(shape.inward[k]);
    Vec3 place = a;
    std::uint8_t bit = face_bit;
    if (inward[0] > 0 && inward[1] > 0 && inward[2] > 0) {
      place = x - from[0].dot(shape.normal) * shape.normal;
    } else {
      double least = infinity;
      for (int k = 0; k < 3; ++k) {
        if (inward[static_cast<std::size_t>(k)] > 0) continue;
        const auto e = static_cast<std::size_t>(k);
        const double t = std::clamp(along[e], 0.0, shape.length[e]);
        const Vec3 p = shape.corners[e] + t * shape.along[e];
        const double square = (x - p).squaredNorm();
        if (square >= least) continue;
        least = square;
        place = p;
        bit = t <= 0 ? corner_bit(k) : t >= shape.length[e] ? corner_bit((k + 1) % 3) : edge_bit(k);
      }
    }
    const Vec3 g = x - place;
    const double d = g.norm();
    const double low = d > 0 ? std::min({g.dot(from[0]), g.dot(from[1]), g.dot(from[2])}) / d : 0;
    if (lows) lows[i] = low;
    best.low = std::min(best.low, low);
    if (d < nearest) nearest = d, best.place = place, best.face = face, best.bit = bit;
  }
  best.low = std::max(0.0, best.low - loss);
  best.high = nearest + loss;
  return best;
}

// By the pseudo-normal of the nearest feature (Bærentzen & Aanæs 2005); far above rounding, or not at all.
int DistanceSurface::side_at(const Vec3& x, const Foot& foot) const {
  if (side_ != 0) return side_;
  if (!(foot.low > 1e3 * rounding_at(x))) return 0;
  const MeshFeatures& f = *features_;
  Vec3 normal;
  if (foot.bit == face_bit) {
    normal = f.faces[foot.face].normal;
  } else if (foot.bit < corner_bit(0)) {
    normal = f.edges[f.edge_of[foot.face][foot.bit - edge_bit(0)]].cap.axis;
  } else {
    normal = f.vertices[f.solid()->triangles()[foot.face][foot.bit - corner_bit(0)]].pseudo_normal;
  }
  const double along = (x - foot.place).dot(normal);
  if (!(std::abs(along) > 1e-6 * foot.high * normal.norm())) return 0;
  return along > 0 ? 1 : -1;
}

// The features of one triangle that can be nearest in it to some point of the box.
std::uint8_t DistanceSurface::mask(std::uint32_t face, const Vec3& center, const Vec3& reach) const {
  const MeshFeatures& f = *features_;
  const MeshFeatures::Face& shape = f.faces[face];
  std::array<double, 3> first, last, low, high;   // along and inward of edge k, at the least and at the most
  double far = 0;
  for (const Vec3& corner : shape.corners) far = std::max(far, (center - corner).squaredNorm());
  far = std::sqrt(far);
  const double loss = rounding_at(center) + (shape.loss + 16 * ulp) * (far + reach.norm());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 from = center - shape.corners[k];
    const double along = from.dot(shape.along[k]), inward = from.dot(shape.inward[k]);
    const double a = spread(shape.along[k], reach) + loss, b = spread(shape.inward[k], reach) + loss;
    first[k] = along - a, last[k] = along + a, low[k] = inward - b, high[k] = inward + b;
  }
  std::uint8_t bits = 0;
  if (high[0] >= 0 && high[1] >= 0 && high[2] >= 0) {
    const double height = (center - f.corner(face, 0)).dot(shape.normal), h = spread(shape.normal, reach) + loss;
    if (sheet_ || side_ == 0 || side_ * height + h >= 0) bits |= 1u << face_bit;
  }
  for (int k = 0; k < 3; ++k) {
    const auto e = static_cast<std::size_t>(k), before = static_cast<std::size_t>((k + 2) % 3);
    if (low[e] <= 0 && last[e] >= 0 && first[e] <= shape.length[e]) bits |= 1u << edge_bit(k);
    if (first[e] <= 0 && last[before] >= shape.length[before]) bits |= 1u << corner_bit(k);
  }
  return bits;
}

// From the feature's line, point or plane to x.
Vec3 DistanceSurface::away(const Local& feature, const Vec3& x) const {
  const MeshFeatures& f = *features_;
  if (feature.kind == Kind::vertex) return x - f.solid()->vertices()[feature.id];
  if (feature.kind == Kind::face) {
    const Vec3& n = f.faces[feature.id].normal;
    return n.dot(x - f.corner(feature.id, 0)) * n;
  }
  const MeshFeatures::Edge& e = f.edges[feature.id];
  const Vec3 from = x - f.solid()->vertices()[e.a];
  return from - from.dot(e.along) * e.along;
}

// A feature counts if all its faces here say so. One that is farther than the foot everywhere in the box does not: its own distance
// is convex, the foot's has second derivatives of at most 1 / distance.
DistanceSurface::Sight DistanceSurface::look(const Vec3& center, const Vec3& reach) const {
  thread_local std::vector<double> all_lows;
  thread_local std::vector<std::uint8_t> all_masks;
  all_lows.resize(faces_.size());
  all_masks.assign(faces_.size(), known_mask);
  double* const lows = all_lows.data();
  std::uint8_t* const masks = all_masks.data();
  Sight sight;
  const double radius = reach.norm() * (1 + 4 * ulp), loss = 4 * rounding_at(center);
  sight.foot = foot_at(center, 2 * radius + 2 * loss, lows);
  sight.side = side_at(center, sight.foot);
  sight.least = std::max(0.0, -(radius - sight.foot.low));
  for (std::size_t i = 0; i < faces_.size(); ++i)
    if (lows[i] <= sight.foot.high + 2 * radius + loss) masks[i] = 0;
  for (const Local& feature : local_) sight.seen.push_back(&feature);
  keep_in_sight(sight, center, reach, masks);
  return sight;
}

// Of those in sight from a box, what is in sight from its centre.
DistanceSurface::Sight DistanceSurface::look_closer(const Sight& sight, const Vec3& center) const {
  thread_local std::vector<std::uint8_t> masks;
  masks.assign(faces_.size(), 0);
  Sight closer = sight;
  closer.least = sight.foot.low;
  keep_in_sight(closer, center, Vec3::Zero(), masks.data());
  return closer;
}

void DistanceSurface::keep_in_sight(Sight& sight, const Vec3& center, const Vec3& reach, std::uint8_t* masks) const {
  const double radius = reach.norm() * (1 + 4 * ulp), loss = 4 * rounding_at(center), d = sight.foot.high;
  const Vec3 to_foot = d > 0 ? Vec3((center - sight.foot.place) / (center - sight.foot.place).norm()) : Vec3::Zero();
  const double curve = d > radius ? radius * radius / (2 * (sight.foot.low - radius)) : infinity;
  const auto can_be_nearest = [&](const Local& feature) {
    for (const auto& [face, bit] : feature.bits) {
      if (!(masks[face] & known_mask)) masks[face] = known_mask | mask(faces_[face], center, reach);
      if (!(masks[face] >> bit & 1)) return false;
    }
    const Vec3 g = away(feature, center);
    const double far = g.norm();
    const double slack = feature.kind == Kind::face ? features_->faces[feature.id].loss * (far + radius + d) * 4 : 0;
    if (far - d > 2 * radius + loss + slack) return false;
    return !(curve >= 0 && far > 0 && far - d > spread(g / far - to_foot, reach) * (1 + 1e-9) + curve + loss + slack);
  };
  sight.seen.erase(std::remove_if(sight.seen.begin(), sight.seen.end(), [&](const Local* feature) { return !can_be_nearest(*feature); }),
                   sight.seen.end());
}

}  // namespace starcell
