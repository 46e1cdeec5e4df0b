// SPDX-License-Identifier: Apache-2.0
#include "random/hard_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "surface/surface_triangles.h"

namespace luxo::random {
namespace {

constexpr int kSpots = 256;  // of the surfaces: about what they extend over, and whether a camera sees any
constexpr int kTries = 10;   // cameras, for one that sees something

/// A point of a surface in the world; `normal` and `along` (a tangent) are unit, any where there is none.
struct Spot {
  Vec3 position{0}, normal{0, 1, 0}, along{1, 0, 0};
};

Vec3 direction(Numbers& n) {
  for (;;) {
    const double x = n.between(-1, 1), y = n.between(-1, 1), z = n.between(-1, 1);
    const Vec3 v(x, y, z);
    const double length = glm::length(v);
    if (length > 0.05 && length < 1) return v / length;
  }
}

Vec3 unitOr(const Vec3& v, const Vec3& other) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : other;
}

/// In the object's space, with two tangents.
struct PointOfSurface {
  Vec3 position, du, dv;
};

PointOfSurface pointOf(const Surface& surface, std::span<const double> parameters, Numbers& n) {
  const auto patch = static_cast<std::uint32_t>(n.whole(0, static_cast<int>(surface.patchCount()) - 1));
  const Domain& domain = surface.patchDomain(patch);
  const double u[] = {n.between(domain.u.lo, domain.u.hi)}, v[] = {n.between(domain.v.lo, domain.v.hi)};
  const SurfacePoints points = surface.evaluate(patch, u, v, parameters);
  return {points.position[0], points.du[0], points.dv[0]};
}

PointOfSurface pointOf(const SurfaceTriangles& triangles, Numbers& n) {
  const auto [a, b, c] =
      triangles.points(static_cast<std::uint32_t>(n.whole(0, static_cast<int>(triangles.count) - 1)));
  const double along = n.between(0, 1), across = n.between(0, 1 - along);
  return {a + along * (b - a) + across * (c - a), b - a, c - a};
}

std::optional<Spot> spotOf(const Snapshot& snapshot, Numbers& n) {
  if (snapshot.nodes.empty()) return std::nullopt;
  const SnapshotNode& node =
      snapshot.nodes[static_cast<std::size_t>(n.whole(0, static_cast<int>(snapshot.nodes.size()) - 1))];
  const PointOfSurface point = node.surface.triangles() ? pointOf(*node.surface.triangles(), n)
                                                        : pointOf(node.surface, node.parameters, n);
  const Transform& t = node.worldFromObject;
  const Vec3 du = transformDirection(t, point.du), dv = transformDirection(t, point.dv);
  const Vec3 position = transformPoint(t, point.position);
  if (!std::isfinite(position.x + position.y + position.z)) return std::nullopt;
  const double turn = n.between(0, kTau);
  const Vec3 along = unitOr(
      std::cos(turn) * unitOr(du, Vec3(1, 0, 0)) + std::sin(turn) * unitOr(dv, Vec3(0, 0, 1)), Vec3(1, 0, 0));
  Vec3 normal = unitOr(glm::cross(unitOr(du, Vec3(1, 0, 0)), unitOr(dv, Vec3(0, 0, 1))), Vec3(0, 1, 0));
  if (n.chance(0.5)) normal = -normal;
  return Spot{position, normal, along};
}

/// Where the surfaces are.
struct Stage {
  std::vector<Spot> spots;
  Vec3 center{0};
  double radius = 1;

