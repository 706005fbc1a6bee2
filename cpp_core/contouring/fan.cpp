#include "contouring/fan.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

#include "contouring/loop_distance.h"
#include "numerics/linear_program.h"

namespace starcell {
namespace {

// Of a cell's size: crossings that were moved no more than this are known again.
constexpr double same_place = 1e-3;

class FanMaker {
 public:
  FanMaker(const FacetTable& table, const Box3& cell, const Sheet& sheet, const DrawnLoop& loop,
           const std::vector<Vec3>& vertices, double error, double margin, double pull)
      : table_(table), cell_(cell), sheet_(sheet), loop_(loop), vertices_(vertices), error_(error), margin_(margin), pull_(pull) {
    centroid_ = Vec3::Zero();
    for (const std::uint32_t v : loop.vertices) centroid_ += vertices[v];
    centroid_ /= static_cast<double>(loop.vertices.size());
  }

  Fan make() {
    switch (sheet_.shape) {
      case Sheet::Shape::planar: return cone(centroid_);
      case Sheet::Shape::crease: return crease();
      case Sheet::Shape::corner: return cone(sheet_.apex);
      case Sheet::Shape::slab: return slab();
      case Sheet::Shape::graph: return graph();
      case Sheet::Shape::flats:
      case Sheet::Shape::loose: break;
    }
    return anything();
  }

 private:
  Vec3 clamped(const Vec3& p) const {
    const Vec3 m = Vec3::Constant(margin_);
    return p.cwiseMax(cell_.min() + m).cwiseMin(cell_.max() - m);
  }

  // E is the cone from `tip`: the fan from there deviates as its loop does, and as its own tip was moved.
  Fan cone(const Vec3& tip) {
    Vec3 wanted = tip + loop_.shift;
    if (sheet_.contact && sheet_.shape == Sheet::Shape::corner) {
      const Vec3 inward = centroid_ - tip;
      if (inward.norm() > 0) wanted += inward * (pull_ / inward.norm());
    }
    Fan fan;
    fan.apex = clamped(wanted);
    const double moved = (fan.apex - tip).norm();
    fan.bound = std::max(loop_.gap, moved);
    fan.on_planes = !(moved > 1e-12 * std::max(tip.cwiseAbs().maxCoeff(), 1e-300)) && !sheet_.contact;
    if (sheet_.shape == Sheet::Shape::planar && fan.on_planes) fan.on_planes = loop_.gap <= 1e-12 * scale();
    return fan;
  }

  double scale() const { return std::max(cell_.min().cwiseAbs().maxCoeff(), cell_.max().cwiseAbs().maxCoeff()); }

  // Any point of the common line in the cell serves: the middle of the line's part there.
  Fan crease() {
    if (sheet_.contact) return pulled_crease();
    const Surface &s = table_.surfaces[sheet_.surfaces[0]], &t = table_.surfaces[sheet_.surfaces[1]];
    const Vec3 along = s.normal.cross(t.normal);
    const double length = along.squaredNorm();
    if (!(length > 0)) return nearly_flat();
    // The line's point nearest to the centroid.
    const double hs = s.offset - s.normal.dot(centroid_), ht = t.offset - t.normal.dot(centroid_);
    const Vec3 foot = centroid_ + (hs * t.normal.cross(along) + ht * along.cross(s.normal)) / length;
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < 3; ++k) {
      if (along[k] == 0) {
        if (foot[k] <= cell_.min()[k] || foot[k] >= cell_.max()[k]) return nearly_flat();
        continue;
      }
      const double a = (cell_.min()[k] - foot[k]) / along[k], b = (cell_.max()[k] - foot[k]) / along[k];
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    if (!(low < high)) return nearly_flat();
    const Vec3 tip = foot + 0.5 * (low + high) * along;
    const double off = std::max(s.distance(tip) - s.thickness, t.distance(tip) - t.thickness);
    if (!(off <= 1e-12 * scale())) return nearly_flat();
    return cone(tip);
  }

