// SPDX-License-Identifier: Apache-2.0
#include "reference/caster.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

#include "math/basis.h"
#include "math/sampling.h"
#include "reference/picture_rules.h"
#include "scene/ranges.h"

namespace luxo::reference {
namespace {

// Of the distances involved: how far a hit may be off its surface. Roots are found to some 1e-13.
constexpr double kHitRounding = 1e-11;
constexpr double kRootRounding = 1e-12;  // and how far a root may be from where another search finds it
constexpr double kGrazing = 1e-4;        // the cosine below which a ray leaves its own surface no sooner

/// How many of two vectors a third one in their plane is.
Vec2 partsOf(const Vec3& step, const Vec3& su, const Vec3& sv) {
  const Vec3 n = glm::cross(su, sv);
  return Vec2(glm::dot(glm::cross(step, sv), n), glm::dot(glm::cross(su, step), n)) / glm::dot(n, n);
}

/// How far along a ray another search may find that hit, metres.
double rootOff(const Ray& ray, const Hit& hit) {
  const double reach = glm::length(hit.position) + glm::length(ray.origin);
  const double off = kRootRounding * reach / std::max(std::abs(glm::dot(hit.facet, ray.direction)), kGrazing);
  return std::max(1e-9 * hit.t, off);
}

}  // namespace

Caster::Caster(const Snapshot& snapshot, ShapeCache& cache, Cells cells, Shading shading,
               std::optional<Shading> geometryIn)
    : snapshot_(snapshot), wholes_(wholeLights(snapshot)) {
  std::vector<ShapeCache::Request> requests;
  for (const SnapshotNode& node : snapshot.nodes) requests.emplace_back(node.surface, node.parameters);
  const auto shapes = cache.shapes(requests);
  if (cells == Cells::AtOnce)
    tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) { shapes[i]->build(); });
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const SnapshotNode& node = snapshot.nodes[i];
    const Material& material = snapshot.materials[node.material.index];
    bodies_.push_back(
        {.shape = PlacedShape(shapes[i], node.worldFromObject),
         .normalFromObject = normalMatrix(node.worldFromObject.linear),
         .mirrored = mirrors(node.worldFromObject),
         .twoSided = material.twoSided == TwoSided::Yes ||
                     (material.twoSided == TwoSided::Auto && !node.surface.closed()),
         .facing = material.twoSided == TwoSided::No ? Facing::Front : Facing::Both,
         .transparent = geometryIn ? material.seenThroughIn(*geometryIn, true) : material.transparent(),
         .drawing = material.shadingIn(shading) == Shading::Toon});
    Body& body = bodies_.back();
    body.normalFromTexel = normalFromTexel(material, body.normalFromObject);
    if (material.drawsMaps())
      std::ranges::transform(material.maps(), body.maps.begin(),
                             [&](const TextureMap* map) { return map->on(node.surface); });
  }
}

Caster::Caster(const Snapshot& snapshot, Shading shading)
    : Caster(snapshot, *std::make_unique<ShapeCache>(), Cells::AtOnce, shading) {}

Ray Caster::rayThrough(double x, double y) const {
  const View& view = snapshot_.view;
  const double right = (2 * x / view.size.width - 1) * view.halfExtent.x;
  const double up = (1 - 2 * y / view.size.height) * view.halfExtent.y;
  const Vec3 across = right * view.right() + up * view.up();
  if (view.perspective()) return {view.eye, unit(view.forward() + across)};
  return {view.eye + across, view.forward()};
}

Caster::Range Caster::rangeOf(const Ray& ray) const {
  const double perDepth = 1 / glm::dot(ray.direction, snapshot_.view.forward());
  return {snapshot_.view.near * perDepth, snapshot_.view.far * perDepth};
}

bool Caster::mayMeet(const Ray& ray, std::uint32_t node) const {
  const Box& box = snapshot_.nodes[node].boundsWorld;
  double enters = 0, leaves = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    // Far above what rounding makes of distances.
    const double slack = 1e-9 * (std::abs(box.min[i]) + std::abs(box.max[i]) + std::abs(ray.origin[i]));
    const double a = (box.min[i] - slack - ray.origin[i]) / ray.direction[i],
                 b = (box.max[i] + slack - ray.origin[i]) / ray.direction[i];
    if (std::isnan(a) || std::isnan(b)) continue;  // along the face of an infinite or a flat box
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves * (1 + 1e-9);
}

