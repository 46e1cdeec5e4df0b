// SPDX-License-Identifier: Apache-2.0
#include "reference/judged_picture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "image/srgb.h"
#include "math/float32.h"
#include "reference/caster.h"
#include "reference/compared_pixels.h"
#include "reference/light_judge.h"
#include "reference/silhouette.h"

namespace luxo::reference {
namespace {

constexpr double kMaxSpacingPx = 20;  // of neighbouring pixels' points on one layer, without a closer look
constexpr double kMaxTurn = 0.1;      // the same for the sine between their line and the surface
constexpr double kTouchingUlps = 2;   // of two depths, each of which is rounded up or down
constexpr double kFloatRounding = 0x1p-24;  // of a number: the nearest float is no farther
/// Pixels whose light may be wrong, times lights: where there are more, thousands of pixels are wrong, and
/// borders of shadows are looked for in four directions alone, so that judging takes no longer than four
/// times casting them did. What has a border nearby may be counted then that would not be.
constexpr std::size_t kMaxTurned = 20'000;

/// What is not a number is wrong without bound.
double errorOf(double value) { return std::isnan(value) ? kInfinity : std::abs(value); }

double degreesBetween(const Vec3& a, const Vec3& b) {
  if (!(glm::length(a) > 0)) return kInfinity;
  return errorOf(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / kPi);
}

/// Of the depth buffer: reversed, float32, infinite for perspective.
class DepthScale {
 public:
  explicit DepthScale(const View& view) : view_(view) {}

  /// `difference` metres at depth `z` in units in the last place of the buffer's value there.
  [[nodiscard]] double ulps(double difference, double z) const {
    const double range = view_.far - view_.near;
    const double value = view_.perspective() ? view_.near / z : (view_.far - z) / range;
    const double perMetre = view_.perspective() ? view_.near / (z * z) : 1 / range;
    const double ulp = std::ldexp(1.0, std::max(std::ilogb(value), -126) - 23);
    return errorOf(difference * perMetre / ulp);
  }

 private:
  const View& view_;
};

class PictureJudge : ComparedPixels {
 public:
  PictureJudge(const Snapshot& snapshot, const ReferencePicture& truth, const MeasuredPicture& measured,
               const VerificationOptions& options)
      : ComparedPixels(snapshot, truth, measured, options),
        depthScale_(snapshot.view),
        chosen_(options.pixels) {
    requireSizes();
    if (chosen_.empty()) {
      chosen_.resize(truth.depth.size());
      std::iota(chosen_.begin(), chosen_.end(), 0U);
    }
    pixels_.resize(chosen_.size());
    anyShader_ = std::ranges::any_of(snapshot.nodes, [&](const SnapshotNode& node) {
      return snapshot.materials[node.material.index].shader != nullptr;
    });
  }

  JudgedPicture judged() {
    std::vector<Floors> floors(chosen_.size() / kStretch + 1);
    tbb::parallel_for(std::size_t(0), floors.size(), [&](std::size_t stretch) {
      const std::size_t end = std::min((stretch + 1) * kStretch, chosen_.size());
      for (std::size_t k = stretch * kStretch; k < end; ++k) judge(k, floors[stretch]);
    });
    findSilhouettes();
    Floors floor;
    for (const Floors& f : floors) floor.add(f);
    return {std::move(chosen_), std::move(pixels_), floor};
  }

 private:
  static constexpr std::size_t kStretch = 1024;

  void requireSizes() const {
    const auto require = [&](const Image& image, int channels, const char* name, bool needed) {
      if (!needed && image.empty()) return;
      if (image.width() == size_.width && image.height() == size_.height && image.channels() == channels)
        return;
      throw Error(
          ErrorKind::Requirement,
          fmt::format("cannot verify: '{}' has {} x {} pixels of {} channels, not {} x {} of {}", name,
                      image.width(), image.height(), image.channels(), size_.width, size_.height, channels));
    };
    require(measured_.color, 3, "color", false);
    require(measured_.depth, 1, "depth", false);
    const bool byPlace = std::ranges::any_of(
        snapshot_.nodes, [](const SnapshotNode& node) { return !node.surface.isParametric(); });
    require(measured_.position, 3, "position", byPlace);
    require(measured_.normal, 3, "normal", false);
    require(measured_.uv, 3, "uv", true);
    require(measured_.id, 1, "id", true);
    require(measured_.dark, 3, "dark", !measured_.alone.empty());
    for (const Image& alone : measured_.alone) require(alone, 3, "alone", true);
  }

