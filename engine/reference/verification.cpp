// SPDX-License-Identifier: Apache-2.0
#include "reference/verification.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "image/flip.h"
#include "image/srgb.h"
#include "math/float32.h"
#include "reference/caster.h"
#include "reference/layers.h"
#include "reference/silhouette.h"

namespace luxo {
namespace {

using reference::Layers;
using reference::Place;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnset = -1;          // of errors: nothing was compared
constexpr double kMostSpacingPx = 20;  // of neighbouring pixels' points on one layer, without a closer look
constexpr double kMostTurn = 0.1;      // the same for the sine between their line and the surface
constexpr double kTouchingUlps = 2;    // of two depths, each of which is rounded up or down
constexpr double kOtherLight = 1e-4;   // linear: smaller differences are not looked into for a light's shadow

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

/// One pixel's comparison; errors are kUnset where they do not apply.
struct Pixel {
  Mismatch mismatch = Mismatch::None;
  bool compared = false, inside = false, differs8 = false, nan = false;
  bool offPoint = false, offLight = false;  // wrong, unless near an outline or a shadow's border
  float silhouettePx = 0;
  double position = kUnset, parameter = kUnset, point = kUnset, depth = kUnset, normal = kUnset,
         color = kUnset, squares = 0, codedSquares = 0;
};

/// The largest error of the rounded truth.
struct Floors {
  double position = 0, parameter = 0, point = 0, depth = 0, normal = 0;

  void add(const Floors& other) {
    position = std::max(position, other.position);
    parameter = std::max(parameter, other.parameter);
    point = std::max(point, other.point);
    depth = std::max(depth, other.depth);
    normal = std::max(normal, other.normal);
  }
};

class Judge {
 public:
  Judge(const Snapshot& snapshot, const ReferencePicture& truth, const MeasuredPicture& measured,
        const VerificationOptions& options)
      : snapshot_(snapshot),
        truth_(truth),
        measured_(measured),
        options_(options),
        size_(snapshot.view.size),
        layers_(snapshot),
        depthScale_(snapshot.view),
        chosen_(options.pixels) {
    requireSizes();
    if (chosen_.empty()) {
      chosen_.resize(truth.depth.size());
      std::iota(chosen_.begin(), chosen_.end(), 0U);
    }
    pixels_.resize(chosen_.size());
    floors_.resize(chosen_.size() / kStretch + 1);
  }

  Verification verdict() {
    tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
    arena.execute([&] {
      tbb::parallel_for(std::size_t(0), floors_.size(), [&](std::size_t stretch) {
        const std::size_t end = std::min((stretch + 1) * kStretch, chosen_.size());
        for (std::size_t k = stretch * kStretch; k < end; ++k) judge(k, floors_[stretch]);
      });
      findSilhouettes();
    });
    Verification result;
    result.coverage = coverage();
    Floors floor;
    for (const Floors& f : floors_) floor.add(f);
    const auto spread = [&](double Pixel::*error, double floorError, bool insideOnly = false) {
      return spreadOf(error, floorError, insideOnly);
    };
    result.positionPx = spread(&Pixel::position, floor.position);
    result.parameterPx = spread(&Pixel::parameter, floor.parameter);
    result.pointPx = spread(&Pixel::point, floor.point);
    result.depthUlp = spread(&Pixel::depth, floor.depth);
    result.normalDegrees = spread(&Pixel::normal, floor.normal);
    result.normalDegreesInside = spread(&Pixel::normal, floor.normal, true);
    result.color = colors();
    for (const Pixel& pixel : pixels_) result.nanPixels += pixel.nan ? 1 : 0;
    if (options_.silhouettes) result.wrong = wrongPixels();
    result.positionMap = positionMap();
    return result;
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
    require(measured_.position, 3, "position", false);
    require(measured_.normal, 3, "normal", false);
    require(measured_.uv, 3, "uv", true);
    require(measured_.id, 1, "id", true);
  }

