// A distance as the least, or the greatest, of several: from sheets of faces, from single edges and vertices, from planes.
#include "distance/distance_surface.h"

#include <map>

#include "distance/distance_terms.h"
#include "solids/disjoint_sets.h"
#include "solids/quadric_surface.h"

namespace starcell {

using namespace distance;

namespace {

// More convex sheets than this are left in one piece.
constexpr std::size_t most_sheets = 4;
// Normals whose cosines with their mean are no less need no sheets of their own.
constexpr double nearly_one = 0.8;

}  // namespace

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
  DisjointSets sets(faces_.size());
  std::map<std::uint32_t, std::uint32_t> first;   // per vertex
  for (std::uint32_t i = 0; i < faces_.size(); ++i)
    for (const std::uint32_t v : features_->solid()->triangles()[faces_[i]]) sets.join(i, first.emplace(v, i).first->second);
  std::vector<std::vector<std::uint32_t>> sheets;
  std::map<std::uint32_t, std::size_t> number;
  for (std::uint32_t i = 0; i < faces_.size(); ++i) {
    const auto [at, fresh] = number.emplace(sets.root(i), sheets.size());
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
