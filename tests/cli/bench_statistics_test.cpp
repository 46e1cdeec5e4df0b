// SPDX-License-Identifier: Apache-2.0
// What `luxo bench` computes from times and errors, with answers by hand.
#include "bench_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench_page.h"
#include "bench_plot.h"
#include "bench_report.h"

namespace luxo {
namespace {

TEST(BenchStatistics, PercentilesLieBetweenRanks) {
  const std::vector<double> five = {30, 10, 50, 20, 40};
  EXPECT_EQ(percentile(five, 0), 10);
  EXPECT_EQ(percentile(five, 0.5), 30);
  EXPECT_EQ(percentile(five, 1), 50);
  // Rank 0.1 * 4 = 0.4: two fifths of the way from the first to the second; one rounding of 0.1 * 4 * 10.
  EXPECT_NEAR(percentile(five, 0.1), 14, 1e-12);
  EXPECT_NEAR(percentile(five, 0.9), 46, 1e-12);
  EXPECT_EQ(percentile({1, 2, 3, 100}, 0.5), 2.5);
  EXPECT_EQ(percentile({7}, 0.9), 7);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
  const Typical typical = typicalOf(five);
  EXPECT_EQ(typical.median, 30);
  EXPECT_LT(typical.p10, typical.median);
  EXPECT_GT(typical.p90, typical.median);
}

TEST(BenchStatistics, ThePowerOfALawIsFound) {
  std::vector<CostAndError> law;
  for (const double n : {100., 400., 1600., 51200.}) law.push_back({n, 3 / n});
  // Logarithms are good to 1 ulp of about 10, and the costs spread over 6 of them.
  EXPECT_NEAR(powerOf(law).value(), -1, 1e-14);
  for (CostAndError& p : law) p.error = 2 / (p.cost * p.cost);
  EXPECT_NEAR(powerOf(law).value(), -2, 1e-14);
  law.push_back({1000, std::numeric_limits<double>::infinity()});
  law.push_back({1000, 0});
  law.push_back({1000, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_NEAR(powerOf(law).value(), -2, 1e-14) << "what has no logarithm does not count";
}

TEST(BenchStatistics, OneCostHasNoPower) {
  EXPECT_FALSE(powerOf({}));
  EXPECT_FALSE(powerOf(std::vector<CostAndError>{{3, 1}}));
  EXPECT_FALSE(powerOf(std::vector<CostAndError>{{0.1, 1}, {0.1, 2}, {0.1, 3}}));
}

TEST(BenchStatistics, TheCheapestThatIsGoodEnough) {
  const std::vector<CostAndError> points = {{5, 0.4}, {9, 0.01}, {3, 0.6}, {20, 0.009}, {1, std::nan("")}};
  EXPECT_EQ(costOfError(points, 0.5), 5);
  EXPECT_EQ(costOfError(points, 0.01), 9) << "equal is good enough";
  EXPECT_EQ(costOfError(points, 0.0099), 20);
  EXPECT_EQ(costOfError(points, 0.001), std::nullopt);
}

BenchRow rowOf(BenchWay way, std::uint64_t triangles, double ms, double errorPx) {
  BenchRow row{.way = way, .cost = {}, .error = {}};
  row.cost.triangles = triangles;
  row.cost.frameMs = {ms, ms, ms};
  row.error.positionMaxPx = errorPx;
  row.error.positionP999Px = 0.1 * errorPx;
  return row;
}

constexpr double kShellPx = DrawOptions{}.shellTolerancePx;

BenchScene exampleScene() {
  return {
      .name = "a \"<b>\", it's & c",
      .covered = 6,
      .undecided = 0,
      .truthMs = 1,
      .truth = Image(2, 3, 3),
      .rows = {rowOf({Shading::Phong, 0.5, 1}, 100, 4, 0.4), rowOf({Shading::Phong, 0.05, 1}, 1'000, 8, 0.04),
               rowOf({Shading::Exact, kShellPx, 1}, 50, 6, 0.0005),
               rowOf({Shading::Exact, kShellPx, 4}, 50, 1, 0.0005)},
      .pictures = {}};
}

TEST(BenchReport, SummariesAreOfOneSample) {
  const BenchSummary summary = summaryOf(exampleScene());
  ASSERT_EQ(summary.shadings.size(), 2U);
  const BenchShading &mesh = summary.shadings[0], &exact = summary.shadings[1];
  EXPECT_EQ(mesh.msOfError[0], 4);
  EXPECT_EQ(mesh.msOfError[1], std::nullopt);
  EXPECT_EQ(mesh.leastErrorPx, 0.04);
  EXPECT_NEAR(mesh.errorPerTriangles.value(), -1, 1e-14);
  EXPECT_NEAR(mesh.errorPerMs.value(), -std::log(10) / std::log(2), 1e-14);
  EXPECT_EQ(exact.msOfError[2], 6) << "the row of 4 samples is faster and does not count";
  EXPECT_EQ(exact.errorPerTriangles, std::nullopt);
  ASSERT_TRUE(summary.usual);
  EXPECT_EQ(summary.usual->exact.cost.triangles, 50U);
  EXPECT_EQ(summary.usual->mesh.cost.triangles, 100U);
  EXPECT_EQ(summary.usual->timeRatio(), 1.5);
}

TEST(BenchReport, OnePixelDoesNotTurnASlope) {
  BenchScene scene = exampleScene();
  scene.rows[1].error.positionMaxPx = 7;
  const BenchSummary summary = summaryOf(scene);
  EXPECT_NEAR(summary.shadings[0].errorPerTriangles.value(), -1, 1e-14);
  EXPECT_EQ(summary.shadings[0].leastErrorPx, 0.4);
}

TEST(BenchReport, TablesSayWhatIsKnown) {
  BenchResult result{.machine = {{"cores", "2"}}, .size = {2, 3}, .runs = 1, .scenes = {exampleScene()}};
  BenchScene& scene = result.scenes[0];
  scene.name = "a|b";
  scene.rows[0].cost.triangles = 1234567;
  scene.rows[0].error.differing8Part = std::nan("");
  const std::string markdown = benchMarkdown(result);
  EXPECT_NE(markdown.find("| a\\|b | 1,234,567 | 4.0 | 0.4 | - | 50 | 6.0 | 0.0005 | 0 | 1.50 | - |\n"),
            std::string::npos)
      << markdown;
  EXPECT_NE(markdown.find("| a\\|b | exact | 6.0 | 6.0 | 6.0 | 0.0005 | - | - |\n"), std::string::npos)
      << markdown;
  EXPECT_NE(markdown.find("2 x 3, cores 2."), std::string::npos) << markdown;
  // Every row of a table has as many cells as its head.
  for (const TextTable& table : {usualTable(result), timeToErrorTable(result)}) {
    EXPECT_FALSE(table.rows.empty());
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.head.size());
  }
  scene.rows.erase(scene.rows.begin() + 2);
  EXPECT_TRUE(usualTable(result).rows.empty()) << "without the exact picture there is nothing to compare";
}

TEST(BenchReport, ASilhouetteIsAnError) {
  BenchError error;
  error.positionMaxPx = 0.1;
  error.silhouettePx = 0.3;
  EXPECT_EQ(error.largestPx(), 0.3);
  error.positionMaxPx = std::nan("");
  EXPECT_EQ(error.largestPx(), 0.3);
}

TEST(BenchReport, CsvQuotesNamesAndLeavesOutWhatIsNotFinite) {
  BenchResult result{.machine = {}, .size = {2, 3}, .runs = 1, .scenes = {exampleScene()}};
  result.scenes[0].rows.resize(1);
  result.scenes[0].rows[0].error.boundPx = std::numeric_limits<double>::infinity();
  const std::string csv = benchCsv(result);
  EXPECT_NE(csv.find("\"a \"\"<b>\"\", it's & c\",phong,0.5,1,0,0,100,4,4,4,"), std::string::npos) << csv;
  EXPECT_EQ(csv.find("inf"), std::string::npos);
  EXPECT_EQ(benchJson(result).find("inf"), std::string::npos);
}

// The vectors of RFC 4648, section 10.
TEST(BenchPage, Base64) {
  const auto of = [](std::string_view text) { return base64Of(std::as_bytes(std::span(text))); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

TEST(BenchPage, NamesCannotBreakTheMarkup) {
  const BenchResult result{
      .machine = {{"processor", "<&>"}}, .size = {2, 3}, .runs = 1, .scenes = {exampleScene()}};
  const std::string page = benchPage(result, {});
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_NE(page.find("<h2>a &quot;&lt;b&gt;&quot;, it's &amp; c</h2>"), std::string::npos);
  EXPECT_NE(page.find("<td>&lt;&amp;&gt;</td>"), std::string::npos);
}

TEST(BenchPlot, AnyNameAndNoErrorCanBePlotted) {
  BenchScene scene = exampleScene();
  scene.rows[0].error.positionMaxPx = std::nan("");  // the errors that are 0 stay
  const auto svg = runGnuplot(paretoScript(std::span(&scene, 1), scene.name));
  if (!svg) GTEST_SKIP() << "there is no gnuplot";
  EXPECT_NE(svg->find("<svg"), std::string::npos);
  EXPECT_NE(svg->find("it's &amp; c"), std::string::npos);
  EXPECT_NE(svg->find("</svg>"), std::string::npos);
  const BenchScene nothing{.name = "empty", .truth = {}, .rows = {}, .pictures = {}};
  EXPECT_TRUE(runGnuplot(paretoScript(std::span(&nothing, 1), "")));
  EXPECT_THROW(static_cast<void>(runGnuplot("no such command\n")), std::exception);
}

}  // namespace
}  // namespace luxo
