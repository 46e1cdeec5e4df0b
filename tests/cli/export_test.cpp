// SPDX-License-Identifier: Apache-2.0
// luxo export: the files, what luxo reads back from them, and every way in which it refuses. No device is
// needed: pictures are the reference's.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/format.h"
#include "mesh/model.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

// The ambient colour is the default, as a GLB has no word for it.
const char* const kRing = R"scene({
  "luxo": 1,
  "params": { "minor": { "value": 0.4, "range": [0.1, 0.9] } },
  "materials": { "enamel": { "diffuse": [0.5, 0.08, 0.06], "specular": 0.3, "shininess": 20 } },
  "surfaces": { "ring": { "type": "torus", "major": 1, "minor": "minor" } },
  "nodes": [ { "name": "ring", "surface": "ring", "material": "enamel" },
             { "rotate": { "axis": [1, 0, 0], "angle": "-50deg" }, "light": { "type": "directional" } } ],
  "camera": { "eye": [0.3, 2.6, 3.2] }
}
)scene";

class Export : public RenderTest {
 protected:
  void SetUp() override { writeText(folder / "ring.luxo.json", kRing); }

  [[nodiscard]] Outcome exported(Arguments arguments) const {
    arguments.insert(arguments.begin(), "export");
    return run(folder, arguments);
  }
  void expectExported(const Arguments& arguments) const {
    const Outcome outcome = exported(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  /// The reference's picture.
  [[nodiscard]] std::string pictureOf(const std::string& scene, const std::string& file,
                                      const Arguments& extra = {}) const {
    Arguments arguments = {"render", scene, "--engine", "reference", "--size", "67x45", "-o", file};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return textOf(folder / file);
  }
  /// Replaces a part of a file by one that is no longer, and blanks.
  void edit(const std::string& file, const std::string& part, std::string instead) const {
    std::string bytes = textOf(folder / file);
    const std::size_t at = bytes.find(part);
    ASSERT_NE(at, std::string::npos);
    ASSERT_LE(instead.size(), part.size());
    instead.resize(part.size(), ' ');
    writeText(folder / file, bytes.replace(at, part.size(), instead));
  }
};

TEST_F(Export, FormulasComeBackExactly) {
  for (const std::string scene : {"luxo-grandpa", "showcase", "ring.luxo.json"}) {
    SCOPED_TRACE(scene);
    expectExported({scene, "-o", "a.glb", "-q"});
    EXPECT_TRUE(pictureOf("a.glb", "a.pfm") == pictureOf(scene, "b.pfm"));
  }
}

TEST_F(Export, TheMomentAndTheParametersAreThoseOfTheExport) {
  expectExported({"luxo-grandpa", "-o", "a.glb", "-q", "--time", "3"});
  EXPECT_TRUE(pictureOf("a.glb", "a.pfm") == pictureOf("luxo-grandpa", "b.pfm", {"--time", "3"}));
  expectExported({"ring.luxo.json", "-o", "a.glb", "-P", "minor=0.2"});
  const std::string thin = pictureOf("ring.luxo.json", "b.pfm", {"-P", "minor=0.2"});
  EXPECT_TRUE(pictureOf("a.glb", "a.pfm") == thin);
  // They are parameters still.
  EXPECT_TRUE(pictureOf("a.glb", "a.pfm", {"-P", "minor=0.4"}) == pictureOf("ring.luxo.json", "b.pfm"));
  EXPECT_EQ(run(folder, {"render", "a.glb", "-o", "a.png", "-P", "minor=2"}).code, 2);
}

TEST_F(Export, TrianglesGiveTheSamePictureWithinTheTolerance) {
  expectExported({"ring.luxo.json", "-o", "a.glb", "--no-formulas", "--tolerance", "1mm"});
  static_cast<void>(pictureOf("a.glb", "a.exr", {"--aov", "position"}));
  static_cast<void>(pictureOf("ring.luxo.json", "b.exr", {"--aov", "position"}));
  const Image triangles = loadImage(folder / "a.exr"), formulas = loadImage(folder / "b.exr");
  int hits = 0, different = 0;
  double most = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto p = triangles.pixel(x, y), q = formulas.pixel(x, y);
      const auto hit = [](const auto& sample) { return sample[0] != 0 || sample[1] != 0 || sample[2] != 0; };
      different += hit(p) != hit(q);
      if (!hit(p)) continue;
      ++hits;
      most = std::max(most, std::abs(std::hypot(std::hypot(p[0], p[2]) - 1, p[1]) - 0.4));
    }
  EXPECT_GT(hits, 500);
  EXPECT_LE(different, 2);  // a pixel is 50 tolerances wide there
  EXPECT_LE(most, 1e-3);
  EXPECT_GT(most, 1e-5);  // they are triangles
  static_cast<void>(pictureOf("a.glb", "a.pfm"));
  static_cast<void>(pictureOf("ring.luxo.json", "b.pfm"));
  const Image lit = loadImage(folder / "a.pfm"), truth = loadImage(folder / "b.pfm");
  double sum = 0;
  for (std::size_t i = 0; i < lit.samples().size(); ++i)
    sum += std::abs(lit.samples()[i] - truth.samples()[i]);
  EXPECT_LT(sum / double(lit.samples().size()), 2e-3);
}

/// Light from everywhere, colours of it, and what is behind all.
TEST_F(Export, TrianglesHaveTheScenesSurroundings) {
  writeText(folder / "s.luxo.json", R"({ "luxo": 1,
    "render": { "ambient": [0.6, 0.3, 0.5], "background": [0.1, 0.2, 0.05] },
    "materials": { "m": { "diffuse": [0.2, 0.3, 0.4], "ambient": [0.9, 0.1, 0.1] } },
    "surfaces": { "s": { "type": "sphere" } }, "nodes": [ { "surface": "s", "material": "m" } ],
    "camera": { "eye": [0, 0, 4], "look_at": [0, 0, 0], "fov_y": "40deg" } })");
  expectExported({"s.luxo.json", "-o", "a.glb", "--no-formulas", "--tolerance", "0.1mm"});
  static_cast<void>(pictureOf("a.glb", "a.pfm"));
  static_cast<void>(pictureOf("s.luxo.json", "b.pfm"));
  const Image triangles = loadImage(folder / "a.pfm"), formulas = loadImage(folder / "b.pfm");
  int different = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c)
        different += std::abs(triangles.pixel(x, y)[c] - formulas.pixel(x, y)[c]) > 1e-5;
  EXPECT_LE(different, 3);  // a pixel of the outline
  EXPECT_NEAR(triangles.pixel(kWidth / 2, kHeight / 2)[0], 0.54, 1e-6);
}

