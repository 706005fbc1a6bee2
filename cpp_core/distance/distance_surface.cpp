#include "distance/distance_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "solids/quadric_surface.h"

namespace starcell {
namespace {

constexpr double ulp = 2.3e-16;
constexpr double infinity = std::numeric_limits<double>::infinity();
// More faces than this are not looked at feature by feature: the cell has to be smaller. Unless that does not help: many faces may
// have one vertex, as the tip of a cone.
constexpr std::size_t most_faces = 64;
constexpr std::size_t most_about_a_vertex = 4096;
constexpr double helps = 0.8;
// More convex sheets than this are left in one piece.
constexpr std::size_t most_sheets = 4;
// Normals whose cosines with their mean are no less need no sheets of their own.
constexpr double nearly_one = 0.8;

// Bits of a face's mask: its interior, edge k, corner k.
constexpr std::uint8_t face_bit = 0;
std::uint8_t edge_bit(int k) { return static_cast<std::uint8_t>(1 + k); }
std::uint8_t corner_bit(int k) { return static_cast<std::uint8_t>(4 + k); }

double spread(const Vec3& u, const Vec3& reach) { return u.cwiseAbs().dot(reach); }

Interval hull(const Interval& a, const Interval& b) { return {std::min(a.lower(), b.lower()), std::max(a.upper(), b.upper())}; }
Interval3 hull(const Interval3& a, const Interval3& b) { return {hull(a.x, b.x), hull(a.y, b.y), hull(a.z, b.z)}; }
Interval common(const Interval& a, const Interval& b) {
  const double low = std::max(a.lower(), b.lower()), high = std::min(a.upper(), b.upper());
  return low <= high ? Interval(low, high) : a;
}
Interval around(double x, double radius) { return {-(radius - x), x + radius}; }
Interval3 around(const Vec3& x, double radius) { return {around(x.x(), radius), around(x.y(), radius), around(x.z(), radius)}; }
Interval3 any_direction() { return {Interval(-1, 1), Interval(-1, 1), Interval(-1, 1)}; }

}  // namespace

DistanceSurface::DistanceSurface(std::shared_ptr<const MeshFeatures> features, double offset)
    : features_(std::move(features)), offset_(offset) {
  faces_.resize(features_->size());
  std::iota(faces_.begin(), faces_.end(), 0u);
  find_local();
}

DistanceSurface::DistanceSurface(std::shared_ptr<const MeshFeatures> features, std::vector<std::uint32_t> faces, double radius)
    : features_(std::move(features)), offset_(radius), sheet_(true), side_(1), faces_(std::move(faces)) {
  find_local();
}

DistanceSurface::DistanceSurface(const DistanceSurface& whole, std::vector<std::uint32_t> faces, const Box3& box)
    : features_(whole.features_), offset_(whole.offset_), sheet_(whole.sheet_), towards_(whole.towards_), side_(whole.side_), faces_(std::move(faces)), box_(box) {}

double DistanceSurface::rounding_at(const Vec3& x) const { return 64 * ulp * (features_->scale() + x.cwiseAbs().maxCoeff()); }

// Which features of the faces can be nearest to anything: what bends the wrong way, or not at all, never is, unless some of the
// faces about it are missing here.
void DistanceSurface::find_local() {
  local_.clear();
  if (faces_.size() > (crowded_ ? most_about_a_vertex : most_faces)) return;
  const MeshFeatures& f = *features_;
  std::map<std::uint32_t, Local> edges, vertices;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const std::uint32_t face = faces_[i];
    const auto index = static_cast<std::uint16_t>(i);
    local_.push_back({Kind::face, face, true, {{index, face_bit}}});
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t e = f.edge_of[face][static_cast<std::size_t>(k)], v = f.solid()->triangles()[face][static_cast<std::size_t>(k)];
      edges.try_emplace(e, Local{Kind::edge, e, false, {}}).first->second.bits.emplace_back(index, edge_bit(k));
      vertices.try_emplace(v, Local{Kind::vertex, v, false, {}}).first->second.bits.emplace_back(index, corner_bit(k));
    }
  }
  const auto keep = [&](Local& feature, Bend bend, std::size_t faces_about) {
    feature.interior = feature.bits.size() == faces_about;
    const bool never = bend == Bend::flat || (!sheet_ && side_ > 0 && bend == Bend::concave) || (side_ < 0 && bend == Bend::convex);
    if (!feature.interior || !never) local_.push_back(std::move(feature));
  };
  for (auto& [id, feature] : edges) keep(feature, f.edges[id].bend, 2);
  for (auto& [id, feature] : vertices) keep(feature, f.vertices[id].bend, f.first_about[id + 1] - f.first_about[id]);

  all_behind_ = side_ != 0 && !sheet_;
  for (std::size_t i = 0; i < faces_.size() && all_behind_; ++i)
    for (std::size_t j = 0; j < faces_.size() && all_behind_; ++j) all_behind_ = i == j || behind(faces_[j], faces_[i]);
}

