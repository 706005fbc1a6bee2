#include "configuration_space/free_space.h"

#include "operations/results.h"
#include "planar_samples.h"

namespace starcell {
namespace {

using namespace sample;

Options at(double error) {
  Options options;
  options.error = error;
  return options;
}

const Ring ell{{0, 0}, {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}};

// Signs of points by CGAL's polygons; signs of boxes by points in them.
TEST(CollisionSurface, IsNegativeWherePolygonsOverlap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.8, 1.8), turn(-4, 9), share(-1, 1);
  for (int k = 0; k < 60; ++k) {
    const Ring robot = random_star(random, 3 + k % 9), obstacle = random_star(random, 3 + k % 7);
    const ConfigurationProblem problem = planar_robot({robot}, {obstacle, placed(obstacle, 2, 0.5, 1)}, {-3, -3}, {3, 3});
    const CollisionSurface surface(problem.bodies);
    const auto sign_at = [&](const Vec3& q) {
      const Ring body = placed(robot, q.x(), q.y(), q.z() / problem.unit);
      return overlap(body, obstacle) || overlap(body, placed(obstacle, 2, 0.5, 1)) ? -1 : 1;
    };
    for (int i = 0; i < 20; ++i) {
      const Vec3 q(place(random), place(random), turn(random));
      const double reach = i % 2 == 0 ? 0 : 0.3 * std::abs(share(random));
      int sign = 0, of_cell = 0;
      {
        const Rounding rounding;
        sign = certain_sign(surface.expand(q, Vec3::Constant(reach)).range());
        of_cell = certain_sign(surface.restricted(Box3(q - Vec3::Constant(reach), q + Vec3::Constant(reach)))->expand(q, Vec3::Constant(reach)).range());
      }
      if (reach == 0) {
        EXPECT_EQ(sign, sign_at(q));   // coordinates of placed polygons are rounded, but no sample is so near
      }
      for (const int s : {sign, of_cell})
        for (int j = 0; s != 0 && j < 4; ++j) EXPECT_EQ(s, sign_at(q + reach * Vec3(share(random), share(random), share(random)))) << k;
    }
  }
}

// What is said of different boxes of a cell is said of one function: values of points lie in ranges, and change by no more than slopes say. Measuring rests on it.
TEST(CollisionSurface, OfACellIsOneFunction) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.5, 1.5), turn(0, 6), share(-1, 1);
  int kinked = 0;
  for (int k = 0; k < 400; ++k) {
    const ConfigurationProblem problem = planar_robot({random_star(random, 3 + k % 7)}, {random_star(random, 3 + k % 5)}, {-3, -3}, {3, 3});
    const CollisionSurface surface(problem.bodies);
    const Vec3 center(place(random), place(random), turn(random)), reach = Vec3::Constant(0.1);
    const auto cell = surface.restricted(Box3(center - reach, center + reach));
    std::vector<SmoothSurfacePtr> all = cell->parts();
    all.push_back(cell);
    for (const SmoothSurfacePtr& f : all) {
      if (!f->simple()) continue;
      const Vec3 at = center + 0.05 * Vec3(share(random), share(random), share(random)), half = Vec3::Constant(0.05);
      const Vec3 p = at + 0.05 * Vec3(share(random), share(random), share(random)), q = at + 0.05 * Vec3(share(random), share(random), share(random));
      const Rounding rounding;
      const Expansion box = f->expand(at, half), of_p = f->expand(p, Vec3::Zero()), of_q = f->expand(q, Vec3::Zero());
      kinked += box.slopes.size() > 1;
      const Interval range = box.range(), rise = box.along(q - p) + Interval(-1e-12, 1e-12);
      EXPECT_LE(range.lower(), of_p.value.upper());
      EXPECT_GE(range.upper(), of_p.value.lower());
      EXPECT_LE(rise.lower(), (of_q.value - of_p.value).upper());
      EXPECT_GE(rise.upper(), (of_q.value - of_p.value).lower());
      EXPECT_NEAR(f->value(p, nullptr), middle(of_p.value), 1e-9);
    }
  }
  EXPECT_GT(kinked, 50);
}

