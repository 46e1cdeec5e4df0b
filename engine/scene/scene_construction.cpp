// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_construction.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/error.h"
#include "scene/material_builder.h"
#include "scene/model_files.h"
#include "scene/model_scene.h"
#include "scene/moment_formulas.h"
#include "scene/named.h"
#include "scene/scene_variables.h"
#include "scene/scene_warnings.h"
#include "scene/shape_builder.h"
#include "scene/surface_names.h"
#include "scene/texture_builder.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

struct BuiltSurface {
  const SurfaceDesc* desc = nullptr;
  Surface surface;
  std::optional<Segments> segments;
  /// The same, displaced: by which material, and where among the surfaces.
  std::vector<std::pair<const MaterialDesc*, std::size_t>> displaced = {};
};

/// A material of the file. Where its formulas read the surface it is another one on each, made when a node
/// first has it there.
struct BuiltMaterial {
  const MaterialDesc* desc = nullptr;
  bool readsNames = false;      ///< of the surface's points (scene/surface_names.h): not only its range
  bool readsCurvature = false;  ///< its shader does
  std::optional<Displacement> displacement = {};
  std::optional<MaterialId> everywhere = {};
  std::unordered_map<std::size_t, std::optional<MaterialId>> onSurface = {};  ///< nothing where that failed
};

bool bendsAlongTangents(const MaterialDesc& material) {
  return material.normalMap && material.normalMap->space == NormalSpace::Tangent;
}

bool knowsTangents(const MaterialDesc& material) {
  return bendsAlongTangents(material) || material.hasShader();
}

class SceneConstruction {
 public:
  SceneConstruction(const SceneFile& file, std::span<const ParameterOverride> overrides,
                    SceneProblems& problems, std::vector<Diagnostic>* warnings, WarningsAbout about)
      : file_(file),
        problems_(problems),
        variables_(file, overrides, problems, scene_),
        formulas_(variables_, problems),
        shapes_(variables_, formulas_, problems, warnings, about,
                std::ranges::any_of(file.materials, knowsTangents)),
        images_(formulas_, problems, warnings),
        warnings_(warnings),
        looks_(file, textures_, formulas_, problems, warnings) {}

  Scene build() {
    for (const TextureDesc& texture : file_.textures)
      textures_.add(texture.name, images_.build(texture), problems_);
    for (const MaterialDesc& material : file_.materials) addMaterial(material);
    for (const SurfaceDesc& surface : file_.surfaces) addSurface(surface);
    for (const NodeDesc& node : file_.nodes) addNode(node);
    addModels();
    for (const BuiltMaterial& material : materials_) checkUnused(material);
    setCasters();
    if (file_.camera) addCamera(*file_.camera);
    for (const CameraDesc& camera : file_.cameras) addCamera(camera);
    setRender(file_.render);
    return std::move(scene_);
  }

 private:
  void addMaterial(const MaterialDesc& desc);
  std::optional<MaterialId> makeMaterial(const MaterialDesc& desc, ShapeBuilder::MovingPaint paint);
  std::optional<MaterialId> materialOn(std::optional<std::size_t> surface, BuiltMaterial& material,
                                       const NodeDesc& node);
  bool acceptNames(const NodeDesc& node, const Surface& surface);
  void checkUnused(const BuiltMaterial& material);
  void addSurface(const SurfaceDesc& desc);
  std::size_t shapeOf(std::size_t surface, const BuiltMaterial& material, const NodeDesc& node);
  std::optional<Segments> segments(const std::optional<QuantityPair>& written);
  void addNode(const NodeDesc& desc);
  void addModels();
  void warnOfCutColor(const NodeDesc& desc, const Domain& domain, const Animated<Material>& moving);
  void warnOfTangents(const NodeDesc& desc, const Surface& surface);
  Light light(const LightDesc& desc);
  Spot spot(const SpotDesc& desc);
  ShadowMap shadowMap(const ShadowMapDesc& desc);
  void setCasters();
  void addCamera(const CameraDesc& desc);
  void setRender(const RenderDesc& desc);
  /// A whole number from 1 to `most`.
  std::optional<int> count(const Quantity& quantity, double most);
  Vec3 colorOnce(const Quantity3& color);
  /// Calls `add`; what it throws is a problem there.
  template <class Add>
  void attempt(FilePlace place, const Add& add);

