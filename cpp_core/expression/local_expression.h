// An expression as one cell sees it: solids that do not reach into the cell are constants and have been folded away.
//
// Rests on T§3.10.2. A LocalExpression names the solids that are left by slots 0..n-1; a membership is one bit a slot.
// Guarantees: for every point of the cell, value(membership of the left solids) is the membership in the whole
// expression, provided the states given to simplified() were true in the cell.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace starcell {

/// What is known of a solid inside a cell.
enum class State : std::uint8_t { outside, inside, mixed };

/// One bit a slot. Cells with more solids than bits are subdivided before anything is evaluated.
using Membership = std::uint64_t;
constexpr std::size_t max_slots = 64;

class LocalExpression {
 public:
  enum class Op : std::uint8_t { leaf, set_union, intersection, complement };
  /// Postfix program: `count` is the slot of a leaf, or how many values an operation takes.
  struct Step {
    Op op;
    std::uint32_t count;
  };

  LocalExpression() = default;
  LocalExpression(std::vector<Step> program, std::vector<std::uint32_t> solids)
      : program_(std::move(program)), solids_(std::move(solids)) {}

  /// The solid behind each slot.
  const std::vector<std::uint32_t>& solids() const { return solids_; }
  const std::vector<Step>& program() const { return program_; }

  /// Set when no solid is left: the whole cell is inside (true) or outside (false).
  std::optional<bool> constant() const { return constant_; }

  /// Folds solids known to be inside or outside; states[slot] for every slot. Slots are renumbered in order.
  LocalExpression simplified(const std::vector<State>& states) const;

  /// Membership in the expression. At most max_slots solids may be left.
  bool value(Membership membership) const;

 private:
  std::vector<Step> program_;
  std::vector<std::uint32_t> solids_;
  std::optional<bool> constant_;
};

}  // namespace starcell
