// Simplification inside a cell against brute force: a tree of its own, evaluated for every membership.
#include "expression/local_expression.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace starcell {
namespace {

using Op = LocalExpression::Op;
using Step = LocalExpression::Step;

struct Tree {
  Op op = Op::leaf;
  std::uint32_t slot = 0;
  std::vector<Tree> children;

  bool value(Membership m) const {
    if (op == Op::leaf) return m >> slot & 1;
    if (op == Op::complement) return !children[0].value(m);
    for (const Tree& c : children)
      if (c.value(m) == (op == Op::set_union)) return op == Op::set_union;
    return op == Op::intersection;
  }
  void append_to(std::vector<Step>& program) const {
    for (const Tree& c : children) c.append_to(program);
    program.push_back({op, op == Op::leaf ? slot : static_cast<std::uint32_t>(children.size())});
  }
};

struct Random {
  std::mt19937 engine{11};
  int upto(int n) { return std::uniform_int_distribution<int>(0, n)(engine); }

  Tree tree(int solids, int depth) {
    const int kind = depth == 0 ? 0 : upto(4);
    if (kind == 0) return {Op::leaf, static_cast<std::uint32_t>(upto(solids - 1)), {}};
    if (kind == 1) return {Op::complement, 0, {tree(solids, depth - 1)}};
    Tree t{kind <= 3 ? (kind == 2 ? Op::set_union : Op::intersection) : Op::set_union, 0, {}};
    for (int k = upto(3); k >= 0; --k) t.children.push_back(tree(solids, depth - 1));
    return t;
  }
};

LocalExpression compile(const Tree& tree, std::uint32_t solids) {
  std::vector<Step> program;
  tree.append_to(program);
  std::vector<std::uint32_t> names;
  for (std::uint32_t k = 0; k < solids; ++k) names.push_back(10 * k);  // not the slots, so that mixing them up shows
  return {program, names};
}

// The memberships of a cell's points are those in which every solid that is not mixed has its state's value.
void expect_equal_in_cell(const Tree& tree, int solids, const LocalExpression& simple, const std::vector<State>& states) {
  for (Membership m = 0; m < Membership{1} << solids; ++m) {
    bool possible = true;
    for (int k = 0; k < solids; ++k)
      possible = possible && (states[k] == State::mixed || (states[k] == State::inside) == (m >> k & 1));
    if (!possible) continue;
    Membership left = 0;
    for (std::size_t slot = 0; slot < simple.solids().size(); ++slot)
      left |= (m >> (simple.solids()[slot] / 10) & 1) << slot;
    ASSERT_EQ(simple.constant().value_or(simple.constant() ? false : simple.value(left)), tree.value(m));
  }
}

TEST(LocalExpression, SimplifiedHasTheSameValueForEveryPointOfTheCell) {
  Random random;
  for (int i = 0; i < 3000; ++i) {
    const int solids = 1 + random.upto(5);
    const Tree tree = random.tree(solids, 4);
    const LocalExpression whole = compile(tree, solids);
    std::vector<State> states;
    for (int k = 0; k < solids; ++k) states.push_back(static_cast<State>(random.upto(2)));
    const LocalExpression simple = whole.simplified(states);
    expect_equal_in_cell(tree, solids, simple, states);
    for (std::size_t k = 1; k < simple.solids().size(); ++k) EXPECT_LT(simple.solids()[k - 1], simple.solids()[k]);
    for (const std::uint32_t solid : simple.solids()) EXPECT_EQ(states[solid / 10], State::mixed);
  }
}

// A child cell knows more: folding twice must be folding once with both states.
TEST(LocalExpression, SimplifyingStepByStepDownTheTreeIsTheSame) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const int solids = 2 + random.upto(4);
    const Tree tree = random.tree(solids, 4);
    std::vector<State> states(solids, State::mixed);
    LocalExpression simple = compile(tree, solids);
    for (int level = 0; level < 3; ++level) {
      const int settled = random.upto(solids - 1);
      if (states[settled] == State::mixed) states[settled] = random.upto(1) ? State::inside : State::outside;
      std::vector<State> here;
      for (const std::uint32_t solid : simple.solids()) here.push_back(states[solid / 10]);
      simple = simple.simplified(here);
      expect_equal_in_cell(tree, solids, simple, states);
    }
  }
}

// All 64 bits of a membership are used: a union is true for each alone, an intersection only for all.
TEST(LocalExpression, SixtyFourSolidsFit) {
  Tree any{Op::set_union, 0, {}}, all{Op::intersection, 0, {}};
  for (std::uint32_t k = 0; k < max_slots; ++k) {
    any.children.push_back({Op::leaf, k, {}});
    all.children.push_back({Op::leaf, k, {}});
  }
  const LocalExpression some = compile(any, max_slots), every = compile(all, max_slots);
  EXPECT_FALSE(some.value(0));
  EXPECT_TRUE(every.value(~Membership{0}));
  for (std::uint32_t k = 0; k < max_slots; ++k) {
    EXPECT_TRUE(some.value(Membership{1} << k)) << k;
    EXPECT_FALSE(every.value(~(Membership{1} << k))) << k;
  }
}

}  // namespace
}  // namespace starcell
