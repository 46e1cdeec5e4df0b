// SPDX-License-Identifier: Apache-2.0
#include "reference/audit.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <vector>

#include "reference/picture_rules.h"
#include "reference/silhouette.h"
#include "reference/verification.h"

namespace luxo::reference {
namespace {

/// Linear: what 8 bits show of a colour.
constexpr double kOtherColor = 1.0 / 255;
/// What floats leave of a normal, some 2^-20, moves a highlight of a larger exponent by a quarter of that.
constexpr double kMaxShininess = 1024;

/// Whether its colour is the same function of the point in the picture and in the truth, whatever rounding
/// makes of the point.
bool isPlain(const Material& material) {
  const bool mapped = material.map.valid() || material.normalMap.valid() || material.specularMap.valid() ||
                      material.glowMap.valid();
  return material.shadingIn(Shading::Exact) == Shading::Exact && !material.shader && !material.lesson &&
         !material.diffusePattern.valid() && !material.isolines.valid() && !mapped &&
         material.shininess <= kMaxShininess;
}

/// What the truth shows at a point of the picture plane.
struct Shown {
  double depth = std::numeric_limits<double>::infinity();
  double perPixel = 0;  ///< how much the depth of the tangent plane changes over a pixel, at most
  bool certified = true;
};

/// Of the length of a matrix's columns, what rounding leaves of their determinant.
constexpr double kFlattened = 1e-12;

bool flattens(const Mat3& m) {
  return std::abs(glm::determinant(m)) <=
         kFlattened * glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
}

/// Whether some of the surfaces that a pixel sees are as near to each other as depths are known, or flattened
/// so that their own sides are.
bool touchesAnother(const Caster& caster, const Vec2& pixel, double rounding) {
  const Snapshot& snapshot = caster.snapshot();
  const View& view = snapshot.view;
  const Ray ray = caster.rayThrough(pixel.x, pixel.y);
  const std::vector<Hit> hits = caster.look(ray).hits;
  const double cosine = glm::dot(ray.direction, view.forward());
  const auto slack = [&](const Hit& hit) {
    const double metresPerPixel = (view.perspective() ? hit.t * cosine : 1) / view.pixelsPerUnit;
    return (rounding + kPointPx * metresPerPixel) / cosine;
  };
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (flattens(snapshot.nodes[hits[i].node].worldFromObject.linear)) return true;
    if (i > 0 && hits[i].t - hits[i - 1].t <= slack(hits[i])) return true;
  }
  for (std::uint32_t node = 0; !hits.empty() && node < snapshot.nodes.size(); ++node) {
    if (node == hits.back().node) continue;
    const Caster::First other = caster.firstOf({&node, 1}, ray);
    if (other.hit && std::abs(other.hit->t - hits.back().t) <= slack(hits.back())) return true;
  }
  return false;
}

class SampleJudge {
 public:
  SampleJudge(const Caster& caster, std::span<const std::uint32_t> nodes, double depth, double rounding)
      : caster_(caster), nodes_(nodes), depth_(depth), rounding_(rounding) {}

  [[nodiscard]] Judgement at(const Vec2& pixel) const {
    const Shown truth = shownAt(pixel);
    if (!truth.certified) return Judgement::Undecided;
    if (agrees(truth, kPointPx)) return Judgement::Right;
    const double farthest = 2 * kSilhouettePx;
    // The plane that leads from the one to the other is of one layer: no outline is between them. What bends
    // shows the point beside the pixel's centre; half of what is allowed is that way, half along the plane.
    const bool sameLayer = agrees(truth, farthest);
    const double px = sameLayer ? 0.5 * kPointPx : kPointPx;
    const double distance =
        distanceTo([&](const Vec2& p) { return agrees(shownAt(p), px); }, pixel, farthest);
    return distance > (sameLayer ? px : kSilhouettePx) ? Judgement::Wrong : Judgement::Right;
  }

 private:
  [[nodiscard]] Shown shownAt(const Vec2& pixel) const {
    const View& view = caster_.snapshot().view;
    const Ray ray = caster_.rayThrough(pixel.x, pixel.y);
    const Caster::First first = caster_.firstOf(nodes_, ray);
    if (!first.hit) return {.certified = first.certified};
    const double cosine = glm::dot(ray.direction, view.forward()), depth = first.hit->t * cosine;
    const double metresPerPixel = (view.perspective() ? depth : 1) / view.pixelsPerUnit;
    const double facing = std::abs(glm::dot(first.hit->facet, ray.direction));
    return {depth, metresPerPixel / (cosine * facing), first.certified};
  }

  [[nodiscard]] bool agrees(const Shown& truth, double px) const {
    if (std::isinf(depth_) || std::isinf(truth.depth)) return depth_ == truth.depth;
    return std::abs(depth_ - truth.depth) <= rounding_ + px * truth.perPixel;
  }

  const Caster& caster_;
  std::span<const std::uint32_t> nodes_;
  double depth_, rounding_;
};

}  // namespace

