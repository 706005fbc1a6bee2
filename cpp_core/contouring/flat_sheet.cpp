#include "contouring/flat_sheet.h"

#include <algorithm>
#include <map>

#include "contouring/flat_polygon.h"

namespace starcell {
namespace {

class Emitter {
 public:
  Emitter(const Box3& cell, const Sheet& sheet, const DrawnLoop& loop, double margin, SurfaceMesh& mesh)
      : cell_(cell), sheet_(sheet), loop_(loop), margin_(margin), mesh_(mesh) {}

  std::optional<FlatSheet> emit() {
    for (std::size_t k = 0; k < loop_.vertices.size(); ++k)
      if (named(k) && !at_.emplace(loop_.names[k], k).second) return std::nullopt;
    for (const FlatPart& part : sheet_.flats)
      if (!add(part)) return std::nullopt;
    if (on_rim_ != loop_.vertices.size()) return std::nullopt;
    return FlatSheet{std::max(loop_.gap, moved_)};
  }

 private:
  bool named(std::size_t k) const { return loop_.names[k][2] != 0; }

  bool add(const FlatPart& part) {
    std::vector<RimEdge> rim;
    bool on_plane = true;
    for (const auto& cycle : part.cycles) {
      std::vector<std::uint32_t> ring;
      for (std::size_t k = 0; k < cycle.size(); ++k)
        if (!walk(cycle[k], cycle[(k + 1) % cycle.size()], part.surface, ring, on_plane)) return false;
      for (std::size_t k = 0; k < ring.size(); ++k) rim.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
    }
    const auto triangles = triangulate_flat(mesh_.vertices, rim);
    if (!triangles) return false;
    mesh_.triangles.insert(mesh_.triangles.end(), triangles->begin(), triangles->end());
    mesh_.surface.insert(mesh_.surface.end(), triangles->size(), on_plane ? part.surface : no_surface);
    return true;
  }

  // From a corner to just before the next: along the rim past the vertices that finer neighbours put there.
  bool walk(const FlatPart::Corner& corner, const FlatPart::Corner& next, std::uint32_t surface,
            std::vector<std::uint32_t>& ring, bool& on_plane) {
    if (corner.name[2] < side_label(0)) {
      ring.push_back(inner_vertex(corner, on_plane));
      return true;
    }
    const auto from = at_.find(corner.name);
    if (from == at_.end()) return false;
    ring.push_back(loop_.vertices[from->second]);
    if (corner.edge < side_label(0)) return true;
    const auto to = at_.find(next.name);
    if (to == at_.end()) return false;
    for (std::size_t i = from->second; i != to->second; i = (i + 1) % loop_.vertices.size()) {
      if (i != from->second) {
        if (named(i)) return false;
        ring.push_back(loop_.vertices[i]);
      }
      on_plane = on_plane && loop_.surfaces[i] == surface;
      ++on_rim_;
    }
    return true;
  }

  std::uint32_t inner_vertex(const FlatPart::Corner& corner, bool& on_plane) {
    const auto [it, fresh] = inner_.emplace(corner.name, Inner{static_cast<std::uint32_t>(mesh_.vertices.size()), false});
    if (fresh) {
      const Vec3 m = Vec3::Constant(margin_);
      const Vec3 p = corner.place.cwiseMax(cell_.min() + m).cwiseMin(cell_.max() - m);
      mesh_.vertices.push_back(p);
      moved_ = std::max(moved_, (p - corner.place).norm());
      it->second.moved = p != corner.place;
    }
    on_plane = on_plane && !it->second.moved;
    return it->second.vertex;
  }

  struct Inner {
    std::uint32_t vertex;
    bool moved;
  };

  const Box3& cell_;
  const Sheet& sheet_;
  const DrawnLoop& loop_;
  const double margin_;
  SurfaceMesh& mesh_;
  std::map<CornerName, std::size_t> at_;   // loop vertices with a name
  std::map<CornerName, Inner> inner_;
  std::size_t on_rim_ = 0;                 // segments of the loop that parts have used
  double moved_ = 0;
};

}  // namespace

std::optional<FlatSheet> emit_flats(const Box3& cell, const Sheet& sheet, const DrawnLoop& loop, double margin,
                                    SurfaceMesh& mesh) {
  const std::size_t triangles = mesh.triangles.size();
  auto made = Emitter(cell, sheet, loop, margin, mesh).emit();
  if (!made) mesh.triangles.resize(triangles), mesh.surface.resize(triangles);
  return made;
}

}  // namespace starcell
