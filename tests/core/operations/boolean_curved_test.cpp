// Booleans of curved solids: volumes from closed forms, topology known by construction, at random rotations.
#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

constexpr double pi = 3.14159265358979323846;

Eigen::Matrix4d placed(const Eigen::Matrix3d& rotation) {
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = rotation;
  map.topRightCorner<3, 1>() = Vec3(0.3, -1.7, 2.1);
  return map;
}

Expression ball(const Vec3& center, double radius) { return Expression(CurvedSolid::sphere(center, radius)); }
Expression rod(const Vec3& base, const Vec3& axis, double radius, double height) { return Expression(CurvedSolid::cylinder(base, axis, radius, height)); }
Expression ring(double major, double minor) { return Expression(CurvedSolid::torus({0, 0, 0}, {0, 0, 1}, major, minor)); }
Expression cone(double radius1, double radius2, double height) { return Expression(CurvedSolid::cone({0, 0, 0}, {0, 0, 1}, radius1, radius2, height)); }

double area(const Result& r) {
  double sum = 0;
  for (const Triangle& t : r.triangles)
    sum += 0.5 * (r.vertices[t[1]] - r.vertices[t[0]]).cross(r.vertices[t[2]] - r.vertices[t[0]]).norm();
  return sum;
}

struct Case {
  const char* name;
  Expression expression;
  double volume;
  std::vector<int> genus;
};

std::vector<Case> cases() {
  // A lens of two unit spheres 1.2 apart: two caps of height 0.4. Steinmetz (Archimedes): 16/3, and 8 (2 - sqrt 2) for three.
  const double lens = 2 * pi * 0.16 * (3 - 0.4) / 3;
  const Expression x = rod({-2, 0, 0}, {1, 0, 0}, 1, 4), y = rod({0, -2, 0}, {0, 1, 0}, 1, 4), z = rod({0, 0, -2}, {0, 0, 1}, 1, 4);
  const Expression a = ball({0, 0, 0}, 1), b = ball({1.2, 0, 0}, 1);
  // A cone of radius 1 and height 2 has its tip in the centre of a unit ball: the solid angle 2 pi (1 - 2 / sqrt 5) of it.
  const Expression tip_in_ball = Expression::intersection({cone(1, 0, 2), ball({0, 0, 2}, 1)});
  return {{"sphere", a, 4 * pi / 3, {0}},
          {"frustum", cone(1, 0.4, 2), pi * 2 / 3 * (1 + 0.4 + 0.16), {0}},
          {"sharp cone", cone(1, 0, 2), pi * 2 / 3, {0}},
          {"torus", ring(2, 0.6), 2 * pi * pi * 2 * 0.36, {1}},
          {"lens", Expression::intersection({a, b}), lens, {0}},
          {"two spheres", Expression::set_union({a, b}), 8 * pi / 3 - lens, {0}},
          {"two pipes' core", Expression::intersection({x, y}), 16.0 / 3, {0}},
          {"three pipes' core", Expression::intersection({x, y, z}), 8 * (2 - std::sqrt(2.0)), {0}},
          {"napkin ring", Expression::difference(ball({0, 0, 0}, 2), rod({0, 0, -3}, {0, 0, 1}, 1, 6)), 4 * pi * std::pow(3, 1.5) / 3, {1}},
          {"half torus", Expression::intersection({ring(2, 0.6), Expression(HalfSpace::make({0, 0, 0}, {1, 0, 0}))}), pi * pi * 2 * 0.36, {0}},
          {"tip in a ball", tip_in_ball, 2 * pi * (1 - 2 / std::sqrt(5.0)) / 3, {0}},
          {"hollow ball", Expression::difference(ball({0, 0, 0}, 2), ball({0.3, 0.2, 0.1}, 1)), 28 * pi / 3, {0, 0}}};
}

TEST(BooleanOfCurved, VolumeAndTopologyInEveryRotation) {
  std::mt19937 random(1);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix4d map = placed(i == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random_rotation(random));
    for (const Case& c : cases()) {
      const Result r = evaluate(c.expression.transformed(map), with_error(0.05));
      expect_sound(r, c.name);
      EXPECT_NE(r.certificate.verdict, Verdict::unresolved) << c.name;
      EXPECT_EQ(r.certificate.genus, c.genus) << c.name << " rotation " << i;
      EXPECT_LE(r.certificate.error_bound, 0.05) << c.name;
      EXPECT_NEAR(volume(r), c.volume, 1.2 * r.certificate.error_bound * area(r)) << c.name << " rotation " << i;
    }
  }
}

// Nonuniform scaling: an ellipsoid is a stretched ball, and its volume the ball's times the stretches.
TEST(BooleanOfCurved, MapsAreNoTessellations) {
  Eigen::Matrix4d stretch = Eigen::Matrix4d::Identity();
  stretch.diagonal() << 2, 0.5, -1.5, 1;
  for (const Case& c : cases()) {
    const Result r = evaluate(c.expression.transformed(stretch), with_error(0.05));
    EXPECT_NE(r.certificate.verdict, Verdict::unresolved) << c.name;
    EXPECT_EQ(r.certificate.genus, c.genus) << c.name;
    EXPECT_TRUE(r.certificate.tessellated.empty());
    EXPECT_NEAR(volume(r), 1.5 * c.volume, 1.2 * r.certificate.error_bound * area(r)) << c.name;
  }
}