  // Planes so nearly parallel that their line is uncertain: where all facets face one side, E is a graph over either plane
  // in the slab that both span in the cell. Where they do not, it may be folded, and nothing is claimed.
  Fan nearly_flat() {
    if (!sheet_.level) return anything();
    const Surface &s = table_.surfaces[sheet_.surfaces[0]], &t = table_.surfaces[sheet_.surfaces[1]];
    const double sense = s.normal.dot(t.normal) < 0 ? -1 : 1;
    double apart = s.thickness + t.thickness;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 x = cell_.corner(static_cast<Box3::CornerType>(corner));
      apart = std::max(apart, std::abs((s.normal.dot(x) - s.offset) - sense * (t.normal.dot(x) - t.offset)) + s.thickness + t.thickness);
    }
    for (const double turn : {1.0, -1.0}) {
      Sheet flat;
      flat.shape = Sheet::Shape::slab;
      flat.direction = turn * s.normal;
      flat.low = turn * s.offset - apart;
      flat.high = turn * s.offset + apart;
      Fan fan = FanMaker(table_, cell_, flat, loop_, vertices_, error_, margin_, pull_).slab();
      if (fan.bound < cell_.diagonal().norm()) return fan;
    }
    return anything();
  }

  // Sheets that touch along their creases: the two bends where the loop changes planes were pulled off the common line.
  Fan pulled_crease() {
    std::vector<Vec3> ends;
    for (const std::uint32_t v : loop_.vertices) {
      const Vec3& p = vertices_[v];
      if (std::all_of(sheet_.surfaces.begin(), sheet_.surfaces.end(), [&](std::uint32_t id) {
            const Surface& s = table_.surfaces[id];
            return s.distance(p) <= 2 * pull_ + s.thickness;
          }))
        ends.push_back(p);
    }
    if (ends.size() != 2) return anything();
    return cone(0.5 * (ends[0] + ends[1]));
  }

  // Triangles over arcs on a plane are on it if the apex is on all such planes.
  Fan graph() const {
    std::vector<Vec3> points;
    for (const std::uint32_t v : loop_.vertices) points.push_back(vertices_[v]);
    // The cone over a loop that runs near the accepted one is as near to the cone over that.
    if (!sheet_.polygon.empty() && faces_direction(sheet_.apex)) {
      const double bound = sheet_.near + loop_distance(sheet_.polygon, points, same_place * cell_.sizes().x());
      if (bound <= error_) return with_apex(sheet_.apex, bound);
    }
    const GraphFan best = graph_fan(cell_, sheet_, points, loop_.sways, loop_.gap, margin_);
    return with_apex(best.apex, best.bound);
  }

  Fan with_apex(const Vec3& apex, double bound) const {
    Fan fan;
    fan.apex = apex;
    fan.bound = std::min(bound, cell_.diagonal().norm());
    fan.on_planes = std::all_of(loop_.surfaces.begin(), loop_.surfaces.end(), [&](std::uint32_t id) {
      return id == no_surface || table_.surfaces[id].distance(apex) <= 1e-12 * scale();
    });
    return fan;
  }

  bool faces_direction(const Vec3& apex) const {
    const std::size_t n = loop_.vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 p = vertices_[loop_.vertices[k]] - apex, q = vertices_[loop_.vertices[(k + 1) % n]] - apex;
      const Vec3 normal = p.cross(q);
      // Far above rounding: p and q are differences of nearby points with relative error 1e-15.
      if (!(normal.dot(sheet_.direction) > 1e-9 * p.norm() * q.norm())) return false;
    }
    return true;
  }

  // Back between the slab's planes, and again into the cell.
  Vec3 into_slab(Vec3 apex) const {
    apex = clamped(apex);
    const double height = apex.dot(sheet_.direction);
    return clamped(apex + (std::clamp(height, sheet_.low, sheet_.high) - height) * sheet_.direction);
  }

