// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "image/image.h"
#include "unit/mesh_model_support.h"

namespace luxo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The current folder, for as long as this lives.
class InFolder {
 public:
  explicit InFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  InFolder(const InFolder&) = delete;
  InFolder& operator=(const InFolder&) = delete;
  ~InFolder() { std::filesystem::current_path(before_); }

 private:
  std::filesystem::path before_;
};

constexpr const char* kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, AFaceOfFourIsTwoTriangles) {
  ModelFolder folder;
  const Model model = folder.read("quad.obj", std::string("# a quad\n") + kQuad + "f 1 2 3 4\n");
  EXPECT_EQ(model.name, "quad");
  ASSERT_EQ(model.meshes.size(), 1u);
  expectPromises(model.meshes[0]);
  EXPECT_EQ(model.triangleCount(), 2u);
  EXPECT_EQ(model.meshes[0].positions().size(), 4u);
  EXPECT_EQ(model.meshes[0].bounds(), (Box{Vec3(0), Vec3(1, 1, 0)}));
  EXPECT_EQ(model.meshes[0].normals()[0], Vec3f(0, 0, 1));
  ASSERT_EQ(model.nodes.size(), 1u);
  EXPECT_EQ(model.nodes[0].mesh, 0u);
  EXPECT_EQ(model.materials.size(), 1u);
  EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(ReadObj, NumbersCountFromOneOrBackFromTheLast) {
  ModelFolder folder;
  const Model forward = folder.read("a.obj", std::string(kQuad) + "f 1 2 3\n"),
              backward = folder.read("b.obj", std::string(kQuad) + "f -4 -3 -2\n");
  EXPECT_EQ(trianglesOf(forward.meshes[0]), trianglesOf(backward.meshes[0]));
}

TEST(ReadObj, UvsAndNormalsAreThoseOfTheirCorners) {
  ModelFolder folder;
  const Model model = folder.read("a.obj", std::string(kQuad) +
                                               "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 3 4\n"
                                               "f 1/1/1 2/2/1 3/3/1\n");
  const TriangleMesh& mesh = model.meshes[0];
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh.uvs()[i], Vec2f(mesh.positions()[i].x, 1 - mesh.positions()[i].y));  // from the top
    EXPECT_LT(glm::distance(mesh.normals()[i], Vec3f(0, 0.6f, 0.8f)), 1e-7f);
  }
}

TEST(ReadObj, ConcavePolygonsKeepTheirArea) {
  // An arrow of area 3/2 whose fan from the first vertex would leave it, and a comb with many teeth.
  ModelFolder folder;
  const auto areaOf = [](const TriangleMesh& mesh) {
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices().size(); i += 3) {
      const Vec3 a = mesh.point(mesh.indices()[i]), b = mesh.point(mesh.indices()[i + 1]),
                 c = mesh.point(mesh.indices()[i + 2]);
      EXPECT_GT(glm::cross(b - a, c - a).y, 0);  // all turn alike, so areas do not cancel
      area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
  };
  const Model arrow = folder.read("arrow.obj", "v -1 5 1\nv 0 5 -1\nv 1 5 1\nv 0 5 0.5\nf 4 3 2 1\n");
  EXPECT_NEAR(areaOf(arrow.meshes[0]), 1.5, 1e-6);
  std::string comb, face = "f";
  for (int i = 0; i < 41; ++i) comb += "v " + std::to_string(i) + " 0 " + (i % 2 ? "-1" : "-2") + "\n";
  comb += "v 40 0 0\nv 0 0 0\n";
  for (int i = 43; i > 0; --i) face += " " + std::to_string(i);
  const Model combs = folder.read("comb.obj", comb + face + "\n");
  EXPECT_EQ(combs.triangleCount(), 41u);
  EXPECT_NEAR(areaOf(combs.meshes[0]), 40 * 1.5, 1e-4);
}

TEST(ReadObj, SmoothingGroupsAndContinuedLines) {
  ModelFolder folder;
  const std::string roof = "v 0 1 0\nv 1 0 0\nv 1 0 1\nv 0 1 1\nv -1 0 1\nv -1 0 0\n";
  const std::string faces = "f 1 4 3 \\\n  2\nf 1 6 5 4\n";
  EXPECT_EQ(folder.read("a.obj", roof + "s 1\n" + faces).meshes[0].positions().size(), 6u);
  EXPECT_EQ(folder.read("b.obj", roof + "s off\n" + faces).meshes[0].positions().size(), 8u);
  EXPECT_EQ(folder.read("c.obj", roof + faces).meshes[0].positions().size(), 8u);  // a crease of 90 degrees
}

