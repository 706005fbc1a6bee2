// The patches of a cell: the surfaces that bound the remaining solids there, each met by whatever lies on it, and the
// expression as a function of the sides of patches that a point is on.
//
// A region contributes its surface, or the parts of it that the cell tells apart. A polyhedron contributes its facets' planes, where it is locally one half-space, the
// intersection of several (all its facets in the cell behind each other's planes) or their union (all before): then its
// membership in the cell is read off the planes' signs. Surface identity (DESIGN §4) makes one patch of what is shared, so
// all solids on it flip together.
// Guarantees: for every point of the cell, value(sides of the patches) is the membership in the expression, solids taken as
// moved by their surfaces' thickness.
#pragma once

#include <memory>
#include <optional>

#include "subdivision/cell_problem.h"

namespace starcell {

/// Bit k: the point is on the negative side of patch k, F < 0.
using Sides = std::uint32_t;
constexpr std::size_t max_patches = 12;

class Patches {
 public:
  /// None where a polyhedron is more than planes can say, or there are too many.
  static std::optional<Patches> of(const Restriction& restriction, const CellProblem& problem);

  std::size_t size() const { return surfaces_.size(); }
  /// The table's number for it: of several parts of one surface the same.
  std::uint32_t surface(std::size_t k) const { return surfaces_[k]; }
  /// The table's plane that it is in the cell; UINT32_MAX: none.
  std::uint32_t plane(std::size_t k) const { return planes_[k]; }
  /// What it is in the cell.
  const Surface& at(std::size_t k) const { return *here_[k]; }
  const std::shared_ptr<const Surface>& here(std::size_t k) const { return here_[k]; }
  /// The patches on that surface which may vanish on a stretch along `axis` about p: none that does is left out.
  std::vector<std::size_t> vanishing(std::uint32_t surface, int axis, double low, double high, const Vec3& p) const;
  bool value(Sides sides) const;

 private:
  /// A solid: on the given sides of all (or, `any`, of any) of its patches, and in all (or any) of what is inside the forms.
  struct Form {
    bool any = false;
    std::vector<std::pair<std::size_t, bool>> patches;   ///< (patch, positive side)
    std::vector<Form> forms;
    bool holds(Sides sides) const;
  };

  explicit Patches(const FacetTable& table) : table_(&table) {}
  std::size_t add(std::uint32_t surface);
  /// The patch, and whether the form is it turned: positive on its negative side.
  std::pair<std::size_t, bool> add_part(const Region& region, SmoothSurfacePtr form);
  bool add_region(const Region& region, const SmoothSurfacePtr& form);
  Form form_of(const Region& region, const SmoothSurfacePtr& form);
  bool add_polyhedron(const FacetTable& table, const std::uint32_t* first, const std::uint32_t* last);

  const FacetTable* table_;
  const LocalExpression* expression_ = nullptr;
  std::vector<std::uint32_t> surfaces_, planes_;
  std::vector<std::shared_ptr<const Surface>> here_;
  std::vector<Form> forms_;   // per slot
};

}  // namespace starcell
