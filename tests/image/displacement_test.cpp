// SPDX-License-Identifier: Apache-2.0
// Surfaces that a material displaces: every pixel against certified rays, and meshes against their bound.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "reference/reference.h"
#include "reference/verification.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

class Displacement : public VerifiedPictureTest {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int from(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  /// Waves, one of them that closes where u and v end and one that does not; a dent; one that is 0 at poles.
  std::string displacement() {
    switch (from(0, 3)) {
      case 0:
        return fmt::format("{:.4f}*sin({}*tau*u)*sin({}*pi*v)", between(0.01, 0.1), from(1, 6), from(1, 6));
      case 1:
        return fmt::format("{:.4f}*sin({:.3f}*u+{:.3f}*v)", between(0.01, 0.1), between(3, 30),
                           between(3, 30));
      case 2:
        return fmt::format("-{:.4f}*exp(-{:.3f}*((u-{:.3f})^2+(v-{:.3f})^2))", between(0.05, 0.2),
                           between(20, 2000), between(0, 1), between(0, 1));
      default:
        return fmt::format("{:.4f}*v*(1-v)*cos({}*tau*u+{:.3f})", between(0.1, 0.4), from(1, 6),
                           between(0, 6));
    }
  }

  /// One surface alone, displaced, lit by a lamp that casts.
  Snapshot snapshotOf(const std::string& surface, const std::string& displacement) {
    const Vec3 eye = between(2.2, 3.5) * glm::normalize(Vec3(between(-1, 1), between(-1, 1), between(-1, 1)));
    const std::string text = fmt::format(
        R"({{ "luxo": 1, "materials": {{ "m": {{ "displacement": "{}" }} }},
              "surfaces": {{ "s": {{ "type": "{}" }} }},
              "nodes": [ {{ "surface": "s", "material": "m" }},
                         {{ "translate": [3, 4, 2], "light": {{ "type": "point", "intensity": 0.9 }} }} ],
              "camera": {{ "eye": [{:.6f}, {:.6f}, {:.6f}], "look_at": [0, 0.2, 0], "fov_y": 0.7 }} }})",
        displacement, surface, eye.x, eye.y, eye.z);
    return takeSnapshot(buildScene(parseScene(text, "displacement")), 0, {96, 72});
  }

  std::mt19937 random_{29};
};

constexpr std::array kSurfaces{"sphere",     "torus", "cylinder", "disk",      "cone",       "ellipsoid",
                               "paraboloid", "flag",  "mobius",   "rectangle", "hyperboloid"};

TEST_F(Displacement, ExactPicturesAreTheTruth) {
  std::uint64_t seen = 0, lost = 0;
  for (int round = 0; round < 11; ++round) {
    const std::string surface = kSurfaces[static_cast<std::size_t>(round)];
    const std::string height = displacement();
    SCOPED_TRACE(fmt::format("{}: {}", surface, height));
    const Verified found = verified(snapshotOf(surface, height));
    EXPECT_EQ(found.verification.coverage.beyond, 0U)
        << "missing " << found.verification.coverage.missing << ", extra "
        << found.verification.coverage.extra << ", of another layer "
        << found.verification.coverage.wrongLayer;
    EXPECT_LE(found.verification.positionPx.max, 1e-3 + found.verification.positionPx.floor);
    EXPECT_EQ(found.verification.nanPixels, 0U);
    seen += found.verification.coverage.both;
    lost += found.statistics.error.unconvergedPx;
  }
  EXPECT_GT(seen, 10'000U);
  EXPECT_EQ(lost, 0U);
}

// What a mesh promises: it is nowhere farther off on the screen than its proven bound. A silhouette is found
// to a hundredth of a pixel, and corners of triangles are rounded to 1 / 256.
TEST_F(Displacement, MeshesAreWithinTheirBound) {
  for (int round = 0; round < 11; ++round) {
    const std::string surface = kSurfaces[static_cast<std::size_t>(round)], height = displacement();
    SCOPED_TRACE(fmt::format("{}: {}", surface, height));
    const Snapshot snapshot = snapshotOf(surface, height);
    const auto show = [&](Output output) {
      return renderer().render(snapshot, {.shading = Shading::Gouraud, .output = output});
    };
    const Picture color = show(Output::Color);
    const double bound = color.statistics.error.boundPx;
    const Verification found =
        verify(snapshot, castPicture(snapshot),
               {.color = color.image, .uv = show(Output::Uv).image, .id = show(Output::Id).image},
               {.shading = Shading::Gouraud, .boundPx = bound, .flip = false});
    EXPECT_LE(found.coverage.farthestPx, bound + kSilhouettePx + 0x1p-8);
    EXPECT_GT(found.coverage.both, 200U);
  }
}

}  // namespace
}  // namespace luxo::test
