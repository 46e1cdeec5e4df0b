// SPDX-License-Identifier: Apache-2.0
#include "reference/light_judge.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "math/numbers.h"
#include "reference/silhouette.h"

namespace luxo::reference {
namespace {

using enum LightVerdict;

/// Of a colour that is so much off.
LightVerdict wrongBy(const Vec3& off) { return off.x + off.y + off.z < 0 ? TooDark : TooBright; }

double largest(const Vec3& off) { return std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}); }

}  // namespace

LightJudge::LightJudge(const ComparedPixels& pixels, const Caster& caster, bool coarse)
    : ComparedPixels(pixels),
      caster_(caster),
      coarse_(coarse),
      hasEstimates_(std::ranges::any_of(
          snapshot_.lights, [](const SnapshotLight& light) { return light.pointOf.has_value(); })),
      occluded_(snapshot_.ambientOcclusion.any() && snapshot_.ambient != Vec3(0)) {}

LightVerdict LightJudge::of(std::uint32_t i, double off) const {
  if (!occluded_ && (hasLayers_ || (off > kOtherTexture && showsTexture(i)))) return byLayers(i);
  if (!hasShadows_ || !isMesh(i)) return ofPoint(i);
  return occluded_ ? Unjudged : ofMesh(i);
}

/// From where light rays of a pixel that shows a mesh start, and where that is on the screen: the surface's
/// own point that is shown; of a plane, on which its mesh lies, and of triangles, what is seen.
std::pair<std::optional<Hit>, Vec2> LightJudge::litPoint(std::uint32_t i, std::uint32_t node) const {
  const Vec2 center = centerOf(i);
  const Ray ray = caster_.rayThrough(center.x, center.y);
  if (surfaceOf(node).liesOnItsMesh()) {
    const Caster::Sight sight = caster_.look(ray);
    const Hit* first = caster_.firstShown(sight);
    if (!seesLayerOf(i, first, center)) return {};
    return {*first, center};
  }
  const auto shown = shownAt(i, node);
  if (!shown) return {};
  return {caster_.pointAt(node, parametersAt(i), ray), shown->pixel};
}

/// Of a mesh the picture without lights, and with each one alone, tell what a light gives where it is seen;
/// and the surface's own point, which the pixel shows, whether it is.
LightVerdict LightJudge::ofMesh(std::uint32_t i) const {
  if (measured_.id.samples()[i] != truth_.number[i]) return Right;  // of layers that touch the other one
  const std::span<const WholeLight> wholes = caster_.wholes();
  if (measured_.normal.empty() || measured_.alone.size() != wholes.size()) return Unjudged;
  const std::uint32_t node = *layers_.nodeOf(truth_.number[i]);
  const auto [hit, at] = litPoint(i, node);
  if (!hit) return Unjudged;
  const Vec3 normal = valueAt(measured_.normal, i), dark = valueAt(measured_.dark, i);
  const Shading shading = shadingOf(node);

  struct Arriving {
    Vec3 share;
    Caster::SeenPart part;  // both the same, but of what a map estimates
  };
  std::vector<Arriving> arriving;
  std::vector<std::size_t> shadowed;
  bool certified = true;
  for (std::size_t k = 0; k < wholes.size(); ++k) {
    const WholeLight& whole = wholes[k];
    arriving.push_back({valueAt(measured_.alone[k], i) - dark, {Vec3(1), Vec3(1)}});
    if (!whole.light.hasShadow() || arriving.back().share == Vec3(0)) continue;
    const double cosine = glm::dot(normal, Caster::towardLight(whole.light, *hit));
    // What vertices receive is no light on what turns away from it.
    if (shading == Shading::Gouraud && isOnHorizon(whole.light, *hit, normal)) return Unjudged;
    Caster::SeenPart& part = arriving.back().part;
    if (shading == Shading::Gouraud && cosine < 0) {
      part = {};
    } else if (whole.number) {
      part.least = part.most = caster_.reaching(*whole.number, *hit, certified);
    } else {
      part = caster_.seenPart(whole, *hit);
    }
    // In steps a part of a light has a border of its own.
    const bool isPart = part.least != part.most || (part.least != Vec3(0) && part.least != Vec3(1));
    if (shading == Shading::Toon && isPart) return Unjudged;
    shadowed.push_back(k);
  }
  if (!certified) return Unjudged;
  // A drawing is as bright as its brightest light.
  const auto lit = [&](Vec3 Caster::SeenPart::*part) {
    Vec3 all(0);
    for (const Arriving& one : arriving) {
      const Vec3 more = one.part.*part * one.share;
      all = shading == Shading::Toon ? glm::max(all, more) : all + more;
    }
    return dark + all;
  };
  const Vec3 least = lit(&Caster::SeenPart::least), most = lit(&Caster::SeenPart::most);
  const Vec3 shown = valueAt(measured_.color, i), off = shown - glm::clamp(shown, least, most);
  std::vector<Turned> lights;
  for (const std::size_t k : shadowed) {
    Arriving& one = arriving[k];
    if (!wholes[k].number) {
      lights.push_back(estimate(one.share, one.part, off));
      continue;
    }
    const Caster::SeenPart truly = one.part;
    const bool visible = truly.most != Vec3(0);
    one.part.least = Vec3(visible ? 0 : 1);
    lights.push_back({.light = *wholes[k].number,
                      .visible = visible,
                      .change = lit(&Caster::SeenPart::least) - least,
                      .atBorder = isOnHorizon(wholes[k].light, *hit, hit->normal)});
    one.part = truly;
  }
  return withoutBorders(i, off, std::move(lights), at).byTurned ? wrongBy(off) : Right;
}

