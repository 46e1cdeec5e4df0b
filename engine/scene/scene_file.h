// SPDX-License-Identifier: Apache-2.0
// What a scene file says, as data: every number as it was written, every name with its place, nothing
// evaluated. In comes text (scene/scene_reader.h) or C++; out goes a scene (scene/scene_builder.h) or text
// (scene/scene_writer.h).
//
//     SceneFile file;
//     file.parameters.push_back({.name = "k", .value = 3, .range = QuantityPair{1, 12}});
//     file.surfaces.push_back({.name = "s", .shape = FormulaShape{.position = {"u", "sin(k*u)", "v"}}});
//     file.nodes.push_back({.surface = "s"});
//     Scene scene = buildScene(file);
//
// Metres, radians, seconds, linear RGB. Two descriptions are equal when they say the same, wherever it
// stands.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "scene/light.h"
#include "scene/material.h"
#include "scene/scene.h"

namespace luxo {

class ModelFiles;
class ShaderFiles;
class TextureFiles;
enum class NormalRule;

/// Bytes [begin, end) of the file; empty for what was made in C++.
struct FilePlace {
  std::uint32_t begin = 0, end = 0;

  friend bool operator==(const FilePlace&, const FilePlace&) { return true; }
};

/// A name or a text.
struct FileName {
  std::string text;
  FilePlace place = {};

  FileName() = default;
  FileName(std::string name, FilePlace where = {}) : text(std::move(name)), place(where) {}  // NOLINT
  FileName(const char* name) : text(name) {}                                                 // NOLINT

  [[nodiscard]] bool empty() const { return text.empty(); }
  friend bool operator==(const FileName&, const FileName&) = default;
};

/// A number, or the formula of one (formula/parse.h).
class Quantity {
 public:
  Quantity() = default;
  template <class Number>
  requires(std::is_arithmetic_v<Number>)
      Quantity(Number number, FilePlace place = {})  // NOLINT: a number is one
      : number_(static_cast<double>(number)), place_(place) {}
  Quantity(std::string formula, FilePlace place = {})  // NOLINT
      : formula_(std::make_shared<const std::string>(std::move(formula))), place_(place) {}
  Quantity(const char* formula) : Quantity(std::string(formula)) {}  // NOLINT

  [[nodiscard]] bool isFormula() const { return formula_ != nullptr; }
  [[nodiscard]] double number() const { return number_; }                 ///< 0 for a formula
  [[nodiscard]] const std::string& formula() const { return *formula_; }  ///< required: isFormula()
  [[nodiscard]] FilePlace place() const { return place_; }

  /// Numbers bit by bit, formulas letter by letter.
  friend bool operator==(const Quantity& a, const Quantity& b);

 private:
  double number_ = 0;
  std::shared_ptr<const std::string> formula_;
  FilePlace place_;
};

using QuantityPair = std::array<Quantity, 2>;
using Quantity3 = std::array<Quantity, 3>;

[[nodiscard]] inline Quantity3 repeated(const Quantity& q) { return {q, q, q}; }

struct ParameterDesc {
  FileName name = {};
  Quantity value = {};  ///< of `t` and of any other parameter that does not need this one
  std::optional<QuantityPair> range = {};
  std::optional<Quantity> step = {};
  std::string label = {};

  friend bool operator==(const ParameterDesc&, const ParameterDesc&) = default;
};

/// An image file, or what is made without one: squares of two colours, or one colour.
struct TextureDesc {
  FileName name = {};
  FileName file = {};  ///< relative to the folder of the scene, and in it
  std::optional<std::array<Quantity3, 2>> checker = {};
  Quantity squares = 8;  ///< of a checker, along u and along v
  std::optional<Quantity3> color = {};
  TextureWrap wrap = TextureWrap::Repeat;
  TextureFilter filter = TextureFilter::Trilinear;
  Quantity anisotropy = 8;
  bool data = false;  ///< its numbers are no colours

  friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
};

/// A texture by its name, and where it is (TextureMap).
struct MapDesc {
  FileName texture = {};
  QuantityPair offset{0, 0}, scale{1, 1};
  Quantity rotate = 0;
  bool alpha = false;  ///< Material::mapOpacity: of "map" alone

  friend bool operator==(const MapDesc&, const MapDesc&) = default;
};

/// A map of normals says what they are relative to.
struct NormalMapDesc {
  MapDesc map = {};
  NormalSpace space = NormalSpace::Tangent;

  friend bool operator==(const NormalMapDesc&, const NormalMapDesc&) = default;
};

/// A value for a uniform of a material's shader: a number, or some, those of matrices row after row; or a
/// texture, which a single formula names, too, where the uniform is a sampler.
struct UniformDesc {
  FileName name = {};
  std::vector<Quantity> values = {};
  FilePlace place = {};
  std::optional<MapDesc> map = {};
  bool truth = false;  ///< said as true or false

  friend bool operator==(const UniformDesc&, const UniformDesc&) = default;
};

/// `let`: a name for a formula, for the formulas beside it.
struct LetDesc {
  FileName name = {};
  Quantity value = {};

  friend bool operator==(const LetDesc&, const LetDesc&) = default;
};

/// As Isolines: where a formula is `at` + k `step`, or without a step `at`; and so many lines of constant u
/// and of constant v over the surface's range.
struct IsolinesDesc {
  std::optional<Quantity> of = {}, step = {}, u = {}, v = {};
  Quantity at = 0, width = 1.2, opacity = 1;
  Quantity3 color = repeated(0);
  FilePlace place = {};

  friend bool operator==(const IsolinesDesc&, const IsolinesDesc&) = default;
};

/// As Material. A diffuse or ambient colour, or an opacity, that uses u or v is a pattern on the surface.
struct MaterialDesc {
  FileName name = {};
  std::vector<LetDesc> let = {};  ///< for `diffuse`, `opacity`, `isolines` and `displacement`
  Quantity3 diffuse = repeated(0.7);
  std::optional<Quantity3> ambient = {};
  Quantity3 specular = repeated(0.2);
  Quantity shininess = 30, opacity = 1;
  Quantity cutoff = 0;        ///< Material::cutoff
  Quantity displacement = 0;  ///< of u and v: metres along the normal of the surface that it is on
  Blend blend = Blend::Over;
  TwoSided twoSided = TwoSided::Auto;
  std::optional<Shading> shading = {};
  bool lectureSpecular = false;
  bool lesson = false;  ///< "shading": "lesson", which is exact shading otherwise
  std::optional<MapDesc> map = {}, specularMap = {}, glowMap = {};
  std::optional<NormalMapDesc> normalMap = {};
  std::vector<IsolinesDesc> isolines = {};
  FileName shader = {};  ///< relative to the folder of the scene, and in it; empty: none
  FileName vertex = {};  ///< the same, of a vertex program in the course's style, beside a shader or alone
  std::vector<UniformDesc> uniforms = {};

  [[nodiscard]] bool hasShader() const { return !shader.empty() || !vertex.empty(); }

  /// Those that there are, in the order of Material::maps(); null: none.
  [[nodiscard]] std::array<const MapDesc*, 4> maps() const {
    return {map ? &*map : nullptr, normalMap ? &normalMap->map : nullptr,
            specularMap ? &*specularMap : nullptr, glowMap ? &*glowMap : nullptr};
  }

  friend bool operator==(const MaterialDesc&, const MaterialDesc&) = default;
};

/// One of the catalogue (surface/catalogue.h), by its type's name. Arguments that are left out have their
/// default.
struct NamedShape {
  struct Argument {
    FileName name = {};
    std::vector<Quantity> values = {};  ///< one, or as many as the argument has components

