// SPDX-License-Identifier: Apache-2.0
// The files that a scene names travel in a GLB beside its formulas: images, models with theirs, shaders with
// what they include. From another folder, with the originals gone, its pictures have the scene's bytes.
#include <random>

#include "cli/program.h"
#include "image/codes.h"
#include "image/file.h"
#include "image/png.h"
#include "mesh/model.h"

namespace luxo::test {
namespace {

class ExportFiles : public RenderTest {
 protected:
  void SetUp() override {
    for (const char* name : {"work", "work/maps", "work/models"})
      std::filesystem::create_directory(folder / name);
  }

  void writeNoise(const std::string& name, int width, int height, Codes codes) const {
    Image image(width, height, 3);
    std::mt19937 random(static_cast<std::uint32_t>(width));
    for (float& sample : image.samples()) sample = float(random() % 256) / 255;
    writeFileAtomically(folder / name, encodePng(image, codes));
  }
  void writeScene(const std::string& materials, const std::string& others = "") const {
    writeText(folder / "work/s.luxo.json", R"scene({ "luxo": 1,
    "textures": { "wood": { "file": "maps/wood.png", "wrap": "mirror" }, "bumps": { "file": "maps/bumps.png", "data": true } },
    "materials": { "m": { )scene" + materials +
                                               R"scene( } },
    "surfaces": { "ball": { "type": "sphere" } },
    "nodes": [ { "surface": "ball", "material": "m" }, { "translate": [3, 4, 5], "light": { "type": "point" } } )scene" +
                                               others + R"scene( ],
    "camera": { "eye": [1, 2, 5] } })scene");
  }
  [[nodiscard]] Outcome exported(const Arguments& extra = {}) const {
    Arguments arguments = {"export", "work/s.luxo.json", "-o", "a.glb", "--tolerance", "5cm"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(folder, arguments);
  }
  [[nodiscard]] std::string pictureOf(const std::string& scene, const Arguments& how) const {
    Arguments arguments = {"render", scene, "--size", "67x45", "-o", "picture.pfm"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return textOf(folder / "picture.pfm");
  }
  /// Exports, and draws both; the scene is gone when the GLB is drawn, which lies elsewhere.
  void expectSamePicture(const Arguments& how) const {
    const Outcome outcome = exported();
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "formulas")) << outcome.err;
    const std::string expected = pictureOf("work/s.luxo.json", how);
    std::filesystem::remove_all(folder / "work");
    std::filesystem::create_directory(folder / "other");
    std::filesystem::rename(folder / "a.glb", folder / "other/a.glb");
    EXPECT_TRUE(pictureOf("other/a.glb", how) == expected);
    EXPECT_TRUE(pictureOf("other/a.glb", how) != pictureOf("torus", how));
  }

