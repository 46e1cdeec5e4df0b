// SPDX-License-Identifier: Apache-2.0
// What is behind triangles is hidden in exactly the samples that they hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "cull/occlusion_buffer.h"

namespace luxo {
namespace {

OcclusionBuffer bufferOf(const PixelSize& size, const Vec2& sample = Vec2(0.5)) {
  OcclusionBuffer buffer;
  buffer.clear(size, sample);
  return buffer;
}

void cover(OcclusionBuffer& buffer, const PixelTriangle& leaving) { buffer.cover({&leaving, 1}); }
void cover(OcclusionBuffer& buffer, const PixelTriangle& leaving, const PixelTriangle& entering) {
  buffer.cover({&leaving, 1}, {&entering, 1});
}

/// Holds the picture's upper left half of `size`, at a depth.
PixelTriangle upperLeft(double size, double depth) {
  return {Vec3(0, 0, depth), Vec3(size, 0, depth), Vec3(0, size, depth)};
}
PixelTriangle lowerRight(double size, double depth) {
  return {Vec3(size, size, depth), Vec3(0, size, depth), Vec3(size, 0, depth)};
}
PixelTriangle moved(PixelTriangle triangle, const Vec3& by) {
  for (Vec3& corner : triangle) corner += by;
  return triangle;
}

TEST(OcclusionBuffer, HidesWhatIsBehindAndNothingElse) {
  OcclusionBuffer buffer = bufferOf({32, 32});
  EXPECT_FALSE(buffer.hides(upperLeft(10, 5)));
  cover(buffer, upperLeft(32, 2));
  EXPECT_TRUE(buffer.hides(upperLeft(10, 5)));
  EXPECT_FALSE(buffer.hides(upperLeft(10, 1)));
  EXPECT_FALSE(buffer.hides(upperLeft(10, 2))) << "as far as the cover";
  EXPECT_FALSE(buffer.hides(lowerRight(31, 5)));
}

TEST(OcclusionBuffer, AKnownNumberOfSamples) {
  // On or left of the diagonal x + y = 4: 4 + 3 + 2 + 1 centres, whichever way the corners go round.
  OcclusionBuffer buffer = bufferOf({8, 8});
  const PixelTriangle triangle = upperLeft(4, 1);
  EXPECT_EQ(buffer.samplesIn(triangle), 10U);
  EXPECT_EQ(buffer.samplesIn({triangle[0], triangle[2], triangle[1]}), 10U);
  EXPECT_EQ(buffer.samplesIn(moved(triangle, Vec3(-1, 0, 0))), 3U + 2U + 1U) << "half outside of the picture";
  EXPECT_EQ(buffer.samplesIn(moved(triangle, Vec3(20, 0, 0))), 0U);
  EXPECT_EQ(buffer.covered(), 0U);
  cover(buffer, triangle);
  EXPECT_EQ(buffer.covered(), 10U);
  // Other samples of the same pixels: those at (1/8, 5/8) are inside where column + row <= 3.25.
  EXPECT_EQ(bufferOf({8, 8}, Vec2(0.125, 0.625)).samplesIn(triangle), 10U);
  EXPECT_EQ(bufferOf({8, 8}, Vec2(0.875, 0.875)).samplesIn(triangle), 6U);
}

TEST(OcclusionBuffer, NeighboursLeaveNoGap) {
  OcclusionBuffer buffer = bufferOf({64, 64});
  cover(buffer, upperLeft(64, 2));
  EXPECT_FALSE(buffer.hides(moved(upperLeft(20, 5), Vec3(25, 25, 0))));
  cover(buffer, lowerRight(64, 3));
  EXPECT_TRUE(buffer.hides(moved(upperLeft(20, 5), Vec3(25, 25, 0))));
  EXPECT_FALSE(buffer.hides(moved(upperLeft(20, 2.5), Vec3(25, 25, 0))));
}

// 1 + row / 8, from the upper edge of the first.
TEST(OcclusionBuffer, ASlopingCoverHidesWhatIsBehindItThere) {
  OcclusionBuffer buffer = bufferOf({32, 32});
  cover(buffer, {Vec3(0, 0, 1), Vec3(32, 0, 1), Vec3(0, 32, 5)});
  EXPECT_TRUE(buffer.hides(upperLeft(8, 2.1)));
  EXPECT_FALSE(buffer.hides(upperLeft(8, 1.9)));
  EXPECT_FALSE(buffer.hides(moved(upperLeft(8, 2.1), Vec3(0, 9, 0))));
  EXPECT_TRUE(buffer.hides({Vec3(0, 0, 1.1), Vec3(9, 0, 1.1), Vec3(0, 9, 2.3)})) << "parallel to it";
  EXPECT_FALSE(buffer.hides({Vec3(0, 0, 0.9), Vec3(9, 0, 0.9), Vec3(0, 9, 2.1)}));
  EXPECT_FALSE(buffer.hides({Vec3(0, 0, 9), Vec3(9, 0, 9), Vec3(0, 9, 1)})) << "comes before it";
}

/// The depth at a point of the plane through the corners.
double depthAt(const PixelTriangle& t, double x, double y) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  return t[0].z - (normal.x * (x - t[0].x) + normal.y * (y - t[0].y)) / normal.z;
}

// Two planes that slope at random: their distance at the corners, which are samples, tells of all between.
TEST(OcclusionBuffer, DepthsAreThoseOfThePlanes) {
  std::mt19937 random(11);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int hidden = 0, seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const PixelTriangle plane = {Vec3(-20, -20, between(1, 2)), Vec3(90, -20, between(1, 2)),
                                 Vec3(-20, 90, between(1, 2))};
    PixelTriangle candidate;
    double least = 1;
    for (Vec3& corner : candidate) {
      corner = Vec3(std::floor(between(0, 32)) + 0.5, std::floor(between(0, 32)) + 0.5, 0);
      const double behind = between(-0.01, 0.03);
      corner.z = depthAt(plane, corner.x, corner.y) + behind;
      least = std::min(least, behind);
    }
    const bool narrow = std::abs(glm::cross(candidate[1] - candidate[0], candidate[2] - candidate[0]).z) < 8;
    if (narrow || std::abs(least) < 1e-4) continue;  // within what floats and the room around it make of it
    OcclusionBuffer buffer = bufferOf({32, 32});
    cover(buffer, plane);
    EXPECT_EQ(buffer.hides(candidate), least > 0) << i;
    ++(least > 0 ? hidden : seen);
  }
  EXPECT_GT(hidden, 200);
  EXPECT_GT(seen, 200);
}

