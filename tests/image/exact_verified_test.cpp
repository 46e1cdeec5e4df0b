// SPDX-License-Identifier: Apache-2.0
// Exact pictures of the standard scenes, every pixel held against the ground truth of the reference engine.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "reference/reference.h"
#include "reference/verification.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scenes/embedded_scenes.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

Scene embedded(std::string_view name) {
  for (const EmbeddedScene& scene : embeddedScenes())
    if (scene.name == name) return buildScene(parseScene(std::string(scene.text), std::string(name)));
  throw std::runtime_error("no such scene");
}

class ExactVerified : public PictureTest, public testing::WithParamInterface<const char*> {};

INSTANTIATE_TEST_SUITE_P(Scenes, ExactVerified, testing::Values("sphere", "torus", "flag", "klein", "teapot"),
                         [](const auto& name) { return std::string(name.param); });

// A tube of two pixels: what float rounds away of a place on it turns its normal by 1e-4.
TEST_F(PictureTest, SharpBendsKeepTheirColour) {
  const Snapshot snapshot = takeSnapshot(embedded("thin-torus"), 0, {512, 512});
  const auto show = [&](Output output) {
    return renderer().render(snapshot, {.shading = Shading::Exact, .output = output}).image;
  };
  const Verification found =
      verify(snapshot, castPicture(snapshot),
             {.color = show(Output::Color), .uv = show(Output::Uv), .id = show(Output::Id)});
  EXPECT_GT(found.coverage.both, 3000U);
  EXPECT_GE(found.color.psnrLinear, 110);
}

TEST_P(ExactVerified, EveryPixelIsWithinAThousandth) {
  const Snapshot snapshot = takeSnapshot(embedded(GetParam()), 0, {256, 256});
  const auto show = [&](Output output) {
    return renderer().render(snapshot, {.shading = Shading::Exact, .output = output});
  };
  const Picture color = show(Output::Color);
  EXPECT_EQ(color.statistics.error.unconvergedPx, 0U);
  EXPECT_LE(color.statistics.error.residualMaxPx.value(), 1e-3);
  const Verification found = verify(snapshot, castPicture(snapshot),
                                    {.color = color.image,
                                     .normal = show(Output::Normal).image,
                                     .uv = show(Output::Uv).image,
                                     .id = show(Output::Id).image});
  EXPECT_GT(found.coverage.both, 5000U);
  EXPECT_EQ(found.coverage.undecided, 0U);
  EXPECT_EQ(found.coverage.beyond, 0U) << "coverage wrong farther than 0.01 px from the silhouette";
  EXPECT_LE(found.positionPx.max, 1e-3);
  EXPECT_GE(found.color.psnrLinear, 110);
  EXPECT_EQ(found.nanPixels, 0U);
}

}  // namespace
}  // namespace luxo::test