  const Arguments reference = {"--engine", "reference"}, exact = {"--shading", "exact"};
};

const char* const kTextured = R"("map": "wood", "normal_map": { "texture": "bumps", "scale": [2, 2] })";

TEST_F(ExportFiles, ImagesAndModelsComeBackExactly) {
  writeNoise("work/maps/wood.png", 31, 17, Codes::Srgb);
  writeNoise("work/maps/bumps.png", 32, 32, Codes::Data);
  writeNoise("work/models/skin.png", 9, 8, Codes::Srgb);
  writeText(folder / "work/models/a.mtl", "newmtl a\nmap_Kd skin.png\n");
  writeText(folder / "work/models/a.obj",
            "mtllib a.mtl\nv -2 0 -1\nv 2 0 -1\nv 0 2 -1\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n");
  writeScene(kTextured, R"(, { "model": "models/a.obj" })");
  expectSamePicture(reference);
}

TEST_F(ExportFiles, InExactShadingToo) {
  requireDevice();
  if (IsSkipped()) return;
  writeNoise("work/maps/wood.png", 31, 17, Codes::Srgb);
  writeNoise("work/maps/bumps.png", 32, 32, Codes::Data);
  writeScene(kTextured);
  expectSamePicture(exact);
}

TEST_F(ExportFiles, ShadersComeBackWithWhatTheyInclude) {
  requireDevice();
  if (IsSkipped()) return;
  writeNoise("work/maps/wood.png", 31, 17, Codes::Srgb);
  writeNoise("work/maps/bumps.png", 32, 32, Codes::Data);
  writeText(folder / "work/models/half.glsl",
            "#include \"nothing.glsl\"\nfloat half_of(float x) { return 0.5 * x; }\n");
  writeText(folder / "work/models/nothing.glsl", "");
  writeText(folder / "work/models/m.frag",
            "#include \"half.glsl\"\nuniform sampler2D wood;\n"
            "vec4 material(Point p) { return vec4(texture(wood, p.uv).rgb * half_of(p.uv.x), 1.0); }\n");
  writeScene(R"("shader": "models/m.frag", "uniforms": { "wood": "wood" })");
  expectSamePicture(exact);
}

/// What could only be named with --allow-outside is inside then.
TEST_F(ExportFiles, WhatWasOutsideIsInside) {
  writeNoise("outside.png", 8, 8, Codes::Srgb);
  writeNoise("work/maps/bumps.png", 32, 32, Codes::Data);
  writeScene(kTextured);
  std::string scene = textOf(folder / "work/s.luxo.json");
  writeText(folder / "work/s.luxo.json", scene.replace(scene.find("maps/wood.png"), 13, "../outside.png"));
  EXPECT_EQ(exported().code, 3);
  ASSERT_EQ(exported({"--allow-outside"}).code, 0);
  Arguments outside = reference;
  outside.emplace_back("--allow-outside");
  const std::string expected = pictureOf("work/s.luxo.json", outside);
  std::filesystem::remove(folder / "outside.png");
  EXPECT_TRUE(pictureOf("a.glb", reference) == expected);
  // And again, from the GLB itself.
  ASSERT_EQ(run(folder, {"export", "a.glb", "-o", "b.glb", "-q", "--tolerance", "5cm"}).code, 0);
  EXPECT_TRUE(pictureOf("b.glb", reference) == expected);
}

/// And takes none of the scene's for them.
TEST_F(ExportFiles, AnObjHasItsImagesBesideIt) {
  writeNoise("work/s_map0.png", 8, 8, Codes::Srgb);
  writeText(folder / "work/s.luxo.json", R"scene({ "luxo": 1, "textures": { "t": { "file": "s_map0.png" } },
    "materials": { "m": { "map": "t" } }, "surfaces": { "ball": { "type": "sphere" } },
    "nodes": [ { "surface": "ball", "material": "m" } ] })scene");
  const Outcome outcome = run(folder, {"export", "work/s.luxo.json", "-o", "a.obj", "--tolerance", "5cm"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_FALSE(contains(outcome.err, "warning")) << outcome.err;
  EXPECT_EQ(folder.entries(), 4U);  // work, a.obj, a.mtl, a_map0.png
  EXPECT_TRUE(std::filesystem::exists(folder / "a_map0.png"));
  EXPECT_TRUE(readModel(folder / "a.obj").materials[0].map.given());
  const std::string image = textOf(folder / "work/s_map0.png");
  expectFailure(run(folder, {"export", "work/s.luxo.json", "-o", "work/s.obj", "-q"}), 2,
                "'work/s_map0.png' would overwrite a file of the scene");
  EXPECT_TRUE(textOf(folder / "work/s_map0.png") == image);
  EXPECT_FALSE(std::filesystem::exists(folder / "work/s.obj"));
}

/// A scene that was drawn without an image is still; one whose model is not there shows its triangles.
/// Neither reads what lies beside the GLB by that name.
TEST_F(ExportFiles, NothingIsReadFromTheDisk) {
  writeNoise("work/maps/bumps.png", 32, 32, Codes::Data);
  writeScene(kTextured);
  const Outcome outcome = exported();
  EXPECT_TRUE(contains(outcome.err, "there is no texture 'maps/wood.png'")) << outcome.err;
  const std::string expected = pictureOf("work/s.luxo.json", reference);
  std::filesystem::create_directory(folder / "maps");
  writeNoise("maps/wood.png", 31, 17, Codes::Srgb);
  EXPECT_TRUE(pictureOf("a.glb", reference) == expected);
  EXPECT_TRUE(contains(run(folder, {"inspect", "a.glb"}).out, "there is no texture 'maps/wood.png'"));

  writeText(folder / "work/models/a.obj", "v -2 0 -1\nv 2 0 -1\nv 0 2 -1\nf 1 2 3\n");
  writeScene(kTextured, R"(, { "model": "models/a.obj" })");
  ASSERT_EQ(exported().code, 0);
  std::filesystem::create_directory(folder / "models");
  std::filesystem::rename(folder / "work/models/a.obj", folder / "models/a.obj");
  std::string bytes = textOf(folder / "a.glb");
  const std::string name = R"("name":"models/a.obj")";
  ASSERT_NE(bytes.find(name), std::string::npos);
  writeText(folder / "a.glb", bytes.replace(bytes.find(name), name.size(), R"("name":"models/b.obj")"));
  const Outcome inspected = run(folder, {"inspect", "a.glb"});
  EXPECT_EQ(inspected.code, 0) << inspected.err;
  EXPECT_TRUE(contains(inspected.out, "its triangles are used instead")) << inspected.out;
  EXPECT_TRUE(contains(inspected.out, "'models/a.obj'")) << inspected.out;
}

}  // namespace
}  // namespace luxo::test
