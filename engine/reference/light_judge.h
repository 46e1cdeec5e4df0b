// SPDX-License-Identifier: Apache-2.0
// Whether a pixel that shows the right point shows it in the right light: no shadow where there is none, none
// missing, the right texel, all that is seen through; and in exact shading no colour that nothing nearby has.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "reference/compared_pixels.h"

namespace luxo::reference {

/// Linear: smaller differences are not looked into for a light's shadow.
inline constexpr double kOtherLight = 1e-4;
/// Linear: devices filter with few bits. A colour that is neither a texture's nor seen through is looked into
/// for other reasons than shadows from there on, too.
inline constexpr double kOtherTexture = 1.0 / 255;

enum class LightVerdict {
  Right,
  TooDark,  ///< in a shadow that there is not, or without a texel's or a layer's light
  TooBright,
  OtherColor,  ///< of exact shading, and none that lights or what is nearby explain
  Unjudged     ///< the truth does not know it, or the picture does not tell enough
};

/// Borders of shadows are right on either side. Cost of a pixel: some hundred rays.
class LightJudge : ComparedPixels {
 public:
  /// `coarse`: borders of shadows are looked for in four directions alone; what has one nearby may be wrong
  /// then that would not be.
  LightJudge(const ComparedPixels& pixels, const Caster& caster, bool coarse);

  /// Of a pixel that shows what the truth sees, and a colour that is so much off.
  [[nodiscard]] LightVerdict of(std::uint32_t i, double off) const;

 private:
  /// A light of which the colour shown may have it that it is seen where it is not, or the other way round;
  /// or of which more or less is seen than a map may estimate.
  struct Turned {
    std::optional<std::uint32_t> light;  ///< index into Snapshot::lights; nothing of an estimate
    bool visible;                        ///< in truth
    Vec3 change;                         ///< of the colour; of an estimate at most
    bool atBorder = false;

    /// What of a colour that is so much off the change leaves.
    [[nodiscard]] Vec3 leaves(const Vec3& off) const;
  };
  /// Whether single precision cannot tell on which side of the horizon a light is.
  [[nodiscard]] bool isOnHorizon(const SnapshotLight& light, const Hit& hit, const Vec3& normal) const {
    return std::abs(glm::dot(Caster::towardLight(light, hit), normal)) <=
           kCosineRounding * caster_.cosineLoss(light, hit);
  }
  [[nodiscard]] LightVerdict byLayers(std::uint32_t i) const;
  [[nodiscard]] LightVerdict byColor(std::uint32_t i, double reach, double tolerance) const;
  [[nodiscard]] LightVerdict ofMesh(std::uint32_t i) const;
  [[nodiscard]] LightVerdict ofPoint(std::uint32_t i) const;
  [[nodiscard]] std::pair<std::optional<Hit>, Vec2> litPoint(std::uint32_t i, std::uint32_t node) const;
  [[nodiscard]] Turned estimate(const Vec3& share, const Caster::SeenPart& part, const Vec3& off) const;
  [[nodiscard]] std::optional<double> reachOfColors(const Caster::Sight& sight) const;
  /// Of a colour.
  struct Unexplained {
    Vec3 off;
    bool byTurned;  ///< a light's visibility, turned round, would explain some of it
  };
  [[nodiscard]] Unexplained withoutBorders(std::uint32_t i, Vec3 off, std::vector<Turned> lights,
                                           const Vec2& center) const;
  void findBorders(std::uint32_t i, const Vec2& center, std::vector<Turned>& lights) const;

  const Caster& caster_;
  bool coarse_;
  bool hasEstimates_;  ///< of some light a map estimates how much is seen
  bool occluded_;      ///< of the ambient light the picture knows less than the truth: no colour is the same
};

}  // namespace luxo::reference