// Poincare's formula: positions in which two convex polygons meet measure 2 pi (A + B) + L M, areas and perimeters.
TEST(FreeSpace, OfConvexPolygonsHasTheVolumeOfPoincaresFormula) {
  const Ring robot{{-0.4, -0.3}, {0.5, -0.2}, {0.0, 0.5}}, obstacle = rectangle(-0.5, -0.5, 0.5, 0.5);
  const FreeSpace space = free_space(planar_robot({robot}, {obstacle}, {-3, -3}, {3, 3}), at(0.02));
  EXPECT_EQ(space.result.certificate.verdict, Verdict::exact);
  EXPECT_EQ(topology(space.result), (Topology{1, {1}}));
  EXPECT_EQ(space.components, 1u);
  EXPECT_EQ(bad_edges(space.result), 0u);
  const double collides = 2 * M_PI * (area(robot) + area(obstacle)) + perimeter(robot) * perimeter(obstacle);
  EXPECT_NEAR(volume(space.result), 2 * M_PI * 36 - collides, 0.01 * collides);
  EXPECT_EQ(space.facet_kind.size(), space.result.triangles.size());
}

// Where sides become parallel while they touch, four functions meet in a crease at one angle: a direction that sees all of it is not
// that of their mean. (The corner about which the triangle turns makes one of them the same at all angles.)
TEST(FreeSpace, CreasesAtOneAngleAreSettledInFewCells) {
  const FreeSpace space = free_space(planar_robot({Ring{{0, 0}, {1, 0}, {0, 1}}}, {Ring{{-0.4, -0.3}, {0.5, -0.2}, {0.0, 0.5}}}, {0, -0.35}, {0.2, -0.15}), at(0.01), false);
  EXPECT_EQ(space.result.certificate.verdict, Verdict::exact);
  EXPECT_LT(space.result.certificate.statistics.at("max_depth"), 16);   // 24 where single cells stay open
}

// A closed room: what is inside and what is outside, at any angle of the robot in its own frame.
TEST(FreeSpace, OfALockedRoomHasTwoComponents) {
  const std::vector<PlanarPolygon> room{rectangle(-3, 2, 3, 3), rectangle(-3, -3, 3, -2), rectangle(-3, -3, -2, 3), rectangle(2, -3, 3, 3)};
  const FreeSpace space = free_space(planar_robot({placed(ell, 0, 0, 0.4)}, room, {-6, -6}, {6, 6}), at(0.4));
  EXPECT_NE(space.result.certificate.verdict, Verdict::unresolved);
  EXPECT_EQ(topology(space.result), (Topology{2, {0, 1}}));
  EXPECT_EQ(space.components, 2u);
}

// A bar of width 0.5 before a slot of 0.51 and one of 0.49: through, or not.
TEST(FreeSpace, ASlotIsPassedIfItIsWideEnough) {
  const Ring bar = rectangle(-0.8, -0.25, 0.8, 0.25);
  for (const double half : {0.255, 0.245}) {
    const FreeSpace space = free_space(planar_robot({bar}, {rectangle(-0.5, half, 0.5, 9), rectangle(-0.5, -9, 0.5, -half)}, {-3, -2}, {3, 2}), at(0.3));
    EXPECT_EQ(space.result.certificate.verdict, Verdict::exact);
    EXPECT_EQ(space.components, half > 0.25 ? 1u : 2u);
  }
}

TEST(FreeSpace, WithNothingAroundIsTheDomain) {
  const FreeSpace space = free_space(planar_robot({ell}, {}, {-1, -1}, {1, 1}), at(0.1));
  EXPECT_EQ(space.result.triangles.size(), 12u);
  EXPECT_NEAR(volume(space.result), 8 * M_PI, 1e-9);
  EXPECT_EQ(space.components, 1u);
  for (const std::uint8_t kind : space.facet_kind) EXPECT_EQ(kind, 1);
}

// Two posts in the way of the first link, one on either side: two sectors, which the other joints' turns do not join.
TEST(FreeSpace, OfAnArmIsCutByWhatItsFirstLinkCannotPass) {
  const FreeSpace space = free_space(planar_arm({.lengths = {2, 0.3, 0.3}, .self_collision = false}, {rectangle(1, -0.1, 1.5, 0.1), rectangle(-1.5, -0.1, -1, 0.1)}), at(0.4));
  EXPECT_EQ(space.result.certificate.verdict, Verdict::exact);
  EXPECT_EQ(space.components, 2u);
}

// Equal links cross in two quadrangles of the last two angles, corners (pi, pi), (pi, pi / 2), (2 pi / 3, 2 pi / 3), (pi / 2, pi) and their images: a twelfth of all. They have (pi, pi)
// in common: a contact, along a line.
TEST(FreeSpace, OfAFoldingArmLosesATwelfth) {
  const FreeSpace space = free_space(planar_arm({.lengths = {1, 1, 1}}, {}), at(0.1));
  EXPECT_EQ(space.result.certificate.verdict, Verdict::contact);
  EXPECT_EQ(space.result.certificate.contacts.size(), 1u);
  EXPECT_LE(space.result.certificate.error_bound, 0.1);
  EXPECT_EQ(space.components, 1u);
  EXPECT_NEAR(volume(space.result) / (8 * M_PI * M_PI * M_PI), 11.0 / 12, 0.005);   // a move of a quarter of 0.001, scaled
}