TEST(ReadObj, MaterialsComeFromTheirFile) {
  ModelFolder folder;
  folder.write("my wood.png", "not read here");
  folder.write("a.mtl",
               "newmtl red\nKd 0.8 0.1 0\nKs 0.5\nNs 60\nd 0.25\nKe 1 2 3\n"
               "newmtl wood\nKd 0 0 0\nmap_Kd -s 2 3 -o 0.5 0.25 -clamp on my wood.png\n"
               "map_bump -bm 0.5 my wood.png\n");
  const Model model =
      folder.read("a.obj", std::string("mtllib a.mtl\n") + kQuad +
                               "vt 0 0\nusemtl wood\nf 1/1 2/1 3/1\nusemtl red\nf 1 3 4\nf 2 3 4\n");
  ASSERT_EQ(model.materials.size(), 2u);
  const ModelMaterial &wood = model.materials[0], &red = model.materials[1];
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(red.diffuse, Vec3(0.8, 0.1, 0));
  EXPECT_EQ(red.specular, Vec3(0.5));
  EXPECT_EQ(red.shininess, 60);
  EXPECT_EQ(red.opacity, 0.25);
  EXPECT_EQ(red.glow, Vec3(1, 2, 3));
  EXPECT_EQ(wood.diffuse, Vec3(1));
  ASSERT_TRUE(wood.map.given());
  EXPECT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[wood.map.image].file.filename(), "my wood.png");
  EXPECT_EQ(wood.map.wrapU, ModelMap::Wrap::Clamp);
  // v = 0.5 from the bottom is read at 3 * 0.5 + 0.25 from the bottom.
  EXPECT_NEAR(wood.map.scale.y * 0.5 + wood.map.offset.y, 1 - (3 * 0.5 + 0.25), 1e-15);
  EXPECT_EQ(wood.normalScale, 0.5);
  ASSERT_EQ(model.meshes[0].groups().size(), 2u);
  EXPECT_EQ(model.meshes[0].groups()[0].triangles, 1u);
  EXPECT_EQ(model.meshes[0].groups()[1].triangles, 2u);
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("a.mtl:10: the bump map is taken for a normal map")));
}

/// One that is not given, or black, is the map's own.
TEST(ReadObj, AMapIsTimesTheColourThatIsGiven) {
  ModelFolder folder;
  folder.write("a.png", "not read here");
  folder.write("a.mtl",
               "newmtl usual\nKd 0.7 0.7 0.7\nKs 0.2\nmap_Kd a.png\nmap_Ks a.png\n"
               "newmtl none\nmap_Kd a.png\nmap_Ks a.png\nmap_Ke a.png\n"
               "newmtl black\nKd 0\nKs 0\nKe 0\nmap_Kd a.png\nmap_Ks a.png\nmap_Ke a.png\n");
  const Model model = folder.read(
      "a.obj",
      std::string("mtllib a.mtl\n") + kQuad +
          "vt 0 0\nusemtl usual\nf 1/1 2/1 3/1\nusemtl none\nf 1/1 2/1 4/1\nusemtl black\nf 2/1 3/1 4/1\n");
  EXPECT_EQ(model.materials.at(0).diffuse, Vec3(0.7));
  EXPECT_EQ(model.materials.at(0).specular, Vec3(0.2));
  for (const std::size_t i : {1, 2})
    for (const Vec3& colour :
         {model.materials.at(i).diffuse, model.materials.at(i).specular, model.materials.at(i).glow})
      EXPECT_EQ(colour, Vec3(1)) << i;
}

TEST(ReadObj, WhatIsMissingIsOneWarning) {
  ModelFolder folder;
  folder.write("b.mtl", "newmtl m\nmap_Kd gone.png\nmap_Ks gone.png\n");
  const Model model = folder.read("a.obj", std::string("mtllib none.mtl\nmtllib b.mtl\n") + kQuad +
                                               "usemtl m\nf 1 2 3\nusemtl other\nf 1 2 4\nl 1 2\nl 2 3\n");
  EXPECT_THAT(
      model.warnings,
      ElementsAre(HasSubstr("a.obj:1: there is no material file"), HasSubstr("b.mtl:2: there is no image"),
                  HasSubstr("'l' is not read"), HasSubstr("a.obj:9: no file has the material 'other'")));
  EXPECT_FALSE(model.materials[0].map.given());
}

