#include "contouring/polygon_sheet.h"

#include <algorithm>
#include <map>

namespace starcell {
namespace {

class Emitter {
 public:
  Emitter(const Box3& cell, const Sheet& sheet, const DrawnLoop& loop, double margin, SurfaceMesh& mesh)
      : cell_(cell), sheet_(sheet), loop_(loop), margin_(margin), mesh_(mesh) {}

  std::optional<PolygonSheet> emit() {
    for (std::size_t k = 0; k < loop_.vertices.size(); ++k)
      if (loop_.names[k][2] != 0 && !at_.emplace(loop_.names[k], k).second) return std::nullopt;
    std::vector<Ring> rings;
    std::size_t on_rim = 0;
    for (const SheetPolygon& polygon : sheet_.polygons) {
      Ring ring;
      if (!walk(polygon, ring, on_rim)) return std::nullopt;
      rings.push_back(std::move(ring));
    }
    if (on_rim != loop_.vertices.size()) return std::nullopt;
    for (std::size_t p = 0; p < rings.size(); ++p) fill(sheet_.polygons[p], rings[p]);
    return PolygonSheet{std::max(loop_.gap, moved_)};
  }

 private:
  struct Ring {
    std::vector<std::uint32_t> vertices;
    bool on_plane = true;
  };

  static bool has(const CornerName& name, std::uint32_t label) { return std::find(name.begin(), name.end(), label) != name.end(); }

  // The side of the cell that two neighbouring corners lie on, or -1.
  static int common_side(const CornerName& a, const CornerName& b) {
    for (int side = 0; side < 6; ++side)
      if (has(a, side_label(side)) && has(b, side_label(side))) return side;
    return -1;
  }

  bool walk(const SheetPolygon& polygon, Ring& ring, std::size_t& on_rim) {
    const std::size_t n = polygon.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      const auto &corner = polygon.corners[k], &next = polygon.corners[(k + 1) % n];
      if (corner.name[2] < side_label(0)) {
        ring.vertices.push_back(inner_vertex(corner, ring));
        continue;
      }
      const auto from = at_.find(corner.name);
      if (from == at_.end()) return false;
      ring.vertices.push_back(loop_.vertices[from->second]);
      if (common_side(corner.name, next.name) < 0) continue;
      const auto to = at_.find(next.name);
      if (to == at_.end()) return false;
      // Along the rim, past the vertices that finer neighbours put there.
      for (std::size_t i = from->second; i != to->second; i = (i + 1) % loop_.vertices.size()) {
        if (i != from->second) {
          if (loop_.names[i][2] != 0) return false;
          ring.vertices.push_back(loop_.vertices[i]);
        }
        ring.on_plane = ring.on_plane && loop_.surfaces[i] == polygon.surface;
        ++on_rim;
      }
    }
    return ring.vertices.size() >= 3;
  }

  std::uint32_t inner_vertex(const SheetPolygon::Corner& corner, Ring& ring) {
    const auto [it, fresh] = inner_.emplace(corner.name, Inner{static_cast<std::uint32_t>(mesh_.vertices.size()), false});
    if (fresh) {
      const Vec3 m = Vec3::Constant(margin_);
      const Vec3 p = corner.place.cwiseMax(cell_.min() + m).cwiseMin(cell_.max() - m);
      mesh_.vertices.push_back(p);
      moved_ = std::max(moved_, (p - corner.place).norm());
      it->second.moved = p != corner.place;
    }
    ring.on_plane = ring.on_plane && !it->second.moved;
    return it->second.vertex;
  }

  void fill(const SheetPolygon& polygon, const Ring& ring) {
    const std::uint32_t surface = ring.on_plane ? polygon.surface : no_surface;
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh_.triangles.push_back({a, b, c});
      mesh_.surface.push_back(surface);
    };
    const std::size_t n = ring.vertices.size();
    if (n == 3) {
      triangle(ring.vertices[0], ring.vertices[1], ring.vertices[2]);
      return;
    }
    Vec3 middle = Vec3::Zero();
    for (const auto& corner : polygon.corners) middle += corner.place / static_cast<double>(polygon.corners.size());
    const auto centre = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(middle);
    for (std::size_t k = 0; k < n; ++k) triangle(centre, ring.vertices[k], ring.vertices[(k + 1) % n]);
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
  std::map<CornerName, std::size_t> at_;      // loop vertices with a name
  std::map<CornerName, Inner> inner_;
  double moved_ = 0;
};

}  // namespace

std::optional<PolygonSheet> emit_polygons(const Box3& cell, const Sheet& sheet, const DrawnLoop& loop, double margin,
                                          SurfaceMesh& mesh) {
  return Emitter(cell, sheet, loop, margin, mesh).emit();
}

}  // namespace starcell