    friend bool operator==(const Argument&, const Argument&) = default;
  };
  FileName type = {};
  std::vector<Argument> arguments = {};

  friend bool operator==(const NamedShape&, const NamedShape&) = default;
};

/// position(u, v).
struct FormulaShape {
  QuantityPair u{0, 1}, v{0, 1};
  std::optional<std::array<bool, 2>> closed = {};  ///< a statement about the u and v directions, verified
  std::vector<LetDesc> let = {};
  Quantity3 position = {};
  FilePlace closedPlace = {};

  friend bool operator==(const FormulaShape&, const FormulaShape&) = default;
};

/// The profile (radius(v), height(v)) turned about the Y axis; u counts turns.
struct RevolveShape {
  QuantityPair u{0, 1}, v{0, 1};
  std::vector<LetDesc> let = {};
  Quantity radius = {}, height = {};

  friend bool operator==(const RevolveShape&, const RevolveShape&) = default;
};

/// A pipe around curve(u); v, from 0 to 1, runs around it (surface/tube.h).
struct TubeShape {
  QuantityPair u{0, 1};
  std::vector<LetDesc> let = {};
  Quantity3 curve = {};
  Quantity radius = {};

  friend bool operator==(const TubeShape&, const TubeShape&) = default;
};

/// Bicubic patches: 16 control points each, given by their index, row by row.
struct BezierShape {
  std::vector<Quantity3> points = {};
  std::vector<std::array<std::uint32_t, 16>> patches = {};

  friend bool operator==(const BezierShape&, const BezierShape&) = default;
};

/// The triangles of a model file, all of them as one surface (scene/model_scene.h).
struct MeshShape {
  FileName file = {};         ///< relative to the folder of the scene, and in it
  NormalRule normals{};       ///< Given
  Quantity crease = "45deg";  ///< MeshOptions::crease

  friend bool operator==(const MeshShape&, const MeshShape&) = default;
};

/// What is held of a cloth: a corner or an edge by its name, or the point nearest to (u, v).
struct ClothPinDesc {
  FileName name = {};  ///< empty: at `point`
  QuantityPair point{0, 0};

  friend bool operator==(const ClothPinDesc&, const ClothPinDesc&) = default;
};

/// What a cloth lies on.
struct ClothBallDesc {
  Quantity3 center = repeated(0);
  Quantity radius = {}, friction = 10;

  friend bool operator==(const ClothBallDesc&, const ClothBallDesc&) = default;
};

/// As Cloth (surface/cloth.h). Cells and pins depend on nothing, other numbers not on time.
struct ClothShape {
  QuantityPair cells{24, 24}, size{1, 1};
  Quantity density = 0.2, stretch = 60, shear = 15, bend = 1e-5, damping = 0.2, step = 0.001;
  Quantity3 gravity{0, -9.81, 0};
  std::vector<ClothPinDesc> pins = {};
  std::optional<ClothBallDesc> ball = {};

  friend bool operator==(const ClothShape&, const ClothShape&) = default;
};

struct SurfaceDesc {
  FileName name = {};
  /// Nothing: it could not be read (never for what parseScene() returns).
  std::variant<std::monostate, NamedShape, FormulaShape, RevolveShape, TubeShape, BezierShape, MeshShape,
               ClothShape>
      shape = {};
  std::optional<QuantityPair> segments = {};  ///< a uniform grid instead of the tolerance

  friend bool operator==(const SurfaceDesc&, const SurfaceDesc&) = default;
};

struct RotationDesc {
  Quantity3 axis{0, 1, 0};
  Quantity angle = {};
  FilePlace place = {};

  friend bool operator==(const RotationDesc&, const RotationDesc&) = default;
};

struct ShadowMapDesc {
  Quantity size = 2048, bias = 0, slopeBias = 0, normalOffset = 0, pcf = 1;
  bool receiverPlane = false;
  FilePlace place = {};

