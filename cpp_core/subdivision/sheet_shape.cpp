#include "subdivision/sheet_shape.h"

#include <algorithm>

#include <Eigen/Dense>

#include "subdivision/voxel_link.h"

namespace starcell {
namespace {

// Points that rounding alone keeps apart count as one; it is far below every error bound and added to them.
double rounding_of(const Box3& box) {
  return 1e-12 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

bool on_all(const FacetTable& table, const std::vector<std::uint32_t>& surfaces, const Vec3& x, double tolerance) {
  return std::all_of(surfaces.begin(), surfaces.end(), [&](std::uint32_t id) {
    const Surface& s = table.surfaces[id];
    return std::abs(s.normal.dot(x) - s.offset) <= tolerance + s.thickness;
  });
}

// The point that all planes have in common, if they have one; of a common line the middle of its part in the box.
std::optional<Vec3> common_point(const FacetTable& table, const std::vector<std::uint32_t>& surfaces, const Box3& box) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> normals(surfaces.size(), 3);
  Eigen::VectorXd heights(surfaces.size());
  const Vec3 centre = box.center();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& s = table.surfaces[surfaces[i]];
    normals.row(static_cast<Eigen::Index>(i)) = s.normal.transpose();
    heights[static_cast<Eigen::Index>(i)] = s.offset - s.normal.dot(centre);
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(normals, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  const Eigen::VectorXd coordinates = svd.matrixU().transpose() * heights;
  Vec3 foot = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (values[k] > 1e-9 * values[0]) foot += svd.matrixV().col(k) * (coordinates[k] / values[k]);
  if (values[2] > 1e-9 * values[0]) return Vec3(centre + foot);
  if (!(values[1] > 1e-9 * values[0])) return std::nullopt;   // nearly one plane
  const Vec3 along = svd.matrixV().col(2);
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(along[k]) < 1e-12) continue;
    const double half = 0.5 * box.sizes()[k], a = (-half - foot[k]) / along[k], b = (half - foot[k]) / along[k];
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  if (!(low < high)) return std::nullopt;
  return Vec3(centre + foot + 0.5 * (low + high) * along);
}

bool well_inside(const Box3& box, const Vec3& x) {
  const double margin = 1e-9 * box.sizes().maxCoeff();
  return ((x - box.min()).array() > margin).all() && ((box.max() - x).array() > margin).all();
}

}  // namespace

std::optional<Sheet> concurrent_sheet(const Restriction& restriction, const Box3& box,
                                      const std::vector<std::uint32_t>& surfaces, const std::vector<Vec3>& candidates) {
  const FacetTable& table = restriction.table();
  Sheet sheet;
  sheet.surfaces = surfaces;
  if (surfaces.size() <= 2) {
    sheet.shape = surfaces.size() == 1 ? Sheet::Shape::planar : Sheet::Shape::crease;
    return sheet;
  }
  sheet.shape = Sheet::Shape::corner;
  const double tolerance = rounding_of(box);
  for (const Vec3& x : candidates)
    if (well_inside(box, x) && on_all(table, surfaces, x, tolerance)) {
      sheet.apex = x;
      return sheet;
    }
  if (surfaces.size() > 8) return std::nullopt;
  const auto x = common_point(table, surfaces, box);
  if (!x) return std::nullopt;
  sheet.apex = *x;
  if (!well_inside(box, sheet.apex) || !on_all(table, surfaces, sheet.apex, tolerance)) return std::nullopt;
  return sheet;
}

std::optional<Sheet> slab_sheet(const FacetTable& table, const Box3& box, const std::vector<std::uint32_t>& facets,
                                bool flip) {
  std::vector<std::vector<Vec3>> polygons;
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t f : facets) {
    polygons.push_back(clip_facet(table, f, box));
    const std::vector<Vec3>& p = polygons.back();
    for (std::size_t k = 2; k < p.size(); ++k) sum += (p[k - 1] - p[0]).cross(p[k] - p[0]);
  }
  const double length = sum.norm();
  if (!(length > 0)) return std::nullopt;
  Sheet sheet;
  sheet.shape = Sheet::Shape::slab;
  sheet.direction = sum / length;
  sheet.low = std::numeric_limits<double>::infinity();
  sheet.high = -sheet.low;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    // Margins far above the rounding of a cross product (a needle's normal is noise: refused), so signs are certain.
    const Vec3 n = table.area_vector(facets[i]);
    const Vec3 &a = table.corner(facets[i], 0), &b = table.corner(facets[i], 1), &c = table.corner(facets[i], 2);
    const double reach = std::max((b - a).squaredNorm(), (c - a).squaredNorm());
    if (!(n.dot(sheet.direction) > 1e-3 * n.norm()) || !(n.norm() > 1e-10 * reach)) return std::nullopt;
    for (const Vec3& p : polygons[i]) {
      const double height = p.dot(sheet.direction);
      sheet.low = std::min(sheet.low, height);
      sheet.high = std::max(sheet.high, height);
    }
  }
  const double slack = rounding_of(box);
  sheet.low -= slack;
  sheet.high += slack;
  if (flip) {
    sheet.direction = -sheet.direction;
    std::swap(sheet.low, sheet.high);
    sheet.low = -sheet.low;
    sheet.high = -sheet.high;
  }
  return sheet;
}

}  // namespace starcell
