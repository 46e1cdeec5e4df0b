// SPDX-License-Identifier: Apache-2.0
#include "reference/caster.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace luxo::reference {
namespace {

constexpr int kMostLayers = 1024;  // of transparent surfaces behind each other

// x^n for 0 <= x <= 1 with 0^0 = 1.
double highlight(double x, double n) { return x > 0 || n == 0 ? std::pow(x, n) : 0; }

}  // namespace

Caster::Caster(const Snapshot& snapshot, ShapeCache& cache) : snapshot_(snapshot) {
  std::vector<ShapeCache::Request> requests;
  for (const SnapshotNode& node : snapshot.nodes) requests.emplace_back(node.surface, node.parameters);
  const auto shapes = cache.shapes(requests);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const SnapshotNode& node = snapshot.nodes[i];
    const Material& material = snapshot.materials[node.material.index];
    bodies_.push_back({.shape = PlacedShape(shapes[i], node.worldFromObject),
                       .normalFromObject = normalMatrix(node.worldFromObject.linear),
                       .mirrored = mirrors(node.worldFromObject),
                       .twoSided = material.twoSided == TwoSided::Yes ||
                                   (material.twoSided == TwoSided::Auto && !node.surface.closed()),
                       .facing = material.twoSided == TwoSided::No ? Facing::Front : Facing::Both,
                       .opacity = material.opacity});
  }
}

Caster::Caster(const Snapshot& snapshot) : Caster(snapshot, *std::make_unique<ShapeCache>()) {}

Ray Caster::rayThrough(double x, double y) const {
  const View& view = snapshot_.view;
  const double right = (2 * x / view.size.width - 1) * view.halfExtent.x;
  const double up = (1 - 2 * y / view.size.height) * view.halfExtent.y;
  const Vec3 across = right * view.right() + up * view.up();
  if (view.perspective()) return {view.eye, unit(view.forward() + across)};
  return {view.eye + across, view.forward()};
}

void Caster::meet(const Ray& ray, std::uint32_t node, double nearest, double farthest, Sight& sight) const {
  const SnapshotNode& n = snapshot_.nodes[node];
  const Body& body = bodies_[node];
  RootQuery query{nearest, farthest, body.facing, body.mirrored};
  for (int layer = 0; layer < kMostLayers; ++layer) {
    const Roots roots = body.shape.nearestRoot(ray, query);
    sight.certified &= roots.certified;
    if (!roots.nearest) return;
    const Root& root = *roots.nearest;
    Hit hit{.t = root.t, .node = node, .u = root.u, .v = root.v, .certified = roots.certified};
    hit.position = ray.origin + root.t * ray.direction;
    hit.normal = unit(body.normalFromObject * n.surface.normal(root.patch, root.u, root.v, n.parameters));
    if (body.twoSided && glm::dot(hit.normal, ray.direction) > 0) hit.normal = -hit.normal;
    sight.hits.push_back(hit);
    if (body.opacity >= 1) return;
    // Behind this layer: far enough not to find it again, near enough not to miss the next.
    query.nearest = root.t * (1 + 1e-9);
  }
}

Caster::Sight Caster::look(const Ray& ray) const {
  Sight sight;
  // The near and far planes are planes, not spheres.
  const double perDepth = 1 / glm::dot(ray.direction, snapshot_.view.forward());
  const double nearest = snapshot_.view.near * perDepth;
  double opaque = snapshot_.view.far * perDepth;
  for (std::uint32_t node = 0; node < bodies_.size(); ++node) {
    meet(ray, node, nearest, opaque, sight);
    for (const Hit& hit : sight.hits)
      if (bodies_[hit.node].opacity >= 1) opaque = std::min(opaque, hit.t);
  }
  std::erase_if(sight.hits, [&](const Hit& hit) { return hit.t > opaque; });
  // Of two points at one distance that of the earlier node is in front.
  std::stable_sort(sight.hits.begin(), sight.hits.end(),
                   [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return sight;
}

bool Caster::lit(const SnapshotLight& light, const Hit& hit, bool& certified) const {
  if (!light.shade) return true;
  const SnapshotNode& own = snapshot_.nodes[hit.node];
  if (own.id == light.shade->caster) return true;  // its normals decide
  const Vec3 toLight = Vec3(light.positionWorld) - hit.position * light.positionWorld.w;
  const double distance = glm::length(toLight);
  const Ray ray{hit.position, toLight / distance};
  for (std::uint32_t node = 0; node < bodies_.size(); ++node) {
    if (snapshot_.nodes[node].id != light.shade->caster) continue;
    const Roots roots = bodies_[node].shape.nearestRoot(ray, {0, distance, Facing::Both, false});
    certified &= roots.certified;
    if (roots.nearest) return false;
  }
  return true;
}

Vec3 Caster::diffuseAt(const Hit& hit) const {
  const Material& material = snapshot_.materials[snapshot_.nodes[hit.node].material.index];
  return material.diffusePattern.valid()
             ? material.diffusePattern.colorAt(hit.u, hit.v, material.patternParameters)
             : material.diffuse;
}

Vec3 Caster::shareOf(const SnapshotLight& light, const Hit& hit, const Vec3& toViewer) const {
  const Material& material = snapshot_.materials[snapshot_.nodes[hit.node].material.index];
  const Vec3 toLight = Vec3(light.positionWorld) - hit.position * light.positionWorld.w;
  const double distance = glm::length(toLight);
  if (!(distance > 0)) return Vec3(0);
  const Vec3 l = toLight / distance;
  const double cosine = glm::dot(hit.normal, l);
  if (cosine <= 0 && !material.lectureSpecular) return Vec3(0);
  const Vec3 h = unit(l + toViewer);
  const double nh = std::clamp(glm::dot(hit.normal, h), 0.0, 1.0);
  const Vec3 reflectance =
      diffuseAt(hit) * std::max(cosine, 0.0) + material.specular * highlight(nh, material.shininess);
  const bool fades = light.attenuation == Light::Attenuation::InverseSquare && !light.directional();
  return reflectance * light.radiance * (fades ? 1 / (distance * distance) : 1.0);
}

Vec3 Caster::illuminated(const Hit& hit, const Vec3& toViewer, bool& certified) const {
  const Material& material = snapshot_.materials[snapshot_.nodes[hit.node].material.index];
  Vec3 sum = material.ambient.value_or(diffuseAt(hit)) * snapshot_.ambient;
  for (const SnapshotLight& light : snapshot_.lights) {
    const Vec3 share = shareOf(light, hit, toViewer);
    if (share != Vec3(0) && lit(light, hit, certified)) sum += share;
  }
  return sum;
}

std::vector<Caster::Shadowed> Caster::shadowedLights(const Hit& hit, const Vec3& toViewer) const {
  std::vector<Shadowed> lights;
  for (const SnapshotLight& light : snapshot_.lights) {
    if (!light.shade) continue;
    Shadowed one{.share = shareOf(light, hit, toViewer)};
    if (one.share == Vec3(0)) continue;
    one.visible = lit(light, hit, one.certified);
    lights.push_back(one);
  }
  return lights;
}

Vec3 Caster::color(const Ray& ray, const Sight& sight, bool& certified) const {
  Vec3 color = snapshot_.background;
  for (auto hit = sight.hits.rbegin(); hit != sight.hits.rend(); ++hit) {
    const double opacity = bodies_[hit->node].opacity;
    color = opacity * illuminated(*hit, -ray.direction, certified) + (1 - opacity) * color;
  }
  return color;
}

}  // namespace luxo::reference