Hit Caster::hitAt(const Beam& beam, std::uint32_t node, const Root& root) const {
  const Ray& ray = beam.ray;
  const SnapshotNode& n = snapshot_.nodes[node];
  const Body& body = bodies_[node];
  Hit hit{.t = root.t, .node = node, .u = root.u, .v = root.v, .patch = root.patch};
  hit.position = ray.origin + root.t * ray.direction;
  if (n.surface.triangles()) {
    placeOnTriangle(beam, root, hit);
    return hit;
  }
  const Vec3 outward =
      unit(body.normalFromObject * n.surface.normal(root.patch, root.u, root.v, n.parameters));
  hit.back = glm::dot(outward, ray.direction) > 0;
  const bool turned = body.twoSided && hit.back;
  hit.normal = hit.facet = turned ? -outward : outward;
  if (materialOf(node).readsFootprint()) {
    const SurfacePoints at = n.surface.evaluate(root.patch, {&root.u, 1}, {&root.v, 1}, n.parameters);
    const Mat3& world = n.worldFromObject.linear;
    const Vec3 su = world * at.du[0], sv = world * at.dv[0];
    hit.footprint = footprintOf(beam, hit, su, sv);
    hit.frame = normalFrame(su, sv, outward, turned);
  }
  return hit;
}

std::optional<Hit> Caster::pointAt(std::uint32_t node, const Vec2& parameters, const Ray& ray) const {
  const SnapshotNode& of = snapshot_.nodes[node];
  std::optional<Hit> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t patch = 0; patch < of.surface.patchCount(); ++patch) {
    const Domain& domain = of.surface.patches()[patch].domain;
    const Vec2 inside(std::clamp(parameters.x, domain.u.lo, domain.u.hi),
                      std::clamp(parameters.y, domain.v.lo, domain.v.hi));
    const Vec2 beyond = glm::abs(inside - parameters);
    if (!(beyond.x <= kPatchSlack * domain.u.width() && beyond.y <= kPatchSlack * domain.v.width())) continue;
    const Vec3 position = transformPoint(
        of.worldFromObject, BoundedPatch(of.surface, patch, of.parameters).at(inside.x, inside.y).position);
    const double off = glm::length(glm::cross(position - ray.origin, ray.direction));
    if (!(off < least)) continue;
    least = off;
    nearest = hitAt(
        {ray}, node,
        {.t = glm::dot(position - ray.origin, ray.direction), .patch = patch, .u = inside.x, .v = inside.y});
    nearest->position = position;
  }
  return nearest;
}

std::array<Vec3, 2> Caster::stepsAt(const Beam& beam, const Hit& hit) const {
  const View& view = snapshot_.view;
  const Vec3& along = beam.ray.direction;
  if (!beam.travelled) {
    const double depth = view.perspective() ? glm::dot(along, view.forward()) * hit.t : 1;
    return {view.right() * (depth / view.pixelsPerUnit), view.up() * (-depth / view.pixelsPerUnit)};
  }
  const Vec3 right = unit(glm::cross(along, std::abs(along.y) < 0.5 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)));
  const double size = (view.perspective() ? *beam.travelled + hit.t : 1) / view.pixelsPerUnit;
  return {right * size, glm::cross(along, right) * size};
}

/// The neighbours' rays meet the plane where the neighbours are, moved along the ray.
Footprint Caster::footprintOf(const Beam& beam, const Hit& hit, const Vec3& su, const Vec3& sv) const {
  const Vec3& along = beam.ray.direction;
  const Vec3 n = glm::cross(su, sv);
  const double perCosine = 1 / glm::dot(n, along);
  const std::array<Vec3, 2> steps = stepsAt(beam, hit);
  Footprint footprint;
  for (int i = 0; i < 2; ++i)
    footprint[i] = partsOf(steps[i] - along * (glm::dot(n, steps[i]) * perCosine), su, sv);
  return footprint;
}