// By regions of the triangle's plane (Ericson 2005, 5.1.5), then enclosed whatever rounding did to it: no point of the triangle is
// nearer than min over its corners of g . (x - corner), for any unit vector g.
DistanceSurface::Foot DistanceSurface::foot_at(const Vec3& x, double* lows) const {
  const MeshFeatures& f = *features_;
  Foot best;
  double nearest = infinity;
  best.low = infinity;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const std::uint32_t face = faces_[i];
    const MeshFeatures::Face& shape = f.faces[face];
    const Vec3 &a = f.corner(face, 0), &b = f.corner(face, 1), &c = f.corner(face, 2);
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
        const Vec3 p = f.corner(face, k) + t * shape.along[e];
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
  const double loss = rounding_at(x);
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
  for (int k = 0; k < 3; ++k) far = std::max(far, (center - f.corner(face, k)).norm());
  const double loss = rounding_at(center) + (shape.loss + 16 * ulp) * (far + reach.norm());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 from = center - f.corner(face, static_cast<int>(k));
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
  all_masks.assign(faces_.size(), 0);
  double* const lows = all_lows.data();
  std::uint8_t* const masks = all_masks.data();
  Sight sight;
  sight.foot = foot_at(center, lows);
  sight.side = side_at(center, sight.foot);
  const double radius = reach.norm() * (1 + 4 * ulp);
  sight.least = std::max(0.0, -(radius - sight.foot.low));
  const double d = sight.foot.high, loss = 4 * rounding_at(center);
  for (std::size_t i = 0; i < faces_.size(); ++i)
    if (lows[i] <= d + 2 * radius + loss) masks[i] = mask(faces_[i], center, reach);
  const Vec3 to_foot = d > 0 ? Vec3((center - sight.foot.place) / (center - sight.foot.place).norm()) : Vec3::Zero();
  const double curve = d > radius ? radius * radius / (2 * (sight.foot.low - radius)) : infinity;
  for (const Local& feature : local_) {
    bool possible = true;
    for (const auto& [face, bit] : feature.bits) {
      possible = masks[face] >> bit & 1;
      if (!possible) break;
    }
    if (!possible) continue;
    const Vec3 g = away(feature, center);
    const double far = g.norm();
    const double slack = feature.kind == Kind::face ? features_->faces[feature.id].loss * (far + radius + d) * 4 : 0;
    if (far - d > 2 * radius + loss + slack) continue;
    if (curve >= 0 && far > 0 && far - d > spread(g / far - to_foot, reach) * (1 + 1e-9) + curve + loss + slack) continue;
    sight.seen.push_back(&feature);
  }
  return sight;
}

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