  /// The truth, rounded to the output.
  [[nodiscard]] std::optional<Place> roundedPlace(const Place& seen) const {
    return surfaceOf(seen.node).isParametric()
               ? layers_.at(seen.node, roundedToFloat(seen.parameters), seen.position)
               : layers_.onTriangle(seen.node, seen.parameters, Vec3(roundedToFloat(seen.position)));
  }

  void judge(std::size_t k, Floors& floors) {
    const std::uint32_t i = chosen_[k];
    JudgedPixel& pixel = pixels_[k];
    pixel.nan = anyNan(i);
    if (!truth_.certified[i]) return;
    pixel.compared = true;
    compareColors(pixel, i);
    const double number = measured_.id.samples()[i];
    if (truth_.number[i] == 0) {
      if (number != 0) pixel.mismatch = Mismatch::Extra;
      return;
    }
    if (number != truth_.number[i]) {
      pixel.mismatch = number == 0        ? Mismatch::Missing
                       : showsTouching(i) ? Mismatch::None
                                          : Mismatch::WrongNode;
      return;
    }
    const Place seen = seenAt(i);
    const auto shown = shownAt(i, seen.node);
    if (!shown || !layers_.same(*shown, seen, truth_.facet[i], seen.pixel)) {
      if (!tellsTheTruthRounded(i) && !showsTouching(i)) pixel.mismatch = Mismatch::WrongLayer;
      return;
    }
    compareGeometry(pixel, i, seen, *shown, floors);
  }

  /// Whether the parameters, or of triangles the place, are the truth's but for the output's single
  /// precision. At a rim that is infinitely steep that moves a point by pixels, or out of the domain.
  [[nodiscard]] bool tellsTheTruthRounded(std::uint32_t i) const {
    if (!surfaceOf(*layers_.nodeOf(truth_.number[i])).isParametric())
      return glm::distance(valueAt(measured_.position, i), truth_.position[i]) <=
             2 * kFloatRounding * glm::length(truth_.position[i]);
    const Vec2 off = glm::abs(parametersAt(i) - truth_.parameters[i]);
    return glm::all(glm::lessThanEqual(off, kFloatRounding * glm::abs(truth_.parameters[i])));
  }

  /// Whether what is shown is on the pixel's ray, and no farther from what the truth sees there than the
  /// depth buffer tells, or, from the surface there, than a point may be off: of layers that touch either is
  /// right.
  [[nodiscard]] bool showsTouching(std::uint32_t i) const {
    const auto node = layers_.nodeOf(measured_.id.samples()[i]);
    const Vec3& seen = truth_.position[i];
    const auto shown = node ? shownAt(i, *node) : std::nullopt;
    if (!shown) return false;
    const double off = glm::distance(shown->pixel, centerOf(i));
    if (!(off <= kPointPx) && !(off <= kPointPx + roundingPx(*shown))) return false;
    const Vec3 behind = shown->position - seen;
    if (depthScale_.ulps(glm::dot(behind, snapshot_.view.forward()), truth_.depth[i]) <= kTouchingUlps)
      return true;
    const double throughSurface = std::abs(glm::dot(behind, truth_.facet[i]));
    return throughSurface <= kPointPx * layers_.footprint(seen);
  }

  [[nodiscard]] bool anyNan(std::uint32_t i) const {
    for (const Image* image : {&measured_.color, &measured_.depth, &measured_.position, &measured_.normal,
                               &measured_.uv, &measured_.id}) {
      if (image->empty()) continue;
      const Vec3 v = valueAt(*image, i);
      if (std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z)) return true;
    }
    return false;
  }