TEST(OcclusionBuffer, WhatHoldsNoSampleIsHidden) {
  const OcclusionBuffer buffer = bufferOf({32, 32});
  EXPECT_TRUE(buffer.hides({Vec3(3.6, 3.6, 1), Vec3(4.4, 3.6, 1), Vec3(4, 4.4, 1)}));
  EXPECT_TRUE(buffer.hides(moved(upperLeft(5, 1), Vec3(-9, 0, 0))));
  // A little around counts: devices move corners.
  EXPECT_FALSE(buffer.hides({Vec3(3.51, 3.51, 1), Vec3(4.4, 3.6, 1), Vec3(4, 4.4, 1)}));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(buffer.hides({Vec3(kNan, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)})) << "nobody knows";
}

TEST(OcclusionBuffer, BandsTogetherAreTheWhole) {
  OcclusionBuffer whole = bufferOf({32, 32});
  std::array<OcclusionBuffer, 3> bands;
  for (int i = 0; i < 3; ++i)
    bands[static_cast<std::size_t>(i)].clear(32, {12 * i, std::min(12 * i + 12, 32)}, Vec2(0.5));
  const auto inAll = [&](const auto& action) {
    action(whole);
    for (OcclusionBuffer& band : bands) action(band);
  };
  inAll([](OcclusionBuffer& buffer) {
    cover(buffer, upperLeft(30, 2), moved(upperLeft(9, 1), Vec3(3, 9, 0)));
    cover(buffer, moved(lowerRight(10, 3), Vec3(14, 14, 0)));
  });
  int hidden = 0;
  for (int x = 0; x < 32; x += 2)
    for (int y = 0; y < 32; y += 2) {
      const PixelTriangle triangle = moved(upperLeft(5, 4), Vec3(x, y, 0));
      const bool byBands =
          std::ranges::all_of(bands, [&](const OcclusionBuffer& band) { return band.hides(triangle); });
      EXPECT_EQ(byBands, whole.hides(triangle)) << x << ", " << y;
      hidden += byBands;
    }
  EXPECT_GT(hidden, 10);
  EXPECT_LT(hidden, 200);
}

