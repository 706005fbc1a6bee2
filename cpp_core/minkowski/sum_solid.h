// The Minkowski sum A ⊕ B = {a + b}, and the erosion A ⊖ B = {x : x + B ⊆ A}, of two polyhedra: candidates from their convolution,
// membership by whether A meets x - B.
//
// T§4.1; the erosion is the complement of ~A ⊕ -B (T§1.2). Any operands: disconnected, with cavities, neither convex, the origin
// anywhere. Of the regularised sum: where operands touch only when moved, nothing is added.
#pragma once

#include "minkowski/convolution.h"
#include "minkowski/meeting.h"
#include "solids/candidate_solid.h"

namespace starcell {

class SumSolid final : public CandidateSolid {
 public:
  enum class Kind { sum, erosion };

  /// Throws std::invalid_argument for an operand without triangles; calls `pause` now and then, and passes on what it throws.
  static std::shared_ptr<const SumSolid> make(Kind kind, PolyhedronPtr a, PolyhedronPtr b, const std::function<void()>& pause = {});

  const std::vector<Vec3>& points() const override { return convolution_.points; }
  const std::vector<char>& merged() const override { return convolution_.merged; }
  const std::vector<Triangle>& facets() const override { return convolution_.facets; }
  const std::vector<std::uint32_t>& partners() const override { return convolution_.partners; }
  std::optional<bool> contains(const Vec3& x) const override;
  std::optional<bool> constant(const Box3& box) const override;

  Kind kind() const { return kind_; }
  const PolyhedronPtr& a() const { return a_; }
  const PolyhedronPtr& b() const { return b_; }
  /// Of an erosion empty if it is certainly gone.
  const Box3& bounding_box() const { return box_; }
  /// The image under an affine map: of both operands, the second without its translation.
  std::shared_ptr<const SumSolid> transformed(const Eigen::Matrix4d& map) const;

 private:
  SumSolid(Kind kind, PolyhedronPtr a, PolyhedronPtr b, const std::function<void()>& pause);

  Kind kind_;
  PolyhedronPtr a_, b_;
  SumOperand placed_a_, placed_b_;
  Convolution convolution_;
  Meeting meeting_;
  Box3 box_;
};

using SumSolidPtr = std::shared_ptr<const SumSolid>;

}  // namespace starcell
