// SPDX-License-Identifier: Apache-2.0
// `luxo bench`: the files it leaves, and what it refuses.
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

#include "bench_report.h"
#include "cli/program.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class BenchTest : public testing::Test {
 protected:
  ScratchFolder folder;
};

class BenchFilesTest : public BenchTest {
 protected:
  void SetUp() override { requireDevice(); }
};

Words split(const std::string& text, char separator) {
  Words words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

/// The names of the elements that are open where `markup` ends, or where a wrong one ends first.
Words unclosedIn(const std::string& markup) {
  Words open;
  for (std::size_t at = 0; (at = markup.find('<', at)) != std::string::npos;) {
    const std::size_t end = markup.find(markup.compare(at, 4, "<!--") == 0 ? "-->" : ">", at);
    if (end == std::string::npos) return {"<"};
    const std::string tag = markup.substr(at + 1, end - at - 1);
    at = end;
    if (tag.starts_with('!') || tag.starts_with('?') || tag.ends_with('/')) continue;
    if (!tag.starts_with('/'))
      open.push_back(tag.substr(0, tag.find_first_of(" \n\t")));
    else if (open.empty() || open.back() != tag.substr(1))
      return {tag};
    else
      open.pop_back();
  }
  return open;
}

void expectCompleteTable(const std::string& csv, const Json& json) {
  const Words lines = split(csv, '\n');
  const Words names = split(lines.at(0), ',');
  const auto columns = benchColumns();
  ASSERT_EQ(names, Words(columns.begin(), columns.end()));
  const Json& rows = json["scenes"][0]["rows"];
  ASSERT_EQ(lines.size(), 1 + rows.size());
  // Phong at three tolerances and an exact shell, each with 1 and 4 samples; and the latter deferred.
  EXPECT_EQ(rows.size(), 9U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Words cells = split(lines[i + 1] + ",", ',');
    ASSERT_EQ(cells.size(), names.size()) << lines[i + 1];
    EXPECT_EQ(cells[0], "sphere");
    EXPECT_EQ(cells[1], rows[i]["shading"]);
    for (std::size_t c = 2; c < names.size(); ++c) {
      const Json& value = rows[i][names[c]];
      ASSERT_EQ(value.is_null(), cells[c].empty()) << names[c];
      // Six digits in the CSV.
      if (!value.is_null()) {
        EXPECT_NEAR(std::stod(cells[c]), value.get<double>(), 1e-5 * std::abs(value.get<double>()))
            << names[c];
      }
    }
    EXPECT_EQ(rows[i]["runs"], 2);
    EXPECT_LE(rows[i]["frame_ms_p10"], rows[i]["frame_ms"]);
    EXPECT_LE(rows[i]["frame_ms"], rows[i]["frame_ms_p90"]);
    EXPECT_GT(rows[i]["frame_ms_p10"], 0);
    EXPECT_GT(rows[i]["cold_ms"], 0);
    if (rows[i]["shading"] == "phong") {
      EXPECT_LE(rows[i]["error_max_px"], rows[i]["bound_px"]);
      EXPECT_LE(rows[i]["bound_px"], rows[i]["tolerance_px"]);
    }
  }
}

TEST_F(BenchFilesTest, EveryFileIsCompleteAndWellFormed) {
  const Outcome outcome = run(
      folder, {"bench", "sphere", "--size", "64x48", "--quick", "--runs", "2", "-q", "-o", "new/results"});
  const bool plotted = outcome.code == 0;
  ASSERT_TRUE(plotted || outcome.code == 75) << outcome.err;
  if (plotted) {
    EXPECT_EQ(outcome.err, "");
  }
  for (const char* said : {"exact triangles", "time ratio", "ms for 0.001 px", "\nsphere "})
    EXPECT_TRUE(contains(outcome.out, said)) << outcome.out;
  EXPECT_TRUE(contains(textOf(folder / "new/results/summary.md"), "\n| sphere | exact | "));

  const Json json = Json::parse(textOf(folder / "new/results/results.json"));
  EXPECT_EQ(json["size"], Json({64, 48}));
  EXPECT_EQ(json["runs"], 2);
  for (const char* name : {"luxo", "device", "driver", "processor", "cores", "load_before"})
    EXPECT_FALSE(json["machine"][name].get<std::string>().empty()) << name;
  expectCompleteTable(textOf(folder / "new/results/results.csv"), json);

  const std::string page = textOf(folder / "new/results/index.html");
  EXPECT_EQ(unclosedIn(page), Words{});
  std::size_t images = 0;
  for (std::size_t at = 0; (at = page.find("<img", at)) != std::string::npos; ++at, ++images)
    EXPECT_EQ(page.find("src=\"data:image/", at), page.find("src=", at)) << "a page needs no other file";
  // The truth, two pictures with their maps, and a plot.
  EXPECT_EQ(images, plotted ? 6U : 5U);
  if (!plotted) return;
  const std::string svg = textOf(folder / "new/results/pareto.svg");
  EXPECT_TRUE(contains(svg, "<svg"));
  EXPECT_EQ(unclosedIn(svg), Words{});
}

TEST_F(BenchFilesTest, ReloadsAreTheDriversTimeAndLuxos) {
  const Outcome outcome = run(folder, {"bench", "reload", "--size", "64x48", "--runs", "1", "-o", "reload"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(textOf(folder / "reload/reload.json"));
  EXPECT_EQ(json["runs"], 1);
  EXPECT_EQ(json["size"], Json({64, 48}));
  ASSERT_EQ(json["rows"].size(), 5u);
  for (const Json& row : json["rows"]) {
    const auto median = [&](const char* key) { return row[key]["median"].get<double>(); };
    EXPECT_GT(median("driver_ms"), 0) << "each edit makes pipelines";
    EXPECT_GT(median("own_ms"), 0);
    EXPECT_NEAR(median("total_ms"), median("driver_ms") + median("own_ms"), 1e-9 * median("total_ms"));
    EXPECT_TRUE(contains(outcome.out, row["shader"].get<std::string>()));
  }
}

/// Of the page of shadows, in which surfaces are their own casters.
void expectBiasesTradeAcneForGaps(const Json& biases) {
  ASSERT_EQ(biases.size(), 3U * 2U * 6U)
      << "two constant biases, slope biases and normal offsets, of two maps";
  std::uint64_t without = 0, sloped = 0, offset = 0;
  for (const Json& row : biases) {
    if (row["map_size"] != 256) continue;
    const auto wrong = row["wrong_px"].get<std::uint64_t>();
    if (row["bias"] == "bias" && row["amount"] == 0) without += wrong;
    if (row["bias"] == "slope bias" && row["amount"] == 3) sloped += wrong;
    if (row["bias"] == "normal offset" && row["amount"] == 3) offset += wrong;
  }
  // A surface is nearer to the light than half of its texels' depths: about half of what is lit has acne.
  EXPECT_GT(without, 4 * sloped);
  EXPECT_GT(without, 4 * offset);
}

// One run for all that it tells: it takes a minute.
TEST_F(BenchFilesTest, ShadowsAreRightOrCounted) {
  const Outcome outcome =
      run(folder, {"bench", "shadows", "--size", "80x60", "--quick", "--runs", "1", "-o", "shadows"});
  const bool plotted = outcome.code == 0;
  ASSERT_TRUE(plotted || outcome.code == 75) << outcome.err;
  const Json results = Json::parse(textOf(folder / "shadows/shadows.json")), &rows = results["rows"];
  ASSERT_EQ(rows.size(), 3U * 21U);  // none, exact from three maps, six depth maps of two sizes, one of a
                                     // lamp with a radius, planar, soft of 1, 4 and 16 points
  EXPECT_EQ(split(textOf(folder / "shadows/shadows.csv"), '\n').size(), 1 + rows.size());
  double rmsOfOne = 0;
  std::uint64_t planarWrong = 0;
  for (const Json& row : rows) {
    const std::string way = row["shadows"];
    EXPECT_GT(row["frame_ms"], 0) << row;
    EXPECT_EQ(row["shadow_passes"] == 0, way == "none") << row;
    const bool hasRadius = way.starts_with("soft") || way.ends_with("pcss");
    EXPECT_EQ(row["rms"].is_number(), hasRadius) << row;
    EXPECT_EQ(row["wrong_px"].is_number(), way != "none" && !hasRadius) << row;
    if (way == "none") {
      EXPECT_EQ(row["to_none"], 1) << row;
    }
    if (way.starts_with("exact")) {
      EXPECT_EQ(row["wrong_px"], 0) << row;
    }
    if (way.starts_with("depth map") && !hasRadius) {
      EXPECT_GT(row["wrong_px"], 0) << row;
    }
    if (way == "planar") planarWrong += row["wrong_px"].get<std::uint64_t>();
    // Points share the light: the error falls with their number, by a half at least from 1 to 16.
    if (way == "soft, 1 points") rmsOfOne = row["rms"];
    if (way == "soft, 16 points") {
      EXPECT_LT(row["rms"], 0.5 * rmsOfOne) << row;
    }
  }
  EXPECT_GT(planarWrong, 0U) << "what is not the floor has no planar shadow";
  expectBiasesTradeAcneForGaps(results["biases"]);
  EXPECT_EQ(split(textOf(folder / "shadows/shadow_biases.csv"), '\n').size(), 1 + results["biases"].size());
  const std::string markdown = textOf(folder / "shadows/shadows.md");
  EXPECT_TRUE(contains(markdown, "| torus on the ground |")) << markdown;
  EXPECT_TRUE(contains(markdown, ", 0 px |")) << markdown;
  if (!plotted) return;
  const std::string page = textOf(folder / "shadows/shadows.html");
  EXPECT_TRUE(contains(page, "depth map of 256, bias 0.04334"));
  EXPECT_EQ(unclosedIn(page), Words{});
  const std::string svg = textOf(folder / "shadows/shadows.svg");
  EXPECT_TRUE(contains(svg, "<svg"));
  EXPECT_EQ(unclosedIn(svg), Words{});
}

TEST_F(BenchFilesTest, ErrorsAreTheSameEveryTime) {
  const auto errors = [&](const std::string& name) {
    EXPECT_NE(run(folder, {"bench", "torus", "--size", "40x30", "--quick", "--runs", "1", "-o", name}).code,
              1);
    Json rows = Json::parse(textOf(folder / name / "results.json"))["scenes"][0]["rows"];
    for (Json& row : rows)
      for (const char* time :
           {"frame_ms", "frame_ms_p10", "frame_ms_p90", "device_ms", "readback_ms", "cold_ms"})
        row.erase(time);
    return rows;
  };
  EXPECT_EQ(errors("a"), errors("b"));
}

TEST_F(BenchFilesTest, WithoutGnuplotOnlyThePlotIsMissing) {
  const Outcome outcome = run({.arguments = {"PATH=/nonexistent", LUXO_PROGRAM, "bench", "sphere", "--size",
                                             "32x24", "--quick", "--runs", "1", "-o", "r"},
                               .folder = folder.path(),
                               .program = "/usr/bin/env"});
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "there is no gnuplot")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "help: install it")) << outcome.err;
  for (const char* file : {"results.csv", "results.json", "summary.md", "index.html"})
    EXPECT_TRUE(std::filesystem::exists(folder / "r" / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(folder / "r/pareto.svg"));
}

TEST_F(BenchTest, Refusals) {
  const auto refused = [&](Arguments arguments, int code, const std::string& said) {
    arguments.insert(arguments.begin(), "bench");
    const std::size_t before = folder.entries();
    expectFailure(run(folder, arguments), code, said);
    EXPECT_EQ(folder.entries(), before);
  };
  refused({}, 2, "no scene is given");
  refused({"sphere", "--runs", "0"}, 2, "--runs '0'");
  refused({"sphere", "--runs", "1.5"}, 2, "--runs '1.5'");
  refused({"sphere", "--tolerance", "1"}, 2, "unknown option '--tolerance'");
  refused({"nosuch", "-o", "results"}, 3, "nosuch");
  refused({"sphere", "-o", "-"}, 2, "these are several files");
  writeText(folder / "file", "in the way");
  refused({"sphere", "-o", "file/results"}, 5, "cannot make the folder");
}

}  // namespace
}  // namespace luxo::test
