#include "subdivision/acceptance.h"

#include <algorithm>
#include <cmath>

#include "subdivision/complex_cell.h"
#include "subdivision/concurrency.h"
#include "subdivision/face_link.h"
#include "subdivision/face_pieces.h"
#include "subdivision/face_force.h"
#include "subdivision/face_star.h"
#include "subdivision/face_trace.h"
#include "subdivision/grid_line.h"
#include "subdivision/loops.h"
#include "subdivision/sheet_shape.h"
#include "subdivision/voxel_link.h"
#include "subdivision/voxel_planes.h"
#include "subdivision/voxel_star.h"

namespace starcell {
namespace {

std::vector<std::uint32_t> surfaces_of(const FacetTable& table, const std::vector<std::uint32_t>& facets) {
  std::vector<std::uint32_t> ids;
  ids.reserve(facets.size());
  for (const std::uint32_t f : facets) ids.push_back(table.surface[f]);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::vector<Vec3> vertices_inside(const FacetTable& table, const std::vector<std::uint32_t>& facets, const Box3& box) {
  std::vector<Vec3> inside;
  for (const std::uint32_t f : facets)
    for (int k = 0; k < 3 && inside.size() < 4; ++k) {
      const Vec3& p = table.corner(f, k);
      if (box_contains(box, p) && std::find(inside.begin(), inside.end(), p) == inside.end()) inside.push_back(p);
    }
  return inside;
}

// Creases and corners of few planes are worth isolating, whatever the error: they come out exactly, and there are no more
// cells of this kind than the input has corners. 25 degrees and more is a feature, less is a tessellated curve.
constexpr std::size_t few_planes = 6;
constexpr double feature_cosine = 0.9;

bool is_feature(const FacetTable& table, const std::vector<std::uint32_t>& surfaces) {
  if (surfaces.size() > few_planes) return false;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t j = i + 1; j < surfaces.size(); ++j)
      if (std::abs(table.surfaces[surfaces[i]].normal.dot(table.surfaces[surfaces[j]].normal)) < feature_cosine) return true;
  return false;
}

// Far from edge-on, so that doubles are sure of it; a needle's normal is noise: refused.
bool faces_one_side(const FacetTable& table, std::uint32_t surface, const std::vector<std::uint32_t>& facets) {
  int side = 0;
  for (const std::uint32_t f : facets) {
    const Vec3 n = table.area_vector(f);
    const Vec3 &a = table.corner(f, 0), &b = table.corner(f, 1), &c = table.corner(f, 2);
    const double along = n.dot(table.surfaces[surface].normal);
    const int s = along > 0 ? 1 : -1;
    if (!(std::abs(along) > 0.5 * n.norm()) || !(n.norm() > 1e-10 * std::max((b - a).squaredNorm(), (c - a).squaredNorm()))) return false;
    if (side != 0 && s != side) return false;
    side = s;
  }
  return true;
}

// More than three planes, or three with a line in common: concurrent by intent. Three in general position always are, and
// V-planes has to find the cell in which they can be told apart.
bool degenerate(const FacetTable& table, const std::vector<std::uint32_t>& surfaces) {
  if (surfaces.size() != 3) return true;
  const Vec3 &a = table.surfaces[surfaces[0]].normal, &b = table.surfaces[surfaces[1]].normal, &c = table.surfaces[surfaces[2]].normal;
  return std::abs(a.dot(b.cross(c))) < 1e-9;
}

double largest_sway(const Leaf& leaf) {
  double sway = 0;
  for (const auto& arcs : leaf.arcs)
    for (const Arc& arc : arcs) sway = std::max(sway, arc.sway);
  return sway;
}

// Candidate facets of both senses on one surface: two walls may be there, nearer to each other than rounding tells.
bool turned_both_ways(const FacetTable& table, const CellProblem& problem) {
  if (problem.candidates(table) == 0) return false;
  std::vector<std::pair<std::uint32_t, bool>> senses;
  for (const std::uint32_t f : problem.facets)
    if (table.candidate(table.operand_of(f))) senses.emplace_back(table.surface[f], table.is_along(f));
  std::sort(senses.begin(), senses.end());
  return std::adjacent_find(senses.begin(), senses.end(), [](const auto& x, const auto& y) { return x.first == y.first && x.second != y.second; }) != senses.end();
}

bool all_disks(const Leaf& leaf) {
  return std::all_of(leaf.sheets.begin(), leaf.sheets.end(), [](const Sheet& sheet) { return sheet.disk; });
}

// Leaves are what fills the memory: nothing in them is kept larger than it has to be.
void compact(Leaf& leaf) {
  if (leaf.sheets.size() == 1) leaf.sheets.front().crossings = {};
  leaf.sheets.shrink_to_fit();
  for (Sheet& sheet : leaf.sheets) sheet.surfaces.shrink_to_fit(), sheet.crossings.shrink_to_fit();
  leaf.problem.facets.shrink_to_fit();
  for (auto& arcs : leaf.arcs) {
    arcs.shrink_to_fit();
    for (Arc& arc : arcs) arc.bends.shrink_to_fit(), arc.surfaces.shrink_to_fit();
  }
}

// Facets above which a quick look decides whether the full tests can succeed.
constexpr std::size_t many_facets = 32;
// The linear program's cost grows with its rows: beyond this a cell is cheaper to split.
constexpr std::size_t most_star_facets = 400;
// The fan may add its loop's deviation to a slab's thickness: see contouring/loop_points.h.
constexpr double slab_share = 0.85;
// What F-star's arcs may leave E's by.
constexpr double sway_share = 0.4;

}  // namespace

bool Acceptance::worth_isolating(const std::vector<std::uint32_t>& surfaces, const Box3& box) const {
  if (std::isinf(settings_.error) || box.diagonal().norm() < settings_.smallest_feature) return false;
  return is_feature(restriction_.table(), surfaces);
}

bool Acceptance::small_enough(const Box3& box) const { return box.diagonal().norm() <= 0.98 * settings_.error; }

// With a finite error most large cells fail for their size alone. Sampled vertices spread farther than the error along
// their mean normal rule a slab out; too many planes rule a cone out. Refusing is always allowed.
bool Acceptance::hopeless(const CellProblem& problem, const Box3& box) const {
  if (problem.slots() > max_slots) return true;
  if (std::isinf(settings_.error) || problem.facets.size() <= many_facets || small_enough(box)) return false;
  const FacetTable& table = restriction_.table();
  // Candidates come by the dozen on every plane, and V-planes does not mind.
  if (problem.candidates(table) != 0 && surfaces_of(table, problem.facets).size() <= max_cell_planes) return false;
  const std::size_t step = problem.facets.size() / many_facets + 1;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < problem.facets.size(); i += step) sum += table.area_vector(problem.facets[i]);
  std::vector<std::uint32_t> sample;
  for (std::size_t i = 0; i < problem.facets.size(); i += step) sample.push_back(problem.facets[i]);
  if (surfaces_of(table, sample).size() <= 8) return false;
  const double length = sum.norm();
  if (!(length > 0)) return true;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::uint32_t f : sample) {
    if (table.area_vector(f).dot(sum) <= 0) return true;
    for (int k = 0; k < 3; ++k) {
      if (!box_contains(box, table.corner(f, k))) continue;
      const double height = table.corner(f, k).dot(sum) / length;
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  return high - low > settings_.error;
}

std::optional<Leaf> Acceptance::accept(CellProblem& problem) const {
  Leaf leaf;
  if (!problem.empty(restriction_.table())) {
    const Box3 box = box_of(restriction_.grid(), problem.cell);
    if (hopeless(problem, box)) return std::nullopt;
    const bool ok = problem.has_regions(restriction_.table())      ? accept_patches(problem, box, leaf)
                    : settings_.criterion == Criterion::complex_cell ? accept_complex(problem, box, leaf)
                    : problem.candidates(restriction_.table()) != 0 || groups_may_cross(restriction_, problem, box) ? accept_crossing(problem, box, leaf)
                                                                   : accept_linked(problem, box, leaf);
    if (!ok) return std::nullopt;
  }
  leaf.problem = std::move(problem);
  compact(leaf);
  return leaf;
}

bool Acceptance::accept_linked(const CellProblem& problem, const Box3& box, Leaf& leaf) const {
  const FacetTable& table = restriction_.table();
  std::vector<Group> groups = link_groups(restriction_, problem, box);
  if (!classify_groups(restriction_, problem, box, groups)) return false;
  std::erase_if(groups, [](const Group& g) { return !g.contributes; });
  for (const Group& group : groups) {
    if (group.characteristic != 1) return false;
    const std::vector<std::uint32_t> surfaces = surfaces_of(table, group.facets);
    auto sheet = concurrent_sheet(restriction_, box, surfaces, vertices_inside(table, group.facets, box));
    if (!sheet) {
      const bool feature = worth_isolating(surfaces, box);
      if (feature && accept_planes(problem, box, leaf = Leaf())) return true;
      if (feature) return false;
      sheet = slab_sheet(table, box, group.facets, group.flip);
      if (!sheet || sheet->high - sheet->low > slab_share * settings_.error) {
        if (!small_enough(box)) return false;
        sheet = Sheet();
      }
    }
    if (sheet->shape == Sheet::Shape::crease) sheet->level = faces_one_side(table, sheet->surfaces[0], group.facets);
    leaf.sheets.push_back(std::move(*sheet));
  }
  for (int side = 0; side < 6; ++side) {
    const Face face = face_of(problem.cell, side);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto pieces = face_pieces(restriction_, problem, groups[g].facets, face);
      if (pieces.empty()) continue;
      auto arcs = link_pieces(restriction_, face, pieces, groups[g].flip);
      if (!arcs) return false;
      for (Arc& arc : *arcs) {
        if (!arc.closed) {
          leaf.sheets[g].crossings.push_back(arc.start);
          leaf.sheets[g].crossings.push_back(arc.end);
        }
        leaf.arcs[side].push_back(std::move(arc));
      }
      count(statistics_.face_link);
    }
  }
  for (Sheet& sheet : leaf.sheets) {
    std::sort(sheet.crossings.begin(), sheet.crossings.end());
    sheet.crossings.erase(std::unique(sheet.crossings.begin(), sheet.crossings.end()), sheet.crossings.end());
    count(sheet.shape == Sheet::Shape::corner ? statistics_.voxel_cone : statistics_.voxel_link);
  }
  return true;
}

