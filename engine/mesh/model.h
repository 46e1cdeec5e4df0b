// SPDX-License-Identifier: Apache-2.0
// What a model file holds: meshes, materials with their images, and, of glTF, nodes that move, cameras,
// lights.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/file_source.h"
#include "math/transform.h"
#include "mesh/triangle_mesh.h"

namespace luxo {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The bytes of an image file as they are, or where they lie.
struct ModelImage {
  std::string name;
  std::string place = {};  ///< what names it first, for messages: "cube.mtl:4", "lamp.glb: images[3]"
  std::filesystem::path file = {};  ///< exists and is inside the model's folder, unless it may be outside
  FileBytes bytes = nullptr;        ///< instead of a file on disk: embedded, or in memory as the model
};

/// How a map is read: uv' = turned(angle) * (scale * uv) + offset, where a turn takes u toward v. Row 0 of
/// the image, its top, is at v = 0, as in glTF; readers of other formats have turned their v around.
struct ModelMap {
  enum class Wrap { Repeat, Clamp, Mirror };
  std::uint32_t image = kNone;  ///< of Model::images; kNone: no map
  Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
  bool nearest = false;  ///< instead of a trilinear filter
  Vec2 offset{0}, scale{1};
  double angle = 0;  ///< radians

  [[nodiscard]] bool given() const { return image != kNone; }
};

/// As Blinn's model has it (scene/material.h). Colours are linear factors of what their map says.
struct ModelMaterial {
  std::string name;
  Vec3 diffuse{0.7};
  std::optional<Vec3> ambient = std::nullopt;  ///< the diffuse colour unless given
  Vec3 specular{0.2};
  double shininess = 30;
  double opacity = 1;
  Vec3 glow{0};           ///< light of its own
  bool twoSided = false;  ///< asked for by the file
  /// Of opacities from a map: what is below is not there, the rest is opaque. 0: as it is, seen through.
  double cutoff = 0;
  bool opacityFromMap = false;  ///< the alpha of `map` is the opacity
  bool lesson = false;          ///< for the lesson's formula (scene/lesson.h), which its maps are made for
  bool objectNormals = false;   ///< the normal map is in object space, not in that of the tangents
  double normalScale = 1;       ///< of the x and y of normal maps
  bool specularColors = false;  ///< the specular map is of colours (sRGB)
  ModelMap map, normalMap, specularMap, glowMap;  ///< colour (sRGB), data (tangent space), data, colour

  [[nodiscard]] bool hasMaps() const {
    return map.given() || normalMap.given() || specularMap.given() || glowMap.given();
  }
};

/// Values at times, and what is between them.
struct Keyframes {
  enum class Interpolation { Linear, Step, CubicSpline };
  Interpolation interpolation = Interpolation::Linear;
  std::vector<double> times;  ///< seconds, ascending, at least one
  /// One a time: x, y, z of a translation or scale, the quaternion x, y, z, w of a rotation. Of cubic splines
  /// three: the tangent toward it, itself, the tangent from it.
  std::vector<Vec4> values;

  /// Before the first and after the last time the value there. Rotations are linear on the sphere (slerp, the
  /// shorter way), and unit.
  [[nodiscard]] Vec4 at(double seconds, bool rotation) const;
};

struct ModelNode {
  std::string name;
  std::uint32_t parent = kNone;  ///< before it in Model::nodes
  Vec3 translation{0};
  Vec4 rotation{0, 0, 0, 1};  ///< unit quaternion x, y, z, w
  Vec3 scale{1};
  std::optional<Keyframes> translationKeys, rotationKeys, scaleKeys;
  std::uint32_t mesh = kNone, camera = kNone, light = kNone;

