#include "contouring/cell_piece.h"

#include <algorithm>

#include "contouring/embedding.h"
#include "contouring/flat_sheet.h"
#include "subdivision/loops.h"

namespace starcell {
namespace {

class PieceMaker {
 public:
  PieceMaker(const Restriction& restriction, const Leaf& leaf, const std::vector<DrawnFace>& faces, const TracePoints& points,
             const PieceSettings& settings)
      : restriction_(restriction), leaf_(leaf), cell_(leaf.problem.cell), box_(box_of(restriction.grid(), cell_)), faces_(faces),
        points_(points), settings_(settings) {}

  CellPiece make() {
    CellPiece piece;
    std::vector<LoopArc> arcs;
    for (const DrawnFace& f : faces_)
      for (const Arc& arc : f.face.arcs()) arcs.push_back({&arc, f.face.side, f.face.side % 2 == 0});
    if (arcs.empty()) {
      piece.good = leaf_.sheets.empty();
      return piece;
    }
    const auto loops = form_loops(arcs);
    if (!loops) return piece;
    bool good = true;
    std::vector<std::pair<std::size_t, std::size_t>> fans;
    std::vector<const Sheet*> sheets = by_crossings(*loops);
    // All rims first: what is inside the cell comes after them in mesh_.
    std::vector<DrawnLoop> drawn;
    for (const Loop& loop : *loops) drawn.push_back(drawn_loop(loop, piece.rim));
    find_by_names(drawn, sheets);
    find_the_last(sheets);
    if (leaf_.resolved && !every_sheet_has_its_loops(sheets)) return piece;
    for (std::size_t k = 0; k < loops->size(); ++k) {
      if (sheets[k] && std::find(sheets.begin(), sheets.begin() + static_cast<std::ptrdiff_t>(k), sheets[k]) != sheets.begin() + static_cast<std::ptrdiff_t>(k)) continue;
      const std::size_t first = mesh_.triangles.size();
      std::vector<const DrawnLoop*> rims{&drawn[k]};
      for (std::size_t l = k + 1; l < loops->size() && sheets[k]; ++l)
        if (sheets[l] == sheets[k]) rims.push_back(&drawn[l]);
      good = replace(sheets[k] ? *sheets[k] : Sheet(), rims, piece.bound) && good;
      fans.emplace_back(first, mesh_.triangles.size() - first);
    }
    const Triangle* triangles = mesh_.triangles.data();
    for (std::size_t a = 0; a < fans.size() && good; ++a)
      for (std::size_t b = a + 1; b < fans.size() && good; ++b)
        good = !fans_meet(mesh_.vertices, triangles + fans[a].first, fans[a].second, triangles + fans[b].first, fans[b].second,
                          settings_.floats);
    piece.good = good;
    piece.inner.assign(mesh_.vertices.begin() + static_cast<std::ptrdiff_t>(piece.rim.size()), mesh_.vertices.end());
    piece.triangles = std::move(mesh_.triangles);
    piece.surface = std::move(mesh_.surface);
    return piece;
  }

 private:
  // Appends what stands for one sheet; false if it does not serve.
  bool replace(const Sheet& sheet, const std::vector<const DrawnLoop*>& loops, double& bound) {
    if (sheet.shape == Sheet::Shape::flats) {
      const std::size_t first = mesh_.triangles.size();
      if (const auto made = emit_flats(box_, sheet, loops, settings_.margin, mesh_)) {
        bound = std::max(bound, made->bound);
        return made->bound <= settings_.error &&
               !sheet_folds(mesh_.vertices, mesh_.triangles.data() + first, mesh_.triangles.size() - first, settings_.floats);
      }
    }
    bool near = true;
    for (const DrawnLoop* loop : loops) {   // closes the mesh; of what is no disk it says nothing
      const Fan fan = make_fan(restriction_.table(), box_, sheet, *loop, mesh_.vertices, settings_.error, settings_.margin, settings_.pull);
      bound = std::max(bound, fan.bound);
      emit(*loop, fan);
      near = near && fan.bound <= settings_.error;
    }
    return near && sheet.disk;
  }

  void emit(const DrawnLoop& loop, const Fan& fan) {
    const auto apex = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(fan.apex);
    const std::size_t n = loop.vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
      mesh_.triangles.push_back({apex, loop.vertices[k], loop.vertices[(k + 1) % n]});
      mesh_.surface.push_back(fan.on_planes ? loop.surfaces[k] : no_surface);
    }
  }

  // A loop's sheet shares crossings with it. Null: not known.
  std::vector<const Sheet*> by_crossings(const std::vector<Loop>& loops) const {
    std::vector<const Sheet*> found(loops.size(), nullptr);
    for (std::size_t k = 0; k < loops.size(); ++k)
      for (std::size_t s = 0; s < leaf_.sheets.size() && !found[k]; ++s)
        if (share_crossing(leaf_.sheets[s], loops[k])) found[k] = &leaf_.sheets[s];
    return found;
  }

  // The last loop without a sheet has the last sheet without a loop.
  void find_the_last(std::vector<const Sheet*>& found) const {
    const Sheet* last = nullptr;
    std::size_t left = 0;
    for (const Sheet& sheet : leaf_.sheets)
      if (std::find(found.begin(), found.end(), &sheet) == found.end()) last = &sheet, ++left;
    if (left == 1 && std::count(found.begin(), found.end(), nullptr) == 1) *std::find(found.begin(), found.end(), nullptr) = last;
  }

