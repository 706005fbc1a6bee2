// The configurations in which a robot is free, as a certified mesh (T§1.3, T§5.1-5.4).
//
// A solid that translates (what is free of the sum of obstacles and mirrored robot, minkowski/), a planar body that translates and turns, and an arm of three links on revolute joints: all that is free is what is left of
// a box of configurations where no contact function says that something meets (collision_surface.h), contoured as any other solid. Angles are scaled by `unit`, a power of two
// and at least the robot's radius, while that is done: so a distance there is no less than one that counts as many model units a radian as the radius.
// Guarantees: the certificate's, of the free configurations within the domain, in model units and radians. Touching is not free; contacts are told as everywhere.
#pragma once

#include "configuration_space/collision_surface.h"
#include "operations/boolean.h"

namespace starcell {

struct ConfigurationProblem {
  std::vector<Body> bodies;
  std::optional<std::array<double, 3>> crossing;   ///< links, without width, of which the last one must not cross the first
  Box3 domain;                                ///< of scaled configurations; angles that go round from 0 to 2 pi
  double unit = 1;
  int first_angle = 2;                        ///< this coordinate and those after it are angles
  std::array<bool, 3> goes_round{false, false, true};

  struct Collision {
    std::optional<Expression> set;     ///< none: all is free
    double moved = 0;                  ///< within the contact tolerance, to decide `contacts`
    std::vector<Box3> contacts;
  };
  Collision collision(double contact) const;
};

/// Polygons in the robot's frame, whose origin it turns about; `lower` and `upper`: of its translations. Throws InvalidSolidError for polygons, std::invalid_argument
/// for bounds that are not finite or are empty.
ConfigurationProblem planar_robot(const std::vector<PlanarPolygon>& robot, const std::vector<PlanarPolygon>& obstacles, const std::array<double, 2>& lower, const std::array<double, 2>& upper);

/// An arm of three links on revolute joints; a link's own frame has its joint at the origin and the next one at (length, 0).
struct Arm {
  std::array<double, 3> lengths;
  std::array<double, 2> base{0, 0};
  bool self_collision = true;                                         ///< the last link must not meet the first: neighbours are up to the limits
  std::array<std::vector<PlanarPolygon>, 3> shapes{};                          ///< of links, in their frames; none: a straight line without width
  std::array<std::optional<std::array<double, 2>>, 3> limits{};       ///< of the joints, radians, lower before upper; none: it goes round
};

/// Throws InvalidSolidError for polygons, std::invalid_argument for what is not finite, lengths that are not positive, limits that are empty or more than a turn.
ConfigurationProblem planar_arm(const Arm& arm, const std::vector<PlanarPolygon>& obstacles);

struct FreeSpace {
  Result result;                             ///< in configurations: angles in radians
  std::vector<std::uint8_t> facet_kind;      ///< 0: of a contact surface, 1: of the domain's sides
  std::optional<std::size_t> components;     ///< of what is free where angles go round; none: not told at this error
};

/// Of a solid that translates among solids: the positions of its frame's origin, which its own coordinates are about. Bounds as planar_robot(); throws as evaluate_in_few().
FreeSpace free_translations(const Expression& robot, const Expression& obstacles, const Vec3& lower, const Vec3& upper, const Options& options, bool decimate = true);

/// Throws as evaluate_in_few().
FreeSpace free_space(const ConfigurationProblem& problem, const Options& options, bool decimate = true);

}  // namespace starcell
