#include "contouring/contour.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "contouring/embedding.h"
#include "contouring/flat_sheet.h"
#include "contouring/trace_points.h"
#include "subdivision/loops.h"

namespace starcell {
namespace {

// A minimal face and the one leaf whose arcs count on it.
struct MinimalFace {
  Face face;
  const std::vector<Arc>* arcs;
  bool every_bend;   // a fan on either side is exact as long as its loop is
};

bool has_cone(const Leaf& leaf) {
  return std::any_of(leaf.sheets.begin(), leaf.sheets.end(), [](const Sheet& sheet) {
    return sheet.shape == Sheet::Shape::planar || sheet.shape == Sheet::Shape::crease || sheet.shape == Sheet::Shape::corner ||
           sheet.shape == Sheet::Shape::flats;
  });
}

class Contourer {
 public:
  Contourer(const Restriction& restriction, const Octree& tree, const ContourSettings& settings)
      : restriction_(restriction), tree_(tree), settings_(settings), points_(restriction, settings.relaxed, result_.mesh.vertices) {}

  Contour make() {
    const std::vector<Leaf*> leaves = tree_.leaves();
    std::vector<std::vector<MinimalFace>> faces(leaves.size() * 6);
    for (std::size_t k = 0; k < leaves.size(); ++k)
      for (int side = 0; side < 6; ++side) gather(*leaves[k], side, faces[6 * k + side]);
    for (const auto& some : faces)
      for (const MinimalFace& f : some)
        for (const Arc& arc : *f.arcs) points_.announce(arc);
    points_.place();
    for (std::size_t k = 0; k < leaves.size(); ++k) {
      poll(k);
      bool drawn = true;
      for (int side = 0; side < 6; ++side)
        for (const MinimalFace& f : faces[6 * k + side]) drawn = draw(f) && drawn;
      if (!drawn) result_.failed.push_back(leaves[k]->problem.cell);
    }
    for (std::size_t k = 0; k < leaves.size(); ++k) {
      poll(k);
      fill(*leaves[k], &faces[6 * k]);
    }
    std::sort(result_.failed.begin(), result_.failed.end(), [](const Cell& a, const Cell& b) {
      return a.lower != b.lower ? a.lower < b.lower : a.size < b.size;
    });
    result_.failed.erase(std::unique(result_.failed.begin(), result_.failed.end(),
                                     [](const Cell& a, const Cell& b) { return a.lower == b.lower && a.size == b.size; }),
                         result_.failed.end());
    return std::move(result_);
  }

 private:
  void poll(std::size_t k) const {
    if (k % 1024 == 0 && settings_.poll) settings_.poll();
  }

  // The finest side of a face rules; between equals, the cell below it.
  void gather(const Leaf& leaf, int side, std::vector<MinimalFace>& faces) const {
    const Cell& cell = leaf.problem.cell;
    Cell found;
    const OctreeNode* beyond = tree_.across(cell, side, found);
    if (beyond && beyond->children) {
      gather_finer(*beyond, found, side, has_cone(leaf), faces);
      return;
    }
    if (beyond && beyond->leaf && found.size == cell.size && side % 2 == 0) {
      const auto& arcs = beyond->leaf->arcs[side + 1];
      if (!arcs.empty()) faces.push_back({face_of(cell, side), &arcs, has_cone(leaf) || has_cone(*beyond->leaf)});
      return;
    }
    const bool cone = has_cone(leaf) || (beyond && beyond->leaf && has_cone(*beyond->leaf));
    if (!leaf.arcs[side].empty()) faces.push_back({face_of(cell, side), &leaf.arcs[side], cone});
  }

  void gather_finer(const OctreeNode& node, const Cell& at, int side, bool cone, std::vector<MinimalFace>& faces) const {
    const int axis = side / 2, opposite = side ^ 1;
    if (node.children) {
      for (int i = 0; i < 8; ++i)
        if ((i >> axis & 1) == (side % 2 ? 0 : 1)) gather_finer((*node.children)[i], at.child(i), side, cone, faces);
    } else if (node.leaf && !node.leaf->arcs[opposite].empty()) {
      faces.push_back({face_of(at, opposite), &node.leaf->arcs[opposite], cone || has_cone(*node.leaf)});
    }
  }

