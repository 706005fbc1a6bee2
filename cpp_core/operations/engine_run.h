// One run of the engine over one table of facets: a grid, its octree, the mesh (DESIGN §3).
//
// Contouring names the leaves that do not serve; they are refined, or relaxed, until all do or a budget ends. Guarantees:
// `bound` holds everything by which the run's mesh may differ from the operands' Boolean, moved operands included; every
// cell whose topology was not proved is in `unresolved`.
#pragma once

#include <chrono>
#include <map>
#include <string>

#include "contouring/contour.h"
#include "operations/operands.h"
#include "operations/options.h"
#include "operations/tolerances.h"
#include "subdivision/grazes.h"
#include "subdivision/subdivide.h"

namespace starcell {

struct Run {
  Grid grid;
  SurfaceMesh mesh;
  double bound = 0;
  std::vector<Box3> unresolved, contacts;
  std::vector<Graze> suspects;   ///< unresolved cells that several operands reach
  std::size_t leaves = 0;
  bool exhausted = false;        ///< a budget ran out: another try would only cost more
  bool grazes = false;           ///< exactness was lost to the position of the grid
};

/// What polish() found out about the mesh.
struct Polish {
  bool embedded = false;             ///< closed, manifold and without self-intersections
  std::vector<Box3> meet_as_floats;  ///< triangles that meet once rounded to float32
  bool tight = false;                ///< some meet if coordinates are rounded, be it only one of the three
};

class Engine {
 public:
  /// Everything must outlive the engine. `timings`: seconds and rounds are added under their names.
  Engine(const Operands& operands, const Options& options, const Box3& box, const Tolerances& tolerances, const Progress& progress,
         Statistics& statistics, std::map<std::string, double>& timings)
      : operands_(operands), options_(options), box_(box), tolerances_(tolerances), progress_(progress), statistics_(statistics),
        timings_(timings), start_(std::chrono::steady_clock::now()) {}

  /// How much a run may cost where it leads nowhere; a user's budgets hold besides.
  enum class Effort { a_look, usual };

  /// `moved`: how far the table's operands were moved; `attempt`: which position of the grid.
  Run run(const FacetTable& table, double moved, int attempt, Effort effort = Effort::usual) const;

  /// Merges flat regions and opens gaps for float32; adds what that moves to the run's bound.
  Polish polish(Run& run) const;

 private:
  bool out_of_time() const;
  void tell(double done, const std::string& stage) const;
  double scale() const { return std::max(box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff()); }
  AcceptanceSettings acceptance_settings(const FacetTable& table, const Grid& grid, double moved) const;
  SubdivisionLimits limits(const Grid& grid, Effort effort) const;
  std::size_t cells_for(Effort effort) const;
  Contour refine_until_good(const Restriction& restriction, Subdivision& subdivision, Octree& tree, const AcceptanceSettings& settings) const;
  bool grazes_grid(const Octree& tree, double bound) const;

  const Operands& operands_;
  const Options& options_;
  const Box3 box_;
  const Tolerances& tolerances_;
  const Progress& progress_;
  Statistics& statistics_;
  std::map<std::string, double>& timings_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace starcell
