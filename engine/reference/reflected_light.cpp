// SPDX-License-Identifier: Apache-2.0
// The light that rays see: what their hits reflect of each light, drawings, and the colours of all layers
// together.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "reference/caster.h"
#include "reference/picture_rules.h"

namespace luxo::reference {
namespace {

// The cosine of a light that is in the plane of what it falls on, or lower.
constexpr double kInPlane = 1e-12;

// x^n for 0 <= x <= 1 with 0^0 = 1.
double highlight(double x, double n) { return x > 0 || n == 0 ? std::pow(x, n) : 0; }

}  // namespace

bool Caster::shinesOn(std::uint32_t light, const Hit& hit) const {
  return faces(light, hit) && snapshot_.lights[light].coneTo(hit.position) > 0;
}

bool Caster::faces(std::uint32_t light, const Hit& hit) const {
  const Material& material = materialOf(hit.node);
  return material.lightsBelowHorizon() || glm::dot(hit.normal, towardLight(light, hit)) > kInPlane;
}

Vec3 Caster::towardLight(const SnapshotLight& light, const Hit& hit) {
  const Vec4& at = light.positionWorld;
  return unit(Vec3(at) - hit.position * at.w);
}

double Caster::cosineLoss(const SnapshotLight& light, const Hit& hit) const {
  if (light.directional()) return 1;
  const double distance = glm::distance(Vec3(light.positionWorld), hit.position);
  return 1 + glm::distance(hit.position, snapshot_.view.eye) / (8 * std::max(distance, 1e-300));
}

/// Of a light where nothing is in its way: it fades with the distance, or does not.
Vec3 Caster::radianceAt(const SnapshotLight& light, const Vec3& position) {
  const Vec3 toLight = light.from(position);
  const bool fades = light.attenuation == Light::Attenuation::InverseSquare && !light.directional();
  const double squared = glm::dot(toLight, toLight);
  return squared > 0 ? light.radiance * light.coneTo(position) * (fades ? 1 / squared : 1.0) : Vec3(0);
}

Vec3 Caster::shareOf(const SnapshotLight& light, const Hit& hit, const Reflection& reflection,
                     const Vec3& toViewer, const Vec3& visible, double tilt) const {
  const Material& material = materialOf(hit.node);
  const Vec3 toLight = light.from(hit.position);
  const double distance = glm::length(toLight);
  if (!(distance > 0)) return Vec3(0);
  const Vec3 l = toLight / distance;
  const Vec3 arriving = radianceAt(light, hit.position);
  if (material.drawsLesson()) return lessonOf(reflection).added(l, arriving, visible);
  const double lift = tilt == 0 ? 0 : tilt * cosineLoss(light, hit);
  const double cosine = glm::dot(reflection.normal, l) + lift;
  if ((cosine <= 0 || glm::dot(hit.normal, l) + lift <= 0) && !material.lectureSpecular) return Vec3(0);
  const Vec3 h = unit(l + toViewer);
  const double nh = std::clamp(glm::dot(reflection.normal, h), 0.0, 1.0);
  const Vec3 reflectance =
      reflection.diffuse * std::max(cosine, 0.0) + reflection.specular * highlight(nh, reflection.exponent);
  return reflectance * arriving * visible;
}

LessonPoint Caster::lessonOf(const Reflection& reflection) const {
  return {reflection.diffuse, reflection.glow, reflection.normal, reflection.exponent,
          -snapshot_.view.forward()};
}

Caster::Lit Caster::lightAt(std::uint32_t light, const Hit& hit, const Vec3& toViewer) const {
  const Reflection reflection = reflectionAt(hit);
  const SnapshotLight& one = snapshot_.lights[light];
  Lit lit{.radiance = radianceAt(one, hit.position),
          .unshadowed = shareOf(one, hit, reflection, toViewer, Vec3(1))};
  if (shinesOn(light, hit)) lit.reaching = reaching(light, hit, lit.certified);
  lit.share = shareOf(one, hit, reflection, toViewer, lit.reaching);
  return lit;
}

Vec3 Caster::withoutLights(const Hit& hit, const Reflection& reflection) const {
  const Material& material = materialOf(hit.node);
  if (material.drawsLesson()) return lessonOf(reflection).dark();
  const Vec3 ambient = material.ambient.value_or(reflection.diffuse) * snapshot_.ambient;
  return (ambient == Vec3(0) ? ambient : ambient * openness(hit)) + reflection.glow;
}

Vec3 Caster::withoutLights(const Hit& hit) const { return withoutLights(hit, reflectionAt(hit)); }

Vec3 Caster::diffuseOf(const Hit& hit) const { return reflectionAt(hit).diffuse; }

Vec3 Caster::drawn(const Ray& ray, const Hit& hit, bool& certified, double tilt) const {
  constexpr double kTiny = 1e-30;
  const Reflection reflection = reflectionAt(hit);
  const std::array<Beside, 2> neighbours = besides(ray, hit);
  const double shift = tilt == 0 ? 0 : std::copysign(kDrawnEdgePx, tilt);
  const auto gradient = [&](const auto& value) {
    const double here = value(Vec3(0), hit.normal);
    Vec2 change;
    for (int i = 0; i < 2; ++i) {
      const Beside& beside = neighbours[static_cast<std::size_t>(i)];
      change[i] = value(beside.step, beside.normal) - here;
    }
    return glm::length(change) / kDerivativePx;
  };

  Vec3 bright(0);
  for (const SnapshotLight& light : snapshot_.lights) {
    // Where only a part of a light's cone gets, that part of the cosine counts.
    const auto cosineOf = [&](const Vec3& step, const Vec3& normal) {
      const Vec3 at = hit.position + step;
      return glm::dot(normal, unit(light.from(at))) * light.coneTo(at);
    };
    if (light.radiance == Vec3(0) ||
        (materialOf(hit.node).normalMap.valid() && cosineOf(Vec3(0), hit.normal) <= 0))
      continue;
    const double cosine = cosineOf(Vec3(0), reflection.normal), slope = gradient(cosineOf);
    const auto covered = [&](const Vec3& through) {
      return glm::clamp(
          (cosine * through - kDrawnBright) / glm::max(slope * through, Vec3(kTiny)) + 0.5 + shift, Vec3(0),
          Vec3(1));
    };
    if (glm::all(glm::lessThanEqual(covered(Vec3(1)), bright))) continue;
    const Vec3 through = reaching(light, hit, certified);
    if (through != Vec3(0)) bright = glm::max(bright, covered(through));
  }

  const auto facing = [&](const Vec3& step, const Vec3& normal) {
    const View& view = snapshot_.view;
    const Vec3 toViewer = view.perspective() ? unit(view.eye - hit.position - step) : -ray.direction;
    const double cosine = glm::dot(normal, toViewer);
    return cosine * std::abs(cosine);
  };
  double outline = 0;
  if (!snapshot_.nodes[hit.node].surface.flatNormal()) {
    const double distancePx = std::abs(facing(Vec3(0), hit.normal)) / std::max(gradient(facing), kTiny);
    outline = std::clamp(kDrawnOutlinePx + 0.5 - distancePx - shift, 0.0, 1.0);
  }
  return (reflection.diffuse * (kDrawnShaded + (1 - kDrawnShaded) * bright) + reflection.glow) *
         (1 - outline);
}

Vec3 Caster::illuminated(const Ray& ray, const Hit& hit, bool& certified, double tilt, Wide wide) const {
  if (bodies_[hit.node].drawing) return drawn(ray, hit, certified, tilt);
  const Vec3 toViewer = -ray.direction;
  const Reflection reflection = reflectionAt(hit);
  Vec3 sum = withoutLights(hit, reflection);
  for (const WholeLight& whole : wholes_) {
    if (wide == Wide::Points || whole.number) continue;
    if (shareOf(whole.light, hit, reflection, toViewer, Vec3(1), tilt) == Vec3(0)) continue;
    const SeenPart part = seenPart(whole, hit);
    sum +=
        shareOf(whole.light, hit, reflection, toViewer, wide == Wide::Least ? part.least : part.most, tilt);
  }
  for (const SnapshotLight& light : snapshot_.lights) {
    if (wide != Wide::Points && light.pointOf) continue;
    if (shareOf(light, hit, reflection, toViewer, Vec3(1), tilt) == Vec3(0)) continue;
    // Along its own plane no ray proves anything.
    const double lifted = std::max(tilt * cosineLoss(light, hit), kInPlane);
    const bool isFree = std::abs(glm::dot(hit.normal, towardLight(light, hit))) <= lifted;
    const Vec3 visible = isFree ? Vec3(1) : reaching(light, hit, certified);
    sum += shareOf(light, hit, reflection, toViewer, visible, tilt);
  }
  return sum;
}

std::vector<Caster::Shadowed> Caster::shadowedLights(const Hit& hit, const Vec3& toViewer) const {
  std::vector<Shadowed> lights;
  const Reflection reflection = reflectionAt(hit);
  for (std::uint32_t i = 0; i < snapshot_.lights.size(); ++i) {
    const SnapshotLight& light = snapshot_.lights[i];
    if (!light.hasShadow() || light.pointOf || !shinesOn(i, hit)) continue;
    const auto share = [&](const Vec3& visible) {
      return shareOf(light, hit, reflection, toViewer, visible);
    };
    Shadowed one{.light = i, .share = share(Vec3(1))};
    if (one.share == Vec3(0)) continue;
    const Vec3 left = reaching(light, hit, one.certified);
    one.visible = left != Vec3(0);
    if (one.visible) one.share = share(left);
    one.share -= share(Vec3(0));
    lights.push_back(one);
  }
  return lights;
}

Vec3 Caster::color(const Ray& ray, const Sight& sight, bool& certified, double tilt, Wide wide) const {
  std::vector<Hit> hits(sight.hits.rbegin(), sight.hits.rend());
  if (snapshot_.blendOrder == BlendOrder::Given)
    std::ranges::stable_sort(hits, {}, [this](const Hit& hit) {
      return bodies_[hit.node].transparent ? std::int64_t{hit.node} : -1;
    });
  Vec3 color = snapshot_.background;
  for (const Hit& hit : hits) {
    const Vec3 reflected = illuminated(ray, hit, certified, tilt, wide);
    if (!bodies_[hit.node].transparent) {
      color = reflected;
      continue;
    }
    const double opacity = opacityOf(hit);
    color = opacity * reflected + materialOf(hit.node).transmission(opacity, diffuseOf(hit)) * color;
  }
  return color;
}

}  // namespace luxo::reference