bool Acceptance::trace_faces(const CellProblem& problem, const LocalPlanes& local, Leaf& leaf) const {
  RimLines rims(restriction_, problem);
  const TraceSettings settings{settings_.pull, sway_share * settings_.error};
  for (int side = 0; side < 6; ++side) {
    auto arcs = trace_face(restriction_, problem, problem.facets, face_of(problem.cell, side), settings, local, rims, statistics_);
    if (!arcs) return false;
    leaf.arcs[side] = std::move(*arcs);
    for (const Arc& arc : leaf.arcs[side]) leaf.contact = leaf.contact || arc.concurrent;
  }
  return true;
}

// V-cone: if every plane passes through one point of the cell, so that membership is constant along rays from it, then E∩C is
// the cone over its trace. Facets with a common vertex or edge do. Others are taken as concurrent that are so only to within their
// thickness and rounding: an input moved by that much, hence a contact; and so are two cones with one apex.
bool Acceptance::accept_cone(const CellProblem& problem, const Box3& box, Leaf& leaf) const {
  const FacetTable& table = restriction_.table();
  const auto cone = concurrent_sheet(restriction_, box, surfaces_of(table, problem.facets), vertices_inside(table, problem.facets, box));
  if (!cone || cone->shape != Sheet::Shape::corner || !degenerate(table, cone->surfaces) || !trace_faces(problem, LocalPlanes(), leaf) || largest_sway(leaf) > 0) return false;
  const auto loops = leaf_loops(leaf);
  if (!loops) return false;
  leaf.contact = leaf.contact || loops->size() > 1 || turned_both_ways(table, problem) || !meet_by_construction(table, problem.facets, *cone, box);
  for (const Loop& loop : *loops) {
    Sheet sheet;
    sheet.shape = Sheet::Shape::corner;
    sheet.apex = cone->apex;
    sheet.contact = loops->size() > 1;
    for (const LoopArc& a : loop) sheet.surfaces.insert(sheet.surfaces.end(), a.arc->surfaces.begin(), a.arc->surfaces.end());
    std::sort(sheet.surfaces.begin(), sheet.surfaces.end());
    sheet.surfaces.erase(std::unique(sheet.surfaces.begin(), sheet.surfaces.end()), sheet.surfaces.end());
    sheet.crossings = crossings_of(loop);
    leaf.sheets.push_back(std::move(sheet));
  }
  count(statistics_.voxel_cone);
  return true;
}