  // A sheet that is no disk knows the corners on its loops by name.
  void find_by_names(const std::vector<DrawnLoop>& drawn, std::vector<const Sheet*>& found) const {
    for (const Sheet& sheet : leaf_.sheets) {
      if (sheet.disk) continue;
      std::vector<CornerName> names;
      for (const FlatPart& part : sheet.flats)
        for (const auto& cycle : part.cycles)
          for (const FlatPart::Corner& corner : cycle) names.push_back(corner.name);
      std::sort(names.begin(), names.end());
      for (std::size_t k = 0; k < drawn.size(); ++k)
        if (!found[k] && std::any_of(drawn[k].names.begin(), drawn[k].names.end(), [&](const CornerName& n) { return std::binary_search(names.begin(), names.end(), n); }))
          found[k] = &sheet;
    }
  }

  // A disk has one loop, any other sheet at least one.
  bool every_sheet_has_its_loops(const std::vector<const Sheet*>& found) const {
    if (std::count(found.begin(), found.end(), nullptr) != 0) return false;
    return std::all_of(leaf_.sheets.begin(), leaf_.sheets.end(), [&](const Sheet& sheet) {
      const auto loops = std::count(found.begin(), found.end(), &sheet);
      return sheet.disk ? loops == 1 : loops >= 1;
    });
  }

  static bool share_crossing(const Sheet& sheet, const Loop& loop) {
    const auto has = [&](const Crossing& x) { return std::binary_search(sheet.crossings.begin(), sheet.crossings.end(), x); };
    return std::any_of(loop.begin(), loop.end(), [&](const LoopArc& a) { return !a.arc->closed && (has(a.arc->start) || has(a.arc->end)); });
  }

  const TracedArc& traced(const LoopArc& a) const {
    for (const DrawnFace& f : faces_) {
      const std::vector<Arc>& arcs = f.face.arcs();
      if (a.arc >= arcs.data() && a.arc < arcs.data() + arcs.size()) return f.traced->arcs[static_cast<std::size_t>(a.arc - arcs.data())];
    }
    return faces_.front().traced->arcs.front();
  }

  DrawnLoop drawn_loop(const Loop& loop, std::vector<std::uint32_t>& rim) {
    DrawnLoop result;
    for (const LoopArc& a : loop) {
      const TracedArc& arc = traced(a);
      const std::size_t n = arc.surfaces.size();
      for (std::size_t k = 0; k < n; ++k) {
        const std::uint32_t id = arc.vertices[a.reversed ? n - k : k];
        result.vertices.push_back(static_cast<std::uint32_t>(rim.size()));
        rim.push_back(id);
        mesh_.vertices.push_back(points_.vertices()[id]);
        result.surfaces.push_back(arc.surfaces[a.reversed ? n - 1 - k : k]);
        result.sways.push_back({a.arc->sway, a.arc->along});
        result.names.push_back(name_of(a, n, a.reversed ? n - k : k));
      }
      result.gap = std::max(result.gap, arc.gap);
      if (!a.arc->closed && n > 0)
        result.shift += points_.move_of(a.reversed ? arc.vertices.back() : arc.vertices.front()) / static_cast<double>(loop.size());
    }
    return result;
  }

  // Vertex k of an arc drawn with n segments, as V-planes names it; zeros if it has no name in this cell.
  CornerName name_of(const LoopArc& a, std::size_t n, std::size_t k) const {
    const Arc& arc = *a.arc;
    CornerName name{0, 0, 0};
    const std::size_t bends = arc.bends.size();
    if (n != (arc.closed ? bends : bends + 1)) return name;  // bends were left out
    if (arc.closed) {
      name = {arc.surfaces[(k + bends - 1) % bends], arc.surfaces[k % bends], side_label(a.side)};
    } else if (k > 0 && k < n) {
      name = {arc.surfaces[k - 1], arc.surfaces[k], side_label(a.side)};
    } else {
      const Crossing& x = k == 0 ? arc.start : arc.end;
      const int b = (x.axis + 1) % 3, c = (x.axis + 2) % 3;
      const auto side_at = [&](int axis, std::uint32_t at) {
        return at == cell_.lower[axis] ? 2 * axis : at == cell_.lower[axis] + cell_.size ? 2 * axis + 1 : -1;
      };
      const int s = side_at(b, x.i), t = side_at(c, x.j);
      if (s < 0 || t < 0) return name;
      name = {x.surface, side_label(s), side_label(t)};
    }
    std::sort(name.begin(), name.end());
    return name;
  }

  const Restriction& restriction_;
  const Leaf& leaf_;
  const Cell cell_;
  const Box3 box_;
  const std::vector<DrawnFace>& faces_;
  const TracePoints& points_;
  const PieceSettings& settings_;
  SurfaceMesh mesh_;   // the rim's vertices, then those inside the cell
};

}  // namespace

CellPiece make_piece(const Restriction& restriction, const Leaf& leaf, const std::vector<DrawnFace>& faces, const TracePoints& points,
                     const PieceSettings& settings) {
  return PieceMaker(restriction, leaf, faces, points, settings).make();
}

}  // namespace starcell