  void compareGeometry(JudgedPixel& pixel, std::uint32_t i, const Place& seen, const Place& shown,
                       Floors& floors) const {
    const double footprint = layers_.footprint(seen.position);
    pixel.inside = !atSilhouette(i);
    pixel.position = glm::distance(shown.pixel, seen.pixel);
    pixel.parameter = glm::distance(shown.position, seen.position) / footprint;
    Floors floor;
    pixel.offPoint = !(pixel.position <= kPointPx) && !(pixel.position <= kPointPx + roundingPx(shown));
    if (const auto best = roundedPlace(seen)) {
      floor.position = glm::distance(best->pixel, seen.pixel);
      floor.parameter = glm::distance(best->position, seen.position) / footprint;
    }
    if (!measured_.position.empty()) {
      pixel.point = errorOf(glm::distance(valueAt(measured_.position, i), seen.position) / footprint);
      floor.point = glm::distance(roundedToFloat(seen.position), seen.position) / footprint;
    }
    if (!measured_.depth.empty()) {
      const double z = truth_.depth[i];
      pixel.depth = depthScale_.ulps(measured_.depth.samples()[i] - z, z);
      floor.depth = depthScale_.ulps(roundedToFloat(z) - z, z);
    }
    if (!measured_.normal.empty()) {
      pixel.normal = degreesBetween(valueAt(measured_.normal, i), truth_.normal[i]);
      floor.normal = degreesBetween(roundedToFloat(truth_.normal[i]), truth_.normal[i]);
    }
    floors.add(floor);
  }

  /// How far on the screen half a unit in the last place of u and of v may move a point, at most about; or,
  /// of triangles, of its place.
  [[nodiscard]] double roundingPx(const Place& shown) const {
    if (!surfaceOf(shown.node).isParametric())
      return kFloatRounding * glm::length(shown.position) / layers_.footprint(shown.position);
    double sum = 0;
    for (const int axis : {0, 1}) {
      double most = 0;
      for (const double way : {-0.5, 0.5}) {
        const auto value = static_cast<float>(shown.parameters[axis]);
        const double ulp =
            std::nextafter(std::abs(value), std::numeric_limits<float>::max()) - std::abs(value);
        Vec2 moved = shown.parameters;
        moved[axis] += way * ulp;
        const auto place = layers_.at(shown.node, moved, shown.position);
        if (place) most = std::max(most, glm::distance(place->pixel, shown.pixel));
      }
      sum += most;
    }
    return sum;
  }

  /// Whether it is of a material that has a shader, or may be seen before one.
  [[nodiscard]] bool isLitByShader(double number) const {
    const auto node = layers_.nodeOf(number);
    if (!anyShader_ || !node) return false;
    return materialOf(*node).shader || materialOf(*node).transparent();
  }

  void compareColors(JudgedPixel& pixel, std::uint32_t i) const {
    if (measured_.color.empty()) return;
    pixel.byShader = isLitByShader(truth_.number[i]) || isLitByShader(measured_.id.samples()[i]);
    if (pixel.byShader) return;
    const Vec3 shown = valueAt(measured_.color, i), seen = valueAt(truth_.color, i);
    pixel.color = 0;
    for (int c = 0; c < 3; ++c) {
      const double difference = errorOf(shown[c] - seen[c]);
      pixel.color = std::max(pixel.color, difference);
      pixel.squares += difference * difference;
      const double coded = errorOf(srgbFromLinear(std::clamp(shown[c], 0.0, 1.0)) -
                                   srgbFromLinear(std::clamp(seen[c], 0.0, 1.0)));
      pixel.codedSquares += coded * coded;
      pixel.differs8 |= encodeSrgb8(static_cast<float>(shown[c])) != encodeSrgb8(static_cast<float>(seen[c]));
    }
  }