// On either side of where two spheres touch, and of where a bore just swallows its ball.
TEST(BooleanOfCurved, NearTangenciesAreToldApart) {
  Options options = with_error(0.05);
  options.contact = 1e-9;
  for (const double gap : {1e-4, 1e-6})
    for (const bool apart : {true, false}) {
      const Result r = evaluate(Expression::set_union({ball({0, 0, 0}, 1), ball({2 + (apart ? gap : -gap), 0, 0}, 1)}), options);
      EXPECT_EQ(r.certificate.verdict, Verdict::exact) << gap;
      EXPECT_EQ(r.certificate.genus, apart ? std::vector<int>({0, 0}) : std::vector<int>({0})) << gap;
    }
  for (const double radius : {0.9999, 1.0001}) {
    const Result r = evaluate(Expression::difference(ball({0, 0, 0}, 1), rod({0, 0, -3}, {0, 0, 1}, radius, 6)), options);
    EXPECT_EQ(r.certificate.verdict, Verdict::exact) << radius;
    EXPECT_EQ(r.certificate.genus, radius < 1 ? std::vector<int>({1}) : std::vector<int>()) << radius;
  }
}

// Two half-deep pits of different radius in a plate, their floors 2e-4 apart: sheets that share cells, not area / gap^2 cells.
TEST(BooleanOfCurved, AThinFloorBetweenPitsCostsFewLeaves) {
  const Expression plate = solid(box({-2, -2, 0}, {2, 2, 1}));
  for (const double depth : {0.4999, 0.5001}) {
    const Expression pits = Expression::set_union({rod({0, 0, -1}, {0, 0, 1}, 0.7, 1 + depth), rod({0, 0, 1 - depth}, {0, 0, 1}, 0.5, 1 + depth)});
    const Result r = evaluate(Expression::difference(plate, pits), with_error(0.05));
    EXPECT_EQ(r.certificate.genus, std::vector<int>({depth > 0.5 ? 1 : 0})) << depth;
    EXPECT_LT(r.certificate.statistics.at("leaves"), 2000) << depth;
  }
}

// Surfaces that coincide are one: the volume is that of what is left when they are gone.
TEST(BooleanOfCurved, CoincidentSurfacesVanish) {
  std::mt19937 random(4);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix4d map = placed(random_rotation(random));
    const Expression tube = Expression::difference(rod({0, 0, 0}, {0, 0, 1}, 2, 3), rod({0, 0, -1}, {0, 0, 1}, 1, 5));
    const Expression socket = Expression::difference(ball({0, 0, 0}, 2), ball({0, 0, 0}, 1));
    const std::vector<Case> contacts{
        {"shaft in bore", Expression::set_union({tube, rod({0, 0, -1}, {0, 0, 1}, 1, 5)}), 14 * pi, {0}},
        {"flush cylinders", Expression::set_union({rod({0, 0, 0}, {0, 0, 1}, 1, 2), rod({0, 0, 2}, {0, 0, 1}, 1, 1)}), 3 * pi, {0}},
        {"shaft out of itself", Expression::difference(rod({0, 0, 0}, {0, 0, 1}, 1, 2), rod({0, 0, 0}, {0, 0, 1}, 1, 2)), 0, {}},
        {"ball in socket", Expression::set_union({socket, ball({0, 0, 0}, 1)}), 32 * pi / 3, {0}},
        {"rod standing on a block", Expression::set_union({rod({0, 0, 0}, {0, 0, 1}, 1, 2), solid(box({-2, -2, -1}, {2, 2, 0}))}), 16 + 2 * pi, {0}}};
    for (const Case& c : contacts) {
      const Result r = evaluate(c.expression.transformed(map), with_error(0.05));
      EXPECT_NE(r.certificate.verdict, Verdict::unresolved) << c.name;
      EXPECT_EQ(r.certificate.genus, c.genus) << c.name;
      EXPECT_NEAR(volume(r), c.volume, 1.2 * r.certificate.error_bound * area(r) + 1e-9) << c.name;
    }
  }
}

TEST(BooleanOfCurved, TangenciesEndAsContacts) {
  std::mt19937 random(5);
  const Expression block = solid(box({-2, -2, -1}, {2, 2, 0}));
  const std::vector<Expression> touching{Expression::set_union({ball({0, 0, 0}, 1), ball({2, 0, 0}, 1)}), Expression::set_union({ball({0.1, 0.2, 1}, 1), block}),
                                         Expression::set_union({rod({0, -1, 1}, {0, 1, 0}, 1, 2), block})};
  for (std::size_t k = 0; k < touching.size(); ++k) {
    const Result r = evaluate(touching[k].transformed(placed(random_rotation(random))), with_error(0.1));
    expect_sound(r, "tangency");
    EXPECT_EQ(r.certificate.verdict, Verdict::contact) << k;
    EXPECT_FALSE(r.certificate.contacts.empty()) << k;
  }
}