TEST(OcclusionBuffer, ClearedItIsAsANewOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-10, 90), size(5, 60), depth(1, 9);
  const auto any = [&](auto shape) {
    const double across = size(random), far = depth(random), x = place(random), y = place(random);
    return moved(shape(across, far), Vec3(x, y, 0));
  };
  OcclusionBuffer used;
  int hidden = 0;
  for (int round = 0; round < 40; ++round) {
    used.clear({75, 70}, Vec2(0.25 + 0.5 * (round % 2), 0.5));
    OcclusionBuffer fresh = bufferOf({75, 70}, Vec2(0.25 + 0.5 * (round % 2), 0.5));
    for (int slab = 0; slab < 3; ++slab) {
      const PixelTriangle leaving = any(upperLeft), entering = any(lowerRight);
      cover(used, leaving, entering);
      cover(fresh, leaving, entering);
    }
    for (int k = 0; k < 60; ++k) {
      PixelTriangle triangle = any(lowerRight);
      for (Vec3& corner : triangle) corner.z += 2;
      EXPECT_EQ(used.hides(triangle), fresh.hides(triangle));
      hidden += fresh.hides(triangle);
    }
    EXPECT_EQ(used.covered(), fresh.covered());
  }
  EXPECT_GT(hidden, 100);
}

TEST(OcclusionBuffer, ASlabCoversNothingBehindWhereItWasEntered) {
  OcclusionBuffer buffer = bufferOf({32, 32});
  cover(buffer, upperLeft(32, 2), moved(upperLeft(6, 1), Vec3(2, 2, 0)));
  EXPECT_FALSE(buffer.hides(upperLeft(10, 5)));
  EXPECT_TRUE(buffer.hides(moved(upperLeft(6, 5), Vec3(12, 2, 0)))) << "beside the entrance";
  // Another slab has entrances of its own; one behind a cover is none.
  cover(buffer, upperLeft(32, 2), upperLeft(32, 3));
  EXPECT_TRUE(buffer.hides(upperLeft(10, 5)));
  // Behind the corner of a cover that slopes, but before the place that is entered.
  buffer = bufferOf({32, 32});
  cover(buffer, {Vec3(0, 0, 1), Vec3(32, 0, 1), Vec3(0, 32, 9)}, moved(upperLeft(6, 3), Vec3(2, 20, 0)));
  EXPECT_FALSE(buffer.hides(moved(upperLeft(6, 12), Vec3(2, 20, 0))));
  EXPECT_TRUE(buffer.hides(moved(upperLeft(6, 12), Vec3(2, 2, 0))));
}

/// How far a sample is inside the nearest edge of a triangle.
double insideBy(const PixelTriangle& t, const Vec2& sample) {
  const double area = glm::cross(t[1] - t[0], t[2] - t[0]).z;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a(t[k]), way = Vec2(t[(k + 1) % 3]) - a, to = sample - a;
    least = std::min(least, (way.x * to.y - way.y * to.x) / glm::length(way) * (area > 0 ? 1 : -1));
  }
  return least;
}