bool Acceptance::accept_crossing(const CellProblem& problem, const Box3& box, Leaf& leaf) const {
  if (accept_planes(problem, box, leaf)) return true;
  // Planes that are nearly one are no concurrent ones.
  const LocalPlanes local(restriction_.table(), problem.facets, box);
  if (local.empty() ? accept_cone(problem, box, leaf = Leaf()) : accept_thin(problem, box, local, leaf = Leaf())) return true;
  return accept_star(problem, box, leaf = Leaf());
}

// V-planes knows E∩C itself: what is no cone is taken over plane by plane, whatever the error and the topology.
bool Acceptance::accept_planes(const CellProblem& problem, const Box3& box, Leaf& leaf) const {
  auto found = plane_sheets(restriction_, problem);
  if (!found) return false;
  leaf.contact = found->touching;
  for (PlaneSheet& plane_sheet : found->sheets) {
    auto sheet = plane_sheet.disk ? concurrent_sheet(restriction_, box, plane_sheet.surfaces, {}) : std::nullopt;
    if (!sheet) {
      sheet = Sheet();
      if (!plane_sheet.contact && !plane_sheet.flats.empty()) {
        sheet->shape = Sheet::Shape::flats;
        sheet->flats = std::move(plane_sheet.flats);
        sheet->disk = plane_sheet.disk;
      } else if (!small_enough(box)) {
        return false;
      }
    }
    sheet->crossings = std::move(plane_sheet.crossings);
    sheet->contact = plane_sheet.contact;
    leaf.contact = leaf.contact || plane_sheet.contact;
    leaf.sheets.push_back(std::move(*sheet));
  }
  if (!leaf.sheets.empty() && !trace_faces(problem, LocalPlanes(), leaf)) return false;
  if (largest_sway(leaf) > 0) {   // some face was not arranged: its arcs are not E's, and no fan over them is
    if (!small_enough(box) || !all_disks(leaf)) return false;
    for (Sheet& sheet : leaf.sheets) sheet.shape = Sheet::Shape::loose, sheet.flats.clear();
  }
  count(statistics_.voxel_planes);
  const FacetTable& table = restriction_.table();
  for (const std::uint32_t id : surfaces_of(table, problem.facets)) leaf.contact = leaf.contact || table.surfaces[id].shared;
  return true;
}