  [[nodiscard]] static Vec3 valueAt(const Image& image, std::uint32_t i) {
    const std::size_t channels = static_cast<std::size_t>(image.channels());
    const std::span<const float> samples = image.samples().subspan(i * channels, channels);
    return channels == 1 ? Vec3(samples[0], 0, 0) : Vec3(samples[0], samples[1], samples[2]);
  }
  [[nodiscard]] Vec2 centerOf(std::uint32_t i) const {
    const auto width = static_cast<std::uint32_t>(size_.width);
    return Vec2(i % width + 0.5, static_cast<double>(i / width) + 0.5) + snapshot_.view.sampleOffsetPx;
  }
  [[nodiscard]] Vec2 parametersAt(std::uint32_t i) const { return Vec2(valueAt(measured_.uv, i)); }

  /// The truth of a pixel that shows a surface.
  [[nodiscard]] Place seenAt(std::uint32_t i) const {
    const std::uint32_t node = *layers_.nodeOf(truth_.number[i]);
    const Vec2 parameters = truth_.parameters[i];
    return {node, snapshot_.nodes[node].surface.patchAt(parameters.x, parameters.y), parameters,
            truth_.position[i], centerOf(i)};
  }

  void judge(std::size_t k, Floors& floors) {
    const std::uint32_t i = chosen_[k];
    Pixel& pixel = pixels_[k];
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
    const auto shown = layers_.at(seen.node, parametersAt(i), seen.position);
    if (!shown || !layers_.same(*shown, seen, truth_.normal[i], seen.pixel)) {
      if (!showsTouching(i)) pixel.mismatch = Mismatch::WrongLayer;
      return;
    }
    compareGeometry(pixel, i, seen, *shown, floors);
  }