  bool draw(const MinimalFace& f) {
    const Arc* key = f.arcs->data();
    if (drawn_index_.contains(key)) return drawn_ok_[key];
    std::vector<const Arc*> arcs;
    for (const Arc& arc : *f.arcs) arcs.push_back(&arc);
    std::vector<TracedArc> drawn;
    const double tolerance = std::isinf(settings_.error) ? 1e300 : 0.2 * settings_.error;
    const bool ok = points_.draw(f.face, arcs, f.every_bend ? 0 : tolerance, drawn);
    drawn_index_[key] = drawn_.size();
    drawn_ok_[key] = ok;
    for (TracedArc& arc : drawn) drawn_.push_back(std::move(arc));
    return ok;
  }

  void fill(const Leaf& leaf, const std::vector<MinimalFace>* faces) {
    const Cell& cell = leaf.problem.cell;
    std::vector<LoopArc> arcs;
    for (int side = 0; side < 6; ++side)
      for (const MinimalFace& f : faces[side])
        for (const Arc& arc : *f.arcs) arcs.push_back({&arc, side, side % 2 == 0});
    if (arcs.empty()) {
      if (!leaf.sheets.empty()) result_.failed.push_back(cell);
      return;
    }
    const auto loops = form_loops(arcs);
    if (!loops || (leaf.resolved && loops->size() != leaf.sheets.size())) {
      result_.failed.push_back(cell);
      return;
    }
    std::vector<std::pair<std::size_t, std::size_t>> fans;
    bool good = true;
    const std::vector<const Sheet*> sheets = sheets_of(leaf, *loops);
    for (std::size_t k = 0; k < loops->size(); ++k) {
      const Loop& loop = (*loops)[k];
      const Sheet* sheet = sheets[k];
      good = good && (sheet || !leaf.resolved);
      const std::size_t first = result_.mesh.triangles.size();
      good = replace(leaf, sheet ? *sheet : Sheet(), drawn_loop(cell, loop, faces)) && good;
      fans.emplace_back(first, result_.mesh.triangles.size() - first);
    }
    const Triangle* triangles = result_.mesh.triangles.data();
    for (std::size_t a = 0; a < fans.size() && good; ++a)
      for (std::size_t b = a + 1; b < fans.size() && good; ++b)
        good = !fans_meet(result_.mesh.vertices, triangles + fans[a].first, fans[a].second, triangles + fans[b].first,
                          fans[b].second, holds_floats(cell));
    if (!good) result_.failed.push_back(cell);
  }

  bool holds_floats(const Cell& cell) const {
    return restriction_.grid().holds_floats(cell.size) && !settings_.relaxed.touch(cell);
  }

  double margin_in(const Cell& cell) const {
    const Grid& grid = restriction_.grid();
    return settings_.relaxed.touch(cell) ? grid.least_gap() : grid.margin(cell.size);
  }

  // Appends what stands for one sheet; false if it does not serve.
  bool replace(const Leaf& leaf, const Sheet& sheet, const DrawnLoop& loop) {
    const Grid& grid = restriction_.grid();
    const Cell& cell = leaf.problem.cell;
    const Box3 box = box_of(grid, cell);
    if (sheet.shape == Sheet::Shape::flats) {
      const std::size_t first = result_.mesh.triangles.size();
      const auto made = emit_flats(box, sheet, loop, margin_in(cell), result_.mesh);
      if (made) {
        result_.bound = std::max(result_.bound, made->bound);
        return made->bound <= settings_.error &&
               !sheet_folds(result_.mesh.vertices, result_.mesh.triangles.data() + first, result_.mesh.triangles.size() - first,
                            holds_floats(cell));
      }
    }
    const Fan fan = make_fan(restriction_.table(), box, sheet, loop, result_.mesh.vertices, margin_in(cell), settings_.pull);
    result_.bound = std::max(result_.bound, fan.bound);
    emit(loop, fan);
    return fan.bound <= settings_.error;
  }

