// SPDX-License-Identifier: Apache-2.0
// Scenes whose numbers and formulas are extreme or senseless: each is refused, or its picture has a finite
// colour in every pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/snapshot.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kSize{32, 24};
constexpr int kScenes = 150;  // half of them are refused
constexpr std::uint64_t kSeed = 20261123;
/// One in so many of the places of a scene is filled with nonsense: one to four of a scene.
constexpr std::size_t kSane = 10;

/// What stands between < and > is what makes sense there.
constexpr std::string_view kTemplates[] = {
    R"_({"luxo":1,"params":{"k":<3>},"camera":{"eye":[<1>,<2>,<5>],"look_at":[<0>,0,0],"fov_y":<0.7>,"near":<0.1>},
"render":{"ambient":[<0.2>,0.2,0.2],"background":[0.1,<0.2>,0.3]},
"surfaces":{"ball":{"type":"sphere","radius":<1>},"floor":{"type":"rectangle","size":[<4>,4]}},
"materials":{"m":{"diffuse":[<"0.5+0.5*sin(k*u)">,<"v">,<0.25>],"specular":[<0.5>,0.5,0.5],"shininess":<20>}},
"nodes":[{"light":{"color":[<1>,1,1],"intensity":<40>,"attenuation":"inverse-square"},"translate":[<2>,3,<4>]},
{"surface":"ball","material":"m","translate":[<0>,0,0],"scale":[<1>,1,1]},{"surface":"floor","translate":[0,<-1>,0]}]})_",
    R"_({"luxo":1,"params":{"k":<2>},"camera":{"eye":[<3>,2,4],"look_at":[0,0,<0>]},
"surfaces":{"s":{"type":"formula","position":[<"u">,<"0.5*sin(3*u+t)*cos(k*v)">,<"v">],"u":[<-1>,1],"v":[-1,<1>]}},
"materials":{"m":{"diffuse":[<"u*u">,<"1/(1+v*v)">,<"0.5">],"shininess":<5>,"two_sided":true}},
"nodes":[{"light":{"type":"directional","color":[<1>,0.9,0.8],"intensity":<1>},"rotate":{"axis":[<1>,0,0],"angle":<-1>}},
{"surface":"s","material":"m","scale":[<1>,<1>,1]}]})_",
    R"_({"luxo":1,"params":{"k":<2>},"camera":{"eye":[0,<1>,4],"look_at":[0,0,0],"type":"orthographic","height":<3>},
"surfaces":{"ring":{"type":"torus","major":<0.8>,"minor":<0.3>},"tube":{"type":"cylinder","radius":<0.3>,"height":<2>}},
"materials":{"glass":{"diffuse":[<0.8>,0.1,0.1],"opacity":<0.5>},"b":{"diffuse":[<"0.5">,<"u">,<"v">],"ambient":[<0.1>,0.1,0.1]}},
"nodes":[{"light":{"color":[1,<1>,1]},"translate":[<2>,3,4]},{"surface":"ring","rotate":{"axis":[1,<0>,0],"angle":<1.5>},"material":"glass"},
{"surface":"tube","scale":[1,<2>,1],"material":"b"}]})_",
};

constexpr std::string_view kNonsense[] = {
    "0",          "-1",      "1e-30",   "1e-300",     "1e18",          "1e30",       "3e38",
    "1e39",       "1e300",   "1e-7",    "16777217",   "\"1/u\"",       "\"log(v)\"", "\"1/(v-v)\"",
    "\"u^9\"",    "\"0*u\"", "\"u/v\"", "\"tan(u)\"", "\"exp(99*u)\"", "\"1e30*u\"", "\"sqrt(u-3)\"",
    "\"k*1e37\"", "\"1/k\"", "\"t\"",   "\"k/t\"",    "\"exp(k*99)\"",
};

class SenselessScenes : public PictureTest, public testing::WithParamInterface<const char*> {
 protected:
  // Not std::uniform_int_distribution, which differs between libraries.
  std::size_t below(std::size_t count) { return random_() % count; }

  std::string next() {
    const std::string_view pattern = kTemplates[below(std::size(kTemplates))];
    std::string text;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      if (pattern[i] != '<') {
        text += pattern[i];
        continue;
      }
      const std::size_t end = pattern.find('>', i);
      text += below(kSane) == 0 ? kNonsense[below(std::size(kNonsense))] : pattern.substr(i + 1, end - i - 1);
      i = end;
    }
    return text;
  }

 private:
  std::mt19937_64 random_{kSeed};
};

INSTANTIATE_TEST_SUITE_P(Shadings, SenselessScenes, testing::Values("gouraud", "phong", "exact"),
                         [](const auto& shading) { return std::string(shading.param); });

std::optional<Snapshot> snapshotOf(const std::string& text) {
  try {
    return takeSnapshot(buildScene(parseScene(text, "senseless.luxo.json")), 0.5, kSize);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene) << text << error.what();
    return std::nullopt;
  }
}

TEST_P(SenselessScenes, HaveNoPixelThatIsNoNumber) {
  const std::string_view name = GetParam();
  const Shading shading = name == "gouraud" ? Shading::Gouraud
                          : name == "phong" ? Shading::Phong
                                            : Shading::Exact;
  int drawn = 0;
  for (int i = 0; i < kScenes; ++i) {
    const std::string text = next();
    const auto snapshot = snapshotOf(text);
    if (!snapshot) continue;
    ++drawn;
    const Picture picture =
        renderer().render(*snapshot, {.shading = shading, .tolerancePx = 0.5, .samples = 1});
    ASSERT_EQ(picture.statistics.error.nonfinitePx, 0u) << text;
    for (const float value : picture.image.samples()) ASSERT_TRUE(std::isfinite(value)) << text;
  }
  EXPECT_GT(drawn, kScenes / 4);
}

}  // namespace
}  // namespace luxo::test
