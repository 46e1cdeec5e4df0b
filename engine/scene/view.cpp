// SPDX-License-Identifier: Apache-2.0
#include "scene/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/error.h"

namespace luxo {

namespace {

/// Sine of the angle below which `up` counts as parallel to the view direction: its rounding, 1e-16, then
/// turns the picture by up to 1e-7 rad, a ten-thousandth of a pixel.
constexpr double kParallelSine = 1e-9;

/// Room left at both ends of a fitted depth range, relative to it: shells reach out of what they hold by a
/// few hundredths of its size, and where the near plane cuts a shell searches are not certain. The depth
/// buffer loses an eighth of its precision.
constexpr double kDepthRoom = 1.0 / 16;

[[noreturn]] void reject(const Camera& camera, const std::string& what, std::string hint = {}) {
  throw Error(ErrorKind::Scene, fmt::format("camera '{}': {}", camera.name, what), std::move(hint));
}

Vec3 finiteAt(const Camera& camera, std::string_view name, const Animated<Vec3>& value,
              const Moment& moment) {
  const Vec3 v = value.at(moment);
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
    reject(camera,
           fmt::format("{} is ({}, {}, {}) at time {}; it must be finite", name, v.x, v.y, v.z, moment.time));
  return v;
}

void requireAboveZero(const Camera& camera, std::string_view name, double value) {
  if (!(value > 0 && std::isfinite(value)))
    reject(camera, fmt::format("{} is {}; it must be above 0 and finite", name, value));
}

/// Rows right, up, backward. Where `up` gives no direction, +Y takes its place, or -Z when looking along Y.
Mat3 eyeFromWorldRotation(const Vec3& forward, const Vec3& up) {
  Vec3 right = glm::cross(forward, unit(up));
  if (glm::length(right) < kParallelSine) right = glm::cross(forward, Vec3(0, 1, 0));
  if (glm::length(right) < kParallelSine) right = glm::cross(forward, Vec3(0, 0, -1));
  // A short cross product is rounded to a direction that is perpendicular only to 1e-7: finish the job.
  right = unit(right);
  right = unit(right - glm::dot(right, forward) * forward);
  return glm::transpose(Mat3(right, glm::cross(right, forward), -forward));
}

void fitDepthRange(const Camera& camera, double height, const Box& bounds, View& view) {
  view.far = view.near + height;
  if (bounds.empty()) return;
  const Vec3 forward = view.forward();
  const double center = glm::dot(forward, bounds.center() - view.eye);
  const double reach = glm::dot(glm::abs(forward), 0.5 * bounds.extent());
  if (!std::isfinite(center) || !std::isfinite(reach))
    reject(camera, "cannot fit an orthographic depth range: the scene's bounds are infinite",
           "use a perspective camera");
  const double room = kDepthRoom * std::max(2 * reach, height);
  view.near = std::max(view.near, center - reach - room);
  view.far = std::max(view.near + room, center + reach + room);
}

Mat4 perspectiveMatrix(const View& view) {
  Mat4 clip(0);
  clip[0][0] = 1 / view.halfExtent.x;
  clip[1][1] = 1 / view.halfExtent.y;
  clip[2][3] = -1;
  clip[3][2] = view.near;
  return clip;
}

Mat4 orthographicMatrix(const View& view) {
  const double range = view.far - view.near;
  Mat4 clip(1);
  clip[0][0] = 1 / view.halfExtent.x;
  clip[1][1] = 1 / view.halfExtent.y;
  clip[2][2] = 1 / range;
  clip[3][2] = view.far / range;
  return clip;
}

}  // namespace

View viewAt(const Camera& camera, const Moment& moment, PixelSize size, const Box& sceneBounds) {
  if (size.width < 1 || size.height < 1)
    reject(camera, fmt::format("cannot make a picture of {}x{} pixels", size.width, size.height));
  const double near = camera.near.at(moment), fovY = camera.fovY.at(moment),
               height = camera.height.at(moment);
  requireAboveZero(camera, "near", near);
  const bool perspective = camera.projection == Projection::Perspective;
  if (perspective && !(fovY > 0 && fovY < kPi))
    reject(camera, fmt::format("fov_y is {} degrees; it must be above 0 and below 180", fovY * (180 / kPi)));
  if (!perspective) requireAboveZero(camera, "height", height);

  const Vec3 eye = finiteAt(camera, "eye", camera.eye, moment);
  const Vec3 lookAt = finiteAt(camera, "look_at", camera.lookAt, moment);
  const Vec3 up = finiteAt(camera, "up", camera.up, moment);
  const Vec3 forward = unit(0.5 * lookAt - 0.5 * eye);
  if (forward == Vec3(0))
    reject(camera,
           fmt::format("eye and look_at are both ({}, {}, {}) at time {}", eye.x, eye.y, eye.z, moment.time),
           "move one of them: the direction between them is the view direction");

  View view{.size = size, .projection = camera.projection, .eye = eye, .near = near};
  view.eyeFromWorld = eyeFromWorldRotation(forward, up);
  const double halfHeight = perspective ? std::tan(0.5 * fovY) : 0.5 * height;
  view.pixelsPerUnit = size.height / (2 * halfHeight);
  view.halfExtent = {size.width / (2 * view.pixelsPerUnit), halfHeight};
  if (!std::isfinite(view.pixelsPerUnit))
    reject(camera, fmt::format("fov_y or height is too small: {} metres", halfHeight));
  if (!perspective) fitDepthRange(camera, height, sceneBounds, view);
  view.clipFromEye = perspective ? perspectiveMatrix(view) : orthographicMatrix(view);
  return view;
}

View sampledAt(View view, const Vec2& offsetPx) {
  const Vec2 movedPx = offsetPx - view.sampleOffsetPx;
  const Vec2 movedClip(2 * movedPx.x / view.size.width, -2 * movedPx.y / view.size.height);
  // The picture moves the other way; times w, so that it moves as far at every depth.
  for (int column = 0; column < 4; ++column) {
    view.clipFromEye[column].x -= movedClip.x * view.clipFromEye[column].w;
    view.clipFromEye[column].y -= movedClip.y * view.clipFromEye[column].w;
  }
  view.sampleOffsetPx = offsetPx;
  return view;
}

Transform eyeFromObject(const View& view, const Transform& worldFromObject) {
  return {view.eyeFromWorld * worldFromObject.linear, eyeFromWorldPoint(view, worldFromObject.translation)};
}

Vec2 pixelFromEye(const View& view, const Vec3& pointEye) {
  const double scale = view.pixelsPerUnit / (view.perspective() ? -pointEye.z : 1);
  return {0.5 * view.size.width + scale * pointEye.x, 0.5 * view.size.height - scale * pointEye.y};
}

Frustum frustumOf(const View& view, double marginPx) {
  const Vec2 half = view.halfExtent + Vec2(marginPx / view.pixelsPerUnit);
  const Vec3 right = view.right(), up = view.up(), forward = view.forward();
  // A side plane of a perspective view contains the eye; an orthographic one is `half` away from it.
  const auto side = [&](const Vec3& inward, double extent) {
    const Vec3 normal = view.perspective() ? unit(inward + extent * forward) : inward;
    return Plane{normal, (view.perspective() ? 0 : extent) - glm::dot(normal, view.eye)};
  };
  return {{side(right, half.x), side(-right, half.x), side(up, half.y), side(-up, half.y),
           Plane{forward, -glm::dot(forward, view.eye) - view.near}}};
}

}  // namespace luxo
