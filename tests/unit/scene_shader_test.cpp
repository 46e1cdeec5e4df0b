// SPDX-License-Identifier: Apache-2.0
// Shaders of materials in scene files: their texts, and values that move.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "base/error.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/shader_files.h"
#include "scene/snapshot.h"
#include "unit/image_test_support.h"

namespace luxo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusalOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return error.what() + error.hint();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

class SceneShader : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  [[nodiscard]] SceneFile sceneWith(const std::string& material) const {
    return parseScene(R"({ "luxo": 1, "params": { "k": 3 }, "surfaces": { "s": { "type": "sphere" } },
      "materials": { "m": )" +
                          material + R"( }, "nodes": [ { "surface": "s", "material": "m" } ] })",
                      "a.luxo.json", folder.path());
  }

  ScratchFolder folder;
};

TEST_F(SceneShader, ValuesAreFormulasOfTimeAndParameters) {
  write("m.frag", "vec4 material(Point p) { return vec4(1); }");
  const SceneFile file = sceneWith(
      R"({ "shader": "m.frag", "uniforms": { "a": "k * t", "b": [1, "k", 0.5], "c": "#ff0000", "d": true, "e": [[1, 2], [3, 4]] } })");
  const Snapshot snapshot = takeSnapshot(buildScene(file), 2, {8, 8});
  const Material& material = snapshot.materials[snapshot.nodes[0].material.index];
  ASSERT_TRUE(material.shader);
  EXPECT_EQ(material.shader->files.at(0).text, "vec4 material(Point p) { return vec4(1); }");
  ASSERT_EQ(material.uniforms.size(), 5u);
  EXPECT_EQ(material.uniforms[0].values, std::vector<double>{6});
  EXPECT_EQ(material.uniforms[1].values, (std::vector<double>{1, 3, 0.5}));
  EXPECT_EQ(material.uniforms[2].values, (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(material.uniforms[3].values, std::vector<double>{1});
  EXPECT_EQ(material.uniforms[4].values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(material.shadingIn(Shading::Gouraud), Shading::Phong);
  EXPECT_EQ(material.shadingIn(Shading::Toon), Shading::Exact);
}

TEST_F(SceneShader, IsWrittenAsItWasRead) {
  write("m.frag", "");
  const SceneFile file = sceneWith(
      R"({ "shader": "m.frag", "vertex": "m.vert", "uniforms": { "a": "k", "b": [1, 2], "c": true, "d": [false, true] } })");
  EXPECT_EQ(parseScene(writeScene(file), "again", folder.path()).materials, file.materials);
}

TEST_F(SceneShader, IncludesAreRelativeToTheirFileAndInTheFolder) {
  write("look/m.frag", "#include \"lib/a.glsl\"\n");
  write("look/lib/a.glsl", "  #  include \"b.glsl\"\n#include \"../m.frag\"\n");
  write("look/lib/b.glsl", "");
  const MaterialShaderPtr shader = ShaderFiles(folder.path()).get("look/m.frag");
  ASSERT_EQ(shader->files.size(), 3u);
  EXPECT_EQ(shader->files[1].name, (folder / "look/lib/a.glsl").lexically_normal().string());
  write("outside.glsl", "");
  write("look/n.frag", "\n #include \"../outside.glsl\"\n");
  EXPECT_THAT(refusalOf([&] { static_cast<void>(ShaderFiles(folder.path()).get("look/n.frag")); }),
              HasSubstr("n.frag:2:11: the included file '../outside.glsl' is outside"));
}

// What may mend one that cannot be read: all that it names, there or not.
TEST_F(SceneShader, FilesOfOnesWithErrorsAreNamed) {
  write("m.frag", "#include \"lib/a.glsl\"\n#include \"gone.glsl\"\n");
  write("lib/a.glsl", "#include \"b.glsl\"\n#include \"../m.frag\"\n");
  const auto at = [&](const char* name) { return (folder / name).lexically_normal(); };
  const auto all = testing::ElementsAre(at("m.frag"), at("lib/a.glsl"), at("gone.glsl"), at("lib/b.glsl"));
  EXPECT_THAT(filesNamedBy(folder / "m.frag"), all);
  EXPECT_THAT(filesNamedBy(folder / "none.frag"), testing::ElementsAre(at("none.frag")));
  ShaderFiles files(folder.path());
  EXPECT_NE(refusalOf([&] { static_cast<void>(files.get("m.frag")); }), "");
  EXPECT_THAT(files.files(), all);
}

// As the gallery's are: a program that carries its shaders reads no file.
TEST_F(SceneShader, CarriedOnesAreNotLookedForOnDisk) {
  write("m.frag", "on disk");
  const std::string prefix = folder.path().string() + "/";
  FilesInMemory files;
  const auto add = [&](const std::string& name, std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    files[prefix + name] = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
  };
  add("m.frag", "#include \"lib/a.glsl\"\n");
  add("lib/a.glsl", "float a;\n");
  add("n.frag", "\n #include \"b.glsl\"\n");
  add("long.frag", std::string(kMaxShaderBytes + 1, ' '));
  ShaderFiles carried(folder.path(), FileSource(files));
  const MaterialShaderPtr shader = carried.get("m.frag");
  ASSERT_EQ(shader->files.size(), 2u);
  EXPECT_EQ(shader->files[0].text, "#include \"lib/a.glsl\"\n");
  EXPECT_EQ(shader->files[1].text, "float a;\n");
  EXPECT_TRUE(carried.files().empty());
  write("b.glsl", "");
  EXPECT_THAT(refusalOf([&] { static_cast<void>(carried.get("n.frag")); }),
              AllOf(HasSubstr("n.frag:2:11: cannot read the shader"), HasSubstr("b.glsl")));
  EXPECT_THAT(refusalOf([&] { static_cast<void>(carried.get("long.frag")); }), HasSubstr("at most 262144"));
}

TEST_F(SceneShader, AVertexProgramIsBehindWhatTheShaderIncludes) {
  write("m.frag", "#include \"both.glsl\"\n");
  write("both.glsl", "");
  write("look/m.vert", "#include \"own.glsl\"\n");
  write("look/own.glsl", "");
  write("n.vert", "#include \"both.glsl\"\n");
  ShaderFiles files(folder.path());
  const MaterialShaderPtr shader = files.get("m.frag", "look/m.vert");
  ASSERT_EQ(shader->files.size(), 4u);
  EXPECT_EQ(shader->vertex, 2u);
  EXPECT_EQ(shader->files[3].name, (folder / "look/own.glsl").lexically_normal().string());
  EXPECT_EQ(files.get("m.frag", "n.vert")->files.size(), 3u) << "both.glsl is there already";
  EXPECT_EQ(files.get("m.frag")->vertex, 0u);
  EXPECT_EQ(files.get("m.frag", "look/m.vert"), shader);
  EXPECT_THAT(refusalOf([&] { static_cast<void>(files.get("m.frag", "m.frag")); }), HasSubstr("two files"));
  const MaterialShaderPtr alone = files.get("", "look/m.vert");
  EXPECT_EQ(alone->files.front(), kFixedFragments);
  EXPECT_EQ(alone->files.at(alone->vertex), shader->files.at(shader->vertex));
}

TEST_F(SceneShader, WhatIsNotDrawnIsRefused) {
  write("m.frag", "");
  write("long.frag", std::string(kMaxShaderBytes + 1, 'a'));
  const auto refused = [&](const std::string& material) {
    return refusalOf([&] { static_cast<void>(buildScene(sceneWith(material))); });
  };
  EXPECT_THAT(refused(R"({ "shader": "m.frag", "diffuse": ["u", 0, 0] })"), HasSubstr("uses u or v"));
  EXPECT_THAT(refused(R"({ "shader": "none.frag" })"), HasSubstr("a.luxo.json:2:39: cannot read the shader"));
  EXPECT_THAT(refused(R"({ "shader": "../m.frag" })"), HasSubstr("outside of the scene's folder"));
  EXPECT_THAT(refused(R"({ "shader": "long.frag" })"), HasSubstr("at most 262144 are read"));
  EXPECT_THAT(refused(R"({ "shader": "m.frag", "vertex": "none.vert" })"),
              HasSubstr("a.luxo.json:2:59: cannot read the shader"));
  EXPECT_THAT(refused(R"({ "vertex": "none.vert" })"), HasSubstr("a.luxo.json:2:39: cannot read the shader"));
  EXPECT_THAT(refused(R"({ "uniforms": { "a": 1 } })"), HasSubstr("there are uniforms and no shader"));
}

MaterialShader shaderOf(const std::string& text) { return {{{"m.frag", text}}}; }

TEST(ShaderText, WhatACommentSaysIsNotSaid) {
  const MaterialShader none = shaderOf(
      "// trace, see fig. H; a uniform sampler2D is not needed here\nuniform int octaves;\n"
      "/*\n#pragma luxo opacity\n*/\nvec4 material(Point p) { return vec4(1.0); }\n");
  EXPECT_FALSE(none.traces());
  EXPECT_FALSE(none.readsCurvature());
  EXPECT_FALSE(none.hasSampler("octaves"));
  EXPECT_FALSE(none.hasOpacity());
  const MaterialShader all = shaderOf(
      "  #  pragma luxo  opacity // glass\nuniform highp sampler2D oak, ash;\nuniform sampler2D\n  elm;\n"
      "vec4 material(Point p) { return vec4(trace(p.normal).color, p . k1); }\n");
  EXPECT_TRUE(all.traces());
  EXPECT_TRUE(all.readsCurvature());
  EXPECT_TRUE(all.hasOpacity());
  for (const char* name : {"oak", "ash", "elm"}) EXPECT_TRUE(all.hasSampler(name)) << name;
  for (const char* name : {"oa", "p", "", ".*", "a(", "sampler2D"})
    EXPECT_FALSE(all.hasSampler(name)) << name;
}

/// A name that is no word is unknown to the shader, and nothing worse.
TEST_F(SceneShader, NamesOfUniformsAreOnlyNames) {
  write("m.frag", "uniform sampler2D a;\nvec4 material(Point p) { return texture(a, p.uv); }\n");
  const SceneFile file = sceneWith(R"({ "shader": "m.frag", "uniforms": { "a(": "k" } })");
  EXPECT_NO_THROW(static_cast<void>(buildScene(file)));
}

}  // namespace
}  // namespace luxo
