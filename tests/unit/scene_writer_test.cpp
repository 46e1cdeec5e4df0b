// SPDX-License-Identifier: Apache-2.0
// Descriptions as text: canonical, readable, and read back they are the same.
#include "scene/scene_writer.h"
#include "mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "scene/scene_reader.h"
#include "scene_examples.h"
#include "scene_test_support.h"
#include "surface/catalogue.h"

namespace luxo {
namespace {

/// Reads without building: random formulas need not mean anything.
SceneFile readBack(const SceneFile& file) {
  const std::string text = writeScene(file);
  try {
    return parseScene(text, "written");
  } catch (const Error& error) {
    ADD_FAILURE() << error.what() << "\n" << text;
    return {};
  }
}

TEST(SceneWriter, IsCanonical) {
  SceneFile file;
  file.render.background = {1, linearFromSrgb(128 / 255.0), 0};
  file.render.ambient = repeated(0.3);
  file.parameters = {{.name = "k", .value = 3, .range = QuantityPair{1, 12}, .label = "lobes"},
                     {.name = "l", .value = "2k"}};
  file.materials = {{.name = "red", .diffuse = {0.5, "k/10", 0}, .shininess = 60, .twoSided = TwoSided::No}};
  file.surfaces = {{.name = "ball", .shape = NamedShape{.type = "sphere", .arguments = {{"radius", {0.35}}}}},
                   {.name = "flag",
                    .shape = FormulaShape{.let = {{"a", "8u + t"}}, .position = {"3u", "2v", "0.2*sin(a)"}},
                    .segments = QuantityPair{64, 32}}};
  file.nodes = {{.name = "a", .translate = {0, 0.4, 0}, .rotate = {{{0, 1, 0}, "0.5t"}}, .surface = "ball"},
                {.parent = 0, .surface = "flag", .material = "red"},
                {.name = "sun",
                 .visible = 0,
                 .light = LightDesc{.intensity = 40, .casters = std::vector<FileName>{"a"}}}};
  file.camera = CameraDesc{.eye = {"18*sin(t/4)", 9, "18*cos(t/4)"}, .fovY = "50deg"};
  EXPECT_EQ(writeScene(file), R"_({
  "luxo": 1,
  "render": { "background": "#ff8000", "ambient": 0.3 },
  "params": { "k": { "value": 3, "range": [1, 12], "label": "lobes" }, "l": "2k" },
  "materials": { "red": { "diffuse": [0.5, "k/10", 0], "shininess": 60, "two_sided": false } },
  "surfaces": {
    "ball": { "type": "sphere", "radius": 0.35 },
    "flag": {
      "type": "formula",
      "let": { "a": "8u + t" },
      "position": ["3u", "2v", "0.2*sin(a)"],
      "segments": [64, 32]
    }
  },
  "nodes": [
    {
      "name": "a",
      "translate": [0, 0.4, 0],
      "rotate": { "axis": [0, 1, 0], "angle": "0.5t" },
      "surface": "ball",
      "children": [{ "surface": "flag", "material": "red" }]
    },
    { "name": "sun", "visible": 0, "light": { "type": "point", "intensity": 40, "casters": ["a"] } }
  ],
  "camera": { "eye": ["18*sin(t/4)", 9, "18*cos(t/4)"], "fov_y": "50deg" }
}
)_");
  EXPECT_EQ(readBack(file), file);
}

TEST(SceneWriter, AnEmptyDescriptionIsShort) { EXPECT_EQ(writeScene({}), "{ \"luxo\": 1 }\n"); }

TEST(SceneWriter, TheExamplesReadBackTheSame) {
  for (const std::filesystem::path& path : test::exampleScenes()) {
    const SceneFile file = readSceneFile(path);
    const std::string text = writeScene(file);
    EXPECT_EQ(parseScene(text, "written"), file) << path;
    EXPECT_EQ(writeScene(parseScene(text, "written")), text) << path;
  }
}

TEST(SceneWriter, EqualityLooksAtEverything) {
  const SceneFile lamp = parseScene(test::sourceText("apps/scenes/luxo-grandpa.luxo.json"), "lamp");
  SceneFile other = lamp;
  EXPECT_EQ(other, lamp);
  other.nodes.back().light->intensity = Quantity(std::nextafter(70.0, 71.0));
  EXPECT_FALSE(other == lamp);
  other = lamp;
  other.nodes[3].rotate[0].angle = "0.5*t";  // means the same, is written differently
  EXPECT_FALSE(other == lamp);
}

/// Descriptions with everything in them, by chance.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {}

