#include "operations/operands.h"

#include <algorithm>
#include <map>

namespace starcell {
namespace {

// A cuboid with one side on the plane, large enough that the others stay far outside the box.
PolyhedronPtr cover(const HalfSpace& h, const Box3& box) {
  const Vec3 n = h.normal.normalized();
  const double height = n.dot(box.center() - h.point);
  const Vec3 foot = box.center() - height * n;
  const double reach = 4 * (box.diagonal().norm() + std::abs(height));
  const Vec3 u = n.unitOrthogonal() * reach, v = n.cross(n.unitOrthogonal()) * reach, down = -n * reach;
  std::vector<Vec3> p;
  for (int i = 0; i < 8; ++i)
    p.push_back(foot + (i & 1 ? u : Vec3(-u)) + (i & 2 ? v : Vec3(-v)) + (i & 4 ? Vec3::Zero() : down));
  std::vector<Triangle> t;
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    t.push_back({q[0], q[1], q[2]});
    t.push_back({q[0], q[2], q[3]});
  }
  return Polyhedron::make(std::move(p), std::move(t));
}

class Gatherer {
 public:
  explicit Gatherer(const Box3& box) : box_(box) {}

  void visit(const Expression& e) {
    using Op = LocalExpression::Op;
    switch (e.kind()) {
      case Expression::Kind::polyhedron: leaf(e.polyhedron().get(), e.polyhedron()); return;
      case Expression::Kind::half_space: leaf(&e.half_space(), nullptr, &e.half_space()); return;
      case Expression::Kind::curved: curved(e.curved()); return;
      case Expression::Kind::offset: offset(e.offset()); return;
      case Expression::Kind::sum: sum(e.sum()); return;
      case Expression::Kind::winding: winding(e.winding()); return;
      case Expression::Kind::region: region(e.region()); return;
      default: break;
    }
    for (const Expression& operand : e.operands()) visit(operand);
    const auto n = static_cast<std::uint32_t>(e.operands().size());
    program.push_back({e.kind() == Expression::Kind::set_union      ? Op::set_union
                       : e.kind() == Expression::Kind::intersection ? Op::intersection
                                                                    : Op::complement,
                       n});
  }

  std::vector<LocalExpression::Step> program;
  std::vector<PolyhedronPtr> solids;
  std::vector<RegionOperand> regions;
  std::vector<CandidateSolidPtr> candidates;
  std::vector<PolyhedronPtr> sources;
  std::vector<std::pair<std::size_t, std::size_t>> summands;

  // Sums are numbered after all polyhedra, and regions after sums: how many there are is known only now.
  void number_others() {
    const auto sums_from = static_cast<std::uint32_t>(solids.size()), regions_from = static_cast<std::uint32_t>(solids.size() + candidates.size());
    for (auto& step : program) {
      if (step.op != LocalExpression::Op::leaf) continue;
      if (step.count >= first_region)
        step.count += regions_from - first_region;
      else if (step.count >= first_sum)
        step.count += sums_from - first_sum;
    }
  }

 private:
  static constexpr std::uint32_t first_sum = 0x40000000u, first_region = 0x80000000u;

  void curved(const CurvedSolidPtr& solid) {
    const auto [it, fresh] = index_.emplace(solid.get(), static_cast<std::uint32_t>(regions.size()));
    const std::uint32_t body = it->second;
    if (fresh) {
      const Box3 box = solid->bounding_box().value_or(box_);
      for (const SmoothSurfacePtr& surface : solid->surfaces()) regions.push_back({surface, {}, box, body});
      for (const EndPlane& end : solid->ends()) regions.push_back({nullptr, end, box, body});
    }
    const auto faces = static_cast<std::uint32_t>(solid->surfaces().size() + solid->ends().size());
    for (std::uint32_t k = 0; k < faces; ++k) program.push_back({LocalExpression::Op::leaf, first_region + body + k});
    if (faces > 1) program.push_back({LocalExpression::Op::intersection, faces});
  }

  void offset(const OffsetSolidPtr& solid) {
    const auto [it, fresh] = index_.emplace(solid.get(), static_cast<std::uint32_t>(regions.size()));
    if (fresh) regions.push_back({solid->surface(), {}, solid->bounding_box(), it->second}), sources.push_back(solid->solid());
    program.push_back({LocalExpression::Op::leaf, first_region + it->second});
  }

  void region(const SmoothSurfacePtr& surface) {
    const auto [it, fresh] = index_.emplace(surface.get(), static_cast<std::uint32_t>(regions.size()));
    if (fresh) regions.push_back({surface, {}, box_, it->second});
    program.push_back({LocalExpression::Op::leaf, first_region + it->second});
  }

  void sum(const SumSolidPtr& solid) {
    const auto [it, fresh] = index_.emplace(solid.get(), static_cast<std::uint32_t>(candidates.size()));
    if (fresh) {
      candidates.push_back(solid);
      summands.emplace_back(sources.size(), sources.size() + 1);
      sources.push_back(solid->a());
      sources.push_back(solid->b());
    }
    program.push_back({LocalExpression::Op::leaf, first_sum + it->second});
  }

  void winding(const WindingSolidPtr& solid) {
    const auto [it, fresh] = index_.emplace(solid.get(), static_cast<std::uint32_t>(candidates.size()));
    if (fresh) candidates.push_back(solid);
    program.push_back({LocalExpression::Op::leaf, first_sum + it->second});
  }

  void leaf(const void* key, PolyhedronPtr solid, const HalfSpace* half_space = nullptr) {
    const auto [it, fresh] = index_.emplace(key, static_cast<std::uint32_t>(solids.size()));
    if (fresh) solids.push_back(half_space ? cover(*half_space, box_) : std::move(solid));
    program.push_back({LocalExpression::Op::leaf, it->second});
  }

  Box3 box_;
  std::map<const void*, std::uint32_t> index_;
};

}  // namespace

Operands gather_operands(const Expression& expression, const Box3& box) {
  Gatherer gatherer(box);
  gatherer.visit(expression);
  gatherer.number_others();
  std::vector<std::uint32_t> all(gatherer.solids.size() + gatherer.candidates.size() + gatherer.regions.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return {std::move(gatherer.solids), std::move(gatherer.candidates), std::move(gatherer.regions), LocalExpression(std::move(gatherer.program), std::move(all)),
          std::move(gatherer.sources), std::move(gatherer.summands)};
}

double deflection_of(const Operands& operands) {
  const auto of = [](const PolyhedronPtr& solid) { return solid->provenance().deflection + solid->provenance().moved; };
  double most = 0;
  for (const auto& solid : operands.solids) most = std::max(most, of(solid));
  for (const auto& solid : operands.sources) most = std::max(most, of(solid));
  for (const auto& [a, b] : operands.summands) most = std::max(most, of(operands.sources[a]) + of(operands.sources[b]));
  return most;
}

}  // namespace starcell
