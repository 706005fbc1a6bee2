#include "minkowski/sum_solid.h"

#include <stdexcept>

namespace starcell {

std::shared_ptr<const SumSolid> SumSolid::make(Kind kind, PolyhedronPtr a, PolyhedronPtr b, const std::function<void()>& pause) {
  if (a->triangles().empty() || b->triangles().empty()) throw std::invalid_argument("a Minkowski sum needs two solids that are not empty");
  return std::shared_ptr<const SumSolid>(new SumSolid(kind, std::move(a), std::move(b), pause));
}

SumSolid::SumSolid(Kind kind, PolyhedronPtr a, PolyhedronPtr b, const std::function<void()>& pause)
    : kind_(kind), a_(std::move(a)), b_(std::move(b)), placed_a_(a_, {false, kind == Kind::erosion}), placed_b_(b_, {kind == Kind::erosion, false}),
      convolution_(convolve(placed_a_, placed_b_, {.origins = false, .covers = true, .pause = pause})), meeting_(placed_a_, placed_b_) {
  const Box3 &one = a_->bounding_box(), &other = b_->bounding_box();
  if (kind == Kind::sum) {
    box_ = Box3(one.min() + other.min(), one.max() + other.max());
    return;
  }
  // What is left is outside the complement's sum: its boundary is turned round.
  for (Triangle& t : convolution_.facets) std::swap(t[1], t[2]);
  const Vec3 low = one.min() - other.min(), high = one.max() - other.max();
  if ((low.array() < high.array()).all()) box_ = Box3(low, high);
}

std::optional<bool> SumSolid::contains(const Vec3& x) const {
  const auto meets = meeting_.at(x);
  if (!meets) return std::nullopt;
  return *meets == (kind_ == Kind::sum);
}

std::optional<bool> SumSolid::constant(const Box3& box) const {
  if (!meeting_.throughout(box)) return std::nullopt;
  return kind_ == Kind::sum;
}

std::shared_ptr<const SumSolid> SumSolid::transformed(const Eigen::Matrix4d& map) const {
  Eigen::Matrix4d linear = map;
  linear.block<3, 1>(0, 3).setZero();
  return make(kind_, a_->transformed(map), b_->transformed(linear));
}

}  // namespace starcell