Caster::Reflection Caster::reflectionAt(const Hit& hit) const {
  const Material& material = materialOf(hit.node);
  Reflection reflection{hit.normal, material.diffuseAt(hit.u, hit.v), material.specular, Vec3(0),
                        material.shininess};
  if (!material.drawsMaps()) {
    reflection.diffuse = material.underIsolines(reflection.diffuse, hit.u, hit.v, hit.footprint);
    return reflection;
  }
  const Body& body = bodies_[hit.node];
  const auto texel = [&](const TextureMap& map, const TexturePlacement& placement) {
    return map.valid() ? Vec3(map.at(placement, {hit.u, hit.v}, hit.footprint)) : Vec3(1);
  };
  reflection.diffuse = material.underIsolines(reflection.diffuse * texel(material.map, body.maps[0]), hit.u,
                                              hit.v, hit.footprint);
  if (material.normalMap.valid())
    reflection.normal = bentNormal(material, body.normalFromTexel, texel(material.normalMap, body.maps[1]),
                                   hit.normal, hit.frame);
  const Vec3 ofSpecular = texel(material.specularMap, body.maps[2]);
  reflection.specular *= ofSpecular;
  if (material.drawsLesson() && material.specularMap.valid()) reflection.exponent = 255 * ofSpecular.x;
  if (material.glowMap.valid()) reflection.glow = material.glow * texel(material.glowMap, body.maps[3]);
  return reflection;
}

/// Interpolated by weights as the renderer does it: (u, v), and unit normals in the world. Which of its sides
/// is seen the normal tells, or, where that is nearly across the ray, the triangle (shaders/lib/scene.glsl).
void Caster::placeOnTriangle(const Beam& beam, const Root& root, Hit& hit) const {
  const Ray& ray = beam.ray;
  const Body& body = bodies_[hit.node];
  const SurfaceTriangles& triangles = *snapshot_.nodes[hit.node].surface.triangles();
  const std::array<std::uint32_t, 3> corners = triangles.corners(root.patch);
  const std::array<Vec3, 3> points = triangles.points(root.patch);
  const std::array<double, 3> weights{1 - root.u - root.v, root.u, root.v};
  Vec2 parameters(0);
  for (std::size_t i = 0; i < 3; ++i) {
    hit.normal += weights[i] * unit(body.normalFromObject * Vec3(triangles.mesh.normals()[corners[i]]));
    if (!triangles.mesh.uvs().empty()) parameters += weights[i] * Vec2(triangles.mesh.uvs()[corners[i]]);
  }
  hit.u = parameters.x;
  hit.v = parameters.y;
  const double length = glm::length(hit.normal);
  hit.normal = unit(hit.normal);
  hit.facet = unit(body.normalFromObject * glm::cross(points[1] - points[0], points[2] - points[0]));
  const Mat3& world = snapshot_.nodes[hit.node].worldFromObject.linear;
  if (materialOf(hit.node).readsFootprint() && !triangles.mesh.uvs().empty()) {
    const auto uv = [&](std::size_t i) { return Vec2(triangles.mesh.uvs()[corners[i]]); };
    hit.footprint = Mat2(uv(1) - uv(0), uv(2) - uv(0)) *
                    footprintOf(beam, hit, world * (points[1] - points[0]), world * (points[2] - points[0]));
  }
  const double cosine = -glm::dot(hit.normal, ray.direction);
  const bool front = std::abs(cosine) > kTurningAway ? cosine > 0 : glm::dot(hit.facet, ray.direction) < 0;
  const bool turned = body.twoSided && !front;
  hit.back = !front;
  if (turned) hit.normal = -hit.normal;
  if (!materialOf(hit.node).drawsMaps() || triangles.mesh.tangents().empty()) return;
  Vec3 tangent(0);
  for (std::size_t i = 0; i < 3; ++i)
    tangent += weights[i] * unit(world * Vec3(triangles.mesh.tangents()[corners[i]]));
  const double handed = triangles.mesh.tangents()[corners[0]].w * (body.mirrored ? -length : length);
  hit.frame = NormalFrame(tangent, handed) * (turned ? -1.0 : 1.0);
}

double Caster::beyond(const Ray& ray, const Hit& hit) const { return hit.t + rootOff(ray, hit); }

