// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/model_source.h"
#include "mesh/welding.h"
#include "unit/mesh_model_support.h"

namespace luxo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class T>
void put(std::string& bytes, T value, std::endian order) {
  std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

constexpr const char* kPlyProperties =
    "element vertex 4\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\n"
    "element face 1\nproperty list uchar int vertex_indices\nproperty short other\nend_header\n";
constexpr double kSquare[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0.5}};

std::string textPly() {
  std::string ply = std::string("ply\nformat ascii 1.0\ncomment made by a test\n") + kPlyProperties;
  for (const auto& p : kSquare)
    ply += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + " 255\n";
  return ply + "4 0 1 2 3 7\n";
}

std::string binaryPly(std::endian order) {
  std::string ply = std::string("ply\nformat binary_") + (order == std::endian::big ? "big" : "little") +
                    "_endian 1.0\n" + kPlyProperties;
  for (const auto& p : kSquare) {
    put(ply, float(p[0]), order);
    put(ply, p[1], order);
    put(ply, float(p[2]), order);
    put(ply, std::uint8_t(255), order);
  }
  put(ply, std::uint8_t(4), order);
  for (int i = 0; i < 4; ++i) put(ply, std::int32_t(i), order);
  put(ply, std::int16_t(7), order);
  return ply;
}

TEST(ReadPly, TextAndBothBinariesAreTheSame) {
  ModelFolder folder;
  const Model text = folder.read("a.ply", textPly());
  expectPromises(text.meshes[0]);
  EXPECT_EQ(text.triangleCount(), 2u);
  EXPECT_EQ(text.meshes[0].bounds(), (Box{Vec3(0), Vec3(1, 1, 0.5)}));
  EXPECT_THAT(text.warnings, ElementsAre(HasSubstr("colours of vertices are not read")));
  for (const std::endian order : {std::endian::little, std::endian::big})
    EXPECT_EQ(trianglesOf(folder.read("b.ply", binaryPly(order)).meshes[0]), trianglesOf(text.meshes[0]));
}

TEST(ReadPly, NormalsAndUvsAreRead) {
  ModelFolder folder;
  const Model model = folder.read(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
      "element face 1\nproperty list uchar uint vertex_index\nend_header\n"
      "0 3 4 0 0 0 0 0\n0 3 4 1 0 0 1 0\n0 3 4 0 1 0 0 1\n3 0 1 2\n");
  const TriangleMesh& mesh = model.meshes[0];
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::distance(mesh.normals()[i], Vec3f(0, 0.6f, 0.8f)), 1e-7f);
    EXPECT_EQ(mesh.uvs()[i], Vec2f(mesh.positions()[i].x, 1 - mesh.positions()[i].y));
  }
}

TEST(ReadPly, FacesMayComeBeforeTheirVertices) {
  ModelFolder folder;
  const TriangleMesh expected = folder.read("a.ply", textPly()).meshes[0];
  std::string text =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0.5\n";
  EXPECT_EQ(trianglesOf(folder.read("b.ply", text).meshes[0]), trianglesOf(expected));
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_EQ(trianglesOf(folder.read("b.ply", text).meshes[0]), trianglesOf(expected));
  text.replace(text.find("4 0 1 2 3"), 9, "4 0 1 2 4");
  EXPECT_THAT(folder.refusal("b.ply", text), HasSubstr("b.ply:10: face 0 has vertex 4 of 4"));
}

TEST(ReadPly, BytesBeginWhereTheHeaderEnds) {
  ModelFolder folder;
  const TriangleMesh expected = folder.read("a.ply", textPly()).meshes[0];
  const std::string body = [] {
    std::string bytes;
    for (const auto& p : kSquare)
      for (const double x : p) put(bytes, float(x), std::endian::little);
    for (const int corners : {4, 0, 1, 2, 3}) put(bytes, std::uint8_t(corners), std::endian::little);
    return bytes;
  }();
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string ply = "ply" + end + "format binary_little_endian 1.0" + end;
    // A byte of 10, which is a line feed, comes first.
    for (const char* line :
         {"element mark 1", "property uchar ten", "element vertex 4", "property float x", "property float y",
          "property float z", "element face 1", "property list uchar uchar vertex_index", "end_header"})
      ply += line + end;
    EXPECT_EQ(trianglesOf(folder.read("b.ply", ply + "\n" + body).meshes[0]), trianglesOf(expected));
  }
}

