// SPDX-License-Identifier: Apache-2.0
// luxo inspect: what it says of scenes and of pictures. No device is needed.
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/format.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

class Inspect : public RenderTest {
 protected:
  [[nodiscard]] Json inspected(const std::string& what, const Arguments& extra = {}) const {
    Arguments arguments = {"inspect", what, "--json"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }
};

TEST_F(Inspect, TheLamp) {
  const Json lamp = inspected("luxo-grandpa");
  EXPECT_EQ(lamp["count"]["nodes"], 11);
  EXPECT_EQ(lamp["count"]["shown"], 9);
  EXPECT_EQ(lamp["count"]["surfaces"], 6);
  EXPECT_EQ(lamp["count"]["lights"], 2);
  EXPECT_EQ(lamp["time"], 21.0);
  EXPECT_GT(lamp["picture"]["triangles"], 100);
  EXPECT_LE(lamp["picture"]["bound_px"], 0.5);
  ASSERT_EQ(lamp["nodes"].size(), 11u);
  EXPECT_EQ(lamp["nodes"][0]["name"], "floor");
  EXPECT_EQ(lamp["nodes"][0]["bounds"]["max"][0], 30.0);
  EXPECT_EQ(lamp["nodes"][8]["name"], "shade");
  EXPECT_EQ(lamp["nodes"][8]["depth"], 4);
  EXPECT_EQ(lamp["cameras"][0]["name"], "orbit");
  EXPECT_NEAR(lamp["cameras"][0]["fov_y_degrees"], 50, 1e-12);
}

TEST_F(Inspect, ParametersSurfacesAndWarnings) {
  writeText(folder / "s.luxo.json", R"({ "luxo": 1,
    "params": { "k": { "value": 3, "range": [1, 12], "step": 1, "label": "lobes" }, "a": "k+t" },
    "surfaces": { "band": { "type": "mobius" },
                  "odd": { "type": "formula", "u": [-1, 1], "v": [0, 1], "position": ["u", "1/u", "v"] } },
    "nodes": [ { "surface": "band" }, { "surface": "odd" } ] })");
  const Json scene = inspected("s.luxo.json", {"-P", "k=5", "--time", "2"});
  const Json k = scene["parameters"][0], a = scene["parameters"][1];
  EXPECT_EQ(k["value"], 5.0);
  EXPECT_EQ(k["range"], (Json{1.0, 12.0}));
  EXPECT_EQ(k["label"], "lobes");
  EXPECT_EQ(k["moves"], false);
  EXPECT_EQ(a["value"], 7.0);
  EXPECT_EQ(a["moves"], true);
  EXPECT_EQ(scene["surfaces"][0]["orientable"], false);
  EXPECT_EQ(scene["surfaces"][0]["euler_characteristic"], 0);
  const std::string warnings = scene["warnings"].dump();
  EXPECT_TRUE(contains(warnings, "one side")) << warnings;
  EXPECT_TRUE(contains(warnings, "hole")) << warnings;

  const Outcome text = run(folder, {"inspect", "s.luxo.json"});
  for (const char* said : {"lobes", "one-sided", "warnings", "range (1, 12)"})
    EXPECT_TRUE(contains(text.out, said)) << text.out << "\nlacks: " << said;
}

TEST_F(Inspect, Pictures) {
  saveImage(Image(3, 2, 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, -1, 16, 17}), folder / "a.pfm");
  const Json image = inspected("a.pfm", {"--pixel", "1,1"});
  EXPECT_EQ(image["size"], (Json{3, 2}));
  EXPECT_EQ(image["pixel"]["value"], (Json{12.0, 13.0, 14.0}));
  EXPECT_EQ(image["channels"][0]["min"], -1.0);
  EXPECT_EQ(image["channels"][0]["max"], 12.0);
  EXPECT_EQ(image["channels"][2]["mean"], 57 / 6.0);  // 2 + 5 + 8 + 11 + 14 + 17
  expectFailure(run(folder, {"inspect", "a.pfm", "--pixel", "3,0"}), 2, "3 x 2 pixels", "312,88");
  expectFailure(run(folder, {"inspect", "a.pfm", "--pixel", "1;0"}), 2, "not a pixel", "312,88");
}

TEST_F(Inspect, Refusals) {
  expectFailure(run(folder, {"inspect"}), 2, "nothing is named", "luxo-grandpa");
  expectFailure(run(folder, {"inspect", "a.frag"}), 3, "not supported yet", "");
  expectFailure(run(folder, {"inspect", "missing.png"}), 3, "missing.png", "");
  EXPECT_EQ(run(folder, {"inspect", "missing.luxo.json"}).code, 3);
}

}  // namespace
}  // namespace luxo::test