  const SceneFile& file_;
  SceneProblems& problems_;
  Scene scene_;
  SceneVariables variables_;
  MomentFormulas formulas_;
  ShapeBuilder shapes_;
  TextureBuilder images_;
  std::vector<Diagnostic>* warnings_;
  Named<TextureMap> textures_{"texture"};
  MaterialBuilder looks_;
  Named<std::size_t> materialIndices_{"material"};
  std::vector<BuiltMaterial> materials_;
  Named<std::size_t> surfaceIndices_{"surface"};
  std::vector<BuiltSurface> surfaces_;
  std::unordered_map<std::uint32_t, std::vector<NodeId>> partsOfModels_;  // by node of the file
  std::unordered_map<std::shared_ptr<const Model>, std::vector<MaterialId>> materialsOfModels_;
  Named<bool> cameras_{"camera"};
};

template <class Add>
void SceneConstruction::attempt(FilePlace place, const Add& add) {
  try {
    add();
  } catch (const Error& error) {
    problems_.add(place, error.what(), error.hint());
  }
}

void SceneConstruction::addMaterial(const MaterialDesc& desc) {
  attempt(desc.name.place, [&] {
    BuiltMaterial material{&desc};
    const std::size_t problemsBefore = problems_.count();
    ShapeBuilder::MovingPaint paint = shapes_.buildPaint(desc);
    material.readsNames = paint.readsNames;
    material.readsCurvature = looks_.readsCurvature(desc);
    material.displacement = shapes_.buildDisplacement(desc);
    const bool known =
        problems_.count() > problemsBefore || (!paint.readsSurface && !material.readsCurvature);
    if (known) material.everywhere = makeMaterial(desc, std::move(paint));
    materialIndices_.add(desc.name, materials_.size(), problems_);
    materials_.push_back(std::move(material));
  });
}

std::optional<MaterialId> SceneConstruction::makeMaterial(const MaterialDesc& desc,
                                                          ShapeBuilder::MovingPaint paint) {
  std::optional<MaterialId> made;
  attempt(desc.name.place, [&] { made = scene_.add(looks_.build(desc, std::move(paint))); });
  return made;
}

/// The material of a node on its surface, which may be none; nothing where that is a problem.
std::optional<MaterialId> SceneConstruction::materialOn(std::optional<std::size_t> surface,
                                                        BuiltMaterial& material, const NodeDesc& node) {
  if (material.everywhere || !surface || !surfaces_[*surface].surface.valid()) return material.everywhere;
  const auto found = material.onSurface.try_emplace(*surface);
  std::optional<MaterialId>& made = found.first->second;
  if (found.second && (!material.readsNames || acceptNames(node, surfaces_[*surface].surface)))
    attempt(node.material.place, [&] {
      const Surface& shape = surfaces_[*surface].surface;
      ShapeBuilder::MovingPaint paint = shapes_.buildPaint(*material.desc, shape);
      if (material.readsCurvature) {
        paint.curvature = curvaturePattern(shape);
        if (paint.curvature.valid()) paint.curvatureParameters = shape.parameters();
      }
      made = makeMaterial(*material.desc, std::move(paint));
    });
  return made;
}

/// One that reads the surface, and is on none, is made without its colours, for what is wrong with the rest.
void SceneConstruction::checkUnused(const BuiltMaterial& material) {
  if (!material.everywhere && material.onSurface.empty()) static_cast<void>(makeMaterial(*material.desc, {}));
}

bool SceneConstruction::acceptNames(const NodeDesc& node, const Surface& surface) {
  if (surface.isParametric()) return true;
  problems_.add(
      node.material.place,
      fmt::format(
          "the colour, opacity or isolines of material '{}' use the place, normal or curvature of its "
          "surface, and '{}' is a mesh, without a formula of these",
          node.material.text, node.surface.text),
      "give that node a material of u and v, or of one colour");
  return false;
}

void SceneConstruction::addSurface(const SurfaceDesc& desc) {
  surfaceIndices_.add(desc.name, surfaces_.size(), problems_);
  surfaces_.push_back({&desc, shapes_.build(desc), segments(desc.segments)});
}

