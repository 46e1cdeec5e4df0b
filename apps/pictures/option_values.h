// SPDX-License-Identifier: Apache-2.0
// The values that options take, from text. Each parser throws Error(Usage) that names the option and says
// what it takes, and Error(Scene) for what luxo knows but cannot do yet.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/options.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "scene/shading.h"

namespace luxo {

/// The most frames or sweep values in one run.
inline constexpr int kMaxFrames = 1'000'000;

/// The number that the whole text is, if it is one and finite.
[[nodiscard]] std::optional<double> finiteNumber(std::string_view text);

/// One finite number, or a fraction of two: `0.25`, `1e-3`, `1/255`.
[[nodiscard]] double parseNumber(std::string_view option, const std::string& text);

/// `1280x720`, each side 1..kMaxPictureSide.
[[nodiscard]] PixelSize parseSize(const std::string& text);

/// `1-250:2,300`: single frames and ranges with an optional step, 0 or above. In the order given, repetitions
/// dropped.
[[nodiscard]] std::vector<int> parseFrames(const std::string& text);

/// Frames per second, in kFpsRange.
[[nodiscard]] double parseFps(const std::string& text);

/// 1..kMaxSamples.
[[nodiscard]] int parseSamples(const std::string& text);

/// Pixels: errors that may be required, down to what doubles say of the largest picture.
inline constexpr Interval kErrorRange{1e-12, 1e6};

/// A length in pixels, in `range`: `0.25` or `0.25px`.
[[nodiscard]] double parsePixels(std::string_view option, const std::string& text,
                                 const Interval& range = kToleranceRange);

/// Metres: `0.01mm`, `1.2cm`, `5um`, `0.1in`, `2m`, without a unit metres; above 0, up to 1e9 m.
[[nodiscard]] double parseLength(std::string_view option, const std::string& text);
/// How many metres a unit has: um, mm, cm, m, in.
[[nodiscard]] double parseLengthUnit(std::string_view option, const std::string& text);

[[nodiscard]] Shading parseShading(const std::string& text);
[[nodiscard]] Output parseAov(const std::string& text);

/// What makes the pictures: triangles on a Vulkan device, or rays in double precision.
enum class Engine { Vulkan, Reference };

/// `vulkan` or `reference`.
[[nodiscard]] Engine parseEngine(const std::string& text);

/// `all`, `none`, or names out of frustum, small, backface, lights, unchanged, passes, hidden: only those are
/// on.
[[nodiscard]] Composition parseComposition(const std::string& text);
[[nodiscard]] Skips parseSkips(const std::string& text);
/// all, none, or the least number of pixels.
[[nodiscard]] Audit parseAudit(const std::string& text);
/// From 0.
[[nodiscard]] int parseSample(const std::string& text);

/// Of pictures in a row: 1 to `most`.
[[nodiscard]] int parseColumns(const std::string& text, int most);

struct ParameterValue {
  std::string name;
  std::string value;  ///< a number or an expression; the scene judges it

  friend bool operator==(const ParameterValue&, const ParameterValue&) = default;
};

/// `name=value`
[[nodiscard]] ParameterValue parseParameter(const std::string& text);

struct Sweep {
  std::string name;
  std::vector<double> values;  ///< from, from + step, ... up to and including `to` if the steps meet it

  friend bool operator==(const Sweep&, const Sweep&) = default;
};

/// `name=from:to:step`; the step leads from `from` toward `to`.
[[nodiscard]] Sweep parseSweep(const std::string& text);

}  // namespace luxo