// A cylinder's rim that comes down on another one's end plane at a shallow angle: where they meet, three curves on the faces beside
// the corner nearly pass through one point.
TEST(BooleanOfCurved, ARimAtAShallowAngleIsResolved) {
  for (const double off : {1e-3, 1e-4, -1e-3}) {
    const Expression tilted = rod({2 + 0.3 * off, 0.7 * off, 0.2 * off}, {0, -1, 1}, 3, 5), upright = rod({0, 2, 0}, {0, 0, -1}, 2, 5);
    const Result r = evaluate(tilted | upright, with_error(0.0625));
    expect_sound(r, "rim");
    EXPECT_EQ(r.certificate.verdict, Verdict::exact) << off;
    EXPECT_EQ(r.certificate.components, off > 0 ? 1 : 2) << off;
  }
}

// Round numbers: lines of the grid lie in the cone's surface, along its rulings. Another grid has to be found.
TEST(BooleanOfCurved, RulingsAlongGridLinesAreNoContact) {
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = Eigen::AngleAxisd(pi / 4, Vec3::UnitX()).toRotationMatrix();
  map.topRightCorner<3, 1>() = Vec3(-2, 2, -3);
  const Expression e = cone(0, 2, 5).transformed(map) | rod({-2, 0, 1}, {-1, 0, 0}, 3, 4);
  const Result r = evaluate(e, with_error(0.0547));
  expect_sound(r, "cone");
  EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  EXPECT_EQ(r.certificate.genus, std::vector<int>({0}));
}

// Sheets that run closely beside each other make one cell after the other fail once it is drawn.
TEST(BooleanOfCurved, ATangentConeInATorusEndsAsAContact) {
  const Expression tube(CurvedSolid::torus({0, -2, 0}, {0, 0, 1}, 4, 2)), stub(CurvedSolid::cone({1, -3, -1}, {1, 0, 0}, 3, 4, 1));
  const Result r = evaluate(tube | stub, with_error(0.09));
  expect_sound(r, "torus and cone");
  EXPECT_EQ(r.certificate.verdict, Verdict::contact);
  EXPECT_EQ(r.certificate.genus, std::vector<int>({1}));
}

// A comb of three plates, pierced by ellipsoids: a long one goes through all three, others through the upper two.
TEST(BooleanOfCurved, GenusIsThatOfTheHoles) {
  std::vector<Expression> plates{solid(box({-1, 0, 0}, {0, 8, 5}))};
  for (const double z : {0.0, 2.0, 4.0}) plates.push_back(solid(box({-0.5, 0, z}, {8, 8, z + 1})));
  std::vector<Expression> holes;
  int genus = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const bool all = (i + j) % 3 == 0;
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3 * i + 0.7 * j, Vec3::UnitZ()).toRotationMatrix();
      holes.emplace_back(CurvedSolid::ellipsoid({2.0 * i + 1, 2.0 * j + 1.05, all ? 2.5 : 3.5}, {0.5 + 0.06 * i, 0.7, all ? 3.5 : 2.0}, turn));
      genus += all ? 3 : 2;
    }
  for (const double error : {0.6, 0.2, 0.05}) {
    const Result r = evaluate(Expression::difference(Expression::set_union(plates), Expression::set_union(holes)), with_error(error));
    EXPECT_EQ(r.certificate.genus, std::vector<int>({genus})) << error;
    EXPECT_NE(r.certificate.verdict, Verdict::unresolved) << error;
  }
}

TEST(BooleanOfCurved, OutputIsTheSameForAnyNumberOfThreads) {
  Options one = with_error(0.05), two = with_error(0.05);
  one.threads = 1;
  two.threads = 2;
  const Expression e = Expression::difference(ring(2, 0.6), cone(2.4, 0.3, 1));
  const Result a = evaluate(e, one), b = evaluate(e, two);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.vertices, b.vertices);
}

TEST(BooleanOfCurved, OpenQuadricsNeedABound) {
  Eigen::Matrix4d saddle = Eigen::Matrix4d::Zero();   // x^2 + y^2 - z^2 < 1/4: a hyperboloid of one sheet
  saddle.diagonal() << 1, 1, -1, -0.25;
  const Expression open(CurvedSolid::quadric(saddle));
  EXPECT_THROW(evaluate(open, with_error(0.05)), UnboundedError);
  // Within |z| < 1: pi times the integral of 1/4 + z^2.
  const Result r = evaluate(Expression::intersection({open, solid(box({-2, -2, -1}, {2, 2, 1}))}), with_error(0.03));
  EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  EXPECT_NEAR(volume(r), pi * (0.5 + 2.0 / 3), 1.2 * r.certificate.error_bound * area(r));
}

}  // namespace
}  // namespace starcell