Expansion DistanceSurface::expand(const Vec3& center, const Vec3& reach) const {
  Expansion e;
  e.reach = reach;
  e.smooth = false;
  e.steepest = 1;   // as every distance is
  Sight sight;
  if (simple()) {
    sight = look(center, reach);
  } else {
    sight.foot = foot_at(center);
    sight.side = side_at(center, sight.foot);
  }
  const Interval distance(sight.foot.low, sight.foot.high);
  const Interval s = sight.side > 0 ? distance : sight.side < 0 ? Interval(-sight.foot.high, -sight.foot.low) : Interval(-sight.foot.high, sight.foot.high);
  e.value = s - offset_;
  e.gradient = e.slope = any_direction();
  // Beyond the solid's surface, outside the box it was restricted to, s is another function: nothing is said of it there.
  if (sight.seen.empty() || (side_ != 0 && !(sight.least > 0))) return e;
  std::vector<Interval3> normals;
  for (const Local* feature : sight.seen) normals.push_back(this->normals(*feature, sight, center, reach));
  e.slope = normals.front();
  for (const Interval3& n : normals) e.slope = hull(e.slope, n);
  bend(e, sight, normals);
  if (side_ != 0) e.source = offset_;
  for (const Local* feature : sight.seen) e.caps.push_back(cap(*feature, sight, center, reach));
  e.slopes = std::move(normals);
  if (!e.smooth) return e;
  if (reach.isZero(0.0)) {
    e.gradient = e.slope;
    return e;
  }
  const Sight here = look(center, Vec3::Zero());
  bool any = false;
  for (const Local* feature : here.seen) {
    const Interval3 n = this->normals(*feature, here, center, Vec3::Zero());
    e.gradient = any ? hull(e.gradient, n) : n;
    any = true;
  }
  return e;
}

double DistanceSurface::value(const Vec3& x, Vec3* gradient) const {
  const Foot foot = foot_at(x);
  int side = side_at(x, foot);
  const Vec3& normal = features_->faces[foot.face].normal;
  if (side == 0) side = (x - foot.place).dot(normal) < 0 ? -1 : 1;
  const double d = (x - foot.place).norm();
  if (gradient) *gradient = d > 1e3 * rounding_at(x) ? Vec3(side * (x - foot.place) / d) : normal;
  return side * d - offset_;
}

SmoothSurfacePtr DistanceSurface::translated(const Vec3& by) const {
  std::vector<Vec3> moved = features_->solid()->vertices();
  for (Vec3& p : moved) p += by;
  const auto solid = Polyhedron::trusted(std::move(moved), features_->solid()->triangles(), features_->solid()->provenance());
  const auto features = std::make_shared<const MeshFeatures>(solid);
  if (sheet_) return std::make_shared<DistanceSurface>(features, faces_, offset_);
  return std::make_shared<DistanceSurface>(features, offset_);
}

// What is nearest at some point of the box is no farther from its centre than the nearest face and the box's diameter; and of those
// farther than it, none that stays so in the whole box.
SmoothSurfacePtr DistanceSurface::restricted(const Box3& box) const {
  const Rounding rounding;
  const Vec3 center = box.center(), reach = 0.5 * box.sizes() * (1 + 4 * ulp);
  const double radius = reach.norm() * (1 + 4 * ulp), loss = rounding_at(center);
  struct Candidate {
    std::uint32_t face;
    double distance;
    Vec3 away;
  };
  std::vector<Candidate> near;
  double nearest = infinity;
  Foot best;
  DistanceSurface one(*this, {0}, box);
  for (const std::uint32_t face : faces_) {
    // A face's own plane rules most out.
    const MeshFeatures::Face& shape = features_->faces[face];
    const double height = std::abs((center - features_->corner(face, 0)).dot(shape.normal));
    if (height > nearest + 2 * radius + 4 * loss && shape.loss * 4 * (height + features_->scale()) < loss) continue;
    one.faces_[0] = face;
    const Foot foot = one.foot_at(center);
    if (foot.low > nearest + 2 * radius) continue;
    if (foot.high < nearest) nearest = foot.high, best = foot;
    near.push_back({face, foot.low, center - foot.place});
  }
  const Vec3 to_best = center - best.place;
  const double far = to_best.norm();
  const double curve = best.low > radius && far > 0 ? radius * radius / (2 * (best.low - radius)) : infinity;
  std::vector<std::uint32_t> faces;
  for (const Candidate& c : near) {
    if (c.distance > nearest + 2 * radius) continue;
    const double own = c.away.norm();
    if (std::isfinite(curve) && own > 0 && c.distance - nearest > spread(c.away / own - to_best / far, reach) * (1 + 1e-9) + curve + 4 * loss) continue;
    faces.push_back(c.face);
  }
  auto result = std::shared_ptr<DistanceSurface>(new DistanceSurface(*this, std::move(faces), box));
  if (side_ == 0 && best.low > radius) result->side_ = side_at(center, best);
  if (sheet_ && far > 0) result->towards_ = to_best.dot(features_->faces[best.face].normal) < 0 ? -1 : 1;
  result->crowded_ = box_.isEmpty() ? false : static_cast<double>(result->faces_.size()) > helps * static_cast<double>(faces_.size());
  result->find_local();
  return result;
}