/// The surface of a node, by its place among all: as it is, or as the node's material displaces it. What is
/// displaced alike is one surface.
std::size_t SceneConstruction::shapeOf(std::size_t surface, const BuiltMaterial& material,
                                       const NodeDesc& node) {
  if (!material.displacement || !surfaces_[surface].surface.valid()) return surface;
  const MaterialDesc& by = *material.desc;
  if (!surfaces_[surface].surface.isParametric()) {
    problems_.add(node.material.place,
                  fmt::format("material '{}' displaces what it is on by a formula of u and v, and '{}' is a "
                              "mesh, without a formula of its points",
                              node.material.text, node.surface.text),
                  "give that node a material without \"displacement\"");
    return surface;
  }
  for (const auto& [other, displaced] : surfaces_[surface].displaced)
    if (other->displacement == by.displacement && other->let == by.let) return displaced;
  const BuiltSurface from = surfaces_[surface];
  surfaces_[surface].displaced.emplace_back(&by, surfaces_.size());
  surfaces_.push_back(
      {from.desc, shapes_.displace(*from.desc, from.surface, by, *material.displacement, node.material.place),
       from.segments});
  return surfaces_.size() - 1;
}

std::optional<int> SceneConstruction::count(const Quantity& quantity, double most) {
  const std::optional<double> value = formulas_.once(quantity);
  if (!value) return std::nullopt;
  if (*value >= 1 && *value <= most && *value == std::floor(*value)) return static_cast<int>(*value);
  problems_.add(quantity.place(),
                fmt::format("this is {}; it must be a whole number from 1 to {}", *value, most));
  return std::nullopt;
}

std::optional<Segments> SceneConstruction::segments(const std::optional<QuantityPair>& written) {
  if (!written) return std::nullopt;
  const std::optional<int> u = count((*written)[0], kMaxSegments), v = count((*written)[1], kMaxSegments);
  if (!u || !v) return std::nullopt;
  return Segments{static_cast<std::uint32_t>(*u), static_cast<std::uint32_t>(*v)};
}

void SceneConstruction::addNode(const NodeDesc& desc) {
  Node node{.name = desc.name.text,
            .parent = desc.parent == kNoParent ? NodeId{} : NodeId{desc.parent},
            .translation = formulas_.vector(desc.translate, kPlace),
            .rotation = formulas_.rotation(desc.rotate),
            .scale = formulas_.vector(desc.scale, kPlace)};
  const Animated<double> visible = formulas_.number(desc.visible);
  if (visible.isConstant())
    node.visible = visible.at(0) != 0;
  else
    node.visible = {[visible](const Moment& moment) { return visible.at(moment) != 0; },
                    visible.movesWithTime() ? DependsOn::Both : DependsOn::Parameters};
  const std::size_t* named = surfaceIndices_.find(desc.surface, problems_);
  const std::size_t* index = materialIndices_.find(desc.material, problems_);
  std::optional<std::size_t> surface = named ? std::optional(*named) : std::nullopt;
  if (surface && index) surface = shapeOf(*surface, materials_[*index], desc);
  if (surface) {
    node.surface = surfaces_[*surface].surface;
    node.segments = surfaces_[*surface].segments;
  }
  if (index)
    if (const std::optional<MaterialId> material = materialOn(surface, materials_[*index], desc)) {
      node.material = *material;
      if (node.surface.valid()) warnOfCutColor(desc, node.surface.domain(), scene_[*material]);
    }
  warnOfTangents(desc, node.surface);
  if (desc.light) node.light = light(*desc.light);
  const Node placeholder{.parent = node.parent};
  const std::size_t before = problems_.count();
  attempt(desc.place, [&] { scene_.add(std::move(node)); });
  if (problems_.count() > before) scene_.add(placeholder);  // so that the ids of the others are right
}

// After the nodes of the file, whose ids are their places in it.
void SceneConstruction::addModels() {
  for (std::uint32_t i = 0; i < file_.nodes.size(); ++i)
    if (const FileName& file = file_.nodes[i].model; !file.empty())
      attempt(file.place, [&] {
        const std::shared_ptr<ModelFiles>& ofScene = file_.source.models;
        const std::shared_ptr<const Model> model =
            (ofScene ? ofScene : std::make_shared<ModelFiles>())->get(file.text, {});
        const auto [materials, fresh] = materialsOfModels_.try_emplace(model);
        if (warnings_ && fresh)
          for (const std::string& warning : model->warnings)
            warnings_->push_back({rangeOf(file.place), warning, {}});
        partsOfModels_.emplace(i, addModel(scene_, NodeId{i}, model, materials->second));
      });
}