/// What a light may be to blame for of which more, or less, is seen than may be.
LightJudge::Turned LightJudge::estimate(const Vec3& share, const Caster::SeenPart& part,
                                        const Vec3& off) const {
  const bool isDark = wrongBy(off) == TooDark;
  return {.light = std::nullopt,
          .visible = isDark,
          .change = isDark ? -part.least * share : (Vec3(1) - part.most) * share};
}

Vec3 LightJudge::Turned::leaves(const Vec3& off) const {
  const double square = glm::dot(change, change);
  const double part = light || square == 0 ? 1 : std::clamp(glm::dot(off, change) / square, 0.0, 1.0);
  return off - part * change;
}

/// How far beside a pixel what it shows may be from: the width of an outline, and of drawings as far as
/// their meshes may be off. Nothing where light is not known that well: of meshes, which are off, in all
/// other ways.
std::optional<double> LightJudge::reachOfColors(const Caster::Sight& sight) const {
  double reach = kSilhouettePx;
  for (const Hit& hit : sight.hits) {
    const Shading shading = shadingOf(hit.node);
    if (shading == Shading::Exact || (shading == Shading::Phong && surfaceOf(hit.node).liesOnItsMesh()))
      continue;
    if (shading != Shading::Toon || !std::isfinite(options_.boundPx)) return std::nullopt;
    reach = std::max(reach, options_.boundPx);
  }
  return reach;
}

/// Whether no colour is, within the reach of what is seen, as the one that is shown, with lights in the
/// plane of what is seen on either side of it: of what is seen through any layer may be the wrong one, and
/// of a texture any texel. Where a layer ends on the way so does its colour, which beside a fold changes by
/// more than kOtherLight in a hundredth of a pixel: it is followed to the end, and kPointPx beyond.
LightVerdict LightJudge::byColor(std::uint32_t i, double reach, double tolerance) const {
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
    const Ray ray = caster_.rayThrough(center.x + offset.x, center.y + offset.y);
    const Caster::Sight sight = caster_.look(ray);
    throughTexture |= std::ranges::any_of(sight.hits, [&](const Hit& hit) {
      const Material& material = materialOf(hit.node);
      return material.transparent() && material.readsFootprint();
    });
    Vec3 color(0);
    for (const double tilt : {-kCosineRounding, kCosineRounding})
      count(color = caster_.color(ray, sight, certified, tilt));
    return {sight.hits.size(), color};
  };
  const std::size_t layers = look(Vec2(0)).layers;
  if (hasEstimates_)
    for (const Caster::Wide wide : {Caster::Wide::Least, Caster::Wide::Most}) {
      const Ray ray = caster_.rayThrough(center.x, center.y);
      count(caster_.color(ray, caster_.look(ray), certified, 0, wide));
    }
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
  if (!certified) return Unjudged;
  if (throughTexture) tolerance = kOtherTexture;
  const auto slack = [&](double value) { return tolerance * (1 + value); };
  for (int c = 0; c < 3; ++c)
    if (shown[c] < least[c] - slack(least[c]) || shown[c] > most[c] + slack(most[c]))
      return wrongBy(shown - glm::clamp(shown, least, most));
  return Right;
}

/// Of a scene in which something is seen through, or of a texture: by its colour; of a mesh with nothing
/// before it by its lights, which are known where it is.
LightVerdict LightJudge::byLayers(std::uint32_t i) const {
  const Vec2 center = centerOf(i);
  const Caster::Sight sight = caster_.look(caster_.rayThrough(center.x, center.y));
  const bool isOpaque = sight.hits.size() == 1 && !materialOf(sight.hits.front().node).transparent();
  if (isOpaque && isMesh(i)) return ofMesh(i);
  const std::optional<double> reach = reachOfColors(sight);
  return reach ? byColor(i, *reach, kOtherLight) : Unjudged;
}