  SceneFile make() {
    SceneFile file;
    if (coin()) file.render = render();
    for (int i = random_.below(4); i > 0; --i) file.parameters.push_back(parameter(i));
    for (int i = random_.below(4); i > 0; --i) file.materials.push_back(material(i));
    for (int i = random_.below(6); i > 0; --i) file.surfaces.push_back(surface(i));
    const int nodes = random_.below(12);
    for (int i = 0; i < nodes; ++i) file.nodes.push_back(node(i, file));
    if (coin()) file.camera = camera("camera");
    for (int i = random_.below(3); i > 0; --i) file.cameras.push_back(camera("camera " + std::to_string(i)));
    return file;
  }

 private:
  bool coin() { return random_.below(2) == 0; }

  Quantity quantity() {
    switch (random_.below(4)) {
      case 0:
        return random_.below(100) - 50;
      case 1:
        return Quantity("2t + \"\\\u00e9" + std::to_string(random_.below(100)));
      case 2:  // any bits that are a finite number
        for (;;) {
          const double x = std::bit_cast<double>(random_.bits());
          if (std::isfinite(x)) return x;
        }
      default:
        return random_.uniform(-1, 1);
    }
  }
  template <std::size_t N>
  std::array<Quantity, N> quantities() {
    std::array<Quantity, N> all;
    for (Quantity& q : all) q = quantity();
    return all;
  }
  Quantity3 color() {
    switch (random_.below(3)) {
      case 0:
        return repeated(quantity());
      case 1:
        return {linearFromSrgb(random_.below(256) / 255.0), linearFromSrgb(random_.below(256) / 255.0),
                linearFromSrgb(random_.below(256) / 255.0)};
      default:
        return quantities<3>();
    }
  }
  template <class Enum>
  Enum word(int count) {
    return static_cast<Enum>(random_.below(count));
  }
  static std::string name(const char* kind, int i) { return std::string(kind) + " \"\t" + std::to_string(i); }
  std::vector<LetDesc> let() {
    std::vector<LetDesc> all;
    for (int i = random_.below(3); i > 0; --i) all.push_back({name("let", i), quantity()});
    return all;
  }

