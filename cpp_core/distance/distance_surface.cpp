#include "distance/distance_surface.h"

#include <cmath>
#include <map>
#include <numeric>

#include "distance/distance_terms.h"

namespace starcell {

using namespace distance;

namespace {

// More faces than this are not looked at feature by feature: the cell has to be smaller. Unless that does not help: many faces may
// have one vertex, as the tip of a cone.
constexpr std::size_t most_faces = 64;
constexpr std::size_t most_about_a_vertex = 4096;
constexpr double helps = 0.8;

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
  const Sight here = look_closer(sight, center);
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
  result->front_ = static_cast<std::size_t>(std::lower_bound(result->faces_.begin(), result->faces_.end(), best.face) - result->faces_.begin());
  result->find_local();
  return result;
}

}  // namespace starcell