  /// Whether what is shown is on the pixel's ray, and no farther from what the truth sees there than the
  /// depth buffer tells, or, from the surface there, than a point may be off: of layers that touch either is
  /// right.
  [[nodiscard]] bool showsTouching(std::uint32_t i) const {
    const auto node = layers_.nodeOf(measured_.id.samples()[i]);
    const Vec3& seen = truth_.position[i];
    const auto shown = node ? layers_.at(*node, parametersAt(i), seen) : std::nullopt;
    if (!shown) return false;
    const double off = glm::distance(shown->pixel, centerOf(i));
    if (!(off <= kPointPx) && !(off <= kPointPx + roundingPx(*shown))) return false;
    const Vec3 behind = shown->position - seen;
    if (depthScale_.ulps(glm::dot(behind, snapshot_.view.forward()), truth_.depth[i]) <= kTouchingUlps)
      return true;
    const double throughSurface = std::abs(glm::dot(behind, truth_.normal[i]));
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

  void compareGeometry(Pixel& pixel, std::uint32_t i, const Place& seen, const Place& shown,
                       Floors& floors) const {
    const double footprint = layers_.footprint(seen.position);
    pixel.inside = !atSilhouette(i);
    pixel.position = glm::distance(shown.pixel, seen.pixel);
    pixel.parameter = glm::distance(shown.position, seen.position) / footprint;
    Floors floor;
    pixel.offPoint = !(pixel.position <= kPointPx) && !(pixel.position <= kPointPx + roundingPx(shown));
    if (const auto best = layers_.at(seen.node, roundedToFloat(seen.parameters), seen.position)) {
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

  /// How far on the screen half a unit in the last place of u and of v may move a point, at most about.
  [[nodiscard]] double roundingPx(const Place& shown) const {
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

  void compareColors(Pixel& pixel, std::uint32_t i) const {
    if (measured_.color.empty()) return;
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
    if (length < kMostSpacingPx * layers_.footprint(truth_.position[i]) &&
        std::abs(glm::dot(step, truth_.normal[i])) < kMostTurn * length)
      return true;
    return layers_.same(seenAt(j), seenAt(i), truth_.normal[i], centerOf(i));
  }

  void findSilhouettes() {
    const bool shadows = std::ranges::any_of(
        snapshot_.lights, [](const SnapshotLight& light) { return light.shade.has_value(); });
    const auto mayBeInShadow = [&](const Pixel& pixel) {
      return shadows && pixel.mismatch == Mismatch::None && pixel.position != kUnset &&
             pixel.color > kOtherLight;
    };
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < pixels_.size(); ++k)
      if (pixels_[k].mismatch != Mismatch::None || pixels_[k].offPoint || mayBeInShadow(pixels_[k]))
        wrong.push_back(k);
    if (wrong.empty() || !options_.silhouettes) return;
    const reference::Caster caster(snapshot_);
    tbb::parallel_for(std::size_t(0), wrong.size(), [&](std::size_t w) {
      Pixel& pixel = pixels_[wrong[w]];
      const std::uint32_t i = chosen_[wrong[w]];
      if (pixel.mismatch != Mismatch::None)
        pixel.silhouettePx = static_cast<float>(silhouetteDistance(caster, i, pixel.mismatch));
      else if (pixel.offPoint)
        pixel.offPoint = outlineDistance(caster, i) > kSilhouettePx;
      else
        pixel.offLight = inAnotherLight(caster, i);
    });
  }

  /// Whether a ray sees, first, the layer that the truth of pixel `i` is of.
  [[nodiscard]] bool seesLayerOf(std::uint32_t i, const reference::Caster::Sight& sight,
                                 const Vec2& at) const {
    if (sight.hits.empty()) return false;
    const reference::Hit& hit = sight.hits.front();
    const std::uint32_t patch = snapshot_.nodes[hit.node].surface.patchAt(hit.u, hit.v);
    return layers_.same(seenAt(i), {hit.node, patch, {hit.u, hit.v}, hit.position, at}, hit.normal, at);
  }

  /// From a pixel's centre to where the truth shows another layer; not looked for far beyond kSilhouettePx.
  [[nodiscard]] double outlineDistance(const reference::Caster& caster, std::uint32_t i) const {
    return reference::distanceTo(
        [&](const Vec2& at) { return !seesLayerOf(i, caster.look(caster.rayThrough(at.x, at.y)), at); },
        centerOf(i), 2 * kSilhouettePx);
  }

  /// Whether the colour shown is nearer to that with one light's visibility turned round than to the truth,
  /// and no border of that shadow, and no outline, is near.
  [[nodiscard]] bool inAnotherLight(const reference::Caster& caster, std::uint32_t i) const {
    const auto lightsAt = [&](const reference::Ray& ray, const reference::Caster::Sight& sight) {
      return caster.shadowedLights(sight.hits.front(), -ray.direction);
    };
    const Vec2 center = centerOf(i);
    const reference::Ray ray = caster.rayThrough(center.x, center.y);
    const auto sight = caster.look(ray);
    if (!seesLayerOf(i, sight, center) || sight.hits.size() > 1)
      return false;  // seen through: no closed form
    const Vec3 off = valueAt(measured_.color, i) - valueAt(truth_.color, i);
    const auto lights = lightsAt(ray, sight);
    for (std::size_t k = 0; k < lights.size(); ++k) {
      const Vec3 turned = lights[k].visible ? -lights[k].share : lights[k].share;
      const auto size = [](const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
      if (!lights[k].certified || !(size(off - turned) < size(off))) continue;
      const double border = reference::distanceTo(
          [&](const Vec2& at) {
            const reference::Ray other = caster.rayThrough(at.x, at.y);
            const auto seen = caster.look(other);
            if (!seesLayerOf(i, seen, at)) return true;
            const auto there = lightsAt(other, seen);
            return there.size() != lights.size() || there[k].visible != lights[k].visible;
          },
          center, 2 * kSilhouettePx);
      if (border > kSilhouettePx) return true;
    }
    return false;
  }

  [[nodiscard]] WrongPixels wrongPixels() const {
    WrongPixels wrong;
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
      const Pixel& pixel = pixels_[k];
      const bool away = pixel.silhouettePx > kSilhouettePx;
      std::uint64_t* count = nullptr;
      if (!pixel.compared) continue;
      if (away && (pixel.mismatch == Mismatch::Missing || pixel.mismatch == Mismatch::Extra))
        count = &wrong.hitMiss;
      else if (away)
        count = &wrong.layer;
      else if (pixel.nan || pixel.offPoint)
        count = &wrong.point;
      else if (pixel.offLight)
        count = &wrong.light;
      if (count == nullptr) continue;
      ++*count;
      wrong.pixels.push_back(chosen_[k]);
    }
    return wrong;
  }

  /// From a pixel's centre to where the truth is what the pixel shows.
  [[nodiscard]] double silhouetteDistance(const reference::Caster& caster, std::uint32_t i,
                                          Mismatch mismatch) const {
    const auto node = layers_.nodeOf(measured_.id.samples()[i]);
    std::optional<Place> shown;
    if (mismatch == Mismatch::WrongLayer) {
      shown = layers_.at(*node, parametersAt(i), truth_.position[i]);
      if (!shown) return options_.farthestPx;
    } else if (!node && mismatch != Mismatch::Missing) {
      return options_.farthestPx;
    }
    return reference::distanceTo(
        [&](const Vec2& at) {
          const auto sight = caster.look(caster.rayThrough(at.x, at.y));
          if (mismatch == Mismatch::Missing) return sight.hits.empty();
          if (sight.hits.empty() || sight.hits.front().node != *node) return false;
          if (!shown) return true;
          const reference::Hit& hit = sight.hits.front();
          const std::uint32_t patch = snapshot_.nodes[hit.node].surface.patchAt(hit.u, hit.v);
          return layers_.same(*shown, {hit.node, patch, {hit.u, hit.v}, hit.position, at}, hit.normal, at);
        },
        centerOf(i), options_.farthestPx);
  }

  [[nodiscard]] Offence offenceAt(std::size_t k, double error) const {
    const std::uint32_t i = chosen_[k];
    const auto number = [](double value) {
      return value >= 0 && value < 4294967296.0 ? static_cast<std::uint32_t>(value) : 0U;
    };
    return {.x = static_cast<int>(i) % size_.width,
            .y = static_cast<int>(i) / size_.width,
            .error = error,
            .mismatch = pixels_[k].mismatch,
            .measuredNode = number(measured_.id.samples()[i]),
            .trueNode = truth_.number[i],
            .measuredParameters = parametersAt(i),
            .trueParameters = truth_.parameters[i]};
  }

  /// The pixels with the largest of these errors; of equal ones the first.
  template <class ErrorAt>
  [[nodiscard]] std::vector<Offence> worstOf(std::vector<std::size_t> candidates,
                                             const ErrorAt& errorAt) const {
    const std::size_t count =
        std::min(candidates.size(), static_cast<std::size_t>(std::max(options_.worst, 0)));
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(candidates.begin(), end, candidates.end(), [&](std::size_t a, std::size_t b) {
      return errorAt(a) != errorAt(b) ? errorAt(a) > errorAt(b) : a < b;
    });
    std::vector<Offence> worst;
    for (auto k = candidates.begin(); k != end; ++k) worst.push_back(offenceAt(*k, errorAt(*k)));
    return worst;
  }

  [[nodiscard]] ErrorSpread spreadOf(double Pixel::*error, double floor, bool insideOnly) const {
    ErrorSpread spread{.floor = floor};
    std::vector<std::size_t> candidates;
    std::vector<double> values;
    double squares = 0;
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
      const double value = pixels_[k].*error;
      if (value == kUnset || (insideOnly && !pixels_[k].inside)) continue;
      candidates.push_back(k);
      values.push_back(value);
      squares += value * value;
    }
    if (values.empty()) return spread;
    spread.pixels = values.size();
    spread.rms = std::sqrt(squares / static_cast<double>(values.size()));
    const auto quantile = [&](double part) {
      const auto rank =
          values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
      std::nth_element(values.begin(), rank, values.end());
      return *rank;
    };
    spread.p99 = quantile(0.99);
    spread.p999 = quantile(0.999);
    spread.max = quantile(1);
    spread.worst = worstOf(std::move(candidates), [&](std::size_t k) { return pixels_[k].*error; });
    return spread;
  }

  [[nodiscard]] CoverageErrors coverage() const {
    CoverageErrors c;
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
      const Pixel& pixel = pixels_[k];
      if (!pixel.compared) {
        ++c.undecided;
        continue;
      }
      const bool covered = truth_.number[chosen_[k]] != 0;
      ++c.compared;
      c.covered += covered ? 1 : 0;
      c.both += covered && pixel.mismatch == Mismatch::None ? 1 : 0;
      c.missing += pixel.mismatch == Mismatch::Missing ? 1 : 0;
      c.extra += pixel.mismatch == Mismatch::Extra ? 1 : 0;
      c.wrongNode += pixel.mismatch == Mismatch::WrongNode ? 1 : 0;
      c.wrongLayer += pixel.mismatch == Mismatch::WrongLayer ? 1 : 0;
      if (pixel.mismatch == Mismatch::None) continue;
      wrong.push_back(k);
      c.farthestPx = std::max<double>(c.farthestPx, pixel.silhouettePx);
      c.beyond += pixel.silhouettePx > kSilhouettePx ? 1 : 0;
    }
    c.worst = worstOf(std::move(wrong), [&](std::size_t k) { return double(pixels_[k].silhouettePx); });
    return c;
  }

  [[nodiscard]] ColorErrors colors() const {
    ColorErrors c;
    if (measured_.color.empty()) return c;
    c.difference = spreadOf(&Pixel::color, 0, true);
    c.pixels = c.difference.pixels;
    double squares = 0, coded = 0;
    std::uint64_t covered = 0;
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
      const Pixel& pixel = pixels_[k];
      if (!pixel.compared) continue;
      covered += truth_.number[chosen_[k]] != 0 ? 1 : 0;
      c.differing8 += pixel.differs8 ? 1 : 0;
      if (!pixel.inside) continue;
      squares += pixel.squares;
      coded += pixel.codedSquares;
    }
    const auto psnr = [&](double sum) {
      return sum == 0 ? kInfinity : -10 * std::log10(sum / (3 * static_cast<double>(c.pixels)));
    };
    c.psnrLinear = psnr(squares);
    c.psnrSrgb = psnr(coded);
    c.differing8Part = covered == 0 ? 0 : static_cast<double>(c.differing8) / static_cast<double>(covered);
    if (options_.flip && options_.pixels.empty()) {
      const Flip seen = flip(truth_.color, measured_.color);
      c.flipMean = seen.mean;
      c.flipP999 = seen.p999;
      c.flipMax = seen.max;
    }
    return c;
  }

  [[nodiscard]] Image positionMap() const {
    Image map(size_.width, size_.height, 1);
    std::ranges::fill(map.samples(), static_cast<float>(kUnset));
    for (std::size_t k = 0; k < pixels_.size(); ++k)
      map.samples()[chosen_[k]] = pixels_[k].mismatch != Mismatch::None
                                      ? std::numeric_limits<float>::infinity()
                                      : static_cast<float>(pixels_[k].position);
    return map;
  }

  const Snapshot& snapshot_;
  const ReferencePicture& truth_;
  const MeasuredPicture& measured_;
  const VerificationOptions& options_;
  PixelSize size_;
  Layers layers_;
  DepthScale depthScale_;
  std::vector<std::uint32_t> chosen_;
  std::vector<Pixel> pixels_;   // as chosen_
  std::vector<Floors> floors_;  // per stretch
};

}  // namespace

Verification verify(const Snapshot& snapshot, const ReferencePicture& truth, const MeasuredPicture& measured,
                    const VerificationOptions& options) {
  return Judge(snapshot, truth, measured, options).verdict();
}

}  // namespace luxo
