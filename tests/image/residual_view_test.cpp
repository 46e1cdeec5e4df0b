// SPDX-License-Identifier: Apache-2.0
// Views of data beside exact surfaces, and the view of residuals itself: what a picture says of its points is
// theirs, whatever colours are shown.
#include <gtest/gtest.h>

#include <optional>

#include "base/error.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

/// A ring in the light of a lamp whose shadow falls on the ground.
Scene ringOnGround(std::optional<Shading> ofRing, bool shadow) {
  Scene scene;
  scene.set(RenderSettings{.size = {160, 120}});
  const MaterialId ring = scene.add(Material{.shading = ofRing});
  scene.add(Node{.translation = Vec3(0, 0.6, 0), .surface = torus(1, 0.3), .material = ring});
  scene.add(Node{.surface = rectangle(6, 6)});
  scene.add(Node{.translation = Vec3(1, 5, 2),
                 .light = Light{.shadow = shadow ? Light::Shadow::Exact : Light::Shadow::None}});
  return scene;
}

class ResidualView : public PictureTest {
 protected:
  FrameError errorOf(const Scene& scene, Shading shading, int samples = 1) {
    return renderer()
        .render(takeSnapshot(scene, 0, {160, 120}), {.shading = shading, .samples = samples})
        .statistics.error;
  }
};

TEST_F(ResidualView, MaterialsThatShowDataHaveNone) {
  for (const Shading shading :
       {Shading::Normal, Shading::Uv, Shading::Depth, Shading::Id, Shading::Wireframe})
    for (const int samples : {1, 3}) {
      const FrameError error = errorOf(ringOnGround(shading, false), Shading::Exact, samples);
      EXPECT_LE(error.residualMaxPx.value(), 1e-3) << nameOf(shading) << ", " << samples << " samples";
    }
}

TEST_F(ResidualView, TellsTheResidualsThatItShows) {
  for (const int samples : {1, 3}) {
    const FrameError shown = errorOf(ringOnGround({}, false), Shading::Residual, samples);
    EXPECT_EQ(shown.residualMaxPx, errorOf(ringOnGround({}, false), Shading::Exact, samples).residualMaxPx);
  }
}

// Points were looked for where they are lit later: none was found, and rays drew the picture.
TEST_F(ResidualView, OfAPictureWithShadowsPassesItsAudit) {
  const FrameError error = errorOf(ringOnGround({}, true), Shading::Residual);
  EXPECT_EQ(error.auditFailedPx, 0U);
  EXPECT_LT(error.resolvedByRaysPx, 1000U);
}

TEST_F(ResidualView, IsOfAPictureNotOfAMaterial) {
  EXPECT_THROW(static_cast<void>(ringOnGround(Shading::Residual, false)), Error);
}

}  // namespace
}  // namespace luxo::test