Judgement judge(const Caster& caster, std::span<const std::uint32_t> nodes, const Vec2& pixel, double depth,
                double rounding) {
  return SampleJudge(caster, nodes, depth, rounding).at(pixel);
}

Judgement judgeShadow(const Caster& caster, std::span<const std::uint32_t> nodes, const Vec2& pixel,
                      std::uint32_t light, const Vec3& reaching) {
  // Nothing: there the answer does not matter.
  const auto truthAt = [&](const Vec2& at, bool& certified) -> std::optional<Vec3> {
    const Caster::First first = caster.firstOf(nodes, caster.rayThrough(at.x, at.y));
    certified &= first.certified;
    if (!first.hit) return std::nullopt;
    if (!caster.shinesOn(light, *first.hit)) return std::nullopt;
    return caster.reaching(light, *first.hit, certified);
  };
  bool certified = true;
  const auto agrees = [&](const std::optional<Vec3>& truth) {
    return !truth || glm::all(glm::lessThanEqual(glm::abs(*truth - reaching), Vec3(kTransmittanceRounding)));
  };
  const bool right = agrees(truthAt(pixel, certified));
  if (!certified) return Judgement::Undecided;
  if (right) return Judgement::Right;
  const double distance = distanceTo(
      [&](const Vec2& at) {
        bool ignored = true;
        return agrees(truthAt(at, ignored));
      },
      pixel, 2 * kSilhouettePx);
  return distance > kSilhouettePx ? Judgement::Wrong : Judgement::Right;
}

Judgement judgeColor(const Caster& caster, const Vec2& pixel, const Vec3& shown, double rounding) {
  const Snapshot& snapshot = caster.snapshot();
  Vec3 least(std::numeric_limits<double>::infinity()), most(-least);
  const auto allowed = [](const Vec3& color) { return kOtherColor * glm::max(Vec3(1), glm::abs(color)); };
  const auto agrees = [&] {
    return glm::all(glm::lessThanEqual(least - allowed(least), shown)) &&
           glm::all(glm::lessThanEqual(shown, most + allowed(most)));
  };
  // Nothing is wrong there, or known.
  const auto settles = [&](const Vec2& at, std::initializer_list<double> tilts) {
    const Ray ray = caster.rayThrough(at.x, at.y);
    const Caster::Sight sight = caster.look(ray);
    bool certified = sight.certified;
    const bool known = std::ranges::all_of(sight.hits, [&](const Hit& hit) {
      return isPlain(snapshot.materials[snapshot.nodes[hit.node].material.index]);
    });
    for (const double tilt : tilts) {
      const Vec3 color = caster.color(ray, sight, certified, tilt);
      least = glm::min(least, color);
      most = glm::max(most, color);
    }
    return !known || !certified || agrees();
  };
  // A light in a surface's own plane is on either side of it.
  if (settles(pixel, {0}) || settles(pixel, {-kCosineRounding, kCosineRounding}) ||
      touchesAnother(caster, pixel, rounding))
    return Judgement::Right;
  const std::vector<Vec2> places = placesAround(pixel, kSilhouettePx);
  const bool right = std::ranges::any_of(places, [&](const Vec2& at) { return settles(at, {0}); });
  return right ? Judgement::Right : Judgement::Wrong;
}

Judgement judgeLayers(const Caster& caster, std::span<const std::uint32_t> nodes, const Vec2& pixel,
                      const LayerSums& shown, double rounding) {
  const View& view = caster.snapshot().view;
  bool certified = true;
  const auto agrees = [&](const Vec2& at, double px) {
    const Ray ray = caster.rayThrough(at.x, at.y);
    const Caster::Sight sight = caster.look(ray, Caster::Invisible::Told);
    certified &= sight.certified;
    LayerSums truth;
    double allowed = 0;
    for (const Hit& hit : sight.hits) {
      if (!std::ranges::binary_search(nodes, hit.node)) continue;
      const double cosine = glm::dot(ray.direction, view.forward()), depth = hit.t * cosine;
      const double metresPerPixel = (view.perspective() ? depth : 1) / view.pixelsPerUnit;
      ++truth.count;
      truth.depths += depth;
      allowed += rounding + px * metresPerPixel / (cosine * std::abs(glm::dot(hit.facet, ray.direction)));
    }
    return truth.count == shown.count && std::abs(truth.depths - shown.depths) <= allowed;
  };
  const bool right = agrees(pixel, kPointPx);
  if (!certified) return Judgement::Undecided;
  if (right) return Judgement::Right;
  // Beside an outline there are as many, as much deeper or less deep as they are there.
  constexpr double kFarthest = 2 * kSilhouettePx;
  const double distance = distanceTo([&](const Vec2& at) { return agrees(at, kFarthest); }, pixel, kFarthest);
  return distance > kSilhouettePx ? Judgement::Wrong : Judgement::Right;
}

}  // namespace luxo::reference