// A pixel cannot be infinitely bright, nor say that its colour is none: it is cut, and that is said.
void SceneConstruction::warnOfCutColor(const NodeDesc& desc, const Domain& domain,
                                       const Animated<Material>& moving) {
  if (!warnings_ || problems_.any()) return;
  const Material material = moving.at({0, *variables_.initial()});
  if (!material.diffusePattern.valid()) return;
  const auto cut = material.diffusePattern.whereCut(domain, material.patternParameters);
  if (!cut) return;
  warnings_->push_back(
      {rangeOf(desc.material.place),
       fmt::format("the colour or opacity of material '{}' has no value, or one above 1e18, in u "
                   "{:.4g}..{:.4g}, v {:.4g}..{:.4g} of this surface",
                   desc.material.text, cut->u.lo, cut->u.hi, cut->v.lo, cut->v.hi),
       "it is 0 and 1e18 there; give it a value with if, clamp or max"});
}

void SceneConstruction::warnOfTangents(const NodeDesc& desc, const Surface& surface) {
  const SurfaceTriangles* triangles = surface.valid() ? surface.triangles() : nullptr;
  if (!warnings_ || !triangles || !triangles->mesh.tangents().empty()) return;
  const auto material =
      std::ranges::find(file_.materials, desc.material.text,
                        [](const MaterialDesc& one) -> const std::string& { return one.name.text; });
  if (material != file_.materials.end() && bendsAlongTangents(*material))
    warnings_->push_back(
        {rangeOf(desc.material.place),
         fmt::format("the mesh '{}' has no uvs: its map of normals is not drawn", desc.surface.text),
         {}});
}

Light SceneConstruction::light(const LightDesc& desc) {
  const Allowed radius = desc.type == Light::Type::Point
                             ? Allowed{{0, kMaxSceneNumber}, "from 0 to 1e18 metres"}
                             : Allowed{{0, kMaxLightAngle},
                                       "from 0 to pi/2 radians, 90 degrees: a directional light's radius is "
                                       "the half-angle of its disc",
                                       true};
  const std::optional<int> samples = count(desc.shadowSamples, kMaxShadowSamples);
  return {.type = desc.type,
          .color = formulas_.vector(desc.color, kLight),
          .intensity = formulas_.number(desc.intensity, kIntensity),
          .attenuation = desc.attenuation,
          .spot = desc.spot ? std::optional(spot(*desc.spot)) : std::nullopt,
          .shadow = desc.shadow,
          .radius = formulas_.number(desc.radius, radius),
          .shadowSamples = static_cast<std::uint32_t>(samples.value_or(1)),
          .map = shadowMap(desc.map)};
}

Spot SceneConstruction::spot(const SpotDesc& desc) {
  const Allowed outer{{kLeastSpotAngle, kMaxLightAngle}, "from 1e-9 to 90 degrees", true};
  const Allowed inner{{0, kMaxLightAngle}, "from 0 to 90 degrees", true};
  Spot spot{.inner = formulas_.number(desc.inner, inner), .outer = formulas_.number(desc.outer, outer)};
  if (!spot.inner.isConstant() || !spot.outer.isConstant()) return spot;
  const double a = spot.inner.at(0), b = spot.outer.at(0);  // 0 of what is a problem already
  if (a < b) return spot;
  if (b > 0)
    problems_.add(
        desc.inner == SpotDesc().inner ? desc.place : desc.inner.place(),
        fmt::format("the inner angle is {:g} degrees, the outer one {:g}; the inner one must be smaller",
                    a * 180 / kPi, b * 180 / kPi),
        "all light is within the outer angle, and fades from the inner one on");
  return {};
}

ShadowMap SceneConstruction::shadowMap(const ShadowMapDesc& desc) {
  const Allowed allowed{{0, kMaxSceneNumber}, "from 0 to 1e18"};
  const std::optional<int> size = count(desc.size, kMaxShadowMapSize);
  std::optional<int> pcf = count(desc.pcf, kMaxPcf);
  if (pcf && *pcf % 2 == 0) {
    problems_.add(desc.pcf.place(), fmt::format("this is {}; it must be odd", *pcf),
                  "a square of texels around the one that a point is in");
    pcf.reset();
  }
  return {.size = static_cast<std::uint32_t>(size.value_or(1)),
          .bias = formulas_.number(desc.bias, allowed),
          .slopeBias = formulas_.number(desc.slopeBias, allowed),
          .normalOffset = formulas_.number(desc.normalOffset, allowed),
          .pcf = static_cast<std::uint32_t>(pcf.value_or(1)),
          .receiverPlane = desc.receiverPlane};
}