Caster::First Caster::firstOf(std::span<const std::uint32_t> nodes, const Ray& ray) const {
  First first;
  auto [nearest, farthest] = rangeOf(ray);
  std::optional<Root> root;
  std::uint32_t of = 0;
  for (const std::uint32_t node : nodes) {
    if (!mayMeet(ray, node)) continue;
    const Body& body = bodies_[node];
    const Roots roots = body.shape.nearestRoot(ray, {nearest, farthest, body.facing, body.mirrored});
    first.certified &= roots.certified;
    if (!roots.nearest || (root && roots.nearest->t >= root->t)) continue;
    root = roots.nearest;
    of = node;
    farthest = root->t;
  }
  if (root) first.hit = hitAt({ray}, of, *root);
  return first;
}

void Caster::prepareFor(std::span<const Ray> rays, std::span<const std::uint32_t> nodes,
                        std::size_t worth) const {
  for (const std::uint32_t node : nodes) {
    const Shape& shape = bodies_[node].shape.shape();
    if (shape.hasClosedForm()) continue;
    const auto count = std::ranges::count_if(rays, [&](const Ray& ray) { return mayMeet(ray, node); });
    if (count > 0) shape.prepareFor(worth * static_cast<std::size_t>(count));
  }
}

void Caster::meet(const Beam& beam, std::uint32_t node, const Range& range, Invisible invisible,
                  Sight& sight) const {
  const Ray& ray = beam.ray;
  const Body& body = bodies_[node];
  const Material& material = materialOf(node);
  double nearest = range.nearest;
  const RootQuery query{nearest, range.farthest, body.facing, body.mirrored};
  RootWalk walk(body.shape, ray, query);
  for (int layer = 0; layer < kMaxLayers; ++layer) {
    const Roots roots = body.transparent ? walk.from(nearest) : body.shape.nearestRoot(ray, query);
    sight.certified &= roots.certified;
    if (!roots.nearest) return;
    const Hit hit = hitAt(beam, node, *roots.nearest);
    const bool told = invisible == Invisible::Told && !material.invisible();
    if (!body.transparent || told || material.blend == Blend::Multiply || opacityOf(hit) > 0) {
      sight.hits.push_back(hit);
      sight.hits.back().certified = roots.certified;
    }
    if (!body.transparent) return;
    nearest = beyond(ray, hit);
  }
  sight.certified = false;
}

Caster::Sight Caster::look(const Beam& beam, const Range& range, Invisible invisible) const {
  Sight sight;
  double opaque = range.farthest;
  for (std::uint32_t node = 0; node < bodies_.size(); ++node) {
    if (!mayMeet(beam.ray, node)) continue;
    meet(beam, node, {range.nearest, opaque}, invisible, sight);
    for (const Hit& hit : sight.hits)
      if (!bodies_[hit.node].transparent) opaque = std::min(opaque, hit.t);
  }
  std::erase_if(sight.hits, [opaque](const Hit& hit) { return hit.t > opaque; });
  std::stable_sort(sight.hits.begin(), sight.hits.end(),
                   [this](const Hit& a, const Hit& b) { return isInFront(a, b); });
  return sight;
}

const Hit* Caster::firstShown(const Sight& sight) const {
  // A number as devices have it, so that both decide alike.
  const auto first = std::ranges::find_if(sight.hits, [this](const Hit& hit) {
    return !materialOf(hit.node).hasHoles() || static_cast<float>(opacityOf(hit)) >= float{kLeastShown};
  });
  return first == sight.hits.end() ? nullptr : &*first;
}

Caster::Sight Caster::lookFrom(const Hit& hit, const Vec3& direction, double travelled) const {
  const Ray ray{hit.position, unit(direction)};
  return look({ray, travelled}, {ownReach(hit, ray.direction), std::numeric_limits<double>::infinity()},
              Invisible::Skipped);
}

bool Caster::isInFront(const Hit& a, const Hit& b) const {
  if (a.t != b.t) return a.t < b.t;
  if (bodies_[a.node].transparent != bodies_[b.node].transparent) return bodies_[a.node].transparent;
  if (!bodies_[a.node].transparent) return false;
  const auto looks = [this](const Hit& hit) {
    const Reflection reflection = reflectionAt(hit);
    const Material& material = materialOf(hit.node);
    const double opacity = opacityOf(hit);
    const Vec3 transmission = material.transmission(opacity, reflection.diffuse);
    std::array<double, 20> numbers{opacity, reflection.exponent};
    auto next = numbers.begin() + 2;
    for (const Vec3& v : {reflection.diffuse, reflection.specular, material.ambientOrDiffuse(),
                          reflection.glow, reflection.normal, transmission})
      for (int axis = 0; axis < 3; ++axis) *next++ = v[axis];
    return numbers;
  };
  const auto ofA = looks(a), ofB = looks(b);
  if (ofA != ofB) return ofA < ofB;
  // What a shader shows, only its text and what it is given tell.
  const Material &first = materialOf(a.node), &second = materialOf(b.node);
  if (!first.shader || !second.shader) return second.shader != nullptr;
  if (first.shader->files != second.shader->files) return first.shader->files < second.shader->files;
  return std::ranges::lexicographical_compare(
      first.uniforms, second.uniforms, [](const UniformValue& one, const UniformValue& other) {
        return std::tie(one.name, one.values) < std::tie(other.name, other.values);
      });
}