// Two strips: the square, and a triangle that ends it.
TEST(ReadPly, StripsAreTrianglesThatAllTurnAlike) {
  ModelFolder folder;
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n9 0 1 2 3 4 -1 3 5 4\n";
  const TriangleMesh mesh = folder.read("a.ply", text).meshes[0];
  EXPECT_EQ(mesh.triangleCount(), 4u);
  double area = 0;
  for (std::size_t i = 0; i < mesh.indices().size(); i += 3) {
    const Vec3 a = mesh.point(mesh.indices()[i]), b = mesh.point(mesh.indices()[i + 1]),
               c = mesh.point(mesh.indices()[i + 2]);
    EXPECT_GT(glm::cross(b - a, c - a).z, 0);
    area += glm::cross(b - a, c - a).z / 2;
  }
  EXPECT_EQ(area, 2);
  EXPECT_EQ(mesh.edges().border, 6u);
  std::string bad = text;
  bad.replace(bad.find("-1 3"), 2, "-2");
  EXPECT_THAT(folder.refusal("a.ply", bad), HasSubstr("a.ply:16: strip 0 has vertex -2 of 6"));
}

TEST(ReadPly, BadFilesAreRefused) {
  ModelFolder folder;
  const auto refusal = [&](const std::string& text) { return folder.refusal("a.ply", text); };
  EXPECT_THAT(refusal(""), HasSubstr("does not begin with 'ply'"));
  EXPECT_THAT(refusal("ply\nformat ascii 1.0\n"), HasSubstr("no end_header"));
  EXPECT_THAT(refusal("ply\nformat strange 1.0\n"), HasSubstr("a.ply:2: the format 'strange'"));
  std::string lie = binaryPly(std::endian::little);
  lie.replace(lie.find("vertex 4"), 8, "vertex 2000000000");
  EXPECT_THAT(refusal(lie), HasSubstr("promises 34000000003 bytes or more"));
  lie.replace(lie.find("vertex 2000000000"), 17, "vertex 4000000000");
  EXPECT_THAT(refusal(lie), HasSubstr("a.ply:3: 4000000000 elements"));
  const std::string whole = binaryPly(std::endian::big);
  for (std::size_t length = 0; length + 1 < whole.size(); length += 3)
    EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
  std::string text = textPly();
  text.replace(text.find("4 0 1 2 3"), 9, "4 0 1 2 4");
  EXPECT_THAT(refusal(text), HasSubstr("a.ply:17: face 0 has vertex 4 of 4"));
  text.replace(text.find("4 0 1 2 4"), 9, "2 0 1");
  EXPECT_THAT(refusal(text), HasSubstr("face 0 has 2 vertices"));
  text = textPly();
  text.replace(text.find("0.500000"), 8, "nan");
  EXPECT_THAT(refusal(text), HasSubstr("a.ply:15: z of vertex 2 is nan"));
}

std::string binaryStl(const char* header = "made by a test") {
  std::string stl(header);
  stl.resize(80);
  put(stl, std::uint32_t(2), std::endian::little);
  for (const auto& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    for (int i = 0; i < 3; ++i) put(stl, 0.0f, std::endian::little);
    for (const int corner : corners)
      for (const double x : kSquare[corner]) put(stl, float(x), std::endian::little);
    put(stl, std::uint16_t(0), std::endian::little);
  }
  return stl;
}

std::string textStl() {
  std::string stl = "solid square\n";
  for (const auto& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    stl += "facet normal 0 0 1\n outer loop\n";
    for (const int i : corners)
      stl += "  vertex " + std::to_string(kSquare[i][0]) + " " + std::to_string(kSquare[i][1]) + " " +
             std::to_string(kSquare[i][2]) + "\n";
    stl += " endloop\nendfacet\n";
  }
  return stl + "endsolid square\n";
}

TEST(ReadStl, TextAndBinaryAreTheSame) {
  ModelFolder folder;
  const Model text = folder.read("a.stl", textStl());
  expectPromises(text.meshes[0]);
  EXPECT_EQ(text.triangleCount(), 2u);
  EXPECT_EQ(text.meshes[0].positions().size(), 4u);  // welded: both facets lie in one plane
  EXPECT_EQ(text.meshes[0].edges().border, 4u);
  EXPECT_EQ(trianglesOf(folder.read("b.stl", binaryStl()).meshes[0]), trianglesOf(text.meshes[0]));
  EXPECT_EQ(trianglesOf(folder.read("b.stl", binaryStl("solid liar")).meshes[0]),
            trianglesOf(text.meshes[0]));
  EXPECT_EQ(trianglesOf(folder.read("b.stl", binaryStl("solid liar") + "and more").meshes[0]),
            trianglesOf(text.meshes[0]));
  std::string other = textStl();
  std::transform(other.begin(), other.end(), other.begin(),
                 [](char c) { return c == '\n' ? '\r' : char(std::toupper(c)); });
  EXPECT_EQ(trianglesOf(folder.read("b.stl", "\xef\xbb\xbf" + other).meshes[0]), trianglesOf(text.meshes[0]));
}

