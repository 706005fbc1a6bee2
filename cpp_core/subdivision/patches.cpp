#include "subdivision/patches.h"

#include <algorithm>

namespace starcell {

std::vector<std::size_t> Patches::vanishing(std::uint32_t surface, int axis, double low, double high, const Vec3& p) const {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < surfaces_.size(); ++k)
    if (surfaces_[k] == surface) found.push_back(k);
  if (found.size() <= 1) return found;
  Vec3 center = p, reach = Vec3::Zero();
  center[axis] = 0.5 * (low + high);
  reach[axis] = std::max(high - center[axis], center[axis] - low) * (1 + 1e-12) + 1e-15 * std::abs(center[axis]);
  const Rounding rounding;
  std::erase_if(found, [&](std::size_t k) { return certain_sign(at(k).expand(center, reach).range()) != 0; });
  return found;
}

std::size_t Patches::add(std::uint32_t surface) {
  const auto it = std::find(surfaces_.begin(), surfaces_.end(), surface);
  if (it != surfaces_.end()) return static_cast<std::size_t>(it - surfaces_.begin());
  surfaces_.push_back(surface);
  planes_.push_back(table_->surfaces[surface].form ? UINT32_MAX : surface);
  here_.emplace_back(std::shared_ptr<void>(), &table_->surfaces[surface]);   // the table's: not owned
  return surfaces_.size() - 1;
}

std::pair<std::size_t, bool> Patches::add_part(const Region& region, SmoothSurfacePtr form) {
  if (form->nested_parts())
    for (std::size_t k = 0; k < here_.size(); ++k)
      if (here_[k]->form && (here_[k]->form->same_as(*form) || here_[k]->form->opposite_of(*form))) return {k, !here_[k]->form->same_as(*form)};
  Surface part = table_->surfaces[region.surface];
  const auto plane = form->plane();
  part.form = std::move(form);
  surfaces_.push_back(region.surface);
  planes_.push_back(plane ? region.first_plane + static_cast<std::uint32_t>(*plane) : UINT32_MAX);
  here_.push_back(std::make_shared<const Surface>(std::move(part)));
  return {surfaces_.size() - 1, false};
}

bool Patches::add_region(const Region& region, const SmoothSurfacePtr& form) {
  if (!form) {
    forms_.push_back({false, {{add(region.surface), region.complement}}, {}});
    return surfaces_.size() <= max_patches;
  }
  if (!form->simple()) return false;
  forms_.push_back(form_of(region, form));
  return surfaces_.size() <= max_patches;
}

// F < 0 where any part is, if it is the least of them; where all are, if it is the greatest.
Patches::Form Patches::form_of(const Region& region, const SmoothSurfacePtr& form) {
  Form f{form->least_of_parts() != region.complement, {}, {}};
  std::vector<SmoothSurfacePtr> parts = form->parts();
  if (parts.empty()) parts.push_back(form);
  for (SmoothSurfacePtr& part : parts) {
    if (part != form && part->nested_parts() && !part->parts().empty()) {
      f.forms.push_back(form_of(region, part));
      continue;
    }
    const auto [patch, turned] = add_part(region, std::move(part));
    f.patches.emplace_back(patch, region.complement != turned);
  }
  return f;
}

bool Patches::Form::holds(Sides sides) const {
  const auto on_side = [&](const std::pair<std::size_t, bool>& p) { return ((sides >> p.first & 1) != 0) != p.second; };
  const auto inner = [&](const Form& f) { return f.holds(sides); };
  if (any) return std::any_of(patches.begin(), patches.end(), on_side) || std::any_of(forms.begin(), forms.end(), inner);
  return std::all_of(patches.begin(), patches.end(), on_side) && std::all_of(forms.begin(), forms.end(), inner);
}

bool Patches::value(Sides sides) const {
  Membership membership = 0;
  for (std::size_t slot = 0; slot < forms_.size(); ++slot)
    if (forms_[slot].holds(sides)) membership |= Membership{1} << slot;
  return expression_->value(membership);
}

// With all facets behind (before) all planes, the polyhedron's boundary in the cell lies on that of the intersection (union)
// of half-spaces K. Each side of K in the cell is convex, so facets, which have no rim there, cover it whole.
bool Patches::add_polyhedron(const FacetTable& table, const std::uint32_t* first, const std::uint32_t* last) {
  Form form;
  std::vector<std::pair<std::uint32_t, int>> planes;   // (surface, sense of the facets' outward normals)
  for (const std::uint32_t* f = first; f != last; ++f) {
    const std::uint32_t surface = table.surface[*f];
    const double along = table.area_vector(*f).dot(table.surfaces[surface].normal);
    const int sense = along > 0 ? 1 : along < 0 ? -1 : 0;
    if (sense == 0) return false;
    const auto known = std::find_if(planes.begin(), planes.end(), [&](const auto& p) { return p.first == surface; });
    if (known == planes.end()) {
      planes.emplace_back(surface, sense);
      if (planes.size() > max_patches) return false;
    } else if (known->second != sense) {
      return false;
    }
  }
  if (planes.size() > 1) {
    bool behind = true, before = true;
    for (const auto& [surface, sense] : planes) {
      const Surface& s = table.surfaces[surface];
      for (const std::uint32_t* f = first; f != last; ++f) {
        if (table.surface[*f] == surface) continue;
        for (int k = 0; k < 3; ++k) {
          const double height = sense * (s.normal.dot(table.corner(*f, k)) - s.offset);
          behind = behind && height <= s.thickness;
          before = before && height >= -s.thickness;
        }
      }
    }
    if (!behind && !before) return false;
    form.any = !behind;
  }
  for (const auto& [surface, sense] : planes) form.patches.emplace_back(add(surface), sense < 0);
  forms_.push_back(std::move(form));
  return surfaces_.size() <= max_patches;
}

std::optional<Patches> Patches::of(const Restriction& restriction, const CellProblem& problem) {
  const FacetTable& table = restriction.table();
  Patches patches(table);
  patches.expression_ = &problem.expression;
  if (problem.slots() > max_slots) return std::nullopt;
  const std::uint32_t *at = problem.facets.data(), *end = at + problem.facets.size();
  for (std::size_t slot = 0; slot < problem.slots(); ++slot) {
    const std::uint32_t operand = problem.expression.solids()[slot];
    if (table.is_region(operand)) {
      if (!patches.add_region(table.region(operand), problem.forms.empty() ? nullptr : problem.forms[slot])) return std::nullopt;
      continue;
    }
    const std::uint32_t* last = std::lower_bound(at, end, table.first[operand + 1]);
    if (!patches.add_polyhedron(table, at, last)) return std::nullopt;
    at = last;
  }
  return patches;
}

}  // namespace starcell
