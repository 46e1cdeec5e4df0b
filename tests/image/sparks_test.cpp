// SPDX-License-Identifier: Apache-2.0
// No sparks: where surfaces meet, rounding and tessellation must not let through what is hidden. The lamp is
// the hard case: the inside of its shade is a thousand times brighter than the outside, and its rods lean
// against the shade.
#include <gtest/gtest.h>

#include <algorithm>

#include "luxo_grandpa/lamp.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

/// Pixels more than three times as bright as each of their four neighbours, and bright at all. No highlight
/// of the lamp's materials is narrower than a pixel at these distances.
int countSparks(const Image& image) {
  const auto brightness = [&](int x, int y) {
    const auto p = image.pixel(x, y);
    return p[0] + p[1] + p[2];
  };
  int sparks = 0;
  for (int y = 1; y + 1 < image.height(); ++y)
    for (int x = 1; x + 1 < image.width(); ++x) {
      const float around =
          std::max({brightness(x - 1, y), brightness(x + 1, y), brightness(x, y - 1), brightness(x, y + 1)});
      if (brightness(x, y) > 3 * around + 0.3f) ++sparks;
    }
  return sparks;
}

class Sparks : public PictureTest {};

TEST_F(Sparks, NoneWhereRodAndJointTouchTheShade) {
  const Camera camera{.eye = Vec3(0, 6, 6), .lookAt = Vec3(-0.1, 7.6, 0.4), .fovY = radians(30)};
  for (const int samples : {1, 4})
    EXPECT_EQ(countSparks(draw(luxoGrandpa(), camera, {640, 480}, {.samples = samples}, 3).image), 0)
        << samples << " samples";
}

TEST_F(Sparks, NoneAlongTheShadesOutline) {
  const Camera camera{.eye = Vec3(8, 3, 9), .lookAt = Vec3(3.3, 5.6, 3.4), .fovY = radians(20)};
  for (const int samples : {1, 4})
    EXPECT_EQ(countSparks(draw(luxoGrandpa(), camera, {640, 480}, {.samples = samples}, 21).image), 0)
        << samples << " samples";
}

TEST_F(Sparks, NoneInTheLampsOwnPictures) {
  for (const double time : {3.0, 9.5, 21.0})
    EXPECT_EQ(countSparks(draw(luxoGrandpa(), {1280, 720}, {}, time).image), 0) << "t = " << time;
}

}  // namespace
}  // namespace luxo::test