// What readers of STL keep of a corner that many facets give: its point, once.
TEST(ReadStl, EqualCornersAreOnePoint) {
  WeldedPoints points;
  const Vec3 a(1, 2, 3), zero(0), minus(0, -0.0, 0);
  std::vector<std::uint32_t> numbers;
  for (const Vec3& point : {a, zero, a, minus, zero, minus, a}) numbers.push_back(points.numberOf(point));
  EXPECT_THAT(numbers, ElementsAre(0, 1, 0, 2, 1, 2, 0));
  EXPECT_THAT(points.take(), ElementsAre(a, zero, minus));

  // A ball has two facets a point: not 29400 corners, and more points than the table begins with.
  const MeshArrays ball = ballArrays(100, 50);
  WeldedPoints ofBall;
  numbers.clear();
  for (const std::uint32_t i : ball.indices) numbers.push_back(ofBall.numberOf(ball.positions[i]));
  const std::vector<Vec3> kept = ofBall.take();
  EXPECT_EQ(kept.size(), ball.positions.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(kept[numbers[i]], ball.positions[ball.indices[i]]);
}

// The mesh needs the room of the file: of text, some 250 bytes a triangle.
TEST(ReadStl, BytesAreLetGoBeforeTheMeshIsMade) {
  const std::string text = textStl();
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  auto file = std::make_shared<const std::vector<std::byte>>(first, first + text.size());
  const std::weak_ptr<const std::vector<std::byte>> held = file;
  std::vector<bool> gone;
  const ModelOptions options{.progress = [&](double) { gone.push_back(held.expired()); }};
  const ModelSource source("a.stl", options);
  EXPECT_EQ(readStl(source, std::move(file)).triangleCount(), 2u);
  EXPECT_THAT(gone, ElementsAre(true, true));
}

// -0 is 0 and a facet without an area is none, whichever way a file says them.
TEST(ReadStl, PointsThatAreOneAreWeldedWhateverTheirBits) {
  ModelFolder folder;
  std::string text = textStl();
  const std::string zeros = "0.000000 0.000000 0.000000";
  text.replace(text.rfind(zeros), zeros.size(), "-0 0 -0");
  text.insert(text.find("endsolid"),
              "facet\nouter loop\nvertex 0 0 0\nvertex -0 0 0\nvertex 1 0 0\nendloop\nendfacet\n");
  const TriangleMesh mesh = folder.read("a.stl", text).meshes[0];
  expectPromises(mesh);
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(folder.read("b.stl", textStl()).meshes[0]));
  EXPECT_EQ(mesh.positions().size(), 4u);
  EXPECT_EQ(mesh.dropped(), 1u);
}

TEST(ReadStl, BadFilesAreRefused) {
  ModelFolder folder;
  const auto refusal = [&](const std::string& text) { return folder.refusal("a.stl", text); };
  EXPECT_THAT(refusal("nothing"), HasSubstr("it is no STL"));
  EXPECT_THAT(refusal("solid empty\nendsolid\n"), HasSubstr("no facets"));
  EXPECT_THAT(refusal(binaryStl().substr(0, 150)), HasSubstr("2 facets need 184 bytes, and it has 150"));
  std::string lie = binaryStl();
  lie.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_THAT(refusal(lie), HasSubstr("4294967295 facets need 214748364834 bytes, and it has 184"));
  lie = binaryStl();
  lie.replace(84 + 12, 4, std::string("\0\0\xc0\x7f", 4));
  EXPECT_THAT(refusal(lie), HasSubstr("facet 0 has a corner at (nan, 0, 0)"));
  std::string text = textStl();
  text.insert(text.find(" endloop"), "vertex 0 0 0\n");
  EXPECT_THAT(refusal(text), HasSubstr("a.stl:7: a facet of more than three vertices"));
  EXPECT_THAT(refusal(textStl().substr(0, 60)), HasSubstr("a.stl:"));
}

}  // namespace
}  // namespace luxo
