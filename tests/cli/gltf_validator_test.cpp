// SPDX-License-Identifier: Apache-2.0
// What luxo export writes as GLB, by Khronos' own validator (npm package gltf-validator): no error and no
// warning. Without node and the package the tests skip, unless LUXO_REQUIRE_GLTF_VALIDATOR=1.
#include <cmath>
#include <cstdlib>

#include "cli/program.h"
#include "image/codes.h"
#include "image/file.h"
#include "image/png.h"

namespace luxo::test {
namespace {

class GltfValidator : public RenderTest {
 protected:
  void SetUp() override {
    const Outcome outcome = validated({});
    if (outcome.code != 77 && outcome.code != 127) return;  // no package, no node
    const char* required = std::getenv("LUXO_REQUIRE_GLTF_VALIDATOR");
    if (required != nullptr && std::string(required) == "1") FAIL() << "there is no gltf-validator";
    GTEST_SKIP() << "there is no gltf-validator";
  }

  [[nodiscard]] Outcome validated(const Arguments& models) const {
    Launch launch{.arguments = {"node", LUXO_VALIDATE_GLTF, LUXO_NPM_FOLDER},
                  .folder = folder.path(),
                  .program = "/usr/bin/env"};
    launch.arguments.insert(launch.arguments.end(), models.begin(), models.end());
    return run(launch);
  }
  void expectValid(const std::string& scene, const Arguments& options = {}) const {
    SCOPED_TRACE(scene);
    Arguments arguments = {"export", scene, "-o", "a.glb", "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome exported = run(folder, arguments);
    ASSERT_EQ(exported.code, 0) << exported.err;
    const Outcome outcome = validated({"a.glb"});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  }
  /// Images of all kinds, by the names that the scenes below have for them.
  void writeImages() const {
    const auto write = [&](const char* name, int width, int height, int channels, Codes codes) {
      Image image(width, height, channels);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          for (int c = 0; c < channels; ++c)
            image.pixel(x, y)[std::size_t(c)] = float((5 * x + 3 * y + 60 * c) % 256) / 255;
      writeFileAtomically(folder / name, encodePng(image, codes));
    };
    write("wood.png", 31, 17, 3, Codes::Srgb);
    write("leaf.png", 16, 16, 4, Codes::Srgb);
    write("bumps.png", 32, 32, 3, Codes::Data);
    write("gloss.png", 8, 8, 3, Codes::Srgb);
  }
};

/// The lamp has lights, cameras, several materials, and parts that are open.
TEST_F(GltfValidator, AcceptsTheBuiltInScenes) {
  for (const char* scene : {"torus", "teapot", "luxo-grandpa", "showcase", "primitives"}) expectValid(scene);
}

TEST_F(GltfValidator, AcceptsPlates) {
  for (const char* scene : {"flag", "klein", "lecture"}) expectValid(scene, {"--thicken", "20mm"});
}

/// Maps of every kind and every way to read them, names of any letters, mirrored, flattened and sheared
/// places, places far away, cameras and lights of every kind.
TEST_F(GltfValidator, AcceptsWhatScenesCanSay) {
  writeImages();
  writeText(folder / "s.luxo.json", R"scene({ "luxo": 1,
    "textures": { "wood": { "file": "wood.png", "wrap": "mirror" }, "leaf": { "file": "leaf.png" },
                  "bumps": { "file": "bumps.png", "data": true }, "gloss": { "file": "gloss.png", "wrap": "clamp" },
                  "lava": { "file": "wood.png", "filter": "nearest" }, "tiles": { "checker": ["#ffffff", 0.1] } },
    "materials": { "all": { "map": { "texture": "wood", "scale": [2, 2], "rotate": "45deg" },
                            "normal_map": { "texture": "bumps", "scale": [4, 4] },
                            "specular_map": "gloss", "glow_map": "lava" },
                   "cut": { "map": { "texture": "leaf", "alpha": true }, "cutoff": 0.5, "specular": 1.5 },
                   "thin": { "map": "tiles", "opacity": 0.5, "two_sided": false },
                   "plain": { "diffuse": [1, 0, 0], "shininess": 0 } },
    "surfaces": { "ball": { "type": "sphere" }, "ring": { "type": "torus", "major": 1, "minor": 0.3 },
                  "floor": { "type": "rectangle", "size": [4, 4] }, "pot": { "type": "teapot" } },
    "nodes": [ { "name": "Kugel \u00e4\u2603", "surface": "ball", "material": "all" },
               { "surface": "ring", "material": "cut", "translate": [3, 0, 0], "scale": [-1, 2, 1] },
               { "surface": "floor", "material": "thin", "rotate": { "axis": [1, 0, 0], "angle": 1 } },
               { "surface": "pot", "material": "all", "translate": [-4, 0, 0] },
               { "surface": "ball", "material": "plain", "translate": [1e6, 0, 0] },
               { "surface": "ball", "material": "plain", "scale": [1, 0, 1], "translate": [0, 3, 0] },
               { "rotate": { "axis": [0, 0, 1], "angle": 0.3 }, "scale": [1, 2, 1],
                 "children": [ { "surface": "ball", "material": "all", "rotate": { "axis": [0, 0, 1], "angle": 0.7 } } ] },
               { "translate": [0, 5, 0], "light": { "type": "point", "color": [3, 1, 1], "intensity": 40,
                                                    "attenuation": "inverse-square" } },
               { "light": { "type": "directional", "color": [1, 0.5, 0] } },
               { "translate": [0, 3, 3], "rotate": { "axis": [1, 0.2, 0], "angle": -0.7 },
                 "light": { "attenuation": "inverse-square", "spot": { "inner": "20deg", "outer": "90deg" } } },
               { "light": { "spot": { "outer": 1e-9 } } } ],
    "cameras": { "top": { "eye": [0, 9, 0.1] }, "flat": { "type": "orthographic", "height": 5 },
                 "wide": { "fov_y": "170deg" } } })scene");
  expectValid("s.luxo.json", {"--tolerance", "10mm"});
  expectValid("s.luxo.json", {"--tolerance", "10mm", "--no-formulas"});
  expectValid("s.luxo.json", {"--tolerance", "10mm", "--thicken", "1mm"});
}

/// With maps of normals and highlights, on triangles with and without uvs, of several materials.
TEST_F(GltfValidator, AcceptsModels) {
  writeImages();
  writeText(
      folder / "a.mtl",
      "newmtl a\nKd 1 0 0\nmap_Kd wood.png\nnorm bumps.png\nnewmtl b\nnorm bumps.png\nmap_Ks gloss.png\n"
      "newmtl c\nKd 0 0 1\nd 0.5\nKe 3 3 3\n");
  writeText(folder / "a.obj",
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
            "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 2/2 4/4 3/3\nusemtl c\nf 1 2 4\n");
  expectValid("a.obj");
  writeText(folder / "s.luxo.json", R"({ "luxo": 1, "surfaces": { "s": { "type": "mesh", "file": "a.obj" } },
    "nodes": [ { "surface": "s" }, { "model": "a.obj", "translate": [0, 0, 2] } ] })");
  expectValid("s.luxo.json");
  ASSERT_EQ(run(folder, {"export", "s.luxo.json", "-o", "b.glb", "-q"}).code, 0);
  expectValid("b.glb", {"--no-formulas"});
}

TEST_F(GltfValidator, SeesWhatIsWrong) {
  ASSERT_EQ(run(folder, {"export", "torus", "-o", "a.glb", "-q"}).code, 0);
  std::string bytes = textOf(folder / "a.glb");
  const std::string type = R"("type":"VEC3")";
  bytes.replace(bytes.find(type), type.size(), R"("type":"VEC2")");
  writeText(folder / "b.glb", bytes);
  const Outcome outcome = validated({"a.glb", "b.glb"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.out.starts_with("b.glb: ")) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace luxo::test
