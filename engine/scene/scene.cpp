// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "scene/vertex_movement.h"
#include "surface/cloth_simulation.h"
#include "surface/surface_triangles.h"

namespace luxo {

namespace {

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Finding out what messages call a node takes time, so that only messages ask.
using ShownName = std::function<std::string()>;

void requireFinite(const ShownName& shown, std::string_view name, const Animated<Vec3>& value) {
  if (!value.isConstant()) return;  // checked when a snapshot evaluates it
  const Vec3 v = value.at(0);
  if (!finite(v))
    throw Error(ErrorKind::Scene,
                fmt::format("node {}: {} is ({}, {}, {}); it must be finite", shown(), name, v.x, v.y, v.z));
}

void validate(const Node& node, const ShownName& shown) {
  requireFinite(shown, "translation", node.translation);
  requireFinite(shown, "scale", node.scale);
  if (node.segments && (node.segments->u < 1 || node.segments->v < 1))
    throw Error(ErrorKind::Scene, fmt::format("node {}: segments are {} x {}; they must be at least 1",
                                              shown(), node.segments->u, node.segments->v));
  if (node.light && node.light->color.isConstant() && node.light->intensity.isConstant())
    static_cast<void>(radianceAt(*node.light, 0, shown));
  if (node.light && node.light->radius.isConstant()) static_cast<void>(radiusAt(*node.light, 0, shown));
  if (node.light && node.light->spot &&
      (node.light->type != Light::Type::Point ||
       (node.light->spot->inner.isConstant() && node.light->spot->outer.isConstant())))
    static_cast<void>(spotConeAt(*node.light, SpotCone().axis, 0, shown));
  if (node.light && (node.light->shadowSamples < 1 || node.light->shadowSamples > kMaxShadowSamples))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node {}: {} shadow samples; they must be from 1 to {}", shown(),
                            node.light->shadowSamples, kMaxShadowSamples));
  if (node.light && (node.light->map.size < 1 || node.light->map.size > kMaxShadowMapSize))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node {}: its map's size is {}; it must be from 1 to {}", shown(),
                            node.light->map.size, kMaxShadowMapSize));
  if (node.light && (node.light->map.pcf % 2 == 0 || node.light->map.pcf > kMaxPcf))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node {}: its map's pcf is {}; it must be odd, up to {}", shown(),
                            node.light->map.pcf, kMaxPcf));
}

void validate(const RenderSettings& s) {
  const auto reject = [](std::string_view name, const std::string& found, std::string_view wanted) {
    throw Error(ErrorKind::Scene,
                fmt::format("render settings: {} is {}; it must be {}", name, found, wanted));
  };
  const auto color = [&](std::string_view name, const Vec3& c) {
    if (!isColor(c))
      reject(name, fmt::format("({}, {}, {})", c.x, c.y, c.z), fmt::format("from 0 to {}", kMaxSceneNumber));
  };
  const auto within = [&](std::string_view name, double value, const Interval& range) {
    if (!range.contains(value))
      reject(name, fmt::format("{}", value), fmt::format("from {} to {}", range.lo, range.hi));
  };
  for (const int side : {s.size.width, s.size.height})
    if (side < 1 || side > kMaxPictureSide)
      reject("size", fmt::format("{}x{}", s.size.width, s.size.height),
             fmt::format("from 1 to {} pixels on each side", kMaxPictureSide));
  color("background", s.background);
  color("ambient", s.ambient);
  if (!std::isfinite(s.time)) reject("time", fmt::format("{}", s.time), "finite");
  within("fps", s.fps, kFpsRange);
  if (s.samples < 1 || s.samples > kMaxSamples)
    reject("samples", fmt::format("{}", s.samples), fmt::format("from 1 to {}", kMaxSamples));
  within("tolerance", s.tolerance, kToleranceRange);
}

bool constantParameters(const Surface& surface) {
  return std::ranges::all_of(surface.parameters(), &Animated<double>::isConstant);
}

bool movesWithTime(const Node& node) {
  return isCloth(node.surface) || node.translation.movesWithTime() || node.rotation.movesWithTime() ||
         node.scale.movesWithTime() || node.visible.movesWithTime() ||
         (node.light && node.light->movesWithTime()) ||
         (node.surface.valid() &&
          std::ranges::any_of(node.surface.parameters(), &Animated<double>::movesWithTime));
}

