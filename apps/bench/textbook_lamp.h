// SPDX-License-Identifier: Apache-2.0
// Luxo Grandpa as a first program for a graphics lecture writes it: single precision, parametric surfaces as
// strips of N x M quads, one object after the other. Shares no code with the engine but its vectors.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/vec.h"

namespace luxo::bench {

struct VertexData {
  Vec3f pos, norm;
  Vec2f tex;
};
static_assert(sizeof(VertexData) == 32);

/// Strip i holds 2 (M + 1) vertices: (j/M, i/N), (j/M, (i+1)/N) for j = 0..M.
struct ParamSurface {
  std::uint32_t nStrips = 0, nVtxStrip = 0;
  std::vector<VertexData> vtxData;
};

struct Material {
  Vec3f ka, kd, ks;
  float shine;
};

struct Object {
  ParamSurface geometry;
  Material material;
  bool isShade = false;
};

/// Object to world and back: points M p, normals transpose(Minv) n.
struct Pose {
  Mat4f M{1}, Minv{1};
};

inline constexpr std::size_t kObjects = 9;

/// Floor, base, its top, then joint and rod in turn, and the shade.
[[nodiscard]] std::array<Object, kObjects> lampObjects();

/// Where everything is at a time.
struct LampState {
  Mat4f V{1}, P{1};  ///< depth 0 at the front plane, 1 at the back plane
  Vec3f wEye{0};
  std::array<Pose, kObjects> poses;
  Vec3f wFocus{0}, wShadeAxis{0};
};

[[nodiscard]] LampState lampAt(float time, float aspect);

inline constexpr float kShadeFocalLength = 0.2f, kShadeHeight = 1.8f;

}  // namespace luxo::bench