  // A point from which the loop's shadow is seen whole: its kernel, by the small linear program.
  std::optional<Vec3> kernel_point() const {
    std::vector<Vec3> normals, points;
    const std::size_t n = loop_.vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 &p = vertices_[loop_.vertices[k]], &q = vertices_[loop_.vertices[(k + 1) % n]];
      const Vec3 outward = (q - p).cross(sheet_.direction);
      if (!(outward.norm() > 0)) return std::nullopt;
      normals.push_back(outward.normalized());
      points.push_back(p);
    }
    // The slab's planes too, their distances stretched so that they do not limit the margin.
    const double stretch = cell_.sizes().x() / std::max(sheet_.high - sheet_.low, 1e-6 * cell_.sizes().x());
    normals.push_back(stretch * sheet_.direction);
    points.push_back(centroid_ + (sheet_.high - centroid_.dot(sheet_.direction)) * sheet_.direction);
    normals.push_back(-stretch * sheet_.direction);
    points.push_back(centroid_ + (sheet_.low - centroid_.dot(sheet_.direction)) * sheet_.direction);
    const Vec3 m = Vec3::Constant(margin_);
    return deepest_point(normals, points, Box3(cell_.min() + m, cell_.max() - m));
  }

  Fan slab() {
    const Vec3 best = error_minimiser();
    for (const double t : {1.0, 0.5, 0.0})
      if (const auto fan = slab_fan(into_slab(centroid_ + t * (best - centroid_)))) return *fan;
    if (const auto seen = kernel_point())
      if (const auto fan = slab_fan(into_slab(*seen))) return *fan;
    return anything();
  }

  std::optional<Fan> slab_fan(const Vec3& apex) const {
    if (!faces_direction(apex)) return std::nullopt;
    double low = apex.dot(sheet_.direction), high = low;
    for (const std::uint32_t v : loop_.vertices) {
      low = std::min(low, vertices_[v].dot(sheet_.direction));
      high = std::max(high, vertices_[v].dot(sheet_.direction));
    }
    Fan fan;
    fan.apex = apex;
    double sway = 0;   // of arcs that are not E's
    for (const Sway& s : loop_.sways) sway = std::max(sway, s.by);
    fan.bound = std::hypot(std::max(high, sheet_.high) - std::min(low, sheet_.low), loop_.gap + sway);
    return fan;
  }

  // Nothing but the cell holds them together.
  Fan anything() {
    Fan fan;
    fan.apex = clamped(sheet_.surfaces.empty() ? error_minimiser() : on_surfaces());
    if (!fan.apex.allFinite()) fan.apex = clamped(centroid_);
    fan.bound = cell_.diagonal().norm();
    return fan;
  }

  Vec3 on_surfaces() const {
    std::vector<const Surface*> surfaces;
    for (const std::uint32_t id : sheet_.surfaces) surfaces.push_back(&table_.surfaces[id]);
    if (sheet_.graph) {
      surfaces.clear();
      for (const auto& surface : sheet_.graph->surfaces) surfaces.push_back(surface.get());
    }
    return common_place(surfaces, centroid_);
  }

  // Least squares over the planes along the loop, pulled to its centroid where they leave freedom (Ju et al. 2002).
  Vec3 error_minimiser() const {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Vec3 b = Vec3::Zero();
    for (std::size_t k = 0; k < loop_.vertices.size(); ++k) {
      if (loop_.surfaces[k] == no_surface) continue;
      const Surface& s = table_.surfaces[loop_.surfaces[k]];
      a += s.normal * s.normal.transpose();
      b += s.normal * (s.offset - s.normal.dot(centroid_));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(a);
    Vec3 x = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      if (solver.eigenvalues()[k] > 0.05 * solver.eigenvalues()[2])
        x += solver.eigenvectors().col(k) * (solver.eigenvectors().col(k).dot(b) / solver.eigenvalues()[k]);
    return centroid_ + x;
  }

  const FacetTable& table_;
  const Box3& cell_;
  const Sheet& sheet_;
  const DrawnLoop& loop_;
  const std::vector<Vec3>& vertices_;
  const double error_, margin_, pull_;
  Vec3 centroid_;
};

}  // namespace

Fan make_fan(const FacetTable& table, const Box3& cell, const Sheet& sheet, const DrawnLoop& loop,
             const std::vector<Vec3>& vertices, double error, double margin, double pull) {
  return FanMaker(table, cell, sheet, loop, vertices, error, margin, pull).make();
}

}  // namespace starcell
