// How runs end: the same bytes for any number of threads, cancelled at once, honest when a budget ends them.
#include <cfenv>
#include <chrono>

#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

Expression two_stones(int level) {
  std::mt19937 random(17);
  const Mesh a = pebble(random, level), b = turned(pebble(random, level), random_rotation(random), Vec3(0.4, 0.3, 0.2));
  return solid(a) - solid(b);
}

TEST(Runs, AnyNumberOfThreadsGivesTheSameBytes) {
  const Expression e = two_stones(3);
  Options options = with_error(0.03);
  options.threads = 1;
  const Result one = evaluate(e, options);
  EXPECT_FALSE(one.triangles.empty());
  for (const int threads : {2, 4}) {
    options.threads = threads;
    EXPECT_TRUE(identical(evaluate(e, options), one)) << threads;
  }
}

TEST(Runs, TheSameRunTwiceGivesTheSameBytes) {
  const Expression e = two_stones(3);
  EXPECT_TRUE(identical(evaluate(e, with_error(0.05)), evaluate(e, with_error(0.05))));
}

// Interval arithmetic changes the mode; whoever called the engine computes on in round-to-nearest.
TEST(Runs, TheRoundingModeIsAsBefore) {
  ASSERT_EQ(std::fegetround(), FE_TONEAREST);
  Options options = with_error(0.1);
  options.progress = [](double, const std::string&) {
    EXPECT_EQ(std::fegetround(), FE_TONEAREST) << "a callback is the caller's code too";
    return true;
  };
  for (const int threads : {0, 1, 2}) {
    options.threads = threads;
    evaluate(two_stones(2), options);
    EXPECT_EQ(std::fegetround(), FE_TONEAREST) << threads << " threads";
  }
  std::fesetround(FE_TONEAREST);  // so that a failure here does not make other tests fail
}

TEST(Runs, NegativeThreadsAreRefused) {
  Options options;
  options.threads = -1;
  EXPECT_THROW(evaluate(two_stones(1), options), std::invalid_argument);
}

// A run of seconds must be gone within one after the callback has said no.
TEST(Runs, CancellingStopsWithinASecond) {
  const Expression e = two_stones(6);  // 2 x 32,768 facets
  Options options = with_error(2e-4);
  std::chrono::steady_clock::time_point said_no{};
  options.progress = [&](double, const std::string&) {
    said_no = std::chrono::steady_clock::now();
    return false;
  };
  EXPECT_THROW(evaluate(e, options), CancelledError);
  const std::chrono::duration<double> after = std::chrono::steady_clock::now() - said_no;
  EXPECT_LT(after.count(), 1.0);
}

TEST(Runs, CancellingLateStopsToo) {
  const Expression e = two_stones(3);
  Options options = with_error(0.03);
  options.progress = [](double fraction, const std::string&) { return fraction < 0.85; };
  EXPECT_THROW(evaluate(e, options), CancelledError);
}

TEST(Runs, ProgressRisesFromZeroToOne) {
  Options options = with_error(0.05);
  double last = 0;
  options.progress = [&](double fraction, const std::string& stage) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    EXPECT_FALSE(stage.empty());
    last = fraction;
    return true;
  };
  evaluate(two_stones(3), options);
  EXPECT_EQ(last, 1.0);
}

// Whatever ends the run, the mesh is closed, manifold and embedded, and what is open is listed.
void expect_honest_end(const Options& options, const char* what) {
  const Result r = evaluate(two_stones(4), options);
  EXPECT_EQ(r.certificate.verdict, Verdict::unresolved) << what;
  EXPECT_FALSE(r.certificate.unresolved.empty()) << what;
  expect_sound(r, what);
}

TEST(Runs, TooFewCellsEndUnresolved) {
  for (const std::size_t cells : {1, 20, 200, 1000}) {
    Options options = with_error(0.005);
    options.budget.max_cells = cells;
    expect_honest_end(options, ("cells " + std::to_string(cells)).c_str());
  }
}

TEST(Runs, TooLittleDepthEndsUnresolved) {
  for (const int depth : {1, 3, 4}) {
    Options options = with_error(0.005);
    options.budget.max_depth = depth;
    expect_honest_end(options, ("depth " + std::to_string(depth)).c_str());
  }
}

TEST(Runs, TooLittleTimeEndsUnresolved) {
  Options options = with_error(0.001);
  options.budget.max_seconds = 1e-3;
  expect_honest_end(options, "a millisecond");
}

TEST(Runs, TooLittleMemoryEndsUnresolved) {
  Options options = with_error(0.005);
  options.budget.max_bytes = 100'000;
  expect_honest_end(options, "100 kB");
}

// A budget that is not needed changes nothing.
TEST(Runs, AnAmpleBudgetGivesTheSameBytes) {
  Options options = with_error(0.05);
  const Result free = evaluate(two_stones(3), options);
  options.budget.max_cells = 10'000'000;
  options.budget.max_seconds = 1000;
  options.budget.max_bytes = std::size_t{1} << 33;
  EXPECT_TRUE(identical(evaluate(two_stones(3), options), free));
}

// The thesis's criterion on smooth solids in general position: it ends there, with the same topology.
TEST(Runs, TheThesisCriterionAgreesWhereItEnds) {
  std::mt19937 random(23);
  const Expression e = solid(pebble(random, 2, 0.1));
  Options options = with_error(0.1);
  const Result trace = evaluate(e, options);
  options.criterion = Criterion::complex_cell;
  options.budget.max_depth = 10;
  const Result thesis = evaluate(e, options);
  expect_sound(thesis);
  EXPECT_EQ(topology(thesis), topology(trace));
}

}  // namespace
}  // namespace starcell
