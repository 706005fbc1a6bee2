// Acceptance where curved surfaces reach the cell: V-star by classes of patches (DESIGN §3; T§3.5.4).
//
// Every class is seen along a direction of its own, so its part of E projects injectively and is a planar domain; a domain is a
// disk if it has one boundary (voxel_star.h). Classes have no point in common. So a cell may hold two sheets however near each
// other, as long as one certificate keeps them apart.
#include <algorithm>
#include <cmath>

#include "subdivision/acceptance.h"
#include "subdivision/face_star.h"
#include "subdivision/graph_shape.h"
#include "subdivision/sheet_shape.h"
#include "subdivision/voxel_star.h"

namespace starcell {
namespace {

// The sheet's own arcs tell what contouring will draw: what it moves them by for float32 is small beside this reserve.
constexpr double fan_share = 0.95;

bool on_class(const PatchClass& c, const Crossing& x) { return std::find(c.patches.begin(), c.patches.end(), x.patch) != c.patches.end(); }

}  // namespace

// Keeps the apex that was found: contouring will want one.
bool Acceptance::near_enough(Sheet& sheet, const Loop& loop, const Box3& box) const {
  std::vector<Vec3> polygon;
  std::vector<Sway> sways;
  for (const LoopArc& a : loop) {
    std::vector<Vec3> points = a.arc->bends;
    if (!a.arc->closed) points.insert(points.begin(), place_of(a.arc->start, restriction_.grid()));
    if (a.reversed) {
      if (!a.arc->closed) points.erase(points.begin()), points.push_back(place_of(a.arc->end, restriction_.grid()));
      std::reverse(points.begin(), points.end());
    }
    polygon.insert(polygon.end(), points.begin(), points.end());
    sways.resize(polygon.size(), {a.arc->sway, a.arc->along});
  }
  const double margin = std::min(2 * restriction_.grid().step, box.sizes().x() / 16);
  const GraphFan fan = graph_fan(box, sheet, polygon, sways, 0, margin);
  sheet.apex = fan.apex;
  sheet.low = fan.flat_bound;
  sheet.near = fan.bound;
  sheet.polygon = std::move(polygon);
  return fan.bound <= fan_share * settings_.error;
}

// A class of planes through one point is the cone over its trace; any other a graph. Small cells need no bound but their size.
Sheet Acceptance::class_sheet(const Patches& patches, const PatchClass& c, const Vec3& u, const Box3& box) const {
  std::vector<std::uint32_t> planes;
  for (const std::size_t k : c.patches)
    if (patches.plane(k) != no_surface) planes.push_back(patches.plane(k));
  if (planes.size() == c.patches.size()) {
    std::sort(planes.begin(), planes.end());
    if (auto sheet = concurrent_sheet(restriction_, box, planes, {})) return std::move(*sheet);
  }
  if (small_enough(box)) return Sheet();
  return graph_sheet(patches, c, u, room_around(box.sizes().x(), settings_.error));
}

bool Acceptance::accept_patches(const CellProblem& problem, const Box3& box, Leaf& leaf) const {
  const FacetTable& table = restriction_.table();
  const auto patches = Patches::of(restriction_, problem);
  if (!patches) return false;
  PatchView view(*patches, box);
  if (view.constant()) return true;
  auto classes = view.seen_classes(-1, statistics_);
  if (!classes && view.compare_threes()) {
    if (view.constant()) return true;
    classes = view.seen_classes(-1, statistics_);
  }
  if (!classes) return false;
  std::vector<Sheet> shapes;
  for (std::size_t k = 0; k < classes->size(); ++k) shapes.push_back(class_sheet(*patches, (*classes)[k], (*classes)[k].direction, box));
  RimLines rims(restriction_, problem);
  for (int side = 0; side < 6; ++side) {
    auto arcs = star_face(restriction_, *patches, rims, face_of(problem.cell, side), settings_.error, statistics_);
    if (!arcs) return false;
    leaf.arcs[side] = std::move(*arcs);
  }
  const auto loops = leaf_loops(leaf);
  if (!loops) return false;
  // Every loop lies on the surfaces of one class.
  std::vector<std::vector<const Loop*>> of_class(classes->size());
  for (const Loop& loop : *loops) {
    std::size_t k = 0;
    while (k < classes->size() && !std::all_of(loop.begin(), loop.end(), [&](const LoopArc& a) {
             return on_class((*classes)[k], a.arc->start) && on_class((*classes)[k], a.arc->end);
           }))
      ++k;
    if (k == classes->size()) return false;
    of_class[k].push_back(&loop);
  }
  for (std::size_t k = 0; k < classes->size(); ++k) {
    if (!all_outer(of_class[k], (*classes)[k].direction)) return false;
    for (const Loop* loop : of_class[k]) {
      Sheet sheet = shapes[k];
      if (sheet.shape == Sheet::Shape::graph && !near_enough(sheet, *loop, box)) return false;
      sheet.crossings = crossings_of(*loop);
      leaf.sheets.push_back(std::move(sheet));
    }
  }
  for (std::size_t k = 0; k < patches->size(); ++k) leaf.contact = leaf.contact || table.surfaces[patches->surface(k)].shared;
  count(statistics_.voxel_patches);
  return true;
}

}  // namespace starcell