TEST(ReadObj, ALessonsMapsAreFoundByTheirNames) {
  ModelFolder folder;
  for (const char* name : {"head_diffuse.tga", "head_nm.tga", "head_spec.tga"}) folder.write(name, "x");
  const Model model = folder.read("head.obj", std::string(kQuad) + "f 1 2 3\n");
  EXPECT_TRUE(model.materials[0].map.given());
  EXPECT_EQ(model.materials[0].diffuse, Vec3(1));
  EXPECT_TRUE(model.materials[0].normalMap.given() && model.materials[0].objectNormals);
  EXPECT_TRUE(model.materials[0].specularMap.given());
  EXPECT_FALSE(model.materials[0].glowMap.given());
  EXPECT_TRUE(model.materials[0].lesson && model.materials[0].map.nearest);
  EXPECT_FALSE(folder.read("other.obj", std::string(kQuad) + "f 1 2 3\n").materials[0].lesson);
}

/// As without a material file, where it names no maps.
TEST(ReadObj, ALessonsMapsAreFoundBesidesAnMtlWithoutMaps) {
  ModelFolder folder;
  for (const char* name : {"head_diffuse.tga", "head_nm_tangent.tga", "head_spec.tga", "head_glow.tga"})
    folder.write(name, "x");
  const std::string face = std::string(kQuad) + "vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
  const auto materialWith = [&](const char* mtl) {
    folder.write("head.mtl", mtl);
    return folder.read("head.obj", "mtllib head.mtl\n" + face).materials.at(0);
  };
  const ModelMaterial bare = folder.read("head.obj", face).materials.at(0),
                      beside = materialWith("newmtl m\nKd 0.8 0.5 0\nKs 1\nNs 5\nd 0.5\nillum 2\n");
  for (const ModelMaterial& material : {bare, beside}) {
    EXPECT_TRUE(material.lesson && material.map.given() && material.map.nearest);
    EXPECT_TRUE(material.normalMap.given() && material.specularMap.given() && material.glowMap.given());
    EXPECT_FALSE(material.objectNormals);
    EXPECT_EQ(material.diffuse, Vec3(1));
    EXPECT_EQ(material.glow, Vec3(1));
    EXPECT_EQ(material.specular, bare.specular);
    EXPECT_EQ(material.shininess, bare.shininess);
    EXPECT_EQ(material.opacity, 1);
    EXPECT_EQ(material.name, "m");
  }
  for (const char* own : {"newmtl m\nmap_Kd head_spec.tga\n", "newmtl m\nmap_Kd gone.png\n"})
    EXPECT_FALSE(materialWith(own).lesson) << own;
  std::filesystem::remove(folder / "head_diffuse.tga");
  EXPECT_EQ(materialWith("newmtl m\nKd 0.8 0.5 0\n").diffuse, Vec3(0.8, 0.5, 0));
  EXPECT_TRUE(materialWith("newmtl m\n").normalMap.given());
}

TEST(ReadObj, BadFilesAreRefusedWithTheirLine) {
  ModelFolder folder;
  const auto refusal = [&](const std::string& text) { return folder.refusal("a.obj", kQuad + text); };
  EXPECT_THAT(refusal("f 1 2 0\n"), HasSubstr("a.obj:5: there is no vertex 0"));
  EXPECT_THAT(refusal("\nf 1 2 9\n"), HasSubstr("a.obj:6: there is no vertex 9; there are 1 to 4 so far"));
  EXPECT_THAT(refusal("f 1 2 -5\n"), HasSubstr("there is no vertex -5"));
  EXPECT_THAT(refusal("f 1/1 2 3\n"), HasSubstr("there is no vt 1; there are none so far"));
  EXPECT_THAT(refusal("f 1 2 99999999999999999999\n"), HasSubstr("is no number of a vertex"));
  EXPECT_THAT(refusal("f 1 2\n"), HasSubstr("a face of 2 vertices"));
  EXPECT_THAT(refusal("v nan 0 0\n"), HasSubstr("a.obj:5: a coordinate is nan"));
  EXPECT_THAT(refusal("v 1e999 0 0\n"), HasSubstr("a coordinate is 1e999"));
  EXPECT_THAT(refusal("v 1 2\n"), HasSubstr("a coordinate is missing"));
  EXPECT_THAT(refusal("v 1 2 x\n"), HasSubstr("which is no number"));
  EXPECT_THAT(refusal(""), HasSubstr("a.obj: it has no faces"));
  EXPECT_THAT(refusal("f 1 1 2\n"), HasSubstr("a.obj: it has no triangle with an area"));
  EXPECT_THAT(refusal("mtllib ../a.mtl\n"),
              HasSubstr("a.obj:5: '../a.mtl' is outside of the model's folder"));
  EXPECT_THAT(refusal("mtllib /etc/passwd\n"), HasSubstr("outside of the model's folder"));
  EXPECT_THAT(refusal("mtllib C:\\a.mtl\n"), HasSubstr("outside of the model's folder"));
  folder.write("b.mtl", "newmtl m\nmap_Kd a/../../b.png\n");
  EXPECT_THAT(refusal("mtllib b.mtl\n"), HasSubstr("b.mtl:2: 'a/../../b.png' is outside"));
  folder.write("b.mtl", "Kd 1 1 1\n");
  EXPECT_THAT(refusal("mtllib b.mtl\n"), HasSubstr("b.mtl:1: 'Kd' before any newmtl"));
}

