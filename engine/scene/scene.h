// SPDX-License-Identifier: Apache-2.0
// A scene: nodes in a hierarchy, materials, cameras, parameters, and how to picture them. Built by value,
// read at any time.
//
//     Scene scene;
//     const MaterialId red = scene.add(Material{.diffuse = {0.8, 0.1, 0.1}});
//     scene.add(Node{.rotation = spin({0, 1, 0}, 0.5), .surface = torus(2, 0.5), .material = red});
//     Snapshot snapshot = takeSnapshot(scene, 1.5, {1280, 720});
//
// Units: metres, radians, seconds, linear RGB. Reading is safe from any thread while nobody writes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/animated.h"
#include "math/bounds.h"
#include "math/transform.h"
#include "scene/ambient_occlusion.h"
#include "scene/camera.h"
#include "scene/ids.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/parameter.h"
#include "scene/ranges.h"
#include "surface/segments.h"
#include "surface/surface.h"

namespace luxo {

class ClothSimulation;
class VertexMovement;

/// Right-handed, about an axis of any length; a zero axis is allowed only with angle 0.
struct Rotation {
  Vec3 axis{0, 1, 0};
  double angle = 0;  ///< radians

  friend bool operator==(const Rotation&, const Rotation&) = default;
};

/// Turns for ever: the angle is rate * time, from absolute time (math/transform.h, angleAt).
[[nodiscard]] Animated<Rotation> spin(const Vec3& axis, double radiansPerSecond);

/// parentFromNode = translation * rotation * scale; all three, and visibility, are inherited.
struct Node {
  std::string name = {};
  NodeId parent = {};  ///< none: the world
  Animated<Vec3> translation = Vec3(0);
  Animated<Rotation> rotation = Rotation{};
  Animated<Vec3> scale = Vec3(1);
  Surface surface = {};
  MaterialId material = {};  ///< none: Material{}
  std::optional<Light> light = std::nullopt;
  Animated<bool> visible = true;  ///< false: neither the node nor what hangs on it exists for the picture
  std::optional<Segments> segments = std::nullopt;  ///< a uniform grid instead of a tolerance
};

/// Whether its triangles are a cloth, which moves by itself.
[[nodiscard]] bool isCloth(const Surface& surface);

/// What the picture is when nobody asks otherwise. Ranges: scene/ranges.h.
struct RenderSettings {
  PixelSize size = {1280, 720};  ///< each side 1 to kMaxPictureSide
  double time = 0;
  double fps = 24;         ///< in kFpsRange
  int samples = 1;         ///< per pixel, 1 to kMaxSamples
  double tolerance = 0.5;  ///< pixels, in kToleranceRange
  Shading shading = Shading::Exact;
  bool hiddenLines = false;  ///< of wireframes, shown
  BlendOrder blendOrder = BlendOrder::Exact;
  Vec3 background{0.02, 0.025, 0.03};
  Vec3 ambient{0.1};
  AmbientOcclusion ambientOcclusion = {};

  friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

class Scene {
 public:
  /// A node as stored. Slots are never reused, so ids stay unique.
  struct Entry {
    Node node;
    bool removed = false;
    std::optional<Box>
        constantBounds;  ///< object space, found once, for surfaces whose parameters never change
  };

  Scene();

  /// Parents and casters first: a node may only name what exists (asserted), so one pass in order evaluates
  /// the hierarchy. Throws Error(Scene) naming the thing and the value for constants out of range.
  NodeId add(Node node);
  MaterialId add(Animated<Material> material);
  CameraId add(Camera camera);  ///< the first one added is the default
  ParameterId add(Parameter parameter);

  /// Replaces, with the checks of add. A node's parent must have a smaller id.
  void set(NodeId id, Node node);
  void set(MaterialId id, Animated<Material> material);
  void set(CameraId id, Camera camera);
  void set(const RenderSettings& settings);
  /// What moves its cloth (surface/cloth_simulation.h). One that cannot unless it is set: then snapshots
  /// after step 0 throw Error(Scene). Copies of a scene share it.
  void set(std::shared_ptr<ClothSimulation> simulation);
  /// What runs vertex programs that move meshes (scene/vertex_movement.h). One that cannot unless it is set:
  /// then snapshots with such a mesh throw Error(Scene). Copies of a scene share it.
  void set(std::shared_ptr<VertexMovement> movement);
  /// Nothing is rebuilt: only the version and the next snapshot change. Throws Error(Scene) for a constant
  /// out of range.
  void setParameter(ParameterId id, Animated<double> value);

  void remove(NodeId id);  ///< with everything that hangs on it

  [[nodiscard]] const Node& operator[](NodeId id) const;
  [[nodiscard]] const Animated<Material>& operator[](MaterialId id) const;
  [[nodiscard]] const Camera& operator[](CameraId id) const;
  [[nodiscard]] const Parameter& operator[](ParameterId id) const;
  [[nodiscard]] const RenderSettings& settings() const { return settings_; }

  /// What messages call a node: 'arm', or where it has no name its place, nodes[3].children[1]. Linear.
  [[nodiscard]] std::string shownName(NodeId id) const;

  /// The first of that name, or nothing. Linear.
  [[nodiscard]] std::optional<NodeId> findNode(std::string_view name) const;
  [[nodiscard]] std::optional<CameraId> findCamera(std::string_view name) const;
  [[nodiscard]] std::optional<ParameterId> findParameter(std::string_view name) const;

  [[nodiscard]] const std::vector<Entry>& nodes() const {
    return nodes_;
  }  ///< index = id, removed ones included
  [[nodiscard]] const std::vector<Animated<Material>>& materials() const {
    return materials_;
  }  ///< the first is Material{}
  [[nodiscard]] const std::vector<Camera>& cameras() const { return cameras_; }
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }

  /// Every parameter's value then, by ParameterId: what a Moment of this scene needs. Throws Error(Scene)
  /// naming a parameter that is not finite or outside its range.
  [[nodiscard]] std::vector<double> parametersAt(double timeSeconds) const;

  /// Whether any node is a cloth.
  [[nodiscard]] bool hasCloth() const;
  /// Never null. It remembers, and so changes, while the scene does not.
  [[nodiscard]] const std::shared_ptr<ClothSimulation>& clothSimulation() const { return clothSimulation_; }

  /// Whether a material's vertex program may move meshes. Cost: the materials, then.
  [[nodiscard]] bool movesVertices() const;
  /// Never null. It remembers, and so changes, while the scene does not.
  [[nodiscard]] const std::shared_ptr<VertexMovement>& vertexMovement() const { return vertexMovement_; }

  /// Whether anything is a function of time: if not, one snapshot is right for all times (while no parameter
  /// is set).
  [[nodiscard]] bool movesWithTime() const;
  /// Whether a parameter is one.
  [[nodiscard]] bool parametersMove() const;
  /// Grows with every change made through this interface.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  Entry checked(Node node, std::uint32_t index) const;
  /// As shownName(), of a node that need not be there yet.
  [[nodiscard]] std::string shownName(const Node& node, std::uint32_t index) const;

  std::vector<Entry> nodes_;
  std::vector<Animated<Material>> materials_;
  std::vector<Camera> cameras_;
  std::vector<Parameter> parameters_;
  RenderSettings settings_;
  std::shared_ptr<ClothSimulation> clothSimulation_;
  std::shared_ptr<VertexMovement> vertexMovement_;
  std::uint64_t version_ = 0;
};

}  // namespace luxo