  RenderDesc render() {
    return {.size = quantities<2>(),
            .time = quantity(),
            .fps = quantity(),
            .samples = quantity(),
            .tolerance = quantity(),
            .shading = word<Shading>(kShadingNames.size()),
            .background = color(),
            .ambient = color()};
  }
  ParameterDesc parameter(int i) {
    ParameterDesc desc{.name = name("p", i), .value = quantity()};
    if (coin()) desc.range = quantities<2>();
    if (coin()) desc.step = quantity();
    if (coin()) desc.label = name("label", i);
    return desc;
  }
  MaterialDesc material(int i) {
    MaterialDesc desc{.name = name("m", i), .diffuse = color()};
    if (coin()) desc.ambient = color();
    if (coin()) desc.specular = color();
    if (coin()) desc.shininess = quantity();
    if (coin()) desc.opacity = quantity();
    if (coin()) desc.cutoff = quantity();
    if (coin()) desc.displacement = quantity();
    desc.twoSided = word<TwoSided>(3);
    if (coin()) desc.shading = word<Shading>(kShadingNames.size());
    desc.lectureSpecular = coin();
    return desc;
  }
  SurfaceDesc surface(int i) {
    SurfaceDesc desc{.name = name("s", i)};
    switch (random_.below(7)) {
      case 0: {
        const CatalogueEntry& entry =
            catalogue()[static_cast<std::size_t>(random_.below(int(catalogue().size())))];
        NamedShape shape{.type = std::string(entry.name)};
        for (const CatalogueArgument& argument : entry.arguments) {
          if (coin()) continue;
          NamedShape::Argument made{std::string(argument.name), {}};
          for (std::size_t k = 0; k < argument.initial.size(); ++k) made.values.push_back(quantity());
          shape.arguments.push_back(made);
        }
        desc.shape = shape;
        break;
      }
      case 1: {
        FormulaShape shape{.u = quantities<2>(), .let = let(), .position = quantities<3>()};
        if (coin()) shape.closed = {coin(), coin()};
        desc.shape = shape;
        break;
      }
      case 2:
        desc.shape =
            RevolveShape{.v = quantities<2>(), .let = let(), .radius = quantity(), .height = quantity()};
        break;
      case 3:
        desc.shape =
            TubeShape{.u = quantities<2>(), .let = let(), .curve = quantities<3>(), .radius = quantity()};
        break;
      case 5: {
        ClothShape shape{
            .cells = quantities<2>(), .size = quantities<2>(), .density = quantity(), .bend = quantity()};
        if (coin()) shape.gravity = quantities<3>();
        for (int k = random_.below(3); k > 0; --k)
          shape.pins.push_back(coin() ? ClothPinDesc{.name = "back_left"}
                                      : ClothPinDesc{.point = quantities<2>()});
        if (coin()) shape.ball = ClothBallDesc{.center = quantities<3>(), .radius = quantity()};
        desc.shape = shape;
        break;
      }
      case 4:
        desc.shape =
            MeshShape{.file = "models/a b.obj", .normals = word<NormalRule>(3), .crease = quantity()};
        break;
      default: {
        BezierShape shape;
        for (int k = 0; k < 20; ++k) shape.points.push_back(quantities<3>());
        for (int k = random_.below(3); k > 0; --k)
          for (std::uint32_t& index : shape.patches.emplace_back())
            index = static_cast<std::uint32_t>(random_.below(20));
        desc.shape = shape;
      }
    }
    if (coin() && !std::holds_alternative<MeshShape>(desc.shape) &&
        !std::holds_alternative<ClothShape>(desc.shape))
      desc.segments = quantities<2>();
    return desc;
  }
  NodeDesc node(int i, const SceneFile& file) {
    NodeDesc desc;
    if (coin()) desc.name = name("n", i);
    // Below the last node or one of its ancestors: depth first.
    if (i > 0) {
      desc.parent = static_cast<std::uint32_t>(i - 1);
      while (desc.parent != kNoParent && coin()) desc.parent = file.nodes[desc.parent].parent;
    }
    if (coin()) desc.translate = quantities<3>();
    for (int k = random_.below(3); k > 0; --k) desc.rotate.push_back({quantities<3>(), quantity()});
    if (coin()) desc.scale = quantities<3>();
    if (coin()) desc.visible = quantity();
    if (coin()) desc.surface = name("s", i);
    if (coin()) desc.material = name("m", i);
    if (desc.surface.empty() && desc.material.empty() && coin()) desc.model = "models/a b.obj";
    if (coin()) return desc;
    desc.light = LightDesc{.type = word<Light::Type>(2),
                           .color = color(),
                           .intensity = quantity(),
                           .attenuation = word<Light::Attenuation>(2),
                           .shadow = word<Light::Shadow>(4),
                           .radius = quantity(),
                           .shadowSamples = quantity()};
    if (desc.light->type == Light::Type::Point && coin()) {
      desc.light->spot.emplace();
      if (coin()) desc.light->spot->inner = quantity();
      if (coin()) desc.light->spot->outer = quantity();
    }
    if (coin() || desc.light->shadow == Light::Shadow::Planar) desc.light->shadowPlane = name("n", i);
    if (coin()) desc.light->casters.emplace();
    for (int k = desc.light->casters ? random_.below(3) : 0; k > 0; --k)
      desc.light->casters->push_back(name("n", k));
    return desc;
  }
  CameraDesc camera(std::string title) {
    CameraDesc desc{.name = std::move(title), .eye = quantities<3>(), .projection = word<Projection>(2)};
    if (coin()) desc.lookAt = quantities<3>();
    if (coin()) desc.up = quantities<3>();
    if (coin()) desc.fovY = quantity();
    if (coin()) desc.near = quantity();
    if (coin()) desc.height = quantity();
    return desc;
  }

  test::Random random_;
};

TEST(SceneWriter, HiddenLinesReadBackTheSame) {
  SceneFile file;
  file.render.hiddenLines = true;
  EXPECT_NE(writeScene(file).find("\"hidden_lines\": true"), std::string::npos) << writeScene(file);
  EXPECT_TRUE(readBack(file).render.hiddenLines);
  EXPECT_FALSE(readBack(SceneFile{}).render.hiddenLines);
}

TEST(SceneWriter, RandomDescriptionsReadBackTheSame) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const SceneFile file = RandomScene(seed).make();
    const SceneFile again = readBack(file);
    ASSERT_EQ(again, file) << "seed " << seed << "\n" << writeScene(file);
    EXPECT_EQ(writeScene(again), writeScene(file)) << seed;
  }
}

}  // namespace
}  // namespace luxo
