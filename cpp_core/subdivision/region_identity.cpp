#include "subdivision/region_identity.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace starcell {
namespace {

class RegionTable {
 public:
  RegionTable(FacetTable& table, double contact) : table_(table), contact_(contact) {}

  void add(const RegionOperand& operand, const Vec3& shift, std::uint32_t body) {
    RegionOperand moved = operand;
    moved.box = Box3(operand.box.min() + shift, operand.box.max() + shift);
    Region region;
    region.body = body;
    if (operand.form) {
      if (shift != Vec3::Zero()) moved.form = operand.form->translated(shift);
      const Known& known = smooth(moved);
      region.surface = known.surface;
      region.first_plane = known.first_plane;
    } else {
      moved.end.offset += operand.end.normal.dot(shift);
      region.surface = plane(moved, region.complement);
    }
    table_.regions.push_back(region);
  }

 private:
  struct Known {
    std::uint32_t surface;
    Box3 box;   // of all regions on it
    std::uint32_t first_plane = 0;
  };

  bool near(const Box3& a, const Box3& b) const { return a.squaredExteriorDistance(b) <= contact_ * contact_; }

  void share(std::uint32_t surface, double thickness) {
    Surface& s = table_.surfaces[surface];
    s.shared = true;
    s.thickness = std::max(s.thickness, thickness);
    table_.thickest = std::max(table_.thickest, s.thickness);
  }

  std::uint32_t fresh(Surface surface) {
    table_.thickest = std::max(table_.thickest, surface.thickness);
    table_.surfaces.push_back(std::move(surface));
    return static_cast<std::uint32_t>(table_.surfaces.size() - 1);
  }

  const Known& smooth(const RegionOperand& operand) {
    for (Known& known : smooth_) {
      if (!near(known.box, operand.box)) continue;
      const SmoothSurface& other = *table_.surfaces[known.surface].form;
      const auto apart = surface_distance(other, *operand.form, known.box.merged(operand.box));
      if (!apart || *apart > contact_) continue;
      share(known.surface, *apart);
      known.box.extend(operand.box);
      return known;
    }
    Surface s;
    s.normal = Vec3::Zero();
    s.form = operand.form;
    const std::uint32_t id = fresh(std::move(s));
    smooth_.push_back({id, operand.box, id + 1});
    for (const FlatPiece& piece : operand.form->planes()) {
      Surface flat;
      flat.normal = piece.normal;
      flat.offset = piece.offset;
      flat.thickness = piece.thickness;
      fresh(std::move(flat));
    }
    return smooth_.back();
  }

  // How far the planes are apart inside the box; planes of opposite sense are the same surface.
  static double apart(const Surface& s, const EndPlane& end, const Box3& box) {
    const double sense = s.normal.dot(end.normal) < 0 ? -1 : 1;
    const Vec3 turn = s.normal - sense * end.normal;
    return std::abs(turn.dot(box.center()) - (s.offset - sense * end.offset)) + 0.5 * turn.cwiseAbs().dot(box.sizes()) + end.thickness;
  }

  std::uint32_t plane(const RegionOperand& operand, bool& complement) {
    const auto taken = [&](std::uint32_t surface) {
      complement = table_.surfaces[surface].normal.dot(operand.end.normal) < 0;
      share(surface, apart(table_.surfaces[surface], operand.end, operand.box));
      return surface;
    };
    const double offset = std::abs(operand.end.offset), slack = offset_slack(operand);
    for (auto it = planes_.lower_bound(offset - slack); it != planes_.end() && it->first <= offset + slack; ++it) {
      Known& known = it->second;
      if (!near(known.box, operand.box)) continue;
      if (apart(table_.surfaces[known.surface], operand.end, known.box.merged(operand.box)) > contact_) continue;
      known.box.extend(operand.box);
      return taken(known.surface);
    }
    std::uint32_t surface = facet_plane(operand);
    if (surface == UINT32_MAX) {
      Surface s;
      s.normal = operand.end.normal;
      s.offset = operand.end.offset;
      s.thickness = operand.end.thickness;
      surface = fresh(std::move(s));
    } else {
      taken(surface);
    }
    planes_.emplace(std::abs(table_.surfaces[surface].offset), Known{surface, operand.box});
    return surface;
  }

  // Planes that agree inside a box differ by no more than this in their distance from the origin.
  double offset_slack(const RegionOperand& operand) const {
    const double reach = std::max(operand.box.min().cwiseAbs().maxCoeff(), operand.box.max().cwiseAbs().maxCoeff());
    return contact_ * (1 + 8 * reach / std::max(operand.box.sizes().maxCoeff(), 1e-300));
  }

  // A plane of a polyhedron with a facet on it near the box.
  std::uint32_t facet_plane(const RegionOperand& operand) const {
    for (std::uint32_t f = 0; f < table_.size(); ++f) {
      const Surface& s = table_.surfaces[table_.surface[f]];
      if (std::abs(s.normal.dot(operand.end.normal)) < 0.99999 || !near(table_.box(f), operand.box)) continue;
      if (apart(s, operand.end, operand.box) <= contact_) return table_.surface[f];
    }
    return UINT32_MAX;
  }

  FacetTable& table_;
  const double contact_;
  std::vector<Known> smooth_;
  std::multimap<double, Known> planes_;   // by distance from the origin
};

}  // namespace

void add_regions(FacetTable& table, const std::vector<RegionOperand>& regions, double contact, const std::vector<Vec3>& shifts) {
  RegionTable add(table, contact);
  const auto first = static_cast<std::uint32_t>(table.faceted());
  for (const RegionOperand& region : regions) {
    const std::uint32_t body = first + region.body;
    add.add(region, shifts.empty() ? Vec3(Vec3::Zero()) : shifts[body], body);
  }
}

}  // namespace starcell