Animated<Material> checked(Animated<Material> material) {
  if (material.isConstant()) validate(material.at(0));  // others when a snapshot evaluates them
  return material;
}

std::optional<Box> constantBounds(const Surface& surface) {
  if (!surface.valid() || !constantParameters(surface)) return std::nullopt;
  std::vector<double> parameters;
  for (const Animated<double>& parameter : surface.parameters()) parameters.push_back(parameter.at(0));
  return surface.bounds(parameters);
}

template <class Id, class Things, class Name>
std::optional<Id> findNamed(const Things& things, Name matches) {
  const auto found = std::ranges::find_if(things, matches);
  if (found == things.end()) return std::nullopt;
  return Id{static_cast<std::uint32_t>(found - things.begin())};
}

}  // namespace

bool isCloth(const Surface& surface) { return surface.triangles() && surface.triangles()->cloth; }

Animated<Rotation> spin(const Vec3& axis, double radiansPerSecond) {
  return [=](double t) { return Rotation{axis, angleAt(radiansPerSecond, t)}; };
}

Scene::Scene()
    : materials_{Animated<Material>(Material{.name = "default"})},
      clothSimulation_(std::make_shared<ClothSimulation>()),
      vertexMovement_(std::make_shared<VertexMovement>()) {}

Scene::Entry Scene::checked(Node node, std::uint32_t index) const {
  const auto exists = [&](NodeId id) { return id.index < nodes_.size() && !nodes_[id.index].removed; };
  LUXO_REQUIRE(!node.parent.valid() || (node.parent.index < index && exists(node.parent)));
  if (node.light) LUXO_REQUIRE(std::ranges::all_of(node.light->casters, exists));
  if (node.light) LUXO_REQUIRE(!node.light->shadowPlane.valid() || exists(node.light->shadowPlane));
  if (!node.material.valid()) node.material = MaterialId{0};
  LUXO_REQUIRE_COMPARE(node.material.index, <, materials_.size());
  validate(node, [&] { return shownName(node, index); });
  std::optional<Box> bounds = constantBounds(node.surface);
  return {.node = std::move(node), .constantBounds = bounds};
}

NodeId Scene::add(Node node) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(checked(std::move(node), index));
  ++version_;
  return {index};
}

MaterialId Scene::add(Animated<Material> material) {
  materials_.push_back(luxo::checked(std::move(material)));
  ++version_;
  return {static_cast<std::uint32_t>(materials_.size() - 1)};
}

CameraId Scene::add(Camera camera) {
  cameras_.push_back(std::move(camera));
  ++version_;
  return {static_cast<std::uint32_t>(cameras_.size() - 1)};
}

ParameterId Scene::add(Parameter parameter) {
  LUXO_REQUIRE(!findParameter(parameter.name));
  validate(parameter);
  parameters_.push_back(std::move(parameter));
  ++version_;
  return {static_cast<std::uint32_t>(parameters_.size() - 1)};
}

void Scene::set(NodeId id, Node node) {
  LUXO_REQUIRE(id.index < nodes_.size() && !nodes_[id.index].removed);
  nodes_[id.index] = checked(std::move(node), id.index);
  ++version_;
}

void Scene::set(MaterialId id, Animated<Material> material) {
  LUXO_REQUIRE_COMPARE(id.index, <, materials_.size());
  materials_[id.index] = luxo::checked(std::move(material));
  ++version_;
}

void Scene::set(CameraId id, Camera camera) {
  LUXO_REQUIRE_COMPARE(id.index, <, cameras_.size());
  cameras_[id.index] = std::move(camera);
  ++version_;
}

void Scene::set(const RenderSettings& settings) {
  validate(settings);
  settings_ = settings;
  ++version_;
}

void Scene::set(std::shared_ptr<ClothSimulation> simulation) {
  LUXO_REQUIRE(simulation != nullptr);
  clothSimulation_ = std::move(simulation);
  ++version_;
}