  [[nodiscard]] bool moves() const { return translationKeys || rotationKeys || scaleKeys; }
  /// At a time; parentFromNode = translation * rotation * scale.
  [[nodiscard]] Vec3 translationAt(double seconds) const;
  [[nodiscard]] Vec4 rotationAt(double seconds) const;  ///< unit quaternion x, y, z, w
  [[nodiscard]] Vec3 scaleAt(double seconds) const;
  [[nodiscard]] Transform parentFromNodeAt(double seconds) const;
};

/// At its node, looking along -Z, up is +Y.
struct ModelCamera {
  std::string name;
  bool perspective = true;
  double fovY = radians(45);  ///< full vertical angle
  double height = 2;          ///< of what an orthographic one shows
  double near = 0.1;
  double far = 1000;  ///< of an orthographic one, where it is written; scenes fit it to what they show
};

/// At its node; directional ones shine along -Z. KHR_lights_punctual, whose unit of light is kept: candela of
/// points and spots (they fall with the square of the distance), lux of directions. That a range is not read
/// is a warning.
struct ModelLight {
  /// Half-angles in radians, 0 <= inner < outer <= a quarter turn, of a cone around -Z.
  struct Spot {
    double inner = 0, outer = kPi / 4;
  };
  std::string name;
  bool directional = false;
  std::optional<Spot> spot = {};  ///< of one that is not directional
  Vec3 color{1};                  ///< linear
  double intensity = 1;
};

struct Model {
  std::string name;  ///< of the file
  std::vector<TriangleMesh> meshes;
  /// A mesh's material numbers are indices of these; there is always at least one.
  std::vector<ModelMaterial> materials;
  std::vector<ModelImage> images;
  std::vector<ModelNode> nodes;  ///< parents first; each mesh is at one node at least
  std::vector<ModelCamera> cameras;
  std::vector<ModelLight> lights;
  /// Linear, of what luxo itself wrote: light from everywhere, and what is behind all.
  std::optional<Vec3> ambient = std::nullopt, background = std::nullopt;
  /// The scene (scene/scene_reader.h) whose surfaces the meshes stand for, as a text: what a GLB carries as
  /// LUXO_parametric_surface (mesh/gltf_writer.cpp). Empty: none.
  std::string scene;
  FilesInMemory sceneFiles;           ///< all that it names
  double duration = 0;                ///< seconds, of the longest keyframes
  std::vector<std::string> warnings;  ///< what the picture goes without: missing images, dropped triangles
  std::vector<std::filesystem::path> files;  ///< what it is made of, and what it names, there or not

  [[nodiscard]] std::uint64_t triangleCount() const;
  /// Whether it says how it is lit.
  [[nodiscard]] bool lit() const { return !lights.empty() || ambient; }
};

/// Where a node is at a time. Cost: that of its ancestors.
[[nodiscard]] Transform worldFromNodeAt(const Model& model, std::uint32_t node, double seconds = 0);
/// Where all nodes are, to the same bits. Cost: that of the nodes, however deep they hang.
[[nodiscard]] std::vector<Transform> worldFromNodesAt(const Model& model, double seconds = 0);

struct ModelOptions {
  MeshOptions mesh = {};      ///< tangents are made wherever a material has a normal map
  bool allowOutside = false;  ///< files that the model names may be outside of its folder
  FileSource from = {};       ///< of the model, and of what it names
  /// Called now and then, in the caller's thread, with the part that is done: 0 to 1, ascending. It may
  /// throw.
  std::function<void(double)> progress = {};
};

/// Whether the suffix is one of .obj, .gltf, .glb, .ply, .stl, in either case.
[[nodiscard]] bool namesModel(const std::filesystem::path& path);

/// Reads a model. Error(Usage): a suffix that names none. Error(Scene),
/// with the file and, of texts, the line: missing, unreadable, damaged, or of a kind that is not supported.
/// Nothing is allocated because a file says so: memory is at most proportional to the bytes it has.
[[nodiscard]] Model readModel(const std::filesystem::path& path, const ModelOptions& options = {});

}  // namespace luxo
