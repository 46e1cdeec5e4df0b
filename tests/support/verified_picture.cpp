// SPDX-License-Identifier: Apache-2.0
#include "support/verified_picture.h"

#include "reference/reference.h"

namespace luxo::test {

VerifiedPictureTest::Verified VerifiedPictureTest::verified(const Snapshot& snapshot, double shellPx) {
  const auto show = [&](Output output) {
    return renderer().render(snapshot,
                             {.shading = Shading::Exact, .output = output, .shellTolerancePx = shellPx});
  };
  const Picture color = show(Output::Color);
  const Snapshot exact = withExactShadows(snapshot);
  return {color.statistics, verify(exact, castPicture(exact),
                                   {.color = color.image,
                                    .position = show(Output::Position).image,
                                    .normal = show(Output::Normal).image,
                                    .uv = show(Output::Uv).image,
                                    .id = show(Output::Id).image},
                                   {.colors = approximateShadows(snapshot) == 0})};
}

VerifiedPictureTest::Verified VerifiedPictureTest::expectWhole(const Snapshot& snapshot,
                                                               std::uint64_t pixels) {
  Verified found = verified(snapshot);
  EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
  EXPECT_GE(found.verification.coverage.both, pixels);
  EXPECT_EQ(found.verification.nanPixels, 0U);
  return found;
}

VerifiedPictureTest::Verified VerifiedPictureTest::expectTheTruth(const Snapshot& snapshot,
                                                                  std::uint64_t pixels) {
  Verified found = expectWhole(snapshot, pixels);
  const Verification& verification = found.verification;
  EXPECT_EQ(verification.coverage.undecided, 0U);
  EXPECT_EQ(verification.coverage.beyond, 0U) << "coverage wrong farther than 0.01 px from the silhouette";
  EXPECT_LE(verification.positionPx.max, 1e-3);
  EXPECT_GE(verification.color.psnrLinear, 110);
  return found;
}

VerifiedPictureTest::Verified VerifiedPictureTest::expectTrueColors(const Snapshot& snapshot,
                                                                    std::uint64_t pixels) {
  Verified found = expectWhole(snapshot, pixels);
  const Verification& v = found.verification;
  const double light = tolerance(0, 1e-3) * static_cast<double>(v.coverage.both);
  EXPECT_EQ(v.wrong.total(), v.wrong.light)
      << v.wrong.hitMiss << " hit or miss, " << v.wrong.layer << " layer, " << v.wrong.point << " point";
  EXPECT_LE(static_cast<double>(v.wrong.light), light);
  EXPECT_LE(v.color.difference.p999, tolerance(0.1, 1) / 255);
  return found;
}

}  // namespace luxo::test