double Caster::ownReach(const Hit& hit, const Vec3& direction) const {
  const double reach = glm::distance(hit.position, snapshot_.view.eye) + glm::length(hit.position);
  return kHitRounding * reach / std::max(std::abs(glm::dot(hit.facet, direction)), kGrazing);
}

Vec3 Caster::through(std::uint32_t node, const SnapshotLight& light, const Hit& hit, bool& certified) const {
  const Vec3 toLight = Vec3(light.positionWorld) - hit.position * light.positionWorld.w;
  const double distance =
      light.directional() ? std::numeric_limits<double>::infinity() : glm::length(toLight);
  const Ray ray{hit.position, unit(toLight)};
  if (!mayMeet(ray, node)) return Vec3(1);
  double nearest = ownReach(hit, ray.direction);
  const Body& body = bodies_[node];
  // A light that is on the caster is behind none of it: the ray ends before it, by more than rounding moves a
  // root.
  const double reach = glm::length(hit.position) + glm::length(Vec3(light.positionWorld));
  const double margin = light.directional() ? 0 : std::max(1e-9 * distance, kRootRounding * reach / kGrazing);
  if (!(nearest < distance - margin)) return Vec3(1);
  const RootQuery query{nearest, distance - margin, Facing::Both, false};
  if (!materialOf(node).letsLightThrough()) {
    const Roots roots = body.shape.nearestRoot(ray, query);
    certified &= roots.certified;
    return Vec3(roots.nearest ? 0 : 1);
  }
  RootWalk walk(body.shape, ray, query);
  Vec3 left(1);
  for (int layer = 0; layer < kMaxLayers; ++layer) {
    const Roots roots = walk.from(nearest);
    certified &= roots.certified;
    if (!roots.nearest) return left;
    Hit met = hitAt({ray}, node, *roots.nearest);
    met.footprint = Footprint(0);  // light has no pixels
    left *= materialOf(node).lightThrough(opacityOf(met), diffuseOf(met));
    // A ray leaves a plane where it meets it.
    if (left == Vec3(0) || snapshot_.nodes[node].surface.flatNormal()) return left;
    nearest = beyond(ray, met);
  }
  certified = false;
  return left;
}

Vec3 Caster::reaching(const SnapshotLight& light, const Hit& hit, bool& certified) const {
  if (light.plane && *light.plane != snapshot_.nodes[hit.node].id) return Vec3(1);
  Vec3 left(1);
  for (const NodeId caster : light.casters)
    if (const std::optional<std::uint32_t> node = nodeOf(caster);
        node && left != Vec3(0) && (!light.map || materialOf(*node).letsLightThrough()))
      left *= through(*node, light, hit, certified);
  return left;
}

