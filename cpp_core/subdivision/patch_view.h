// Patches over a box: which can bound E there, in which sense, which cannot meet, and the directions that see them as graphs.
//
// Everything is read off second-order enclosures (solids/smooth_surface.h): a patch of one certain sign is a constant; if
// F + c G is of one sign, two patches have no point in common and one combination of their sides does not occur; and so for three,
// where a wedge of two ends before the third. What no
// feasible combination of sides can flip does not bound E: that is how sheets inside other solids disappear (DESIGN §3).
//
// Two patches are linked if they may meet where membership depends on both; elsewhere E runs on through one of them alone. A
// *class* is a set of patches so linked, each bounding E. E in the box is the disjoint union of the classes' parts. On a class's surfaces E flips as `value` says. A
// *direction* u of a class has n . u > 0 for every outward normal of E that it can have: then every line along u meets the
// class's part of E at most once (T§3.5.2 with the guard at infinity, T§3.5.4 for curved surfaces; DESIGN §3, F-star and
// V-star). For why other classes may flip in between: along such a line the class's value falls and never rises, and wherever E
// is on the class's surfaces its membership is that value, whatever the sides of other patches.
#pragma once

#include "subdivision/patches.h"
#include "subdivision/statistics.h"

namespace starcell {

constexpr std::size_t max_class = 6;

/// Patches that may meet each other and bound E, and E's part on them.
struct PatchClass {
  std::vector<std::size_t> patches;     ///< indices into Patches; at most max_class
  std::vector<int> sense;               ///< +1: E's outward normal is F's gradient, -1: turned
  std::uint64_t value = 0;              ///< bit a: inside for the class's sides a (bit i: negative side of patches[i])
  Vec3 direction = Vec3::Zero();        ///< a certified one, once it has been looked for
};

class PatchView {
 public:
  PatchView(const Patches& patches, const Box3& box);

  /// Rules out what three patches cannot be at once, which is looked at where pairs do not suffice. Did it rule out anything?
  bool compare_threes();

  /// Certainly the same membership everywhere?
  bool constant() const;
  /// None if some patch bounds E in both senses, or there are too many.
  std::optional<std::vector<PatchClass>> classes() const;
  /// The same with a direction for each; none if one has none. `flat_axis`: as direction().
  std::optional<std::vector<PatchClass>> seen_classes(int flat_axis, Statistics& statistics) const;
  /// A certified direction of unit length; `flat_axis`: without a component along that axis, or -1.
  std::optional<Vec3> direction(const PatchClass& c, int flat_axis, Statistics& statistics) const;
  /// Is it one?
  bool sees(const PatchClass& c, const Vec3& u) const;

  const Expansion& expansion(std::size_t patch) const { return expansions_[patch]; }

 private:
  /// Does a combination of sides occur, as far as is known?
  bool feasible(Sides sides) const;
  void compare(std::size_t k, std::size_t l);
  bool compare(std::size_t k, std::size_t l, std::size_t m);
  int side_on(std::size_t k, std::size_t l) const;
  bool linked(std::size_t k, std::size_t l) const;
  template <class Visit>
  void for_feasible(Visit visit) const;
  bool tabulate(PatchClass& c) const;

  bool faces(std::size_t patch, const Vec3& n, const Box3& box, int depth) const;

  const Patches& patches_;
  const Box3 box_;
  std::vector<Expansion> expansions_;
  std::vector<std::size_t> mixed_;                                             // patches of no certain sign
  Sides fixed_ = 0;                                                            // negative sides of the others
  std::array<std::array<std::uint8_t, max_patches>, max_patches> excluded_{};  // bit 2 [k negative] + [l negative]
  std::vector<std::pair<Sides, Sides>> excluded_threes_;                       // of three patches, the negative sides
};

}  // namespace starcell