/// Finds of which lights a border, or of all of them an outline, is within kSilhouettePx of a place that
/// shows the layer of a pixel. All are looked for at the same places, so that the points of a soft light
/// cost what their rays do.
void LightJudge::findBorders(std::uint32_t i, const Vec2& center, std::vector<Turned>& lights) const {
  auto left = std::ranges::count(lights, false, &Turned::atBorder);
  for (const Vec2& at : placesAround(center, kSilhouettePx, coarse_)) {
    if (left == 0) return;
    const auto sight = caster_.look(caster_.rayThrough(at.x, at.y));
    const Hit* first = caster_.firstShown(sight);
    const bool sameLayer = seesLayerOf(i, first, at);
    for (Turned& one : lights) {
      if (one.atBorder || (sameLayer && (!one.light || caster_.sees(*one.light, *first) == one.visible)))
        continue;
      one.atBorder = true;
      --left;
    }
  }
}

LightVerdict LightJudge::ofPoint(std::uint32_t i) const {
  const Vec2 center = centerOf(i);
  const Ray ray = caster_.rayThrough(center.x, center.y);
  const auto sight = caster_.look(ray);
  const Hit* first = caster_.firstShown(sight);
  if (!seesLayerOf(i, first, center) || sight.hits.size() > 1)
    return Unjudged;  // seen through: no closed form
  const Hit& hit = *first;
  bool certified = true;
  const Vec3 shown = valueAt(measured_.color, i), truth = valueAt(truth_.color, i);
  Vec3 least = truth, most = truth;
  const auto count = [&](const Vec3& color) {
    least = glm::min(least, color);
    most = glm::max(most, color);
  };
  const auto isOff = [&] {
    return glm::any(glm::greaterThan(glm::abs(shown - glm::clamp(shown, least, most)), Vec3(kOtherLight)));
  };
  if (hasEstimates_ && isOff()) {
    if (shadingOf(hit.node) == Shading::Toon) return Unjudged;  // in steps a part has a border of its own
    for (const Caster::Wide wide : {Caster::Wide::Least, Caster::Wide::Most})
      count(caster_.color(ray, sight, certified, 0, wide));
    if (!isOff()) return certified ? Right : Unjudged;
  }
  // Lights in the plane of what is seen may be on either side of it: with one there begins a highlight.
  std::vector<Turned> lights;
  for (const Caster::Shadowed& one : caster_.shadowedLights(hit, -ray.direction))
    if (certified &= one.certified; one.certified)
      lights.push_back({.light = one.light,
                        .visible = one.visible,
                        .change = one.visible ? -one.share : one.share,
                        .atBorder = isOnHorizon(snapshot_.lights[one.light], hit, hit.normal)});
  if (isOff())
    for (const double tilt : {-kCosineRounding, kCosineRounding})
      count(caster_.color(ray, sight, certified, tilt));
  const Vec3 off = shown - glm::clamp(shown, least, most);
  for (const WholeLight& whole : caster_.wholes())
    if (!whole.number && off != Vec3(0))
      lights.push_back(estimate(caster_.shareOf(whole.light, hit, -ray.direction, Vec3(1)),
                                caster_.seenPart(whole, hit), off));
  const Unexplained left = withoutBorders(i, off, std::move(lights), center);
  // At a crease the colour is that of either side.
  if (left.byTurned) return byColor(i, kSilhouettePx, kOtherLight) == Right ? Right : wrongBy(off);
  if (!certified) return Unjudged;
  if (largest(left.off) <= kOtherTexture || occluded_ || !showsPlainColor(i)) return Right;
  const LightVerdict nearby = byColor(i, kSilhouettePx, kOtherTexture);
  return nearby == TooDark || nearby == TooBright ? OtherColor : nearby;
}

/// What the borders of shadows nearby leave of a colour that is so much off the truth, of a point which is at
/// `center` on the screen. Of many lights that are as bright, the points of a soft shadow, several may
/// explain a colour: those with a border nearby do so first.
LightJudge::Unexplained LightJudge::withoutBorders(std::uint32_t i, Vec3 off, std::vector<Turned> lights,
                                                   const Vec2& center) const {
  const auto helps = [&](const Turned& one) { return largest(one.leaves(off)) < largest(off); };
  std::erase_if(lights, std::not_fn(helps));
  if (!(largest(off) > kOtherLight) || lights.empty()) return {off, false};
  findBorders(i, center, lights);
  const auto others =
      std::partition(lights.begin(), lights.end(), [](const Turned& one) { return one.atBorder; });
  std::vector<Turned> bordering(lights.begin(), others);
  while (!bordering.empty()) {
    const auto best =
        std::ranges::min_element(bordering, {}, [&](const Turned& one) { return largest(one.leaves(off)); });
    if (!helps(*best)) break;
    off = best->leaves(off);
    bordering.erase(best);
  }
  return {off, largest(off) > kOtherLight && std::any_of(others, lights.end(), helps)};
}

}  // namespace luxo::reference