Caster::SeenPart Caster::seenPart(const WholeLight& whole, const Hit& hit) const {
  constexpr std::uint32_t kRim = 16;
  SnapshotLight point = whole.light;
  const Vec3 at(point.positionWorld);
  const bool directional = point.directional();
  const Vec3 ahead = directional ? at : unit(at - hit.position);
  const auto [right, up] = completed(ahead);
  const Mat3 axes(right, up, ahead);
  // Of a disc that is 1 away, of a directional light.
  const double size = directional ? std::tan(std::min(whole.radius, 0.999 * kMaxLightAngle)) : whole.radius;
  const auto from = [&](const Vec2& place) -> SeenPart {
    const Vec3 aside = size * (axes * Vec3(place, 0));
    point.positionWorld = directional ? Vec4(unit(at + aside), 0) : Vec4(at + aside, 1);
    const Vec3 way = Vec3(point.positionWorld) - hit.position * point.positionWorld.w;
    bool known = glm::dot(hit.normal, way) > 0 || materialOf(hit.node).lightsBelowHorizon();
    const Vec3 left = known ? reaching(point, hit, known) : Vec3(0);
    return known ? SeenPart{left, left} : SeenPart{Vec3(0), Vec3(1)};
  };
  SeenPart part = from(Vec2(0));
  bool agree = part.least == part.most;
  for (std::uint32_t k = 0; k < kRim && agree; ++k) {
    const SeenPart rim = from(Vec2(std::cos(kTau * k / kRim), std::sin(kTau * k / kRim)));
    agree = rim.least == part.least && rim.most == part.most;
  }
  if (!agree) {
    part = {};
    for (std::uint32_t k = 0; k < kSeenPartRays; ++k) {
      const SeenPart one = from(discPoint(k, kSeenPartRays));
      part.least += one.least / double(kSeenPartRays);
      part.most += one.most / double(kSeenPartRays);
    }
  }
  return {glm::max(part.least - kSeenPartOff, Vec3(0)), glm::min(part.most + kSeenPartOff, Vec3(1))};
}

std::optional<std::uint32_t> Caster::nodeOf(NodeId id) const {
  const auto node = std::ranges::lower_bound(snapshot_.nodes, id.index, {},
                                             [](const SnapshotNode& n) { return n.id.index; });
  if (node == snapshot_.nodes.end() || node->id != id) return std::nullopt;
  return static_cast<std::uint32_t>(node - snapshot_.nodes.begin());
}

double Caster::opacityOf(const Hit& hit) const {
  const Material& material = materialOf(hit.node);
  const double own = material.opacityAt(hit.u, hit.v);
  if (!material.mapOpacity) return own;
  const double alpha = material.map.at(bodies_[hit.node].maps[0], {hit.u, hit.v}, hit.footprint).w;
  return material.cutOut(own * std::min(alpha, 1.0));
}

Vec3 Caster::normalBeside(const Hit& hit, const Vec3& step) const {
  const SnapshotNode& node = snapshot_.nodes[hit.node];
  const Body& body = bodies_[hit.node];
  const Mat3& world = node.worldFromObject.linear;
  Vec3 normal(0);
  if (const SurfaceTriangles* triangles = node.surface.triangles()) {
    const std::array<std::uint32_t, 3> corners = triangles->corners(hit.patch);
    const std::array<Vec3, 3> points = triangles->points(hit.patch);
    const Vec2 weights = partsOf(hit.position + step - transformPoint(node.worldFromObject, points[0]),
                                 world * (points[1] - points[0]), world * (points[2] - points[0]));
    const std::array<double, 3> all{1 - weights.x - weights.y, weights.x, weights.y};
    for (std::size_t i = 0; i < 3; ++i)
      normal += all[i] * unit(body.normalFromObject * Vec3(triangles->mesh.normals()[corners[i]]));
  } else {
    const SurfacePoints at = node.surface.evaluate(hit.patch, {&hit.u, 1}, {&hit.v, 1}, node.parameters);
    const Vec2 moved = Vec2(hit.u, hit.v) + partsOf(step, world * at.du[0], world * at.dv[0]);
    const Domain& domain = node.surface.patches()[hit.patch].domain;
    normal = body.normalFromObject *
             node.surface.normal(hit.patch, std::clamp(moved.x, domain.u.lo, domain.u.hi),
                                 std::clamp(moved.y, domain.v.lo, domain.v.hi), node.parameters);
  }
  normal = unit(normal);
  if (!(glm::length(normal) > 0)) return hit.normal;
  return glm::dot(normal, hit.normal) < 0 ? -normal : normal;
}

std::array<Caster::Beside, 2> Caster::besides(const Ray& ray, const Hit& hit) const {
  const double perCosine = 1 / glm::dot(hit.facet, ray.direction);
  std::array<Beside, 2> besides;
  const std::array<Vec3, 2> steps = stepsAt({ray}, hit);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 step = kDerivativePx * steps[i];
    besides[i].step = step - ray.direction * (glm::dot(hit.facet, step) * perCosine);
    besides[i].normal = normalBeside(hit, besides[i].step);
  }
  return besides;
}

}  // namespace luxo::reference
