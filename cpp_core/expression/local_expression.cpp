#include "expression/local_expression.h"

namespace starcell {
namespace {

using Op = LocalExpression::Op;
using Step = LocalExpression::Step;

// A sub-expression while it is folded: a constant, or the program that computes it.
struct Folded {
  std::optional<bool> constant;
  std::vector<Step> program;
};

Folded fold_operation(Op op, std::vector<Folded>::iterator first, std::vector<Folded>::iterator last) {
  const bool absorbing = op == Op::set_union;  // true absorbs a union, false an intersection
  Folded result;
  std::uint32_t operands = 0;
  for (auto it = first; it != last; ++it) {
    if (it->constant) {
      if (*it->constant == absorbing) return {absorbing, {}};
      continue;
    }
    result.program.insert(result.program.end(), it->program.begin(), it->program.end());
    ++operands;
  }
  if (operands == 0) return {!absorbing, {}};
  if (operands > 1) result.program.push_back({op, operands});
  return result;
}

}  // namespace

LocalExpression LocalExpression::simplified(const std::vector<State>& states) const {
  std::vector<Folded> stack;
  for (const Step& step : program_) {
    if (step.op == Op::leaf) {
      if (states[step.count] == State::mixed)
        stack.push_back({std::nullopt, {step}});
      else
        stack.push_back({states[step.count] == State::inside, {}});
    } else if (step.op == Op::complement) {
      Folded& top = stack.back();
      if (top.constant)
        top.constant = !*top.constant;
      else if (top.program.back().op == Op::complement)
        top.program.pop_back();
      else
        top.program.push_back(step);
    } else {
      const auto first = stack.end() - step.count;
      Folded folded = fold_operation(step.op, first, stack.end());
      stack.erase(first, stack.end());
      stack.push_back(std::move(folded));
    }
  }
  LocalExpression result;
  if (stack.empty()) {
    result.constant_ = constant_.value_or(false);
    return result;
  }
  result.constant_ = stack.back().constant;
  result.program_ = std::move(stack.back().program);
  std::vector<std::uint32_t> slot_of(solids_.size(), UINT32_MAX);
  std::vector<bool> used(solids_.size(), false);
  for (const Step& step : result.program_)
    if (step.op == Op::leaf) used[step.count] = true;
  for (std::size_t slot = 0; slot < solids_.size(); ++slot)
    if (used[slot]) {
      slot_of[slot] = static_cast<std::uint32_t>(result.solids_.size());
      result.solids_.push_back(solids_[slot]);
    }
  for (Step& step : result.program_)
    if (step.op == Op::leaf) step.count = slot_of[step.count];
  return result;
}

bool LocalExpression::value(Membership membership) const {
  if (constant_) return *constant_;
  if (program_.size() == 1) return membership & 1;
  // Values live in the bits of a word while they fit: expressions nest deeper than 64 only in theory.
  std::vector<bool> deep;
  std::uint64_t stack = 0;
  int height = 0;
  for (const Step& step : program_) {
    if (height >= 63) {
      deep.assign(1, false);
      break;
    }
    if (step.op == Op::leaf) {
      stack = (stack << 1) | ((membership >> step.count) & 1);
      ++height;
    } else if (step.op == Op::complement) {
      stack ^= 1;
    } else {
      const std::uint64_t mask = (std::uint64_t{1} << step.count) - 1;
      const std::uint64_t values = stack & mask;
      const bool value = step.op == Op::set_union ? values != 0 : values == mask;
      stack = ((stack >> step.count) << 1) | std::uint64_t{value};
      height -= static_cast<int>(step.count) - 1;
    }
  }
  if (deep.empty()) return stack & 1;
  std::vector<bool> values;
  for (const Step& step : program_) {
    if (step.op == Op::leaf) {
      values.push_back((membership >> step.count) & 1);
    } else if (step.op == Op::complement) {
      values.back() = !values.back();
    } else {
      bool value = step.op == Op::intersection;
      for (std::uint32_t k = 0; k < step.count; ++k) {
        value = step.op == Op::set_union ? value || values.back() : value && values.back();
        values.pop_back();
      }
      values.push_back(value);
    }
  }
  return values.back();
}

}  // namespace starcell
