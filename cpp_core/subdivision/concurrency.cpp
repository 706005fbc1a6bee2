#include "subdivision/concurrency.h"

#include <algorithm>
#include <cmath>

namespace starcell {
namespace {

// A plane crosses a line no flatter than this where their point counts as known; apexes are known to this share of coordinates.
constexpr double least_sine = 1e-3, rounding_share = 1e-12;

// Corners of the facet and, of a parallelogram, of its other half: its plane passes through them by construction.
std::vector<std::uint32_t> corners_on_plane(const FacetTable& table, std::uint32_t facet) {
  std::vector<std::uint32_t> corners(table.corners[facet].begin(), table.corners[facet].end());
  if (table.candidate(table.operand_of(facet)))
    for (const std::uint32_t partner : table.neighbours[facet]) corners.insert(corners.end(), table.corners[partner].begin(), table.corners[partner].end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

// What the planes of all facets but those on one surface have in common by construction. Vertices that rounding may have made of
// several do not count.
std::vector<std::uint32_t> common_corners(const FacetTable& table, const std::vector<std::uint32_t>& facets, std::uint32_t but) {
  std::optional<std::vector<std::uint32_t>> common;
  for (const std::uint32_t f : facets) {
    if (table.surface[f] == but) continue;
    const std::vector<std::uint32_t> corners = corners_on_plane(table, f);
    if (!common) {
      common = corners;
      std::erase_if(*common, [&](std::uint32_t v) { return table.is_merged(v); });
    }
    std::erase_if(*common, [&](std::uint32_t v) { return !std::binary_search(corners.begin(), corners.end(), v); });
    if (common->empty()) break;
  }
  return common.value_or(std::vector<std::uint32_t>{});
}

// The direction of the line that vertices in common make common, if x is on it.
std::optional<Vec3> common_line(const FacetTable& table, const std::vector<std::uint32_t>& common, const Vec3& x, double rounding) {
  if (common.size() < 2) return std::nullopt;
  const Vec3& from = table.points[common[0]];
  const Vec3 along = (table.points[common[1]] - from).normalized();
  if (!((x - from).cross(along).norm() <= rounding)) return std::nullopt;
  return along;
}

// Facets on one plane not by rounding, but because they are halves of one parallelogram, or one.
bool is_one_plane(const FacetTable& table, const std::vector<std::uint32_t>& facets, std::uint32_t surface) {
  std::optional<std::vector<std::uint32_t>> corners;
  for (const std::uint32_t f : facets) {
    if (table.surface[f] != surface) continue;
    auto own = corners_on_plane(table, f);
    if (corners && *corners != own) return false;
    corners = std::move(own);
  }
  return true;
}

}  // namespace

bool meet_by_construction(const FacetTable& table, const std::vector<std::uint32_t>& facets, const Sheet& cone, const Box3& box) {
  const double rounding = 1e-9 * box.sizes().maxCoeff();
  const std::vector<std::uint32_t> common = common_corners(table, facets, no_surface);
  if (std::any_of(common.begin(), common.end(), [&](std::uint32_t v) { return table.points[v] == cone.apex; })) return true;
  if (common_line(table, common, cone.apex, rounding)) return true;
  // The point where they cross is known to rounding over the sine of their angle: it has to be in the cell.
  const double margin = 4 * rounding_share / least_sine * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (((cone.apex - box.min()).array() <= margin).any() || ((box.max() - cone.apex).array() <= margin).any()) return false;
  return std::any_of(cone.surfaces.begin(), cone.surfaces.end(), [&](std::uint32_t surface) {
    if (!is_one_plane(table, facets, surface)) return false;
    const auto along = common_line(table, common_corners(table, facets, surface), cone.apex, rounding);
    return along && std::abs(along->dot(table.surfaces[surface].normal)) >= least_sine;
  });
}

}  // namespace starcell
