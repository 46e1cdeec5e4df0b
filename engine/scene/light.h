// SPDX-License-Identifier: Apache-2.0
// A light shines from the node that carries it: a point light from the node's origin, a directional one along
// its -Z, a spot, which is a point light with a cone, from the origin around -Z.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "math/animated.h"
#include "math/vec.h"
#include "scene/ids.h"
#include "scene/spot_cone.h"

namespace luxo {

inline constexpr std::uint32_t kMaxShadowMapSize = 8192, kMaxPcf = 15;

/// A depth map seen from a light, and what keeps a surface from shading itself by mistake: each distance is
/// as much nearer to the light as the point is taken to be.
struct ShadowMap {
  std::uint32_t size = 2048;         ///< texels along a side, up to kMaxShadowMapSize
  Animated<double> bias = 0.0;       ///< metres
  Animated<double> slopeBias = 0.0;  ///< times what a texel is wide there, times the tangent of N and L
  /// The point moves along its normal by so many texels' width, times the sine of N and L.
  Animated<double> normalOffset = 0.0;
  std::uint32_t pcf = 1;       ///< the mean of so many texels in a square's side; odd, up to kMaxPcf
  bool receiverPlane = false;  ///< each texel is compared with the plane of the surface there

  [[nodiscard]] bool movesWithTime() const {
    return bias.movesWithTime() || slopeBias.movesWithTime() || normalOffset.movesWithTime();
  }
};

/// The half-angles of a spot's cone, radians (scene/spot_cone.h): 0 <= inner < outer <= a quarter turn.
struct Spot {
  Animated<double> inner = 0.0, outer = kPi / 4;

  [[nodiscard]] bool movesWithTime() const { return inner.movesWithTime() || outer.movesWithTime(); }
};

struct Light {
  enum class Type { Point, Directional };
  enum class Attenuation {
    None,           ///< the same at any distance
    InverseSquare,  ///< divided by the squared distance in metres; a directional light has no distance
  };
  enum class Shadow {
    None,
    Exact,  ///< right in every pixel; hard, or, of a light with a radius, of as many hard ones as are asked
            ///< for
    /// Of a depth map, with its errors: for teaching; soft, by an estimate, of a light with a radius. Casters
    /// that are seen through are in no map: their shadows are exact ones, of `shadowSamples` points.
    Map,
    Planar,  ///< on one plane alone, of flattened meshes: for teaching
  };

  Type type = Type::Point;
  Animated<Vec3> color = Vec3(1);  ///< linear RGB
  Animated<double> intensity = 1.0;
  Attenuation attenuation = Attenuation::None;
  std::optional<Spot> spot = {};  ///< of a point light alone
  Shadow shadow = Shadow::None;
  /// Of a light with exact shadows, which are soft then. A point light: metres, of a luminous ball that looks
  /// like an evenly bright disc from everywhere afar. A directional light: radians, the half-angle of its
  /// disc.
  Animated<double> radius = 0.0;
  std::uint32_t shadowSamples = 16;  ///< points of what has a radius, from 1 to kMaxShadowSamples
  ShadowMap map = {};
  NodeId shadowPlane = {};           ///< what a planar shadow falls on: a flat node
  std::vector<NodeId> casters = {};  ///< who casts the shadow; empty = everything

  [[nodiscard]] bool movesWithTime() const {
    return color.movesWithTime() || intensity.movesWithTime() || radius.movesWithTime() ||
           map.movesWithTime() || (spot && spot->movesWithTime());
  }
};

inline constexpr std::uint32_t kMaxShadowSamples = 1024;

/// color * intensity then. Throws Error(Scene) naming the node and the value: both, and their product, must
/// be from 0 to kMaxLight, the color to kMaxSceneNumber (scene/ranges.h). With `cutNumbers`, what formulas
/// give beyond that is cut off there, and how many numbers that were is added.
[[nodiscard]] Vec3 radianceAt(const Light& light, const Moment& moment,
                              const std::function<std::string()>& nodeName,
                              std::uint32_t* cutNumbers = nullptr);

/// A ShadowMap's numbers then.
struct ShadowMapThen {
  std::uint32_t size = 2048;
  double bias = 0, slopeBias = 0, normalOffset = 0;
  std::uint32_t pcf = 1;
  bool receiverPlane = false;
  double radius = 0;  ///< of the light

  friend bool operator==(const ShadowMapThen&, const ShadowMapThen&) = default;
};
/// Throws Error(Scene) naming the node and the value: biases must be from 0 to kMaxSceneNumber.
[[nodiscard]] ShadowMapThen shadowMapAt(const Light& light, const Moment& moment,
                                        const std::function<std::string()>& nodeName);

/// The radius then. Throws Error(Scene) naming the node and the value: it must be from 0 to kMaxSceneNumber
/// metres, or, of a directional light, to a quarter turn.
[[nodiscard]] double radiusAt(const Light& light, const Moment& moment,
                              const std::function<std::string()>& nodeName);

/// The spot's cone then, around `axis` (unit, world). Throws Error(Scene) naming the node and the value: the
/// light must be a point light, `outer` from kLeastSpotAngle to kMaxLightAngle (scene/ranges.h), `inner` from
/// 0 to below that. Required: light.spot.
[[nodiscard]] SpotCone spotConeAt(const Light& light, const Vec3& axis, const Moment& moment,
                                  const std::function<std::string()>& nodeName);

}  // namespace luxo
