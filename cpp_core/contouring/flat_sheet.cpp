#include "contouring/flat_sheet.h"

#include <algorithm>
#include <map>

#include "contouring/flat_polygon.h"

namespace starcell {
namespace {

class Emitter {
 public:
  Emitter(const Box3& cell, const Sheet& sheet, const std::vector<const DrawnLoop*>& loops, double margin, SurfaceMesh& mesh)
      : cell_(cell), sheet_(sheet), loops_(loops), margin_(margin), mesh_(mesh) {}

  std::optional<FlatSheet> emit() {
    std::size_t segments = 0;
    double gap = 0;
    for (const DrawnLoop* loop : loops_) {
      for (std::size_t k = 0; k < loop->vertices.size(); ++k)
        if (named(*loop, k) && !at_.emplace(loop->names[k], Place{loop, k}).second) return std::nullopt;
      segments += loop->vertices.size();
      gap = std::max(gap, loop->gap);
    }
    for (const FlatPart& part : sheet_.flats)
      if (!add(part)) return std::nullopt;
    if (on_rim_ != segments) return std::nullopt;
    return FlatSheet{std::max(gap, moved_)};
  }

 private:
  struct Place {
    const DrawnLoop* loop;
    std::size_t k;
  };

  static bool named(const DrawnLoop& loop, std::size_t k) { return loop.names[k][2] != 0; }

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
    const DrawnLoop& loop = *from->second.loop;
    ring.push_back(loop.vertices[from->second.k]);
    if (corner.edge < side_label(0)) return true;
    const auto to = at_.find(next.name);
    if (to == at_.end() || to->second.loop != &loop) return false;
    for (std::size_t i = from->second.k; i != to->second.k; i = (i + 1) % loop.vertices.size()) {
      if (i != from->second.k) {
        if (named(loop, i)) return false;
        ring.push_back(loop.vertices[i]);
      }
      on_plane = on_plane && loop.surfaces[i] == surface;
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
  const std::vector<const DrawnLoop*>& loops_;
  const double margin_;
  SurfaceMesh& mesh_;
  std::map<CornerName, Place> at_;   // loop vertices with a name
  std::map<CornerName, Inner> inner_;
  std::size_t on_rim_ = 0;                 // segments of the loops that parts have used
  double moved_ = 0;
};

}  // namespace

std::optional<FlatSheet> emit_flats(const Box3& cell, const Sheet& sheet, const std::vector<const DrawnLoop*>& loops, double margin,
                                    SurfaceMesh& mesh) {
  const std::size_t triangles = mesh.triangles.size();
  auto made = Emitter(cell, sheet, loops, margin, mesh).emit();
  if (!made) mesh.triangles.resize(triangles), mesh.surface.resize(triangles);
  return made;
}

}  // namespace starcell
