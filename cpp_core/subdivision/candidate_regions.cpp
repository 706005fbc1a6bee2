#include "subdivision/candidate_regions.h"

#include <algorithm>

#include "numerics/interval.h"

namespace starcell {
namespace {

// One bit each; a cell of more planes is about to be split.
constexpr std::size_t most_planes = 64;

}  // namespace

CandidateRegions::CandidateRegions(const FacetTable& table, const CellProblem& problem)
    : table_(table), cell_(problem.cell), facets_(problem.facets.size()), solids_(problem.expression.solids()), known_(problem.slots()) {
  for (const std::uint32_t f : problem.facets) surfaces_.push_back(table.surface[f]);
  std::sort(surfaces_.begin(), surfaces_.end());
  surfaces_.erase(std::unique(surfaces_.begin(), surfaces_.end()), surfaces_.end());
}

// A cell's problem loses solids as a whole.
bool CandidateRegions::are_of(const CellProblem& problem) const {
  return problem.cell.lower == cell_.lower && problem.cell.size == cell_.size && problem.facets.size() == facets_ && problem.expression.solids() == solids_;
}

// Planes are as thick as rounding left them: sides hold for every facet on them.
std::optional<std::uint64_t> CandidateRegions::region_of(const Vec3& x) const {
  if (surfaces_.size() > most_planes) return std::nullopt;
  const Rounding rounding;
  std::uint64_t region = 0;
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    const Surface& s = table_.surfaces[surfaces_[k]];
    const int sign = certain_sign(Interval(s.normal.x()) * x.x() + Interval(s.normal.y()) * x.y() + Interval(s.normal.z()) * x.z() - s.offset +
                                  Interval(-s.thickness, s.thickness));
    if (sign == 0) return std::nullopt;
    if (sign > 0) region |= std::uint64_t{1} << k;
  }
  return region;
}

std::optional<bool> CandidateRegions::contains(std::size_t slot, const Vec3& x) {
  const auto region = region_of(x);
  if (region)
    if (const auto known = known_[slot].find(*region); known != known_[slot].end()) return known->second;
  const auto inside = table_.candidate_contains(solids_[slot], x);
  if (region && inside) known_[slot].emplace(*region, *inside);
  return inside;
}

}  // namespace starcell