  /// Whether one of the eight pixels around sees another layer.
  [[nodiscard]] bool atSilhouette(std::uint32_t i) const {
    const int x = static_cast<int>(i) % size_.width, y = static_cast<int>(i) / size_.width;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || x + dx < 0 || y + dy < 0 || x + dx >= size_.width ||
            y + dy >= size_.height)
          continue;
        if (!continuous(i, static_cast<std::uint32_t>((y + dy) * size_.width + x + dx))) return true;
      }
    return false;
  }

  [[nodiscard]] bool continuous(std::uint32_t i, std::uint32_t j) const {
    if (truth_.number[i] != truth_.number[j]) return false;
    const Vec3 step = truth_.position[j] - truth_.position[i];
    const double length = glm::length(step);
    if (length < kMaxSpacingPx * layers_.footprint(truth_.position[i]) &&
        std::abs(glm::dot(step, truth_.facet[i])) < kMaxTurn * length)
      return true;
    return layers_.same(seenAt(j), seenAt(i), truth_.facet[i], centerOf(i));
  }

  /// Whether another light, layer, texel or side than the truth's may be what it shows.
  [[nodiscard]] bool hasDoubtfulLight(std::size_t k) const {
    const JudgedPixel& pixel = pixels_[k];
    if (pixel.mismatch != Mismatch::None || pixel.byShader || measured_.color.empty()) return false;
    const bool sees = pixel.position != kUnset;
    return ((pixel.color > kOtherLight || pixel.offPoint) && (hasLayers_ || (hasShadows_ && sees))) ||
           (pixel.color > kOtherTexture && sees && (showsTexture(chosen_[k]) || showsPlainColor(chosen_[k])));
  }

  /// What is wrong may be right beside an outline, or beside the border of a shadow.
  void findSilhouettes() {
    std::vector<std::size_t> doubtful;
    for (std::size_t k = 0; k < pixels_.size(); ++k)
      if (pixels_[k].mismatch != Mismatch::None || pixels_[k].offPoint || hasDoubtfulLight(k))
        doubtful.push_back(k);
    if (doubtful.empty() || !options_.silhouettes) return;
    const auto shadows =
        std::ranges::count_if(snapshot_.lights, [](const SnapshotLight& light) { return light.hasShadow(); });
    const Caster caster(snapshot_, options_.shading);
    const LightJudge lights(*this, caster, doubtful.size() * static_cast<std::size_t>(shadows) > kMaxTurned);
    tbb::parallel_for(std::size_t(0), doubtful.size(), [&](std::size_t d) {
      const std::size_t k = doubtful[d];
      JudgedPixel& pixel = pixels_[k];
      const std::uint32_t i = chosen_[k];
      if (pixel.mismatch != Mismatch::None) {
        pixel.silhouettePx = static_cast<float>(silhouetteDistance(caster, i, pixel.mismatch));
        return;
      }
      if (hasDoubtfulLight(k) && (!pixel.offPoint || isMesh(i))) pixel.light = lights.of(i, pixel.color);
      if (pixel.offPoint) pixel.offPoint = outlineDistance(caster, i) > kSilhouettePx;
    });
  }

  /// From a pixel's centre to where the truth shows another layer; not looked for far beyond kSilhouettePx.
  [[nodiscard]] double outlineDistance(const Caster& caster, std::uint32_t i) const {
    return distanceTo(
        [&](const Vec2& at) {
          const Ray ray = caster.rayThrough(at.x, at.y);
          const Caster::Sight sight = caster.look(ray, Caster::Invisible::Told);
          return !seesLayerOf(i, caster.firstShown(sight), at);
        },
        centerOf(i), 2 * kSilhouettePx);
  }

  /// From a pixel's centre to where the truth is what the pixel shows.
  [[nodiscard]] double silhouetteDistance(const Caster& caster, std::uint32_t i, Mismatch mismatch) const {
    const auto node = layers_.nodeOf(measured_.id.samples()[i]);
    std::optional<Place> shown;
    if (mismatch == Mismatch::WrongLayer) {
      shown = shownAt(i, *node);
      if (!shown) return options_.farthestPx;
    } else if (!node && mismatch != Mismatch::Missing) {
      return options_.farthestPx;
    }
    return distanceTo(
        [&](const Vec2& at) {
          const auto sight = caster.look(caster.rayThrough(at.x, at.y), Caster::Invisible::Told);
          const Hit* hit = caster.firstShown(sight);
          if (mismatch == Mismatch::Missing) return !hit;
          if (!hit || hit->node != *node) return false;
          if (!shown) return true;
          const std::uint32_t patch = snapshot_.nodes[hit->node].surface.patchAt(hit->u, hit->v);
          return layers_.same(*shown, {hit->node, patch, {hit->u, hit->v}, hit->position, at}, hit->facet,
                              at);
        },
        centerOf(i), options_.farthestPx);
  }

  DepthScale depthScale_;
  std::vector<std::uint32_t> chosen_;
  std::vector<JudgedPixel> pixels_;  // as chosen_
  bool anyShader_ = false;           // of a material
};

}  // namespace

JudgedPicture judgePixels(const Snapshot& snapshot, const ReferencePicture& truth,
                          const MeasuredPicture& measured, const VerificationOptions& options) {
  return PictureJudge(snapshot, truth, measured, options).judged();
}

}  // namespace luxo::reference