TEST(ReadObj, PartsWithoutAreaAreLeftOut) {
  ModelFolder folder;
  const Model model =
      folder.read("a.obj", std::string(kQuad) + "o flat\nusemtl a\nf 1 4 4\no whole\nusemtl b\nf 1 2 3\n");
  EXPECT_EQ(model.triangleCount(), 1u);
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("a.obj: 1 triangles of 'a' have no area")));
}

TEST(ReadObj, LinesEndAsTheyDoAnywhere) {
  ModelFolder folder;
  const std::string unix = "# by a test\nmtllib a.mtl\n" + std::string(kQuad) + "usemtl m\nf 1 2 \\\n3 4\n";
  const auto ending = [](std::string text, const std::string& end) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + end.size()))
      text.replace(at, 1, end);
    return text;
  };
  const TriangleMesh expected = [&] {
    folder.write("a.mtl", "newmtl m\nKd 0.5\n");
    return folder.read("a.obj", unix).meshes[0];
  }();
  for (const char* mark : {"", "\xef\xbb\xbf"})
    for (const char* end : {"\n", "\r\n", "\r"}) {
      folder.write("a.mtl", mark + ending("newmtl m\nKd 0.5\n", end));
      const Model model = folder.read("a.obj", mark + ending(unix, end));
      EXPECT_EQ(trianglesOf(model.meshes[0]), trianglesOf(expected));
      EXPECT_EQ(model.materials[0].diffuse, Vec3(0.5));
      EXPECT_THAT(model.warnings, IsEmpty());
      EXPECT_THAT(folder.refusal("a.obj", mark + ending(unix + "\nf 1 2 9\n", end)),
                  HasSubstr("a.obj:11: there is no vertex 9"));
    }
}