// Other lengths, in general position.
TEST(FreeSpace, OfAnArmOfAnyLengthsIsToldInFewCells) {
  for (const std::array<double, 3>& l : std::vector<std::array<double, 3>>{{1, 0.8, 0.7}, {0.7, 1, 0.9}, {1, 0.6, 1.3}}) {
    const FreeSpace space = free_space(planar_arm({.lengths = l}, {}), at(0.1), false);
    EXPECT_EQ(space.result.certificate.verdict, Verdict::contact);
    EXPECT_LT(space.result.certificate.statistics.at("leaves"), 20000);   // without end where a wedge ends at the cut, before three patches were looked at
  }
}

// Limits keep away from what folds; then nothing touches.
TEST(FreeSpace, OfAnArmWithinLimits) {
  const FreeSpace space = free_space(planar_arm({.lengths = {1, 1, 1}, .limits = {std::nullopt, {{-2.5, 2.5}}, {{-2.5, 2.5}}}}, {}), at(0.1));
  EXPECT_EQ(space.result.certificate.verdict, Verdict::exact);
  EXPECT_EQ(space.components, 1u);
  // Of the two quadrangles what is within the limits: with u = pi - 2.5 the square of side pi - u at (pi, pi), turned about, cut by 2 x + y < pi and x + 2 y < pi.
  const double u = M_PI - 2.5, corner = (M_PI - u) / 2;   // x = u meets x + 2 y = pi at y = corner
  const double area = (corner - u) * (M_PI / 3 - u) ;     // of the kite (u, u), (corner, u), (pi / 3, pi / 3), (u, corner)
  EXPECT_NEAR(volume(space.result), 2 * M_PI * (25 - 2 * area), 0.3);
}

// Links with width: the same configurations as of polygons that CGAL says overlap.
TEST(CollisionSurface, OfAnArmIsNegativeWhereThickLinksOverlap) {
  const std::array<double, 3> l{1, 0.8, 0.6};
  Arm arm{.lengths = l};
  for (std::size_t k = 0; k < 3; ++k) arm.shapes[k] = {rectangle(-0.1, -0.1, l[k] + 0.1, 0.1)};
  const Ring post = rectangle(0.9, 0.4, 1.3, 0.9);
  const ConfigurationProblem problem = planar_arm(arm, {post});
  const CollisionSurface surface(problem.bodies);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> turn(0, 6.28);
  std::array<int, 2> seen{};
  for (int k = 0; k < 300; ++k) {
    const Vec3 q(turn(random), turn(random), turn(random));
    std::array<Ring, 3> links;
    double x = 0, y = 0, angle = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      angle += q[static_cast<int>(i)];
      links[i] = placed(arm.shapes[i].front().outer, x, y, angle);
      x += l[i] * std::cos(angle), y += l[i] * std::sin(angle);
    }
    const bool meets = overlap(links[0], post) || overlap(links[1], post) || overlap(links[2], post) || overlap(links[2], links[0]);
    ++seen[meets];
    const Rounding rounding;
    EXPECT_EQ(certain_sign(surface.expand(problem.unit * q, Vec3::Zero()).range()), meets ? -1 : 1) << q.transpose();
  }
  EXPECT_GT(std::min(seen[0], seen[1]), 50);
}

TEST(FreeSpace, OfATranslatingCubeIsABoxLessABox) {
  const auto cube = [](double half) {
    Mesh mesh = box(Vec3::Constant(-half), Vec3::Constant(half));
    return Expression(Polyhedron::make(std::move(mesh.vertices), std::move(mesh.triangles)));
  };
  const FreeSpace space = free_translations(cube(0.5), cube(1), Vec3::Constant(-4), Vec3::Constant(4), at(0.05));
  EXPECT_EQ(space.result.certificate.verdict, Verdict::exact);
  EXPECT_EQ(space.result.triangles.size(), 24u);
  EXPECT_NEAR(volume(space.result), 512 - 27, 1e-9);
  EXPECT_EQ(space.components, 1u);
}

TEST(FreeSpace, NamesBadArguments) {
  EXPECT_THROW(planar_robot({}, {}, {0, 0}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(planar_robot({ell}, {}, {0, 0}, {0, 1}), std::invalid_argument);
  EXPECT_THROW(planar_arm({.lengths = {1, 0, 1}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace starcell
