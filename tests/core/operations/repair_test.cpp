// Repair: closed forms of overlapping, doubled, turned, holed and crossing boxes; unions of concatenated meshes; refusals.
#include "operations/repair.h"

#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

Repaired mended(const Mesh& m, double error) { return repair(m.vertices, m.triangles, with_error(error)); }

std::map<std::string, int> flaws_of(const Repaired& r) {
  std::map<std::string, int> count;
  for (const auto& [what, where] : r.findings) {
    ++count[what];
    EXPECT_FALSE(where.isEmpty()) << what;
  }
  return count;
}

void expect_solid(const Repaired& r, double volume_is, const Topology& is, double delta = 1e-9) {
  EXPECT_NE(r.result.certificate.verdict, Verdict::unresolved);
  EXPECT_EQ(topology(r.result), is);
  EXPECT_EQ(bad_edges(r.result), 0u);
  EXPECT_NEAR(volume(r.result.vertices, r.result.triangles), volume_is, delta);
}

const Mesh unit = box({0, 0, 0}, {1, 1, 1});
using Flaws = std::map<std::string, int>;

TEST(Repair, LeavesWhatIsSound) {
  const Repaired r = mended(joined({unit, flipped(box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}))}), 0.05);
  expect_solid(r, 1 - 0.125, {2, {0, 0}});
  EXPECT_TRUE(r.findings.empty());
  EXPECT_TRUE(r.solids.has_value());
}

TEST(Repair, UnitesWhatOverlaps) {
  expect_solid(mended(joined({unit, box({0.5, 0.25, 0.125}, {2, 0.75, 0.875})}), 0.05), 1 + 1 * 0.5 * 0.75, {1, {0}});
  // A box in a box, both outward: one solid. Turned in, but not in anything: turned out.
  expect_solid(mended(joined({unit, box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})}), 0.05), 1, {1, {0}});
  const Repaired turned_in = mended(joined({unit, flipped(box({3, 0, 0}, {4, 1, 1}))}), 0.05);
  expect_solid(turned_in, 2, {2, {0, 0}});
  EXPECT_EQ(flaws_of(turned_in), (Flaws{{"piece inside out", 1}}));
}

// All of it in one piece, so that no union of sound pieces can stand for it.
TEST(Repair, CountsDoubledSheetsOnce) {
  const Repaired r = mended(joined({unit, unit}), 0.05);
  expect_solid(r, 1, {1, {0}});
  EXPECT_GE(flaws_of(r)["crossing"], 12);   // every triangle and its double
}

// Boxes that share an edge, the second one cut by a third so that no piece is sound: two solids, pulled apart, whatever the error.
TEST(Repair, PullsApartWhatTouchesInAnEdge) {
  const Mesh touching = joined({unit, box({1, 1, 0}, {2, 2, 1}), box({1, 1, 0}, {2, 2, 1})});
  for (const double error : {0.1, std::numeric_limits<double>::infinity()}) {
    const Repaired r = mended(touching, error);
    EXPECT_EQ(r.result.certificate.verdict, Verdict::contact);
    EXPECT_FALSE(r.result.certificate.contacts.empty());
    EXPECT_LE(r.result.certificate.error_bound, 1e-3);
    expect_solid(r, 2, {2, {0, 0}}, 1e-2);
  }
}

TEST(Repair, TurnsTriangles) {
  Mesh m = unit;
  std::swap(m.triangles[3][1], m.triangles[3][2]);
  std::swap(m.triangles[8][1], m.triangles[8][2]);
  const Repaired r = mended(m, 0.05);
  expect_solid(r, 1, {1, {0}});
  EXPECT_EQ(flaws_of(r), (Flaws{{"turned triangle", 2}}));
}

TEST(Repair, FillsSmallHolesAndRefusesWideOnes) {
  Mesh m = torus(40, 20);
  m.triangles.erase(m.triangles.begin() + 700);
  m.triangles.erase(m.triangles.begin() + 100, m.triangles.begin() + 103);
  const Repaired r = mended(m, 0.1);
  EXPECT_EQ(topology(r.result), (Topology{1, {1}}));
  EXPECT_EQ(flaws_of(r), (Flaws{{"hole", 2}}));
  try {
    mended(m, 0.01);
    FAIL() << "holes wider than 0.1 were filled";
  } catch (const InvalidSolidError& e) {
    EXPECT_NE(std::string(e.what()).find("2 holes are wider than 0.1"), std::string::npos) << e.what();
  }
}

