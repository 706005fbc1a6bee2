// Results in few triangles: the same solid as contoured, both within the error; what is exact stays as it is.
#include "operations/evaluate_in_few.h"

#include "operations/results.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using namespace sample;

TEST(EvaluateInFew, OfACurvedBooleanIsTheSameSolid) {
  const Expression less = Expression(CurvedSolid::sphere(Vec3::Zero(), 1)) - solid(box({-0.4, -0.4, -2}, {0.4, 0.4, 2}));
  const Result plain = evaluate(less, with_error(0.02)), few = evaluate_in_few(less, with_error(0.02));
  expect_result(few, topology(plain), volume(plain), 0.02, "ball less bar");
  EXPECT_EQ(few.certificate.verdict, plain.certificate.verdict);
  EXPECT_LT(3 * few.triangles.size(), 2 * plain.triangles.size());
  EXPECT_GT(few.certificate.statistics.at("triangles.contoured"), static_cast<double>(few.triangles.size()));
  EXPECT_EQ(few.certificate.requested_error, 0.02);
  EXPECT_EQ(few.certificate.contact_tolerance, plain.certificate.contact_tolerance);
}

TEST(EvaluateInFew, LeavesWhatIsExact) {
  const Expression both = solid(box({0, 0, 0}, {2, 2, 2})) | solid(box({1, 1, 1}, {3, 3, 3}));
  EXPECT_TRUE(identical(evaluate(both, with_error(0.1)), evaluate_in_few(both, with_error(0.1))));
}

TEST(EvaluateInFew, TakesTheErrorsThatEvaluateTakes) {
  const Expression ball(CurvedSolid::sphere(Vec3::Zero(), 1));
  EXPECT_TRUE(identical(evaluate(ball, with_error(std::numeric_limits<double>::infinity())), evaluate_in_few(ball, with_error(std::numeric_limits<double>::infinity()))));
  EXPECT_TRUE(evaluate_in_few(ball & Expression(CurvedSolid::sphere({5, 0, 0}, 1)), {}).triangles.empty());
  EXPECT_THROW(evaluate_in_few(ball, with_error(-1)), std::invalid_argument);
  Options cancelled = with_error(0.01);
  cancelled.progress = [](double, const std::string& stage) { return stage != "decimating"; };
  EXPECT_THROW(evaluate_in_few(ball, cancelled), CancelledError);
  double last = 0;
  Options watched = with_error(0.02);
  watched.progress = [&](double done, const std::string&) { EXPECT_GE(done, last); last = done; return true; };
  evaluate_in_few(ball, watched);
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace starcell