// The distance from one feature's line or point as a quadric, square root and all: the same sign, and far cheaper.
SmoothSurfacePtr DistanceSurface::on_one(const Local& feature) const {
  const MeshFeatures& f = *features_;
  const Rounding rounding;
  const double r = std::abs(offset_);
  const Interval scale = Interval(static_cast<double>(side_)) / (2.0 * Interval(r));
  const bool is_edge = feature.kind == Kind::edge;
  const Interval3 t = is_edge ? around(f.edges[feature.id].along, 8 * ulp) : Interval3{};
  const auto entry = [&](int j, int k) { return scale * ((j == k ? Interval(1.0) : Interval(0.0)) - t[j] * t[k]); };
  const IntervalSymmetric a{entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
  const Vec3& origin = f.solid()->vertices()[is_edge ? f.edges[feature.id].a : feature.id];
  return std::make_shared<QuadricSurface>(origin, a, Interval3{}, Interval(static_cast<double>(-side_)) * r * 0.5, 1.0);
}

// Faces that share a vertex.
std::vector<std::vector<std::uint32_t>> DistanceSurface::sheets() const {
  std::vector<std::size_t> root(faces_.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::uint32_t, std::size_t> first;   // per vertex
  for (std::size_t i = 0; i < faces_.size(); ++i)
    for (const std::uint32_t v : features_->solid()->triangles()[faces_[i]]) root[find(i)] = find(first.emplace(v, i).first->second);
  std::vector<std::vector<std::uint32_t>> sheets;
  std::map<std::size_t, std::size_t> number;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const auto [at, fresh] = number.emplace(find(i), sheets.size());
    if (fresh) sheets.emplace_back();
    sheets[at->second].push_back(faces_[i]);
  }
  return sheets;
}

// Is face g, seen from their side, behind f's plane?
bool DistanceSurface::behind(std::uint32_t g, std::uint32_t f) const {
  const MeshFeatures::Face& plane = features_->faces[f];
  const double slack = 1e-12 * features_->scale();
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = features_->corner(g, k) - features_->corner(f, 0);
    if ((sheet_ ? towards_ : side_) * plane.normal.dot(from) > slack || plane.loss * from.norm() > slack) return false;
  }
  return true;
}