// A band with a full twist in its outline: one loop winds once, the other backwards and is no inside.
TEST(Repair, KeepsWhatIsWoundAboutForward) {
  const Mesh bow{{{0, 0, 0}, {2, 1, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 1, 1}, {2, 0, 1}, {0, 1, 1}},
                 {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}}};
  std::mt19937 random(3);
  const Repaired r = mended(turned(bow, random_rotation(random)), 0.05);
  expect_solid(r, 0.5, {1, {0}});
  EXPECT_GT(flaws_of(r)["crossing"], 0);
}

// Jitter that makes a torus cross itself: the candidates' way against the same mesh before, within the jitter.
TEST(Repair, OfAMeshThatCrossesItself) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> by(-0.15, 0.15);
  Mesh m = torus(40, 20, 2, 0.7);
  for (Vec3& p : m.vertices) p += Vec3(by(random), by(random), by(random));
  const Repaired r = mended(m, 0.05);
  EXPECT_GT(flaws_of(r)["crossing"], 5);
  EXPECT_NE(r.result.certificate.verdict, Verdict::unresolved);
  EXPECT_EQ(bad_edges(r.result), 0u);
  EXPECT_NEAR(volume(r.result.vertices, r.result.triangles), volume(m.vertices, m.triangles), 0.15 * area(r.result));
}

// Concatenated solids are their union, as the Boolean has it, also where one of them crosses itself and all goes the candidates' way.
TEST(Repair, OfConcatenatedSolidsIsTheirUnion) {
  std::mt19937 random(4);
  for (int k = 0; k < 6; ++k) {
    const Mesh a = turned(torus(14, 8), random_rotation(random)), b = turned(pebble(random, 1), random_rotation(random), {2.2, 0.4, 0.1});
    const Result want = evaluate(solid(a) | solid(b), with_error(0.02));
    Repaired r = mended(joined({a, b}), 0.02);
    EXPECT_EQ(topology(r.result), topology(want));
    EXPECT_TRUE(r.solids.has_value());
    r = mended(joined({a, b, b}), 0.02);   // doubled: no sound piece of its own
    EXPECT_EQ(topology(r.result), topology(want));
    EXPECT_NEAR(volume(r.result.vertices, r.result.triangles), volume(want.vertices, want.triangles), 0.02 * area(want));
  }
}

TEST(Repair, RefusesWhatHasNoInside) {
  EXPECT_THROW(mended({}, 0.1), InvalidSolidError);
  EXPECT_THROW(mended({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 0.01), InvalidSolidError);
  EXPECT_THROW(mended({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}, 0.01), InvalidSolidError);   // folded onto itself
  EXPECT_THROW(mended({{{0, 0, 0}, {1, 0, 0}, {0, std::nan(""), 0}}, {{0, 1, 2}}}, 0.01), InvalidSolidError);
  EXPECT_THROW(mended({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}, 0.01), std::invalid_argument);
}

// Any triangles at all: a closed result or a refusal with a reason.
TEST(Repair, OfNoiseEndsWell) {
  std::mt19937 random(12);
  for (int k = 0; k < 40; ++k) {
    Mesh m = pebble(random, 1);
    for (int cut = 0; cut < k % 5; ++cut) m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(random() % m.triangles.size()));
    for (int extra = 0; extra < k % 3; ++extra) m.triangles.push_back({static_cast<std::uint32_t>(random() % m.vertices.size()), static_cast<std::uint32_t>(random() % m.vertices.size()), static_cast<std::uint32_t>(random() % m.vertices.size())});
    for (int turned = 0; turned < k % 4; ++turned) std::swap(m.triangles[random() % m.triangles.size()][0], m.triangles[0][1]);
    try {
      const Repaired r = mended(m, 0.05);
      EXPECT_EQ(bad_edges(r.result), 0u) << k;
    } catch (const InvalidSolidError& e) {
      EXPECT_GT(std::string(e.what()).size(), 20u);
    }
  }
}

}  // namespace
}  // namespace starcell