void Scene::set(std::shared_ptr<VertexMovement> movement) {
  LUXO_REQUIRE(movement != nullptr);
  vertexMovement_ = std::move(movement);
  ++version_;
}

void Scene::setParameter(ParameterId id, Animated<double> value) {
  LUXO_REQUIRE_COMPARE(id.index, <, parameters_.size());
  Parameter& parameter = parameters_[id.index];
  if (value.isConstant()) requireAllowed(parameter, value.at(0));
  parameter.value = std::move(value);
  ++version_;
}

void Scene::remove(NodeId id) {
  LUXO_REQUIRE_COMPARE(id.index, <, nodes_.size());
  nodes_[id.index].removed = true;
  for (std::size_t i = id.index + 1; i < nodes_.size(); ++i) {
    const NodeId parent = nodes_[i].node.parent;
    if (parent.valid() && nodes_[parent.index].removed) nodes_[i].removed = true;
  }
  ++version_;
}

const Node& Scene::operator[](NodeId id) const {
  LUXO_REQUIRE_COMPARE(id.index, <, nodes_.size());
  return nodes_[id.index].node;
}

const Animated<Material>& Scene::operator[](MaterialId id) const {
  LUXO_REQUIRE_COMPARE(id.index, <, materials_.size());
  return materials_[id.index];
}

const Camera& Scene::operator[](CameraId id) const {
  LUXO_REQUIRE_COMPARE(id.index, <, cameras_.size());
  return cameras_[id.index];
}

const Parameter& Scene::operator[](ParameterId id) const {
  LUXO_REQUIRE_COMPARE(id.index, <, parameters_.size());
  return parameters_[id.index];
}

std::string Scene::shownName(NodeId id) const { return shownName((*this)[id], id.index); }

std::string Scene::shownName(const Node& node, std::uint32_t index) const {
  if (!node.name.empty()) return fmt::format("'{}'", node.name);
  std::string path;
  for (const Node* inner = &node;;) {
    std::size_t before = 0;
    for (std::uint32_t i = 0; i < index; ++i)
      before += !nodes_[i].removed && nodes_[i].node.parent == inner->parent;
    const bool root = !inner->parent.valid();
    path = fmt::format("{}[{}]{}", root ? "nodes" : ".children", before, path);
    if (root) return path;
    index = inner->parent.index;
    inner = &nodes_[index].node;
  }
}

std::optional<NodeId> Scene::findNode(std::string_view name) const {
  return findNamed<NodeId>(nodes_,
                           [&](const Entry& entry) { return !entry.removed && entry.node.name == name; });
}

std::optional<CameraId> Scene::findCamera(std::string_view name) const {
  return findNamed<CameraId>(cameras_, [&](const Camera& camera) { return camera.name == name; });
}

std::optional<ParameterId> Scene::findParameter(std::string_view name) const {
  return findNamed<ParameterId>(parameters_,
                                [&](const Parameter& parameter) { return parameter.name == name; });
}

std::vector<double> Scene::parametersAt(double timeSeconds) const {
  std::vector<double> values;
  values.reserve(parameters_.size());
  for (const Parameter& parameter : parameters_) {
    values.push_back(parameter.value.at({timeSeconds, values}));
    requireAllowed(parameter, values.back());
  }
  return values;
}

bool Scene::hasCloth() const {
  return std::ranges::any_of(
      nodes_, [](const Entry& entry) { return !entry.removed && isCloth(entry.node.surface); });
}

bool Scene::movesVertices() const {
  const std::vector<double> values = parametersAt(settings_.time);
  return std::ranges::any_of(materials_, [&](const Animated<Material>& material) {
    return material.at({settings_.time, values}).movesVertices();
  });
}

bool Scene::movesWithTime() const {
  return std::ranges::any_of(
             nodes_, [](const Entry& entry) { return !entry.removed && luxo::movesWithTime(entry.node); }) ||
         std::ranges::any_of(cameras_, &Camera::movesWithTime) ||
         std::ranges::any_of(materials_, &Animated<Material>::movesWithTime) || parametersMove();
}

bool Scene::parametersMove() const {
  return std::ranges::any_of(parameters_,
                             [](const Parameter& parameter) { return parameter.value.movesWithTime(); });
}

}  // namespace luxo
