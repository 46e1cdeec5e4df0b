// SPDX-License-Identifier: Apache-2.0
// The shade's rule against what it replaces: a ray from the light to the point, cut with the paraboloid.
#include "scene/shade.h"

#include <cmath>

#include "scene_test_support.h"

namespace luxo {
namespace {

/// Whether the open segment from the focus to `point` (shade space: vertex at the origin, opening +Y) meets
/// the wall x^2 + z^2 = 4 f y, 0 <= y <= h. `margin` becomes the smallest distance, relative to the shade's
/// size, from a decision that rounding could turn.
bool blocked(long double f, long double h, const Vec3& point, long double& margin) {
  const long double dx = point.x, dy = point.y - f, dz = point.z;
  const long double a = dx * dx + dz * dz, b = -4 * f * dy,
                    c = -4 * f * f;  // of s, where the point has s = 1
  const auto meets = [&](long double s) {
    const long double y = f + s * dy;
    margin = std::min({margin, std::fabs(s - 1), std::fabs(y - h) / h});
    return s > 0 && s < 1 && y <= h;
  };
  const long double root = std::sqrt(b * b - 4 * a * c);
  const long double q = -0.5L * (b + (b < 0 ? -root : root));  // no cancellation
  const bool first = a != 0 && meets(q / a), second = q != 0 && meets(c / q);
  return first || second;
}

TEST(Shade, RuleEqualsRayCasting) {
  test::Random random(3);
  int lights = 0, shadows = 0;
  for (const auto& [f, h] : {std::pair(0.2, 1.8), {0.5, 0.5}, {1.0, 0.3}, {0.05, 4.0}}) {
    for (int pose = 0; pose < 40; ++pose) {
      const double size = std::exp(random.uniform(-5, 5));
      const Vec3 scale = size * Vec3(pose % 2 ? -1 : 1, 1, 1);  // a mirrored shade is a shade
      const Rotation turn = random.rotation();
      const Transform worldFromShade = compose(random.inCube(10), rotation(turn.axis, turn.angle), scale);
      const auto rule = shadeRule({f, h}, worldFromShade, {});
      ASSERT_TRUE(rule);
      EXPECT_NEAR(rule->scale, size, 1e-14 * size);
      for (int i = 0; i < 2500; ++i) {
        const Vec3 point = random.inCube(i % 3 ? 3 : 0.6) * std::max(f, h);
        long double margin = 1;
        const bool dark = blocked(f, h, point, margin);
        if (margin < 1e-9) continue;  // rounding of a placement up to 10^4 shade sizes away
        ASSERT_EQ(lit(*rule, transformPoint(worldFromShade, point)), !dark)
            << f << ' ' << h << " at " << point.x << ' ' << point.y << ' ' << point.z;
        ++(dark ? shadows : lights);
      }
    }
  }
  EXPECT_GT(lights, 20000);
  EXPECT_GT(shadows, 20000);
}

TEST(Shade, RimIsWhereTheRuleTurns) {
  const auto rule =
      shadeRule({0.2, 1.8}, Transform{}, {});  // rim radius 1.2; 0.8 = (1.8 - 0.2) / (1.8 + 0.2)
  ASSERT_TRUE(rule);
  EXPECT_DOUBLE_EQ(rule->cosRim, 0.8);
  const Vec3 throughRim = Vec3(1.2, 1.8, 0) - rule->focus;
  EXPECT_TRUE(lit(*rule, rule->focus + 5.0 * (throughRim + Vec3(-1e-9, 0, 0))));
  EXPECT_FALSE(lit(*rule, rule->focus + 5.0 * (throughRim + Vec3(1e-9, 0, 0))));
  EXPECT_TRUE(lit(*rule, {0, 1e-9, 0}));    // inside, just above the vertex
  EXPECT_FALSE(lit(*rule, {0, -1e-9, 0}));  // behind it
  EXPECT_TRUE(lit(*rule, rule->focus));
}

TEST(Shade, OnlySimilaritiesKeepAFocus) {
  const Mat3 turn = rotation({1, 2, 3}, 0.9);
  EXPECT_TRUE(shadeRule({1, 1}, {turn * 1e-6, {}}, {}));
  EXPECT_TRUE(shadeRule({1, 1}, {turn * -3.0, {}}, {}));
  EXPECT_FALSE(shadeRule({1, 1}, compose({}, turn, {1, 1, 1 + 1e-8}), {}));
  EXPECT_FALSE(shadeRule({1, 1}, {Mat3(Vec3(1, 0, 0), Vec3(1e-8, 1, 0), Vec3(0, 0, 1)), {}}, {}));
  EXPECT_FALSE(shadeRule({1, 1}, {Mat3(0), {}}, {}));
}

}  // namespace
}  // namespace luxo