  friend bool operator==(const ShadowMapDesc&, const ShadowMapDesc&) = default;
};

struct SpotDesc {
  Quantity inner = 0, outer = "45deg";
  FilePlace place = {};

  friend bool operator==(const SpotDesc&, const SpotDesc&) = default;
};

struct LightDesc {
  Light::Type type = Light::Type::Point;
  Quantity3 color = repeated(1);
  Quantity intensity = 1;
  Light::Attenuation attenuation = Light::Attenuation::None;
  std::optional<SpotDesc> spot = {};
  Light::Shadow shadow = Light::Shadow::None;
  Quantity radius = 0, shadowSamples = 16;
  ShadowMapDesc map = {};
  FileName shadowPlane = {};
  std::optional<std::vector<FileName>> casters = {};  ///< not given: all

  friend bool operator==(const LightDesc&, const LightDesc&) = default;
};

inline constexpr std::uint32_t kNoParent = std::numeric_limits<std::uint32_t>::max();

/// About 600 bytes.
struct NodeDesc {
  FileName name = {};                ///< unique unless empty
  std::uint32_t parent = kNoParent;  ///< index of an earlier node
  Quantity3 translate = repeated(0);
  std::vector<RotationDesc> rotate = {};  ///< [A, B] is A * B
  Quantity3 scale = repeated(1);
  Quantity visible = 1;  ///< not 0
  FileName surface = {}, material = {};
  FileName model =
      {};  ///< instead of both: a file with its own, relative to the folder of the scene, and in it
  std::optional<LightDesc> light = {};
  FilePlace place = {};

  friend bool operator==(const NodeDesc&, const NodeDesc&) = default;
};

struct CameraDesc {
  FileName name = "camera";
  Quantity3 eye{0, 0, 5}, lookAt = repeated(0), up{0, 1, 0};
  Quantity fovY = "40deg", near = 0.1, height = 10;
  Projection projection = Projection::Perspective;

  friend bool operator==(const CameraDesc&, const CameraDesc&) = default;
};

struct OcclusionDesc {
  OcclusionMethod method = OcclusionMethod::Screen;
  Quantity radius = {};

  friend bool operator==(const OcclusionDesc&, const OcclusionDesc&) = default;
};

/// As RenderSettings. Read once, when the scene is built: parameters count, time does not.
struct RenderDesc {
  QuantityPair size{1280, 720};
  Quantity time = {}, fps = 24, samples = 1, tolerance = 0.5;
  Shading shading = Shading::Exact;
  bool hiddenLines = false;
  BlendOrder blendOrder = BlendOrder::Exact;
  Quantity3 background{0.02, 0.025, 0.03}, ambient = repeated(0.1);
  OcclusionDesc ambientOcclusion = {};

  friend bool operator==(const RenderDesc&, const RenderDesc&) = default;
};

/// The text that a description was read from, for messages, and the files that it names.
struct SceneSource {
  std::string name;
  std::shared_ptr<const std::string> text;      ///< null for what was made in C++
  std::shared_ptr<ModelFiles> models = {};      ///< null: of the current folder
  std::shared_ptr<TextureFiles> textures = {};  ///< the same
  std::shared_ptr<ShaderFiles> shaders = {};    ///< the same

  friend bool operator==(const SceneSource&, const SceneSource&) { return true; }
};

struct SceneFile {
  RenderDesc render;
  std::vector<ParameterDesc> parameters;
  std::vector<TextureDesc> textures;
  std::vector<MaterialDesc> materials;
  std::vector<SurfaceDesc> surfaces;
  std::vector<NodeDesc> nodes;       ///< depth first: a node comes after its parent and before its uncles
  std::optional<CameraDesc> camera;  ///< the default one
  std::vector<CameraDesc> cameras;   ///< the first is the default if there is no `camera`
  SceneSource source;

  friend bool operator==(const SceneFile&, const SceneFile&) = default;
};

}  // namespace luxo
