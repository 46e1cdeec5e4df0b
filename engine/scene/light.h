// SPDX-License-Identifier: Apache-2.0
// A light shines from the node that carries it: a point light from the node's origin, a directional one along
// its -Z.
#pragma once

#include <string_view>
#include <vector>

#include "math/vec.h"
#include "scene/ids.h"

namespace luxo {

struct Light {
  enum class Type { Point, Directional };
  enum class Attenuation {
    None,           ///< the same at any distance
    InverseSquare,  ///< divided by the squared distance in metres; a directional light has no distance
  };
  enum class Shadow {
    None,
    Exact,  ///< closed form: so far one paraboloid shade with the light at its focus
    Map,    ///< not supported yet
  };

  Type type = Type::Point;
  Vec3 color{1};  ///< linear RGB
  double intensity = 1;
  Attenuation attenuation = Attenuation::None;
  Shadow shadow = Shadow::None;
  std::vector<NodeId> casters = {};  ///< who casts the shadow; empty = everything
};

/// Throws Error(Scene) naming the node and the value: colour and intensity must be finite and not negative.
void validate(const Light& light, std::string_view nodeName);

}  // namespace luxo