/// Slabs sample by sample, in a picture of 48 x 40: as `sign` is, what is within a hundredth of more than the
/// room around edges counts as in favour of hiding, or against it.
class SlabModel {
 public:
  explicit SlabModel(double sign) : doubt_(0.02 * sign) {}

  void cover(std::span<const PixelTriangle> leaving, std::span<const PixelTriangle> entering) {
    forEachSample([&](const Vec2& sample, double& farthest) {
      double entered = std::numeric_limits<double>::infinity();
      for (const PixelTriangle& t : entering)
        if (insideBy(t, sample) > doubt_) entered = std::min(entered, depthAt(t, sample.x, sample.y));
      for (const PixelTriangle& t : leaving) {
        const double depth = depthAt(t, sample.x, sample.y);
        if (insideBy(t, sample) > -doubt_ && depth < entered) farthest = std::min(farthest, depth);
      }
    });
  }

  [[nodiscard]] bool hides(const PixelTriangle& triangle) {
    bool hidden = true;
    forEachSample([&](const Vec2& sample, double& farthest) {
      hidden = hidden && !(insideBy(triangle, sample) > doubt_ && triangle[0].z < farthest);
    });
    return hidden;
  }

 private:
  template <class Action>
  void forEachSample(const Action& action) {
    for (std::size_t i = 0; i < farthest_.size(); ++i)
      action(Vec2(static_cast<double>(i % 48) + 0.5, static_cast<double>(i / 48) + 0.5), farthest_[i]);
  }

  double doubt_;
  std::vector<double> farthest_ = std::vector<double>(48 * 40, std::numeric_limits<double>::infinity());
};

// Whatever is skipped as it would change nothing.
TEST(OcclusionBuffer, SlabsAreAsTheyAreSampleBySample) {
  std::mt19937 random(5);
  const auto below = [&](double most) { return std::uniform_real_distribution<double>(0, most)(random); };
  const auto triangle = [&](double size, double slope) {
    for (;;) {
      const Vec2 place(below(60) - 6, below(52) - 6);
      const double depth = std::floor(below(40)), rise = below(2 * slope) - slope;
      PixelTriangle t;
      for (Vec3& corner : t) {
        const Vec2 at = place + Vec2(below(size), below(size));
        corner = Vec3(at, depth + rise * (at.x - place.x));
      }
      if (std::abs(glm::cross(t[1] - t[0], t[2] - t[0]).z) > 4) return t;  // narrow ones cover less
    }
  };
  int hidden = 0, seen = 0;
  for (int picture = 0; picture < 20; ++picture) {
    OcclusionBuffer buffer = bufferOf({48, 40});
    SlabModel inFavour(1), against(-1);
    for (int slab = 0; slab < 6; ++slab) {
      std::vector<PixelTriangle> leaving(slab % 2 ? 12 : 1), entering(slab % 2 ? 6 : 1);
      for (PixelTriangle& t : leaving) t = triangle(40, 1);
      for (PixelTriangle& t : entering) t = triangle(30, 1);
      buffer.cover(leaving, entering);
      for (SlabModel* model : {&inFavour, &against}) model->cover(leaving, entering);
    }
    for (int i = 0; i < 50; ++i) {
      PixelTriangle candidate = triangle(12, 0);
      for (Vec3& corner : candidate) corner.z += 0.5;
      const bool hides = buffer.hides(candidate);
      if (hides)
        EXPECT_TRUE(inFavour.hides(candidate)) << picture << ", " << i;
      else
        EXPECT_FALSE(against.hides(candidate)) << picture << ", " << i;
      ++(hides ? hidden : seen);
    }
  }
  EXPECT_GT(hidden, 200);
  EXPECT_GT(seen, 200);
}

}  // namespace
}  // namespace luxo