  // A loop's sheet shares crossings with it; the last loop without any has the last sheet. Null: not known.
  static std::vector<const Sheet*> sheets_of(const Leaf& leaf, const std::vector<Loop>& loops) {
    std::vector<const Sheet*> found(loops.size(), nullptr);
    std::vector<char> taken(leaf.sheets.size(), 0);
    for (std::size_t k = 0; k < loops.size(); ++k)
      for (std::size_t s = 0; s < leaf.sheets.size() && !found[k]; ++s)
        if (share_crossing(leaf.sheets[s], loops[k])) found[k] = &leaf.sheets[s], taken[s] = 1;
    if (std::count(found.begin(), found.end(), nullptr) == 1 && std::count(taken.begin(), taken.end(), 0) == 1)
      *std::find(found.begin(), found.end(), nullptr) = &leaf.sheets[std::find(taken.begin(), taken.end(), 0) - taken.begin()];
    return found;
  }

  static bool share_crossing(const Sheet& sheet, const Loop& loop) {
    const auto has = [&](const Crossing& x) { return std::binary_search(sheet.crossings.begin(), sheet.crossings.end(), x); };
    return std::any_of(loop.begin(), loop.end(), [&](const LoopArc& a) { return !a.arc->closed && (has(a.arc->start) || has(a.arc->end)); });
  }

  const TracedArc& traced(const LoopArc& a, const std::vector<MinimalFace>* faces) const {
    for (const MinimalFace& f : faces[a.side])
      if (a.arc >= f.arcs->data() && a.arc < f.arcs->data() + f.arcs->size())
        return drawn_[drawn_index_.at(f.arcs->data()) + static_cast<std::size_t>(a.arc - f.arcs->data())];
    return drawn_.front();
  }

  DrawnLoop drawn_loop(const Cell& cell, const Loop& loop, const std::vector<MinimalFace>* faces) const {
    DrawnLoop result;
    for (const LoopArc& a : loop) {
      const TracedArc& arc = traced(a, faces);
      const std::size_t n = arc.surfaces.size();
      for (std::size_t k = 0; k < n; ++k) {
        result.vertices.push_back(arc.vertices[a.reversed ? n - k : k]);
        result.surfaces.push_back(arc.surfaces[a.reversed ? n - 1 - k : k]);
        result.names.push_back(name_of(cell, a, n, a.reversed ? n - k : k));
      }
      result.gap = std::max(result.gap, arc.gap);
      if (!a.arc->closed) result.shift += points_.move_of(a.reversed ? a.arc->end : a.arc->start) / static_cast<double>(loop.size());
    }
    return result;
  }

  // Vertex k of an arc drawn with n segments, as V-planes names it; zeros if it has no name in this cell.
  static CornerName name_of(const Cell& cell, const LoopArc& a, std::size_t n, std::size_t k) {
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
        return at == cell.lower[axis] ? 2 * axis : at == cell.lower[axis] + cell.size ? 2 * axis + 1 : -1;
      };
      const int s = side_at(b, x.i), t = side_at(c, x.j);
      if (s < 0 || t < 0) return name;
      name = {x.surface, side_label(s), side_label(t)};
    }
    std::sort(name.begin(), name.end());
    return name;
  }

  void emit(const DrawnLoop& loop, const Fan& fan) {
    SurfaceMesh& mesh = result_.mesh;
    const auto apex = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(fan.apex);
    const std::size_t n = loop.vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
      mesh.triangles.push_back({apex, loop.vertices[k], loop.vertices[(k + 1) % n]});
      mesh.surface.push_back(fan.on_planes ? loop.surfaces[k] : no_surface);
    }
  }

  const Restriction& restriction_;
  const Octree& tree_;
  const ContourSettings& settings_;
  Contour result_;
  TracePoints points_;
  std::vector<TracedArc> drawn_;
  std::unordered_map<const Arc*, std::size_t> drawn_index_;
  std::unordered_map<const Arc*, bool> drawn_ok_;
};

}  // namespace

Contour contour(const Restriction& restriction, const Octree& tree, const ContourSettings& settings) {
  return Contourer(restriction, tree, settings).make();
}

}  // namespace starcell