TEST_F(Export, EveryFormatIsRead) {
  for (const std::string file : {"a.glb", "a.obj", "a.ply", "a.stl"}) {
    SCOPED_TRACE(file);
    expectExported({"ring.luxo.json", "-o", file, "--tolerance", "1mm"});
    const Model model = readModel(folder / file);
    ASSERT_EQ(model.meshes.size(), 1U);
    EXPECT_TRUE(model.meshes[0].closed());
    EXPECT_EQ(model.meshes[0].edges().nonManifold, 0U);
    EXPECT_NEAR(model.meshes[0].bounds().max.x, 1.4, 1e-3);
    EXPECT_EQ(model.scene.empty(), file != "a.glb");
  }
  expectExported({"ring.luxo.json", "-o", "A.STL", "--unit", "mm"});
  EXPECT_NEAR(readModel(folder / "A.STL").meshes[0].bounds().max.x, 1400, 5);
  EXPECT_TRUE(contains(textOf(folder / "A.STL").substr(0, 80), "mm, closed"));
}

TEST_F(Export, PartsOfTheLampAreClosedWhereTheirSurfacesAre) {
  expectExported({"luxo-grandpa", "-o", "a.glb", "--tolerance", "1mm"});
  const Model model = readModel(folder / "a.glb");
  EXPECT_EQ(model.meshes.size(), 6U);
  for (const TriangleMesh& mesh : model.meshes)
    EXPECT_EQ(mesh.closed(), mesh.name() == "sphere") << mesh.name();
  expectExported({"luxo-grandpa", "-o", "b.glb", "--tolerance", "1mm", "--thicken", "5mm"});
  const Model thick = readModel(folder / "b.glb");
  EXPECT_EQ(thick.meshes.size(), 7U);  // only the joints share one
  for (const TriangleMesh& mesh : thick.meshes) {
    EXPECT_TRUE(mesh.closed()) << mesh.name();
    EXPECT_EQ(mesh.edges().nonManifold, 0U) << mesh.name();
  }
}