  Stage(const Snapshot& snapshot, Numbers& n) {
    Vec3 lo(std::numeric_limits<double>::infinity()), hi = -lo;
    for (int k = 0; k < kSpots; ++k)
      if (const auto spot = spotOf(snapshot, n)) {
        spots.push_back(*spot);
        lo = glm::min(lo, spot->position);
        hi = glm::max(hi, spot->position);
      }
    if (spots.empty())
      spots.emplace_back();
    else
      center = 0.5 * (lo + hi),
      radius = std::max(0.5 * glm::length(hi - lo), 1e-12 + 1e-9 * glm::length(center));
  }
};

struct Sight {
  Vec3 eye{0}, target{0}, up{0, 1, 0};
  double fov = 0.8, near = 0.1;
  std::optional<double> height = {};
};

constexpr double kDegree = kTau / 360;

using Make = Sight (*)(const Stage& stage, const Spot& spot, Numbers& n);
struct CameraKind {
  const char* name;
  Make make;
};

Sight around(const Stage& s, const Spot& spot, Numbers& n) {
  const double distance = s.radius * n.between(0.6, 3);
  const Vec3 target = glm::mix(s.center, spot.position, n.between(0, 0.5));
  Vec3 way = direction(n);
  if (n.chance(0.4)) way = unitOr(Vec3(way.x, 0, way.z), Vec3(1, 0, 0));  // level, as people look
  return {.eye = target + distance * way, .target = target, .fov = n.between(30, 70) * kDegree};
}

Sight far(const Stage& s, const Spot&, Numbers& n) {
  const double distance = s.radius * n.magnitude(4, 60);
  return {.eye = s.center + distance * direction(n),
          .target = s.center,
          .fov = std::max(2 * std::atan(s.radius / distance * n.between(0.3, 1.2)), 5 * kDegree)};
}

Sight close(const Stage& s, const Spot& spot, Numbers& n) {
  const double distance = s.radius * n.magnitude(0.01, 0.4);
  const Vec3 aside = 0.5 * distance * direction(n);
  return {.eye = spot.position + distance * spot.normal + aside,
          .target = spot.position,
          .fov = n.between(30, 90) * kDegree};
}

Sight inside(const Stage& s, const Spot&, Numbers& n) {
  const double aside = 0.6 * s.radius * n.between(0, 1);
  const Vec3 eye = s.center + aside * direction(n);
  return {.eye = eye, .target = eye + s.radius * direction(n), .fov = n.between(40, 120) * kDegree};
}

Sight grazing(const Stage& s, const Spot& spot, Numbers& n) {
  const double distance = s.radius * n.magnitude(0.05, 2);
  return {.eye = spot.position - distance * spot.along + distance * n.magnitude(1e-3, 0.15) * spot.normal,
          .target = spot.position,
          .fov = n.magnitude(5, 60) * kDegree};
}

Sight onSurface(const Stage& s, const Spot& spot, Numbers& n) {
  const double turn = n.between(-0.3, 1.2);
  return {.eye = spot.position,
          .target = spot.position + s.radius * (std::cos(turn) * spot.along + std::sin(turn) * spot.normal),
          .fov = n.between(30, 130) * kDegree};
}

Sight telephoto(const Stage& s, const Spot& spot, Numbers& n) {
  const double distance = s.radius * n.magnitude(10, 2000);
  const double seen = s.radius * n.magnitude(0.003, 0.5);
  return {.eye = spot.position + distance * direction(n),
          .target = spot.position,
          .fov = 2 * std::atan(seen / distance)};
}

Sight wide(const Stage& s, const Spot& spot, Numbers& n) {
  const double distance = s.radius * n.magnitude(0.02, 1.5);
  return {.eye = spot.position + distance * direction(n),
          .target = glm::mix(spot.position, s.center, n.between(0, 1)),
          .fov = n.between(100, 170) * kDegree};
}

Sight parallel(const Stage& s, const Spot& spot, Numbers& n) {
  const bool level = n.chance(0.25);  // along the surface
  const Vec3 way = level ? spot.along : direction(n);
  const double distance = s.radius * (n.chance(0.25) ? n.between(-0.3, 0.8) : n.between(1.5, 5));
  return {.eye = spot.position + distance * way,
          .target = spot.position + (distance - s.radius) * way,
          .height = s.radius * n.magnitude(0.02, 3)};
}

/// How often each is drawn is how often it stands here.
constexpr std::array kKinds = {
    CameraKind{"around", around},
    CameraKind{"around", around},
    CameraKind{"around", around},
    CameraKind{"far", far},
    CameraKind{"near", close},
    CameraKind{"near", close},
    CameraKind{"inside", inside},
    CameraKind{"grazing", grazing},
    CameraKind{"grazing", grazing},
    CameraKind{"on_surface", onSurface},
    CameraKind{"telephoto", telephoto},
    CameraKind{"wide", wide},
    CameraKind{"wide", wide},
    CameraKind{"orthographic", parallel},
    CameraKind{"orthographic", parallel},
};

Json jsonOf(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Vec3 vectorOf(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

Json jsonOf(const Sight& s) {
  Json json = {{"eye", jsonOf(s.eye)}, {"look_at", jsonOf(s.target)}, {"up", jsonOf(s.up)}, {"near", s.near}};
  if (s.height) {
    json["type"] = "orthographic";
    json["height"] = *s.height;
  } else {
    json["fov_y"] = s.fov;
  }
  return json;
}

/// Whether any of the spots lies in a picture of 4:3 behind the near plane.
bool showsAny(const Stage& stage, const Camera& camera) {
  const View view =
      viewAt(camera, {}, {4, 3}, Box{stage.center - 2 * stage.radius, stage.center + 2 * stage.radius});
  return std::ranges::any_of(stage.spots, [&](const Spot& spot) {
    const Vec3 eye = eyeFromWorldPoint(view, spot.position);
    if (!(-eye.z > view.near)) return false;
    const Vec2 pixel = pixelFromEye(view, eye);
    return pixel.x > 0.2 && pixel.x < 3.8 && pixel.y > 0.2 && pixel.y < 2.8;
  });
}

}  // namespace

Camera cameraOf(const Json& json) {
  Camera camera;
  camera.eye = vectorOf(json.at("eye"));
  camera.lookAt = vectorOf(json.at("look_at"));
  camera.up = vectorOf(json.at("up"));
  camera.near = json.at("near").get<double>();
  if (json.contains("height")) {
    camera.projection = Projection::Orthographic;
    camera.height = json.at("height").get<double>();
  } else {
    camera.fovY = json.at("fov_y").get<double>();
  }
  return camera;
}

HardCamera hardCamera(const Snapshot& snapshot, Numbers& n) {
  const Stage stage(snapshot, n);
  for (int k = 1;; ++k) {
    const CameraKind& kind = n.oneOf(std::span<const CameraKind>(kKinds));
    const Spot& spot = n.oneOf(std::span<const Spot>(stage.spots));
    Sight sight = kind.make(stage, spot, n);
    sight.up = n.chance(0.4) ? direction(n) : Vec3(0, 1, 0);
    sight.near = rounded(std::max(glm::distance(sight.eye, sight.target), 0.1 * stage.radius) *
                         n.magnitude(1e-4, 3e-2));
    sight.fov = std::clamp(sight.fov, 1e-4 * kDegree, 170 * kDegree);
    const auto shorter = [](const Vec3& v) {
      return Vec3(rounded(v.x, 12), rounded(v.y, 12), rounded(v.z, 12));
    };
    sight.eye = shorter(sight.eye);
    sight.target = shorter(sight.target);
    sight.up = Vec3(rounded(sight.up.x), rounded(sight.up.y), rounded(sight.up.z));
    sight.fov = rounded(sight.fov, 6);
    if (sight.height) sight.height = rounded(*sight.height, 6);
    if (sight.eye == sight.target) continue;
    HardCamera camera{kind.name, jsonOf(sight)};
    if (k >= kTries || showsAny(stage, cameraOf(camera.json))) return camera;
  }
}

}  // namespace luxo::random
