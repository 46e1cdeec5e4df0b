// SPDX-License-Identifier: Apache-2.0
#include "reference/judged_picture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "image/srgb.h"
#include "math/float32.h"
#include "reference/caster.h"
#include "reference/layers.h"
#include "reference/silhouette.h"

namespace luxo::reference {
namespace {

constexpr double kMaxSpacingPx = 20;  // of neighbouring pixels' points on one layer, without a closer look
constexpr double kMaxTurn = 0.1;      // the same for the sine between their line and the surface
constexpr double kTouchingUlps = 2;   // of two depths, each of which is rounded up or down
constexpr double kFloatRounding = 0x1p-24;   // of a number: the nearest float is no farther
constexpr double kOtherTexture = 1.0 / 255;  // linear: devices filter with few bits
constexpr double kOtherLight = 1e-4;  // linear: smaller differences are not looked into for a light's shadow

/// Pixels whose light may be wrong, times lights: where there are more, thousands of pixels are wrong, and
/// borders of shadows are looked for in four directions alone, so that judging takes no longer than four
/// times casting them did. What has a border nearby may be counted then that would not be.
constexpr std::size_t kMostTurned = 20'000;

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

class PictureJudge {
 public:
  PictureJudge(const Snapshot& snapshot, const ReferencePicture& truth, const MeasuredPicture& measured,
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
    const bool triangles = std::ranges::any_of(
        snapshot_.nodes, [](const SnapshotNode& node) { return node.surface.triangles() != nullptr; });
    require(measured_.position, 3, "position", triangles);
    require(measured_.normal, 3, "normal", false);
    require(measured_.uv, 3, "uv", true);
    require(measured_.id, 1, "id", true);
    require(measured_.dark, 3, "dark", !measured_.alone.empty());
    for (const Image& alone : measured_.alone) require(alone, 3, "alone", true);
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
  [[nodiscard]] bool onTriangles(std::uint32_t node) const {
    return snapshot_.nodes[node].surface.triangles() != nullptr;
  }

  /// The point that a pixel shows of a node, near to what is seen there.
  [[nodiscard]] std::optional<Place> shownAt(std::uint32_t i, std::uint32_t node) const {
    return onTriangles(node) ? layers_.onTriangle(node, parametersAt(i), valueAt(measured_.position, i))
                             : layers_.at(node, parametersAt(i), truth_.position[i]);
  }

  /// The truth, rounded to the output.
  [[nodiscard]] std::optional<Place> roundedPlace(const Place& seen) const {
    return onTriangles(seen.node)
               ? layers_.onTriangle(seen.node, seen.parameters, Vec3(roundedToFloat(seen.position)))
               : layers_.at(seen.node, roundedToFloat(seen.parameters), seen.position);
  }

  /// The truth of a pixel that shows a surface.
  [[nodiscard]] Place seenAt(std::uint32_t i) const {
    const std::uint32_t node = *layers_.nodeOf(truth_.number[i]);
    const Vec2 parameters = truth_.parameters[i];
    return {node, snapshot_.nodes[node].surface.patchAt(parameters.x, parameters.y), parameters,
            truth_.position[i], centerOf(i)};
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
    if (onTriangles(*layers_.nodeOf(truth_.number[i])))
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
    if (onTriangles(shown.node))
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
    const Material& material = snapshot_.materials[snapshot_.nodes[*node].material.index];
    return material.shader || material.transparent();
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

  void findSilhouettes() {
    const bool shadows =
        std::ranges::any_of(snapshot_.lights, [](const SnapshotLight& light) { return light.hasShadow(); });
    const bool layers = std::ranges::any_of(snapshot_.nodes, [&](const SnapshotNode& node) {
      return snapshot_.materials[node.material.index].transparent();
    });
    // Of the ambient light the picture knows less than the truth: no colour is the same.
    const bool occluded = snapshot_.ambientOcclusion.any() && snapshot_.ambient != Vec3(0);
    const auto mayBeInShadow = [&](const JudgedPixel& pixel) {
      return pixel.mismatch == Mismatch::None && pixel.color > kOtherLight &&
             (layers || (shadows && pixel.position != kUnset));
    };
    const auto mayShowAnotherTexture = [&](std::size_t k) {
      const JudgedPixel& pixel = pixels_[k];
      return pixel.mismatch == Mismatch::None && pixel.position != kUnset && pixel.color > kOtherTexture &&
             showsTexture(chosen_[k]);
    };
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < pixels_.size(); ++k)
      if (pixels_[k].mismatch != Mismatch::None || pixels_[k].offPoint || mayBeInShadow(pixels_[k]) ||
          mayShowAnotherTexture(k))
        wrong.push_back(k);
    if (wrong.empty() || !options_.silhouettes) return;
    const auto lights =
        std::ranges::count_if(snapshot_.lights, [](const SnapshotLight& light) { return light.hasShadow(); });
    coarse_ = wrong.size() * static_cast<std::size_t>(lights) > kMostTurned;
    const Caster caster(snapshot_, options_.shading);
    tbb::parallel_for(std::size_t(0), wrong.size(), [&](std::size_t w) {
      JudgedPixel& pixel = pixels_[wrong[w]];
      const std::uint32_t i = chosen_[wrong[w]];
      if (pixel.mismatch != Mismatch::None) {
        pixel.silhouettePx = static_cast<float>(silhouetteDistance(caster, i, pixel.mismatch));
        return;
      }
      const bool isOff = pixel.offPoint;
      if (isOff) pixel.offPoint = outlineDistance(caster, i) > kSilhouettePx;
      if (pixel.byShader || measured_.color.empty() || (isOff && !isMesh(i))) return;
      if (!occluded && (layers || mayShowAnotherTexture(wrong[w])))
        pixel.offLight = isInAnotherColor(caster, i);
      else if (shadows && isMesh(i))
        pixel.offLight = !occluded && meshInAnotherLight(caster, i);
      else
        pixel.offLight = inAnotherLight(caster, i);
    });
  }

  [[nodiscard]] const Material& materialOf(std::uint32_t node) const {
    return snapshot_.materials[snapshot_.nodes[node].material.index];
  }
  [[nodiscard]] Shading shadingOf(std::uint32_t node) const {
    return materialOf(node).shadingIn(options_.shading);
  }

  /// Whether a pixel shows a mesh that stands for a formula.
  [[nodiscard]] bool isMesh(std::uint32_t i) const {
    const auto node = layers_.nodeOf(truth_.number[i]);
    return node && !onTriangles(*node) && shadingOf(*node) != Shading::Exact;
  }

  /// From where light rays of a pixel that shows a mesh start, and where that is on the screen: the surface's
  /// own point that is shown; of a plane, on which its mesh lies, what is seen.
  [[nodiscard]] std::pair<std::optional<Hit>, Vec2> litPoint(const Caster& caster, std::uint32_t i,
                                                             std::uint32_t node) const {
    const Vec2 center = centerOf(i);
    const Ray ray = caster.rayThrough(center.x, center.y);
    if (snapshot_.nodes[node].surface.flatNormal()) {
      const Caster::Sight sight = caster.look(ray);
      if (!seesLayerOf(i, sight, center)) return {};
      return {sight.hits.front(), center};
    }
    const auto shown = shownAt(i, node);
    if (!shown) return {};
    return {caster.pointAt(node, parametersAt(i), ray), shown->pixel};
  }

  /// Of a mesh the picture without lights, and with each one alone, tell what a light gives where it is seen;
  /// and the surface's own point, which the pixel shows, whether it is.
  [[nodiscard]] bool meshInAnotherLight(const Caster& caster, std::uint32_t i) const {
    if (measured_.color.empty() || measured_.normal.empty() ||
        measured_.alone.size() != snapshot_.lights.size() || measured_.id.samples()[i] != truth_.number[i])
      return false;
    const std::uint32_t node = *layers_.nodeOf(truth_.number[i]);
    const auto [hit, at] = litPoint(caster, i, node);
    if (!hit) return false;
    const Vec3 normal = valueAt(measured_.normal, i), dark = valueAt(measured_.dark, i);
    const Shading shading = shadingOf(node);

    std::vector<Vec3> shares, left;
    std::vector<std::uint32_t> shadowed;
    bool certified = true;
    for (std::uint32_t light = 0; light < snapshot_.lights.size(); ++light) {
      shares.push_back(valueAt(measured_.alone[light], i) - dark);
      left.emplace_back(1);
      if (!snapshot_.lights[light].hasShadow() || shares.back() == Vec3(0)) continue;
      const double cosine = glm::dot(normal, caster.towardLight(light, *hit));
      // What vertices receive is no light on what turns away from it.
      if (shading == Shading::Gouraud && std::abs(cosine) <= kCosineRounding) return false;
      left.back() =
          shading == Shading::Gouraud && cosine < 0 ? Vec3(0) : caster.reaching(light, *hit, certified);
      // In steps a part of a light has a border of its own.
      if (shading == Shading::Toon && left.back() != Vec3(0) && left.back() != Vec3(1)) return false;
      shadowed.push_back(light);
    }
    if (!certified) return false;
    // A drawing is as bright as its brightest light.
    const auto lit = [&] {
      Vec3 all(0);
      for (std::size_t light = 0; light < shares.size(); ++light) {
        const Vec3 more = left[light] * shares[light];
        all = shading == Shading::Toon ? glm::max(all, more) : all + more;
      }
      return dark + all;
    };
    const Vec3 expected = lit();
    std::vector<Turned> lights;
    for (const std::uint32_t light : shadowed) {
      const Vec3 truly = left[light];
      const bool visible = truly != Vec3(0);
      left[light] = Vec3(visible ? 0 : 1);
      lights.push_back({.light = light,
                        .visible = visible,
                        .change = lit() - expected,
                        .atBorder = isOnHorizon(caster.towardLight(light, *hit), hit->normal)});
      left[light] = truly;
    }
    return isTurned(caster, i, valueAt(measured_.color, i) - expected, std::move(lights), at);
  }

  /// In exact shading: other ones have colours of their own.
  [[nodiscard]] bool showsTexture(std::uint32_t i) const {
    const auto node = layers_.nodeOf(truth_.number[i]);
    if (!node) return false;
    const Material& material = snapshot_.materials[snapshot_.nodes[*node].material.index];
    return material.readsFootprint() && !material.shader &&
           material.shadingIn(options_.shading) == Shading::Exact;
  }

  /// Whether a ray sees, first, the layer that the truth of pixel `i` is of.
  [[nodiscard]] bool seesLayerOf(std::uint32_t i, const Caster::Sight& sight, const Vec2& at) const {
    if (sight.hits.empty()) return false;
    const Hit& hit = sight.hits.front();
    const std::uint32_t patch = snapshot_.nodes[hit.node].surface.patchAt(hit.u, hit.v);
    return layers_.same(seenAt(i), {hit.node, patch, {hit.u, hit.v}, hit.position, at}, hit.facet, at);
  }

  /// From a pixel's centre to where the truth shows another layer; not looked for far beyond kSilhouettePx.
  [[nodiscard]] double outlineDistance(const Caster& caster, std::uint32_t i) const {
    return distanceTo(
        [&](const Vec2& at) { return !seesLayerOf(i, caster.look(caster.rayThrough(at.x, at.y)), at); },
        centerOf(i), 2 * kSilhouettePx);
  }

  /// How far beside a pixel what it shows may be from: the width of an outline, and of drawings as far as
  /// their meshes may be off. Nothing where light is not known that well: of meshes, which are off, in all
  /// other ways.
  [[nodiscard]] std::optional<double> reachOfColors(const Caster::Sight& sight) const {
    double reach = kSilhouettePx;
    for (const Hit& hit : sight.hits) {
      const Shading shading = shadingOf(hit.node);
      const bool isOn = onTriangles(hit.node) || snapshot_.nodes[hit.node].surface.flatNormal();
      if (shading == Shading::Exact || (shading == Shading::Phong && isOn)) continue;
      if (shading != Shading::Toon || !std::isfinite(options_.boundPx)) return std::nullopt;
      reach = std::max(reach, options_.boundPx);
    }
    return reach;
  }

  /// Whether no colour is, within the reach of what is seen, as the one that is shown, with lights in the
  /// plane of what is seen on either side of it: of what is seen through any layer may be the wrong one, and
  /// of a texture any texel. Where a layer ends on the way so does its colour, which beside a fold changes by
  /// more than kOtherLight in a hundredth of a pixel: it is followed to the end, and kPointPx beyond.
  [[nodiscard]] bool hasAnotherColor(const Caster& caster, std::uint32_t i, double reach) const {
    struct Look {
      std::size_t layers;
      Vec3 color;
    };
    const Vec2 center = centerOf(i);
    const Vec3 shown = valueAt(measured_.color, i);
    Vec3 least(std::numeric_limits<double>::infinity()), most(-least);
    bool certified = true, throughTexture = false;
    const auto count = [&](const Vec3& color) {
      least = glm::min(least, color);
      most = glm::max(most, color);
    };
    const auto look = [&](const Vec2& offset) -> Look {
      const Ray ray = caster.rayThrough(center.x + offset.x, center.y + offset.y);
      const Caster::Sight sight = caster.look(ray);
      throughTexture |= std::ranges::any_of(sight.hits, [&](const Hit& hit) {
        const Material& material = materialOf(hit.node);
        return material.transparent() && material.readsFootprint();
      });
      Vec3 color(0);
      for (const double tilt : {-kCosineRounding, kCosineRounding})
        count(color = caster.color(ray, sight, certified, tilt));
      return {sight.hits.size(), color};
    };
    const std::size_t layers = look(Vec2(0)).layers;
    constexpr int kDirections = 8, kHalvings = 14;  // to 1e-6 px
    for (int k = 0; k < 2 * kDirections && certified; ++k) {
      const double angle = kTau * k / kDirections;
      const Vec2 way(std::cos(angle), std::sin(angle));
      Vec2 same(0), other = (k < kDirections ? 1 : 0.1) * reach * way;
      const std::size_t others = look(other).layers;
      if (others == layers) continue;
      for (int halving = 0; halving < kHalvings && certified; ++halving) {
        const Vec2 middle = 0.5 * (same + other);
        (look(middle).layers == layers ? same : other) = middle;
      }
      const Look last = look(others > layers ? other : same);
      const Look before = others > layers ? look(other + kPointPx * way) : look(same - kPointPx * way);
      if (before.layers == last.layers) count(2.0 * last.color - before.color);
    }
    if (!certified) return false;
    const double tolerance = throughTexture ? kOtherTexture : kOtherLight;
    const auto slack = [&](double value) { return tolerance * (1 + value); };
    for (int c = 0; c < 3; ++c)
      if (shown[c] < least[c] - slack(least[c]) || shown[c] > most[c] + slack(most[c])) return true;
    return false;
  }

  /// Of a scene in which something is seen through, or of a texture: by its colour; of a mesh with nothing
  /// before it by its lights, which are known where it is.
  [[nodiscard]] bool isInAnotherColor(const Caster& caster, std::uint32_t i) const {
    const Vec2 center = centerOf(i);
    const Caster::Sight sight = caster.look(caster.rayThrough(center.x, center.y));
    const bool isOpaque = sight.hits.size() == 1 && !materialOf(sight.hits.front().node).transparent();
    if (isOpaque && isMesh(i)) return meshInAnotherLight(caster, i);
    const std::optional<double> reach = reachOfColors(sight);
    return reach && hasAnotherColor(caster, i, *reach);
  }

  /// Where single precision cannot tell on which side of the horizon a light is.
  static bool isOnHorizon(const Vec3& towardLight, const Vec3& normal) {
    return std::abs(glm::dot(towardLight, normal)) <= kCosineRounding;
  }

  /// A light of which the colour shown may have it that it is seen where it is not, or the other way round.
  struct Turned {
    std::uint32_t light;  ///< index into Snapshot::lights
    bool visible;         ///< in truth
    Vec3 change;          ///< of the colour
    bool atBorder = false;
  };

  /// Finds of which lights a border, or of all of them an outline, is within kSilhouettePx of a place that
  /// shows the layer of a pixel. All are looked for at the same places, so that the points of a soft light
  /// cost what their rays do.
  void findBorders(const Caster& caster, std::uint32_t i, const Vec2& center,
                   std::vector<Turned>& lights) const {
    if (coarse_) return findBorders(caster, i, center, lights, {1.0}, 4);
    // 16 places around: the last ring is as much wider as a straight border that touches the circle passes
    // beside them.
    findBorders(caster, i, center, lights, {0.1, 0.2, 0.4, 0.8, 1.02}, 16);
  }

  /// At so many places of rings, whose radii are in kSilhouettePx.
  void findBorders(const Caster& caster, std::uint32_t i, const Vec2& center, std::vector<Turned>& lights,
                   std::initializer_list<double> radii, int directions) const {
    auto left = std::ranges::count(lights, false, &Turned::atBorder);
    double turn = 0;  // of every other ring by half a step
    for (const double radius : radii) {
      for (int k = 0; k < directions && left > 0; ++k) {
        const double angle = kTau * (k + turn) / directions;
        const Vec2 at = center + radius * kSilhouettePx * Vec2(std::cos(angle), std::sin(angle));
        const auto sight = caster.look(caster.rayThrough(at.x, at.y));
        const bool sameLayer = seesLayerOf(i, sight, at);
        for (Turned& one : lights) {
          if (one.atBorder || (sameLayer && caster.sees(one.light, sight.hits.front()) == one.visible))
            continue;
          one.atBorder = true;
          --left;
        }
      }
      turn = 0.5 - turn;
    }
  }

  [[nodiscard]] bool inAnotherLight(const Caster& caster, std::uint32_t i) const {
    const Vec2 center = centerOf(i);
    const Ray ray = caster.rayThrough(center.x, center.y);
    const auto sight = caster.look(ray);
    if (!seesLayerOf(i, sight, center) || sight.hits.size() > 1)
      return false;  // seen through: no closed form
    const Hit& hit = sight.hits.front();
    std::vector<Turned> lights;
    for (const Caster::Shadowed& one : caster.shadowedLights(hit, -ray.direction))
      if (one.certified)
        lights.push_back({.light = one.light,
                          .visible = one.visible,
                          .change = one.visible ? -one.share : one.share,
                          .atBorder = isOnHorizon(caster.towardLight(one.light, hit), hit.normal)});
    return isTurned(caster, i, valueAt(measured_.color, i) - valueAt(truth_.color, i), std::move(lights),
                    center);
  }

  /// Whether a colour that is so much off the truth, of a point which is at `center` on the screen, is nearer
  /// to that with one light's visibility turned round, and no border of that shadow, and no outline, is near.
  /// Of many lights that are as bright, the points of a soft shadow, several may explain a colour: those with
  /// a border nearby do so first.
  [[nodiscard]] bool isTurned(const Caster& caster, std::uint32_t i, Vec3 off, std::vector<Turned> lights,
                              const Vec2& center) const {
    const auto size = [](const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    std::erase_if(lights, [&](const Turned& one) { return !(size(off - one.change) < size(off)); });
    if (!(size(off) > kOtherLight) || lights.empty()) return false;
    findBorders(caster, i, center, lights);
    const auto others =
        std::partition(lights.begin(), lights.end(), [](const Turned& one) { return one.atBorder; });
    std::vector<Vec3> bordering;
    for (auto one = lights.begin(); one != others; ++one) bordering.push_back(one->change);
    while (!bordering.empty()) {
      const auto best =
          std::ranges::min_element(bordering, {}, [&](const Vec3& change) { return size(off - change); });
      if (!(size(off - *best) < size(off))) break;
      off -= *best;
      bordering.erase(best);
    }
    return size(off) > kOtherLight && std::any_of(others, lights.end(), [&](const Turned& one) {
             return size(off - one.change) < size(off);
           });
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
          const auto sight = caster.look(caster.rayThrough(at.x, at.y));
          if (mismatch == Mismatch::Missing) return sight.hits.empty();
          if (sight.hits.empty() || sight.hits.front().node != *node) return false;
          if (!shown) return true;
          const Hit& hit = sight.hits.front();
          const std::uint32_t patch = snapshot_.nodes[hit.node].surface.patchAt(hit.u, hit.v);
          return layers_.same(*shown, {hit.node, patch, {hit.u, hit.v}, hit.position, at}, hit.facet, at);
        },
        centerOf(i), options_.farthestPx);
  }

  const Snapshot& snapshot_;
  const ReferencePicture& truth_;
  const MeasuredPicture& measured_;
  const VerificationOptions& options_;
  PixelSize size_;
  Layers layers_;
  DepthScale depthScale_;
  std::vector<std::uint32_t> chosen_;
  std::vector<JudgedPixel> pixels_;  // as chosen_
  bool anyShader_ = false;           // of a material
  bool coarse_ = false;              // kMostTurned
};

}  // namespace

JudgedPicture judgePixels(const Snapshot& snapshot, const ReferencePicture& truth,
                          const MeasuredPicture& measured, const VerificationOptions& options) {
  return PictureJudge(snapshot, truth, measured, options).judged();
}

}  // namespace luxo::reference
