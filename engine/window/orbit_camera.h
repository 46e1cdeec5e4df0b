// SPDX-License-Identifier: Apache-2.0
// A turntable around a point: drag turns, the wheel zooms toward the cursor, panning moves the pivot.
// Pure arithmetic without a window, in double. World space in metres; the window in pixels, y down.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace luxo::window {

/// Where a camera stands, as scenes state it.
struct Pose {
  Vec3 eye{0, 0, 5};
  Vec3 lookAt{0};
  Vec3 up{0, 1, 0};  ///< need not be unit or perpendicular

  friend bool operator==(const Pose&, const Pose&) = default;
};

/// Whatever is done to it, its numbers stay finite, its eye stays apart from its pivot, and up stays up:
/// pitch ends 1 degree short of the poles, or where a camera that started closer to them started.
class OrbitCamera {
 public:
  static constexpr double kZoomPerNotch = 1.1;

  /// Starts with the picture of `pose`, which must be finite with eye != lookAt. `heightPerDistance`, above
  /// 0, is the height of the picture at the pivot per metre of distance: 2 tan(fovY / 2) in perspective; a
  /// parallel camera takes its own height / distance and reads height() back.
  OrbitCamera(const Pose& pose, double heightPerDistance)
      : start_{.pivot = pose.lookAt}, axis_(axisOf(pose)), heightPerDistance_(heightPerDistance) {
    const Vec3 offset = pose.eye - pose.lookAt;
    const Vec3 direction = unit(offset);
    start_.distance = glm::length(offset);
    const double along = glm::dot(direction, axis_);
    const Vec3 across = direction - axis_ * along;
    start_.pitch = std::atan2(along, glm::length(across));
    ahead_ = unit(across);
    pitchLimit_ = std::max(radians(89), std::abs(start_.pitch));
    now_ = start_;
  }

  [[nodiscard]] Pose pose() const {
    return {.eye = now_.pivot + direction() * now_.distance, .lookAt = now_.pivot, .up = up()};
  }
  [[nodiscard]] double distance() const { return now_.distance; }
  /// Of the picture at the pivot, metres.
  [[nodiscard]] double height() const { return now_.distance * heightPerDistance_; }

  /// A drag of the whole window's height is half a turn; the picture follows the hand.
  void turn(const Vec2& dragPx, const Vec2& sizePx) {
    if (!usable(dragPx, sizePx)) return;
    now_.yaw = std::remainder(now_.yaw - dragPx.x / sizePx.y * kPi, kTau);
    now_.pitch = std::clamp(now_.pitch + dragPx.y / sizePx.y * kPi, -pitchLimit_, pitchLimit_);
  }

  /// Moves the pivot so that what lies at its depth follows the hand.
  void pan(const Vec2& dragPx, const Vec2& sizePx) {
    if (!usable(dragPx, sizePx)) return;
    movePivot(now_.pivot - inPicture(dragPx, sizePx));
  }

  /// Nearer by 1.1 per notch. What lies at the pivot's depth under the cursor stays there.
  void zoom(double notches, const Vec2& cursorPx, const Vec2& sizePx) {
    if (!usable(cursorPx, sizePx) || !std::isfinite(notches)) return;
    const double wanted = now_.distance * std::pow(kZoomPerNotch, -std::clamp(notches, -100.0, 100.0));
    const double distance = std::clamp(wanted, kNearest * start_.distance, kFarthest * start_.distance);
    const Vec3 cursor = now_.pivot + inPicture(cursorPx - 0.5 * sizePx, sizePx);
    const double scale = distance / now_.distance;
    now_.distance = distance;
    movePivot(cursor + (now_.pivot - cursor) * scale);
  }

 private:
  // All relative to the first distance. With them the eye and the pivot differ in double near the origin.
  static constexpr double kNearest = 1e-4, kFarthest = 1e4, kPivotReach = 1e6;

  struct State {
    Vec3 pivot{0};
    double yaw = 0, pitch = 0;  // radians; yaw 0 is where it started
    double distance = 1;
  };

  // The axis of the turntable: up, or what viewAt() takes in its stead.
  static Vec3 axisOf(const Pose& pose) {
    const Vec3 direction = unit(pose.eye - pose.lookAt);
    for (const Vec3& up : {unit(pose.up), Vec3(0, 1, 0)}) {
      if (glm::length(glm::cross(up, direction)) > 1e-9) return up;
    }
    return {0, 0, -1};
  }

  static bool usable(const Vec2& pixels, const Vec2& sizePx) {
    return std::isfinite(pixels.x) && std::isfinite(pixels.y) && sizePx.x > 0 && sizePx.y > 0;
  }

  [[nodiscard]] Vec3 level() const {  // from the pivot toward the eye, within the plane of the turntable
    return ahead_ * std::cos(now_.yaw) + glm::cross(axis_, ahead_) * std::sin(now_.yaw);
  }
  [[nodiscard]] Vec3 direction() const {
    return level() * std::cos(now_.pitch) + axis_ * std::sin(now_.pitch);
  }
  [[nodiscard]] Vec3 up() const { return axis_ * std::cos(now_.pitch) - level() * std::sin(now_.pitch); }
  [[nodiscard]] Vec3 right() const { return glm::cross(axis_, level()); }

  // The vector of the picture's plane through the pivot that is this many pixels long.
  [[nodiscard]] Vec3 inPicture(const Vec2& pixels, const Vec2& sizePx) const {
    const double metresPerPixel = height() / sizePx.y;
    return (right() * pixels.x - up() * pixels.y) * metresPerPixel;
  }

  void movePivot(const Vec3& pivot) {
    const double reach = kPivotReach * start_.distance;
    now_.pivot = glm::clamp(pivot, start_.pivot - reach, start_.pivot + reach);
  }

  State start_, now_;
  Vec3 axis_;      // unit
  Vec3 ahead_{0};  // unit, perpendicular to the axis: toward the eye at yaw 0
  double pitchLimit_ = 0;
  double heightPerDistance_;
};

}  // namespace luxo::window