// Sets of faces behind each other's planes, as large as they get; they overlap. The distance from each is smooth where its rim is far,
// so creases of the offset run between patches. Empty: more than a few.
std::vector<std::vector<std::uint32_t>> DistanceSurface::convex_sheets() const {
  std::vector<std::vector<std::uint32_t>> sheets;
  std::vector<char> covered(faces_.size(), 0);
  for (std::size_t seed = 0; seed < faces_.size(); ++seed) {
    if (covered[seed]) continue;
    if (sheets.size() == most_sheets) return {};
    std::vector<std::uint32_t> sheet{faces_[seed]};
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const std::uint32_t f = faces_[i];
      if (i != seed && !std::all_of(sheet.begin(), sheet.end(), [&](std::uint32_t g) { return behind(f, g) && behind(g, f); })) continue;
      if (i != seed) sheet.push_back(f);
      covered[i] = 1;
    }
    std::sort(sheet.begin(), sheet.end());
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

// One a plane of the solid, moved; the faces that count as lying on it may be off it a little. A sheet's planes move both ways: the
// second half of them inward.
std::vector<FlatPiece> DistanceSurface::planes() const {
  const MeshFeatures& f = *features_;
  std::vector<FlatPiece> planes;
  for (const int facing : {1, -1}) {
    if (facing < 0 && !sheet_) break;
    const std::size_t first = planes.size();
    for (const std::uint32_t face : f.first_on_plane) {
      const Vec3 n = facing * f.faces[face].normal;
      planes.push_back({n, n.dot(f.corner(face, 0)) + offset_, rounding_at(Vec3::Zero()) + f.faces[face].loss * f.scale()});
    }
    for (std::uint32_t face = 0; face < f.size(); ++face) {
      FlatPiece& plane = planes[first + f.plane_of[face]];
      for (int k = 0; k < 3; ++k)
        plane.thickness = std::max(plane.thickness, std::abs(plane.normal.dot(f.corner(face, k)) + offset_ - plane.offset) + rounding_at(Vec3::Zero()));
    }
  }
  return planes;
}

// Do all normals that may occur lie within a narrow cone?
bool DistanceSurface::nearly_flat(const Sight& sight, const Vec3& center, const Vec3& reach) const {
  if (sight.seen.empty()) return false;
  std::vector<Interval3> normals;
  Vec3 sum = Vec3::Zero();
  for (const Local* feature : sight.seen) {
    normals.push_back(this->normals(*feature, sight, center, reach));
    sum += Vec3(middle(normals.back().x), middle(normals.back().y), middle(normals.back().z));
  }
  if (!(sum.norm() > 0)) return false;
  const Interval3 axis = enclose(Vec3(sum.normalized()));
  return std::all_of(normals.begin(), normals.end(), [&](const Interval3& n) { return dot(n, axis).lower() > nearly_one; });
}

std::optional<std::size_t> DistanceSurface::plane_on(std::uint32_t face, const Vec3& center, const Vec3& reach) const {
  const int facing = side_of(face, center, reach);
  if (facing == 0) return std::nullopt;
  return features_->plane_of[face] + (facing < 0 ? features_->first_on_plane.size() : 0);
}

std::vector<SmoothSurfacePtr> DistanceSurface::parts() const {
  if (side_ == 0 || !simple()) return {};
  const Vec3 center = box_.center(), reach = 0.5 * box_.sizes() * (1 + 4 * ulp);
  {
    // Splitting it would only hide what its rims' neighbours say.
    const Rounding rounding;
    const Sight sight = look(center, reach);
    if (!coplanar(sight) && nearly_flat(sight, center, reach)) return {};
  }
  auto sheets = convex_sheets();
  if (sheets.empty()) sheets = this->sheets();
  std::vector<SmoothSurfacePtr> parts;
  for (auto& sheet : sheets) {
    auto part = std::shared_ptr<DistanceSurface>(new DistanceSurface(*this, std::move(sheet), box_));
    part->crowded_ = crowded_;
    part->split_ = split_ || part->faces_.size() < faces_.size();
    part->find_local();
    const Rounding rounding;
    const Sight sight = part->look(center, reach);
    if (!sight.seen.empty() && part->coplanar(sight)) part->plane_ = part->plane_on(sight.seen.front()->id, center, reach);
    if (sight.seen.size() == 1 && sight.seen.front()->kind != Kind::face)
      parts.push_back(part->on_one(*sight.seen.front()));
    else
      parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace starcell