// V-planes where some planes are one as far as the cell can tell: topology only, so the cell's size has to bound the rest.
bool Acceptance::accept_thin(const CellProblem& problem, const Box3& box, const LocalPlanes& local, Leaf& leaf) const {
  if (!small_enough(box)) return false;
  const FacetTable& table = restriction_.table();
  const auto found = plane_sheets(restriction_, problem, local);
  if (!found || std::any_of(found->sheets.begin(), found->sheets.end(), [](const PlaneSheet& s) { return !s.disk; })) return false;
  leaf.contact = found->touching;
  if (!found->sheets.empty() && !trace_faces(problem, local, leaf)) return false;
  for (const PlaneSheet& plane_sheet : found->sheets) {
    Sheet sheet;
    sheet.contact = plane_sheet.contact;
    leaf.contact = leaf.contact || plane_sheet.contact;
    // The arcs carry the surface that a grid line really meets, V-planes the one that stands for it.
    for (const auto& arcs : leaf.arcs)
      for (const Arc& arc : arcs)
        for (const Crossing* x : {&arc.start, &arc.end}) {
          Crossing named = *x;
          named.surface = local.of(x->surface);
          const auto& known = plane_sheet.crossings;
          if (!arc.closed && std::binary_search(known.begin(), known.end(), named)) sheet.crossings.push_back(*x);
        }
    std::sort(sheet.crossings.begin(), sheet.crossings.end());
    sheet.crossings.erase(std::unique(sheet.crossings.begin(), sheet.crossings.end()), sheet.crossings.end());
    leaf.sheets.push_back(std::move(sheet));
  }
  for (auto& arcs : leaf.arcs)
    for (Arc& arc : arcs)
      for (std::uint32_t& surface : arc.surfaces)
        if (!local.alone(surface)) surface = no_surface;
  for (const std::uint32_t id : surfaces_of(table, problem.facets)) leaf.contact = leaf.contact || table.surfaces[id].shared;
  count(statistics_.voxel_planes);
  return true;
}