// Casters and planes may come later in the file than the light; a scene wants them first.
void SceneConstruction::setCasters() {
  Named<NodeId> nodes("node");
  bool known = false;
  for (std::uint32_t i = 0; i < file_.nodes.size(); ++i) {
    const NodeDesc& desc = file_.nodes[i];
    if (!desc.light || (!desc.light->casters && desc.light->shadowPlane.empty())) continue;
    for (std::uint32_t k = 0; k < file_.nodes.size() && !known; ++k)
      if (!file_.nodes[k].name.empty()) nodes.addFirst(file_.nodes[k].name, NodeId{k});
    known = true;
    std::vector<NodeId> casters;
    for (const FileName& name : desc.light->casters.value_or(std::vector<FileName>()))
      if (const NodeId* caster = nodes.find(name, problems_)) {
        const auto model = partsOfModels_.find(caster->index);
        if (model == partsOfModels_.end())
          casters.push_back(*caster);
        else
          casters.insert(casters.end(), model->second.begin(), model->second.end());
      }
    const NodeId* plane =
        desc.light->shadowPlane.empty() ? nullptr : nodes.find(desc.light->shadowPlane, problems_);
    if (problems_.any()) continue;
    Node node = scene_[NodeId{i}];
    if (desc.light->casters && casters.empty()) node.light->shadow = Light::Shadow::None;
    node.light->casters = std::move(casters);
    if (plane) node.light->shadowPlane = *plane;
    attempt(desc.place, [&] { scene_.set(NodeId{i}, std::move(node)); });
  }
}

void SceneConstruction::addCamera(const CameraDesc& desc) {
  cameras_.add(desc.name, true, problems_);
  // The least is a picture of a billionth of what one usually sees: a zoom that doubles still resolve.
  const Allowed angle{{1e-9, std::nextafter(kPi, 0.0)}, "from 1e-9 to below pi, which is 180 degrees", true};
  const bool perspective = desc.projection == Projection::Perspective;
  Camera camera{.name = desc.name.text,
                .eye = formulas_.vector(desc.eye, kPlace),
                .lookAt = formulas_.vector(desc.lookAt, kPlace),
                .up = formulas_.vector(desc.up),
                .fovY = formulas_.number(desc.fovY, perspective ? angle : kFinite),
                .near = formulas_.number(desc.near, kLength),
                .projection = desc.projection,
                .height = formulas_.number(desc.height, perspective ? kFinite : kLength)};
  scene_.add(std::move(camera));
}

Vec3 SceneConstruction::colorOnce(const Quantity3& color) {
  Vec3 value(0);
  for (int i = 0; i < 3; ++i)
    value[i] = formulas_.once(color[static_cast<std::size_t>(i)], kLight).value_or(0);
  return value;
}

void SceneConstruction::setRender(const RenderDesc& desc) {
  RenderSettings settings{
      .shading = desc.shading, .hiddenLines = desc.hiddenLines, .blendOrder = desc.blendOrder};
  const std::optional<int> width = count(desc.size[0], kMaxPictureSide),
                           height = count(desc.size[1], kMaxPictureSide),
                           samples = count(desc.samples, kMaxSamples);
  if (width && height) settings.size = {*width, *height};
  if (samples) settings.samples = *samples;
  settings.time = formulas_.once(desc.time).value_or(0);
  settings.fps = formulas_.once(desc.fps, {kFpsRange, "from 1e-6 to 1e6"}).value_or(1);
  settings.tolerance = formulas_.once(desc.tolerance, {kToleranceRange, "from 1e-6 to 1e6"}).value_or(1);
  settings.background = colorOnce(desc.background);
  settings.ambient = colorOnce(desc.ambient);
  settings.ambientOcclusion = {
      desc.ambientOcclusion.method,
      formulas_.once(desc.ambientOcclusion.radius, {{0, kMaxSceneNumber}, "from 0 to 1e18"}).value_or(0)};
  scene_.set(settings);
}

}  // namespace

Scene constructScene(const SceneFile& file, std::span<const ParameterOverride> overrides,
                     SceneProblems& problems, std::vector<Diagnostic>* warnings, WarningsAbout about) {
  Scene scene = SceneConstruction(file, overrides, problems, warnings, about).build();
  if (warnings) {
    if (about == WarningsAbout::All) addFileWarnings(file, *warnings);
    addShadowWarnings(file, *warnings);
    std::ranges::stable_sort(*warnings, {}, [](const Diagnostic& warning) { return warning.where.begin; });
  }
  return scene;
}

Scene buildScene(const SceneFile& file, std::span<const ParameterOverride> overrides,
                 std::vector<Diagnostic>* warnings, WarningsAbout about) {
  SceneProblems problems(file.source);
  Scene scene = constructScene(file, overrides, problems, warnings, about);
  problems.raise();
  return scene;
}

}  // namespace luxo
