// SPDX-License-Identifier: Apache-2.0
// Models that are broken, as a user meets them: exit code 3, the file and its line, no picture, and no memory
// in proportion to what a header promises; and what is only missing: a warning, and a picture.
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.h"

namespace luxo::test {
namespace {

class BrokenModels : public RenderTest {
 protected:
  [[nodiscard]] Outcome rendered(const std::string& model) const {
    Launch launch{.arguments = {"render", model, "--size", "16x12", "-o", "a.png"}, .folder = folder.path()};
#ifndef LUXO_SANITIZED  // these reserve terabytes
    launch.addressSpaceLimitBytes = std::uint64_t{3} << 30;
#endif
    return run(launch);
  }

  void write(const std::string& name, const std::string& text) const { writeText(folder / name, text); }

  /// A triangle of an OBJ file, whose material takes its map from there.
  void writeMapped(const std::string& image) const {
    write("m.mtl", "newmtl a\nmap_Kd " + image + "\n");
    write("m.obj", "mtllib m.mtl\nvt 0 0\n" + kCorners + "usemtl a\nf 1/1 2/1 3/1\n");
  }

  const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
};

TEST_F(BrokenModels, AreRefusedByFileAndLine) {
  using namespace std::string_literals;
  struct Broken {
    std::string name, text, said;
  };
  const std::vector<Broken> all{
      {"zero.obj", kCorners + "f 1 2 0\n", "zero.obj:4: there is no vertex 0"},
      {"negative.obj", kCorners + "f 1 2 -4\n", "negative.obj:4: there is no vertex -4"},
      {"beyond.obj", kCorners + "f 1 2 9\n", "beyond.obj:4: there is no vertex 9"},
      {"nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "nan.obj:1: a coordinate is nan"},
      {"empty.obj", "v 0 0 0\n", "empty.obj: it has no faces"},
      {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "flat.obj: it has no triangle with an area"},
      {"cyclic.gltf",
       R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}]})",
       "cyclic.gltf: nodes[0]: it is its own ancestor"},
      {"apart.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"none.bin","byteLength":4}]})",
       "apart.gltf: buffers[0].uri: cannot read"},
      {"short.glb", "glTF\x02\0\0\0\xff\xff\xff\xff\xff\xff\xff\xffJSON{}"s, "promises 4294967295 bytes"},
      {"short.ply",
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float "
       "z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
       "short.ply:3: 4000000000 elements"},
      {"short.stl", std::string(80, '\0') + "\xff\xff\xff\xff", "4294967295 facets need"}};
  for (const Broken& broken : all) {
    SCOPED_TRACE(broken.name);
    write(broken.name, broken.text);
    expectFailure(rendered(broken.name), 3, broken.said);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
  }
}

TEST_F(BrokenModels, SoAreTheirImages) {
  using namespace std::string_literals;
  const std::string tga = "\0\0\2\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x20\0"s;  // 65,535 x 65,535 of 32 bits
  const std::string png = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\1\0\0\0\1\0\0\x08\6\0\0\0"s;  // 65,536 x 65,536
  const std::string jpeg = "\xff\xd8\xff\xe0\0\x10JFIF\0\1\1\0\0\1\0\1\0\0"s;
  for (const auto& [name, bytes] : {std::pair{"a.tga"s, tga}, {"b.png"s, png}, {"c.jpg"s, jpeg}}) {
    SCOPED_TRACE(name);
    write(name, bytes);
    writeMapped(name);
    expectFailure(rendered("m.obj"), 3, "m.mtl:2: cannot read '" + name + "'");
  }
  for (const char* outside : {"../a.tga", "/etc/a.tga"}) {
    writeMapped(outside);
    expectFailure(rendered("m.obj"), 3, "is outside of the model's folder", "--allow-outside");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST_F(BrokenModels, WhatIsMissingIsToldOnce) {
  requireDevice();
  write("bare.obj", "mtllib none.mtl\n" + kCorners + "usemtl a\nf 1 2 3\n");
  writeMapped("none.png");
  for (const auto& [model, said] :
       {std::pair{"bare.obj", "warning: bare.obj:1: there is no material file 'none.mtl'"},
        {"m.obj", "warning: m.mtl:2: there is no image 'none.png'"}}) {
    const Outcome outcome = rendered(model);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, said)) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), outcome.err.rfind("warning")) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
  }
}

/// As a folder of the lesson's, with its maps, is used.
TEST_F(BrokenModels, AFolderIsTheOneModelInIt) {
  std::filesystem::create_directory(folder / "head");
  write("head/notes.txt", "no model\n");
  EXPECT_EQ(rendered("head").code, 3);
  write("head/head.obj", kCorners + "f 1 2 3\n");
  EXPECT_EQ(rendered("head").code, 0);
  write("head/bust.obj", kCorners + "f 1 2 3\n");
  const Outcome several = rendered("head");
  EXPECT_EQ(several.code, 3);
  EXPECT_TRUE(contains(several.err, "has 2 models")) << several.err;
}

}  // namespace
}  // namespace luxo::test
