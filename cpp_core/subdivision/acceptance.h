// Is a cell good enough to be a leaf? The trace theorem's clauses and the error criterion, cheapest first.
//
// Rests on DESIGN §3. A leaf is accepted when every face has a certified trace (face_trace.h) and E∩C is certified to be
// disjoint disks: V-link and V-cone where solids do not cross, V-planes, V-cone or V-star where they do; and when each disk's
// shape bounds the distance to the fan that will replace it (sheet_shape.h). Of a sheet that V-planes knows polygon by polygon
// nothing else is asked: what replaces it has the same polygons, so it may have handles and several loops.
// Guarantees: an accepted leaf satisfies (E), (F) and (V) of the trace theorem, (V) but for such sheets. A refusal proves nothing.
#pragma once

#include <optional>

#include "subdivision/leaf.h"
#include "subdivision/loops.h"
#include "subdivision/local_planes.h"
#include "subdivision/patch_view.h"
#include "subdivision/settings.h"
#include "subdivision/statistics.h"

namespace starcell {

struct AcceptanceSettings {
  double error = 0;          ///< what the fan may deviate; infinite: topology only
  double smallest_feature = 0;   ///< smaller cells are not split just to make creases and corners exact
  double pull = 0;           ///< how far sheets in contact are pulled apart
  Criterion criterion = Criterion::trace;
};

class Acceptance {
 public:
  Acceptance(const Restriction& restriction, const AcceptanceSettings& settings, Statistics& statistics)
      : restriction_(restriction), settings_(settings), statistics_(statistics) {}

  /// A leaf without sheets is a cell that E does not meet. The problem is moved into the leaf on success.
  std::optional<Leaf> accept(CellProblem& problem) const;

  /// A leaf for a cell that the budget gave up on: its arcs where known, `resolved` false.
  Leaf give_up(CellProblem& problem) const;

 private:
  bool hopeless(const CellProblem& problem, const Box3& box) const;
  bool accept_linked(const CellProblem& problem, const Box3& box, Leaf& leaf) const;
  bool accept_crossing(const CellProblem& problem, const Box3& box, Leaf& leaf) const;
  bool accept_planes(const CellProblem& problem, const Box3& box, Leaf& leaf) const;
  bool accept_cone(const CellProblem& problem, const Box3& box, Leaf& leaf) const;
  bool accept_star(const CellProblem& problem, const Box3& box, Leaf& leaf) const;
  std::optional<Sheet> slab_of_candidates(const CellProblem& problem, const Box3& box) const;
  bool accept_slab(const CellProblem& problem, const Sheet& slab, Leaf& leaf) const;
  bool accept_complex(const CellProblem& problem, const Box3& box, Leaf& leaf) const;
  bool accept_thin(const CellProblem& problem, const Box3& box, const LocalPlanes& local, Leaf& leaf) const;
  bool accept_patches(const CellProblem& problem, const Box3& box, Leaf& leaf) const;
  Sheet class_sheet(const Patches& patches, const PatchClass& c, const Vec3& u, const Box3& box) const;
  bool near_enough(Sheet& sheet, const Loop& loop, const Box3& box) const;
  bool trace_faces(const CellProblem& problem, const LocalPlanes& local, Leaf& leaf) const;
  bool small_enough(const Box3& box) const;
  bool worth_isolating(const std::vector<std::uint32_t>& surfaces, const Box3& box) const;

  const Restriction& restriction_;
  AcceptanceSettings settings_;
  Statistics& statistics_;
};

}  // namespace starcell