// V-star bounds no distance by itself: only for cells that are small enough, or when topology is all that is asked.
bool Acceptance::accept_star(const CellProblem& problem, const Box3& box, Leaf& leaf) const {
  if (problem.facets.size() > most_star_facets) return false;
  if (const auto slab = slab_of_candidates(problem, box)) return accept_slab(problem, *slab, leaf);
  if (!small_enough(box)) return false;
  if (worth_isolating(surfaces_of(restriction_.table(), problem.facets), box)) return false;
  const auto direction = star_direction(restriction_, problem, statistics_);
  if (!direction || !trace_faces(problem, LocalPlanes(), leaf)) return false;
  const auto loops = star_loops(leaf, *direction);
  if (!loops) return false;
  for (const auto& crossings : *loops) {
    Sheet sheet;
    sheet.crossings = crossings;
    leaf.sheets.push_back(std::move(sheet));
  }
  count(statistics_.voxel_star);
  return true;
}

// One candidate solid whose facets are all seen along one direction, in a slab that the error allows.
std::optional<Sheet> Acceptance::slab_of_candidates(const CellProblem& problem, const Box3& box) const {
  const FacetTable& table = restriction_.table();
  if (std::isinf(settings_.error) || problem.slots() != 1 || problem.candidates(table) == 0) return std::nullopt;
  if (std::any_of(problem.facets.begin(), problem.facets.end(), [&](std::uint32_t f) { return table.surfaces[table.surface[f]].shared; })) return std::nullopt;
  auto slab = slab_sheet(table, box, problem.facets, problem.expression.value(0));
  if (!slab || slab->high - slab->low > slab_share * settings_.error) return std::nullopt;
  return slab;
}

// V-star with the slab's direction, which bounds the distance too.
bool Acceptance::accept_slab(const CellProblem& problem, const Sheet& slab, Leaf& leaf) const {
  if (!trace_faces(problem, LocalPlanes(), leaf)) return false;
  if (!(std::hypot(slab.high - slab.low, largest_sway(leaf)) <= 0.95 * settings_.error)) return false;
  const auto loops = star_loops(leaf, slab.direction);
  if (!loops) return false;
  for (const auto& crossings : *loops) {
    leaf.sheets.push_back(slab);
    leaf.sheets.back().crossings = crossings;
  }
  count(statistics_.voxel_star);
  return true;
}

bool Acceptance::accept_complex(const CellProblem& problem, const Box3& box, Leaf& leaf) const {
  if (!trace_faces(problem, LocalPlanes(), leaf)) return false;
  if (!satisfies_complex_cell(restriction_, problem, leaf, statistics_)) return false;
  if (std::all_of(leaf.arcs.begin(), leaf.arcs.end(), [](const auto& arcs) { return arcs.empty(); })) return true;
  if (!small_enough(box)) return false;
  Sheet sheet;
  for (const auto& arcs : leaf.arcs)
    for (const Arc& arc : arcs) sheet.crossings.push_back(arc.start), sheet.crossings.push_back(arc.end);
  std::sort(sheet.crossings.begin(), sheet.crossings.end());
  leaf.sheets.push_back(std::move(sheet));
  count(statistics_.voxel_complex);
  return true;
}

Leaf Acceptance::give_up(CellProblem& problem) const {
  Leaf leaf;
  leaf.resolved = false;
  RimLines rims(restriction_, problem);
  for (int side = 0; side < 6; ++side) {
    const Face face = face_of(problem.cell, side);
    std::optional<std::vector<Arc>> arcs;
    if (problem.has_regions(restriction_.table())) {
      if (const auto patches = Patches::of(restriction_, problem)) arcs = star_face(restriction_, *patches, rims, face, settings_.error, statistics_);
    } else if (problem.slots() <= max_slots)
      arcs = trace_face(restriction_, problem, problem.facets, face, {settings_.pull, settings_.error}, LocalPlanes(), rims, statistics_);
    leaf.arcs[side] = arcs ? std::move(*arcs) : force_face(restriction_, problem, face);
  }
  leaf.problem = std::move(problem);
  return leaf;
}

}  // namespace starcell
