// SPDX-License-Identifier: Apache-2.0
#include "textbook_lamp.h"

#include <cmath>

namespace luxo::bench {
namespace {

constexpr std::uint32_t kN = 64, kM = 64;
constexpr float kPiF = static_cast<float>(kPi);

/// `eval(u, v, pos, norm)` for u and v in 0..1.
template <class Eval>
ParamSurface create(Eval eval) {
  ParamSurface surface{.nStrips = kN, .nVtxStrip = (kM + 1) * 2, .vtxData = {}};
  const auto genVertexData = [&](float u, float v) {
    VertexData vd{.pos = {}, .norm = {}, .tex = Vec2f(u, v)};
    eval(u, v, vd.pos, vd.norm);
    return vd;
  };
  for (std::uint32_t i = 0; i < kN; ++i)
    for (std::uint32_t j = 0; j <= kM; ++j) {
      surface.vtxData.push_back(genVertexData(float(j) / kM, float(i) / kN));
      surface.vtxData.push_back(genVertexData(float(j) / kM, float(i + 1) / kN));
    }
  return surface;
}

ParamSurface rectangle(float size) {
  return create([=](float u, float v, Vec3f& pos, Vec3f& norm) {
    pos = Vec3f(size * (u - 0.5f), 0, -size * (v - 0.5f));
    norm = Vec3f(0, 1, 0);
  });
}

ParamSurface disk(float r) {
  return create([=](float u, float v, Vec3f& pos, Vec3f& norm) {
    const float angle = 2 * kPiF * u;
    pos = Vec3f(r * v * std::cos(angle), 0, -r * v * std::sin(angle));
    norm = Vec3f(0, 1, 0);
  });
}

ParamSurface cylinder(float r, float h) {
  return create([=](float u, float v, Vec3f& pos, Vec3f& norm) {
    const float angle = 2 * kPiF * u;
    norm = Vec3f(std::cos(angle), 0, -std::sin(angle));
    pos = Vec3f(r * norm.x, h * v, r * norm.z);
  });
}

ParamSurface sphere(float r) {
  return create([=](float u, float v, Vec3f& pos, Vec3f& norm) {
    const float angle = 2 * kPiF * u, latitude = kPiF * (v - 0.5f);
    norm = Vec3f(std::cos(latitude) * std::cos(angle), std::sin(latitude),
                 -std::cos(latitude) * std::sin(angle));
    pos = r * norm;
  });
}

ParamSurface paraboloid(float f, float h) {
  return create([=](float u, float v, Vec3f& pos, Vec3f& norm) {
    const float angle = 2 * kPiF * u, rho = 2 * std::sqrt(f * h) * v;
    pos = Vec3f(rho * std::cos(angle), rho * rho / (4 * f), -rho * std::sin(angle));
    norm = Vec3f(pos.x, -2 * f, pos.z);
  });
}

Mat4f translateMatrix(const Vec3f& t) {
  Mat4f m(1);
  m[3] = Vec4f(t, 1);
  return m;
}

/// Rodrigues' formula.
Mat4f rotationMatrix(float angle, const Vec3f& axis) {
  const Vec3f d = glm::normalize(axis);
  const float c = std::cos(angle), s = std::sin(angle);
  Mat4f m(1);
  for (int i = 0; i < 3; ++i) {
    Vec3f e(0);
    e[i] = 1;
    m[i] = Vec4f(e * c + d * (d[i] * (1 - c)) + glm::cross(d, e) * s, 0);
  }
  return m;
}

Pose child(const Pose& parent, const Vec3f& pos, float rotAngle, const Vec3f& rotAxis) {
  return {.M = parent.M * translateMatrix(pos) * rotationMatrix(rotAngle, rotAxis),
          .Minv = rotationMatrix(-rotAngle, rotAxis) * translateMatrix(-pos) * parent.Minv};
}

Pose child(const Pose& parent, const Vec3f& pos) { return child(parent, pos, 0, Vec3f(0, 1, 0)); }

Mat4f viewMatrix(const Vec3f& wEye, const Vec3f& wLookat, const Vec3f& wVup) {
  const Vec3f w = glm::normalize(wEye - wLookat), u = glm::normalize(glm::cross(wVup, w)),
              v = glm::cross(w, u);
  return glm::transpose(Mat4f(Vec4f(u, 0), Vec4f(v, 0), Vec4f(w, 0), Vec4f(0, 0, 0, 1))) *
         translateMatrix(-wEye);
}

Mat4f projectionMatrix(float fov, float asp, float fp, float bp) {
  const float sy = 1 / std::tan(fov / 2);
  return {{sy / asp, 0, 0, 0}, {0, sy, 0, 0}, {0, 0, -bp / (bp - fp), -1}, {0, 0, -fp * bp / (bp - fp), 0}};
}

}  // namespace

std::array<Object, kObjects> lampObjects() {
  const auto material = [](const Vec3f& kd, float ks, float shine) {
    return Material{.ka = kPiF * kd, .kd = kd, .ks = Vec3f(ks), .shine = shine};
  };
  const Material lamp = material({0.35f, 0.06f, 0.05f}, 0.8f, 60);
  const Material joint = material({0.5f, 0.42f, 0.12f}, 1.5f, 80);
  const Material floor = material({0.32f, 0.28f, 0.24f}, 0.15f, 40);
  return {{{rectangle(60), floor},
           {cylinder(2, 0.4f), lamp},
           {disk(2), lamp},
           {sphere(0.35f), joint},
           {cylinder(0.15f, 4), lamp},
           {sphere(0.35f), joint},
           {cylinder(0.15f, 4), lamp},
           {sphere(0.35f), joint},
           {paraboloid(kShadeFocalLength, kShadeHeight), lamp, true}}};
}

LampState lampAt(float time, float aspect) {
  const Pose world;
  const Pose joint1 = child(world, {0, 0.4f, 0}, 0.5f * time, {1, 5, 1});
  const Pose joint2 = child(joint1, {0, 4, 0}, 0.75f * time, {2, 6, -1});
  const Pose joint3 = child(joint2, {0, 4, 0}, 1.0f * time, {2, 1, 2});
  const Pose shade = child(joint3, {0, 0.3f, 0});
  const Vec3f wEye(18 * std::sin(time / 4), 9, 18 * std::cos(time / 4));
  return {.V = viewMatrix(wEye, Vec3f(0, 5, 0), Vec3f(0, 1, 0)),
          .P = projectionMatrix(50 * kPiF / 180, aspect, 1, 100),
          .wEye = wEye,
          .poses = {world, world, child(world, {0, 0.4f, 0}), joint1, joint1, joint2, joint2, joint3, shade},
          .wFocus = Vec3f(shade.M * Vec4f(0, kShadeFocalLength, 0, 1)),
          .wShadeAxis = Vec3f(shade.M * Vec4f(0, 1, 0, 0))};
}

}  // namespace luxo::bench