TEST_F(Export, TheSameBytesEveryTime) {
  expectExported({"showcase", "-o", "a.glb", "-q"});
  expectExported({"showcase", "-o", "b.glb", "-q"});
  EXPECT_TRUE(textOf(folder / "a.glb") == textOf(folder / "b.glb"));
}

TEST_F(Export, ToStandardOutput) {
  expectExported({"ring.luxo.json", "-o", "a.stl"});
  const Outcome printed = exported({"ring.luxo.json", "-o", "-", "--format", "stl"});
  EXPECT_EQ(printed.code, 0);
  EXPECT_TRUE(printed.out == textOf(folder / "a.stl"));
  EXPECT_TRUE(contains(printed.err, "standard output: ")) << printed.err;
  EXPECT_EQ(exported({"ring.luxo.json", "-o", "a.stl", "-q"}).err, "");
}

TEST_F(Export, ThickenedForPrinting) {
  const Outcome outcome = exported({"flag", "-o", "a.stl", "--thicken", "20mm", "--unit", "mm", "-q"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(readModel(folder / "a.stl").meshes[0].closed());
  expectExported({"flag", "-o", "b.stl", "-q"});
  EXPECT_FALSE(readModel(folder / "b.stl").meshes[0].closed());
}

TEST_F(Export, WhatCannotBeKeptIsExitCode6) {
  std::string far = kRing;
  const std::string node = R"("name": "ring",)";
  writeText(folder / "far.luxo.json",
            far.insert(far.find(node) + node.size(), R"("translate": [1e6, 0, 0],)"));
  const Outcome outcome = exported({"far.luxo.json", "-o", "a.stl", "--tolerance", "1mm"});
  EXPECT_EQ(outcome.code, 6);
  EXPECT_TRUE(contains(outcome.err, "proven to be within")) << outcome.err;
  EXPECT_TRUE(
      contains(exported({"far.luxo.json", "-o", "b.stl", "--tolerance", "1.0001mm", "--unit", "mm"}).err,
               "not within 1.0001 mm"));
  EXPECT_GT(readModel(folder / "a.stl").meshes[0].triangleCount(), 1000U);
  expectExported({"far.luxo.json", "-o", "a.glb", "--tolerance", "1mm"});  // has an origin in double
  writeText(folder / "holed.luxo.json", R"scene({ "luxo": 1,
    "surfaces": { "s": { "type": "formula", "u": [-1, 1], "v": [-1, 1],
                         "position": ["u", "sqrt(1-u^2-v^2)", "v"] } },
    "nodes": [ { "surface": "s" } ] })scene");
  EXPECT_EQ(exported({"holed.luxo.json", "-o", "a.ply"}).code, 0);
  const Outcome holed = exported({"holed.luxo.json", "-o", "a.ply", "--tolerance", "1mm"});
  EXPECT_EQ(holed.code, 6);
  EXPECT_TRUE(contains(holed.err, "nothing is proven")) << holed.err;
  EXPECT_TRUE(contains(textOf(folder / "a.ply").substr(0, 200), "deviation unknown, open"));
}

TEST_F(Export, WhatIsNotCarriedIsSaid) {
  const Outcome outcome = exported({"primitives", "-o", "a.glb"});
  EXPECT_TRUE(contains(outcome.err, "made by a program")) << outcome.err;
  expectExported({"ring.luxo.json", "-o", "a.glb", "--no-formulas"});
  EXPECT_EQ(readModel(folder / "a.glb").scene, "");
  EXPECT_EQ(run(folder, {"render", "a.glb", "-o", "a.png", "-P", "minor=0.2"}).code, 2);
}

/// Of what moves and of what the format has no room for, as far as there is some.
TEST_F(Export, WhatTheFileHasNoRoomForIsTold) {
  const Outcome moving = exported({"luxo-grandpa", "-o", "a.glb", "--time", "3", "--tolerance", "1cm"});
  EXPECT_TRUE(contains(moving.err, "the triangles stand still, as they are at 3 s")) << moving.err;
  const Outcome ring = exported({"ring.luxo.json", "-o", "a.stl", "--tolerance", "1mm"});
  EXPECT_TRUE(contains(ring.err, "no room for materials, cameras, lights")) << ring.err;
  EXPECT_FALSE(contains(ring.err, "stand still")) << ring.err;
  const Outcome bare = exported({"a.stl", "-o", "b.stl", "--tolerance", "1mm"});
  EXPECT_EQ(bare.code, 0) << bare.err;
  EXPECT_FALSE(contains(bare.err, "warning")) << bare.err;  // those lights were none of its own
}

/// What people are told is what the file says, or more.
TEST_F(Export, TheDeviationIsToldRoundedUp) {
  for (const char* tolerance : {"1mm", "1.7mm", "2.9mm", "4.3mm"}) {
    const Outcome outcome = exported({"ring.luxo.json", "-o", "a.glb", "--tolerance", tolerance});
    const std::size_t at = outcome.err.find("at most ");
    ASSERT_NE(at, std::string::npos) << outcome.err;
    const std::string bytes = textOf(folder / "a.glb");
    const std::string key = R"("deviation":)";
    const double proven = std::stod(bytes.substr(bytes.find(key) + key.size(), 30));
    EXPECT_GE(std::stod(outcome.err.substr(at + 8)), proven) << tolerance;
    EXPECT_LE(std::stod(outcome.err.substr(at + 8)), proven * 1.01) << tolerance;
  }
}

// A file that others have changed: its triangles are there still.
TEST_F(Export, FormulasThatCannotBeReadAreNotUsed) {
  expectExported({"ring.luxo.json", "-o", "a.glb", "--no-formulas"});
  const std::string triangles = pictureOf("a.glb", "a.pfm");
  const std::pair<std::string, std::string> changes[] = {{R"(\"torus\")", R"(\"tarus\")"},
                                                         {R"({"version":1,)", R"({"version":2,)"}};
  for (const auto& [part, instead] : changes) {
    SCOPED_TRACE(instead);
    expectExported({"ring.luxo.json", "-o", "b.glb"});
    edit("b.glb", part, instead);
    EXPECT_TRUE(pictureOf("b.glb", "b.pfm") == triangles);
    const Outcome outcome = run(folder, {"inspect", "b.glb"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(contains(outcome.out, "triangles are used instead")) << outcome.out;
  }
  // Nor do they lead to other files.
  expectExported({"ring.luxo.json", "-o", "ring.ply"});
  expectExported({"ring.luxo.json", "-o", "b.glb"});
  edit("b.glb", R"({ \"type\": \"torus\", \"major\": 1, \"minor\": \"minor\" })",
       R"({ \"type\": \"mesh\", \"file\": \"ring.ply\" })");
  EXPECT_TRUE(pictureOf("b.glb", "b.pfm") == triangles);
}

TEST_F(Export, NoInputIsOverwritten) {
  expectExported({"ring.luxo.json", "-o", "ring.obj"});
  const std::string before = textOf(folder / "ring.obj");
  writeText(folder / "meshes.luxo.json", R"({ "luxo": 1,
    "surfaces": { "s": { "type": "mesh", "file": "ring.obj" } }, "nodes": [ { "surface": "s" } ] })");
  expectFailure(exported({"ring.obj", "-o", "ring.obj"}), 2, "would overwrite a file of the scene",
                "another name");
  expectFailure(exported({"meshes.luxo.json", "-o", "./ring.obj"}), 2, "would overwrite a file of the scene");
  std::filesystem::rename(folder / "ring.mtl", folder / "other.mtl");
  std::string other = before;
  other.replace(other.find("ring.mtl"), 8, "used.mtl");
  writeText(folder / "ring.obj", other);
  std::filesystem::rename(folder / "other.mtl", folder / "used.mtl");
  expectFailure(exported({"ring.obj", "-o", "used.obj"}), 2, "'used.mtl' would overwrite");
  EXPECT_EQ(textOf(folder / "ring.obj"), other);
}

TEST_F(Export, FilesAppearWholeOrNotAtAll) {
  writeText(folder / "a.stl", "what was here before");
  Launch launch{.arguments = {"export", "ring.luxo.json", "-o", "a.stl"}, .folder = folder.path()};
  launch.fileSizeLimitBytes = 4096;
  EXPECT_EQ(run(launch).code, 5);
  EXPECT_EQ(textOf(folder / "a.stl"), "what was here before");
  EXPECT_EQ(folder.entries(), 2U);
  expectFailure(exported({"ring.luxo.json", "-o", "missing/a.stl"}), 5, "missing", "mkdir -p");
  Launch full{.arguments = {"export", "ring.luxo.json", "-o", "-", "--format", "ply"},
              .folder = folder.path(),
              .out = "/dev/full"};
  EXPECT_EQ(run(full).code, 5);
}

TEST_F(Export, Refusals) {
  const auto refused = [&](const Arguments& arguments, int code, const std::string& said,
                           const std::string& help = "") {
    SCOPED_TRACE(arguments.back());
    expectFailure(exported(arguments), code, said, help);
    EXPECT_EQ(folder.entries(), 1U);
  };
  refused({"torus"}, 2, "no output is given", ".glb");
  refused({"-o", "a.glb"}, 2, "no scene is given", "luxo export torus");
  refused({"torus", "-o", "a.gltf"}, 2, "'a.gltf'", ".stl");
  refused({"torus", "-o", "a.png"}, 2, "'a.png'", ".stl");
  refused({"torus", "-o", "-"}, 2, "-o - says no format", "--format");
  refused({"torus", "-o", "-", "--format", "obj"}, 2, "two files");
  refused({"torus", "-o", "-", "--format", "step"}, 2, "no such format", "glb");
  refused({"torus", "-o", "a.stl", "--format", "stl"}, 2, "--format is for -o -");
  refused({"torus", "-o", "a.stl", "--tolerance", "0"}, 2, "must be above 0", "0.01mm");
  refused({"torus", "-o", "a.stl", "--tolerance", "1px"}, 2, "'1px': not a number");
  refused({"torus", "-o", "a.stl", "--thicken", "-1mm"}, 2, "must be above 0");
  refused({"torus", "-o", "a.stl", "--unit", "ft"}, 2, "no such unit");
  refused({"torus", "-o", "a.glb", "--unit", "mm"}, 2, "a GLB is in metres");
  refused({"torus", "-o", "a.stl", "--no-formulas"}, 2, "--no-formulas is for GLB");
  refused({"torus", "-o", "a.glb", "--size", "3x3"}, 2, "unknown option '--size'");
  refused({"torus", "-o", "a.glb", "--camera", "none"}, 2, "no camera 'none'");
  refused({"torus", "-o", "a.glb", "-P", "k=1"}, 2, "no parameter 'k'");
  refused({"torsu", "-o", "a.glb"}, 3, "no scene 'torsu'", "did you mean 'torus'?");
  refused({"missing.luxo.json", "-o", "a.glb"}, 3, "missing.luxo.json");
  writeText(folder / "ring.luxo.json", R"({ "luxo": 1, "nodes": [] })");
  refused({"ring.luxo.json", "-o", "a.glb"}, 3, "shows no surface");
}

}  // namespace
}  // namespace luxo::test