TEST(ReadObj, WhatIsNotReadIsOneWarningEach) {
  ModelFolder folder;
  folder.write("a.png", "");
  folder.write("a.mtl",
               "newmtl m\nKa 1 1 1\nillum 2\nmap_Ka a.png\ndisp a.png\nrefl -type sphere a.png\n"
               "newmtl n\nmap_Ka a.png\nmap_Kd a.png\n");
  const Model model =
      folder.read("a.obj",
                  "mtllib a.mtl\nv 0 0 0 1\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                  "usemtl n\nf 1/1 2/2 3/3\nf 1 2/2 3/3\nf 1 2 3\nusemtl m\nf 1 2 3\n");
  EXPECT_THAT(
      model.warnings,
      ElementsAre(HasSubstr("a.mtl:4: 'map_Ka' is not read"), HasSubstr("a.mtl:5: 'disp' is not read"),
                  HasSubstr("a.mtl:6: 'refl' is not read"),
                  HasSubstr("a.obj:3: colours of vertices are not read"),
                  HasSubstr("a.obj:10: this face has no uvs, which the maps of its material 'n' need"),
                  HasSubstr("edges of 'a'")));
  EXPECT_THAT(model.images.at(0).place, EndsWith("a.mtl:9"));
  EXPECT_FALSE(model.materials[0].ambient);
}

TEST(ReadObj, LinksMayLeadOutsideOnlyWhereThatIsAllowed) {
  ModelFolder folder;
  std::filesystem::create_directories(folder / "in/deep");
  folder.write("out.mtl", "newmtl m\nKd 0.5\n");
  folder.write("in/deep/in.mtl", "newmtl m\nKd 0.5\n");
  std::filesystem::create_symlink(folder / "out.mtl", folder / "in/out.mtl");
  std::filesystem::create_symlink("deep/in.mtl", folder / "in/in.mtl");
  std::filesystem::create_directory_symlink(folder / "in", folder / "link");
  const auto text = [](const char* library) {
    return "mtllib " + std::string(library) + "\n" + kQuad + "usemtl m\nf 1 2 3\n";
  };
  EXPECT_THAT(folder.refusal("in/a.obj", text("out.mtl")),
              HasSubstr("'out.mtl' is outside of the model's folder"));
  EXPECT_EQ(folder.read("in/a.obj", text("out.mtl"), {.allowOutside = true}).materials[0].diffuse, Vec3(0.5));
  EXPECT_EQ(folder.read("in/a.obj", text("in.mtl")).materials[0].diffuse, Vec3(0.5));
  EXPECT_EQ(folder.read("link/a.obj", text("in.mtl")).materials[0].diffuse, Vec3(0.5));
  const std::string longName(5000, 'x');
  EXPECT_THAT(folder.read("in/a.obj", text(longName.c_str())).warnings,
              ElementsAre(HasSubstr("there is no material file")));
}

/// However the model is named: what is beside it is found, what is missing is missing, what is outside is
/// that.
TEST(ReadObj, TheFolderOfAModelMayBeTheCurrentOne) {
  ModelFolder folder;
  std::filesystem::create_directory(folder / "in");
  std::filesystem::create_directory_symlink(folder / "in", folder / "link");
  folder.write("out.mtl", "newmtl m\nKd 0.25\n");
  folder.write("in/in.mtl", "newmtl m\nKd 0.5\nmap_Kd gone.png\nmap_Ks maps/gone.png\n");
  folder.write("in/a_diffuse.tga", "x");
  const std::string face = std::string(kQuad) + "usemtl m\nf 1 2 3\n";
  folder.write("in/a.obj", face);
  folder.write("in/b.obj", "mtllib in.mtl\n" + face);
  folder.write("in/c.obj", "mtllib gone.mtl\n" + face);
  folder.write("in/d.obj", "mtllib ../out.mtl\n" + face);
  folder.write("in/e.obj", "mtllib ../gone.mtl\n" + face);
  folder.write("in/f.gltf", R"({ "asset": { "version": "2.0" },
                                 "buffers": [{ "uri": "gone.bin", "byteLength": 4 }] })");
  const auto refusal = [](const std::filesystem::path& path) {
    try {
      (void)readModel(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const InFolder current(folder / "in");
  for (const std::filesystem::path from : {"", ".", "../in", "../link", "../in/../link/./"}) {
    SCOPED_TRACE(from);
    EXPECT_TRUE(readModel(from / "a.obj").materials[0].map.given());
    const Model found = readModel(from / "b.obj");
    EXPECT_EQ(found.materials[0].diffuse, Vec3(0.5));
    EXPECT_THAT(found.warnings, ElementsAre(HasSubstr("in.mtl:3: there is no image 'gone.png'"),
                                            HasSubstr("in.mtl:4: there is no image 'maps/gone.png'")));
    EXPECT_THAT(readModel(from / "c.obj").warnings,
                ElementsAre(HasSubstr("there is no material file 'gone.mtl'")));
    for (const char* outside : {"d.obj", "e.obj"})
      EXPECT_THAT(refusal(from / outside), HasSubstr("is outside of the model's folder")) << outside;
    EXPECT_EQ(readModel(from / "d.obj", {.allowOutside = true}).materials[0].diffuse, Vec3(0.25));
    EXPECT_THAT(refusal(from / "f.gltf"),
                AllOf(HasSubstr("cannot read"), HasSubstr("gone.bin': No such file")));
  }
}

TEST(ReadObj, FilesOutsideMayBeAllowed) {
  ModelFolder folder;
  folder.write("b.mtl", "newmtl m\nKd 0.5\n");
  std::filesystem::create_directory(folder / "deep");
  const Model model = folder.read(
      "deep/a.obj", std::string("mtllib ../b.mtl\n") + kQuad + "usemtl m\nf 1 2 3\n", {.allowOutside = true});
  EXPECT_EQ(model.materials[0].diffuse, Vec3(0.5));
}

TEST(ReadObj, ProgressAscendsToOne) {
  ModelFolder folder;
  double last = 0;
  (void)folder.read("a.obj", std::string(kQuad) + "f 1 2 3\n", {.progress = [&](double part) {
                      EXPECT_GE(part, last);
                      last = part;
                    }});
  EXPECT_EQ(last, 1);
}

TEST(ReadModel, OtherSuffixesAreRefused) {
  EXPECT_TRUE(namesModel("a/B.OBJ"));
  EXPECT_FALSE(namesModel("a.blend"));
  try {
    (void)readModel("a.blend");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Usage);
  }
  EXPECT_THROW((void)readModel("missing.obj"), Error);
}

}  // namespace
}  // namespace luxo
