// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "math/transform.h"
#include "mesh/turn.h"
#include "unit/mesh_model_support.h"

namespace luxo {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using Json = nlohmann::json;

std::string bytesOf(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), 4 * values.size()};
}
std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}
std::string dataOf(const std::string& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

// A square of two triangles: four points at 0, six 16-bit indices at 48, times and values at 60.
const std::vector<float> kPoints = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<float> kMoves = {0, 2, /**/ 0, 0, 0, 4, 6, 8};
std::string buffer() {
  return bytesOf(kPoints) + std::string("\0\0\1\0\2\0\0\0\2\0\3\0", 12) + bytesOf(kMoves);
}

Json square() {
  return Json::parse(R"({
    "asset": {"version": "2.0"},
    "buffers": [{"byteLength": 92}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                    {"buffer": 0, "byteOffset": 60, "byteLength": 32}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                  {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                  {"bufferView": 2, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "meshes": [{"name": "square", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "nodes": [{"name": "leaf", "mesh": 0, "translation": [1, 2, 3]}, {"name": "root", "children": [0]}],
    "scenes": [{"nodes": [1]}], "scene": 0
  })");
}
Json embedded(Json json) {
  json["buffers"][0]["uri"] = dataOf(buffer());
  return json;
}
std::string glb(std::string text, std::string binary) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4);
  const auto word = [](std::size_t value) {
    const auto raw = std::bit_cast<std::array<char, 4>>(std::uint32_t(value));
    return std::string(raw.data(), 4);
  };
  return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + binary.size()) + word(text.size()) + "JSON" +
         text + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

class ReadGltf : public testing::Test {
 protected:
  Model read(const Json& json) { return folder_.read("a.gltf", embedded(json).dump(1)); }
  std::string refusal(const Json& json) { return folder_.refusal("a.gltf", embedded(json).dump(1)); }

  ModelFolder folder_;
};

TEST_F(ReadGltf, BuffersMayBeEmbeddedBesideOrWithin) {
  const Model data = read(square());
  ASSERT_EQ(data.meshes.size(), 1u);
  expectPromises(data.meshes[0]);
  EXPECT_EQ(data.triangleCount(), 2u);
  EXPECT_EQ(data.meshes[0].bounds(), (Box{Vec3(0), Vec3(1, 1, 0)}));
  EXPECT_EQ(data.meshes[0].name(), "square");
  EXPECT_EQ(data.meshes[0].normals()[0], Vec3f(0, 0, 1));

  Json beside = square();
  beside["buffers"][0]["uri"] = "the%20data.bin";
  folder_.write("the data.bin", buffer());
  EXPECT_EQ(trianglesOf(folder_.read("b.gltf", beside.dump()).meshes[0]), trianglesOf(data.meshes[0]));
  EXPECT_EQ(trianglesOf(folder_.read("c.glb", glb(square().dump(), buffer())).meshes[0]),
            trianglesOf(data.meshes[0]));
}

TEST_F(ReadGltf, NodesHangOnEachOtherParentsFirst) {
  Json json = square();
  json["nodes"].push_back({{"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1}}, {"mesh", 0}});
  json["scenes"][0]["nodes"] = {1, 2};
  const Model model = read(json);
  ASSERT_EQ(model.nodes.size(), 3u);
  EXPECT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.nodes[0].name, "root");
  EXPECT_EQ(model.nodes[0].parent, kNone);
  EXPECT_EQ(model.nodes[1].name, "leaf");
  EXPECT_EQ(model.nodes[1].parent, 0u);
  EXPECT_EQ(model.nodes[1].translationAt(0), Vec3(1, 2, 3));
  // A quarter turn about z and a scale of 2: x goes to 2y.
  EXPECT_LT(
      glm::distance(transformPoint(model.nodes[2].parentFromNodeAt(0), {1, 2, 3}), Vec3(5 - 4, 6 + 2, 7 + 6)),
      1e-14);
}

TEST_F(ReadGltf, MatricesThatShearMirrorOrFlattenStandAsTheySay) {
  for (const Mat3& linear : {Mat3(1, 0, 0, 1, 1, 0, 0, 0, 1), Mat3(1, 2, 3, -4, 5, 6, 7, 8, -9),
                             Mat3(1, 0, 0, 0.5, 1, 0, 0, 0, -2), Mat3(1, 1, 0, 1, 0, 0, 0, 0, 0),
                             Mat3(1, 2, 3, 2, 4, 6, 1, 2, 3), Mat3(0)}) {
    Json json = square();
    json["nodes"].push_back({{"name", "sheared"}, {"mesh", 0}, {"children", {3}}});
    json["nodes"].push_back({{"name", "below"}, {"translation", {0, 0, 1}}});
    for (int i = 0; i < 16; ++i)
      json["nodes"][2]["matrix"].push_back(i % 4 == 3 ? i / 15 : i >= 12 ? i : linear[i / 4][i % 4]);
    json["scenes"][0]["nodes"] = {2};
    const Model model = read(json);
    ASSERT_EQ(model.nodes.size(), 3u);
    EXPECT_EQ(model.nodes[1].name, "sheared");
    EXPECT_EQ(model.nodes[1].mesh, 0u);
    const Transform worldFromSheared = worldFromNodeAt(model, 1), worldFromBelow = worldFromNodeAt(model, 2);
    for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(worldFromSheared.linear[i], linear[i]), 2e-13) << i;
    EXPECT_EQ(worldFromSheared.translation, Vec3(12, 13, 14));
    EXPECT_LT(glm::distance(worldFromBelow.translation, Vec3(12, 13, 14) + linear[2]), 2e-13);
  }
}

TEST(SingularValues, OfRandomMapsTurnAndScaleAreTheMap) {
  std::mt19937_64 random(20);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 10'000; ++k) {
    Mat3 linear;
    for (int i = 0; i < 9; ++i) linear[i / 3][i % 3] = normal(random) * std::exp(4 * normal(random));
    const SingularValues values = singularValues(linear);
    const Mat3 made = compose(Vec3(0), rotationOf(values.turn.rotation), values.turn.scale).linear *
                      rotationOf(values.first);
    double largest = 0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(linear[i / 3][i % 3]));
    for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(made[i], linear[i]), 1e-14 * largest) << k;
  }
}

TEST_F(ReadGltf, AnimationsAreSampledAtTheirKeys) {
  Json json = square();
  json["animations"] =
      Json::parse(R"([{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                                        "samplers": [{"input": 2, "output": 3}]}])");
  const Model model = read(json);
  const ModelNode& leaf = model.nodes[1];
  EXPECT_TRUE(leaf.moves());
  EXPECT_EQ(model.duration, 2);
  EXPECT_EQ(leaf.translationAt(0), Vec3(0));
  EXPECT_EQ(leaf.translationAt(0.5), Vec3(1, 1.5, 2));
  EXPECT_EQ(leaf.translationAt(2), Vec3(4, 6, 8));
}

TEST_F(ReadGltf, CamerasAndLightsStandAtTheirNodes) {
  Json json = square();
  json["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.25}},
                                    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 3, "znear": 0, "zfar": 9}}])");
  json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(
      R"([{"type": "point", "color": [1, 0.5, 0], "intensity": 40}, {"type": "directional"},
          {"type": "spot", "intensity": 7, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}, {"type": "spot", "spot": {}}])");
  json["nodes"][0]["camera"] = 1;
  json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const Model model = read(json);
  EXPECT_EQ(model.nodes[1].camera, 1u);
  EXPECT_EQ(model.nodes[0].light, 0u);
  EXPECT_EQ(model.cameras[0].fovY, 0.7);
  EXPECT_EQ(model.cameras[0].near, 0.25);
  EXPECT_FALSE(model.cameras[1].perspective);
  EXPECT_EQ(model.cameras[1].height, 6);
  EXPECT_EQ(model.lights[0].color, Vec3(1, 0.5, 0));
  EXPECT_EQ(model.lights[0].intensity, 40);
  EXPECT_TRUE(model.lights[1].directional);
  EXPECT_FALSE(model.lights[0].spot || model.lights[1].spot);
  EXPECT_FALSE(model.lights[2].directional);
  EXPECT_EQ(model.lights[2].intensity, 7);
  EXPECT_EQ(model.lights[2].spot.value().inner, 0.25);
  EXPECT_EQ(model.lights[2].spot.value().outer, 0.5);
  EXPECT_EQ(model.lights[3].spot.value().inner, 0);
  EXPECT_NEAR(model.lights[3].spot.value().outer, kPi / 4, 1e-15);
  EXPECT_TRUE(model.warnings.empty());
}

TEST_F(ReadGltf, ConesOfSpots) {
  const auto readSpot = [this](const std::string& spot) {
    Json json = square();
    json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::parse(R"([{"type": "spot", "spot": )" + spot + "}]");
    return read(json);
  };
  // A quarter turn as a float has it; and a border that has no width, which some programs write.
  EXPECT_EQ(readSpot(R"({"outerConeAngle": 1.5707963705062866})").lights[0].spot.value().outer, kPi / 2);
  const Model sharp = readSpot(R"({"innerConeAngle": 0.5, "outerConeAngle": 0.5})");
  EXPECT_NEAR(sharp.lights[0].spot.value().inner, 0.4995, 1e-12);
  EXPECT_EQ(sharp.lights[0].spot.value().outer, 0.5);
  EXPECT_THAT(sharp.warnings,
              ElementsAre(HasSubstr("lights[0].spot: its inner cone is as wide as its outer one")));
  for (const auto& [spot, place] :
       {std::pair(R"({"innerConeAngle": 0.6, "outerConeAngle": 0.5})", "innerConeAngle"),
        {R"({"innerConeAngle": -0.1})", "innerConeAngle"},
        {R"({"innerConeAngle": "wide"})", "innerConeAngle"},
        {R"({"outerConeAngle": 0})", "outerConeAngle"},
        {R"({"outerConeAngle": 1.6})", "outerConeAngle"},
        {R"({"outerConeAngle": -1})", "outerConeAngle"}})
    try {
      static_cast<void>(readSpot(spot));
      ADD_FAILURE() << "taken: " << spot;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(place)) << spot;
    }
}

TEST_F(ReadGltf, RangesOfLightsAreToldThatAreNotRead) {
  Json json = square();
  json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(
      R"([{"type": "directional", "range": 5}, {"type": "point"}, {"type": "point", "range": 5}, {"type": "point", "range": 2}])");
  const Model model = read(json);
  EXPECT_EQ(model.lights.size(), 4u);
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("lights[2]: ranges of lights are not read")));
}

/// Nothing is below a cutoff of 0, and everything below one above 1.
TEST_F(ReadGltf, CutoffsBesideOneToZeroAreAllOrNothing) {
  Json json = square();
  json["materials"] = Json::parse(R"([
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, 0.5]}, "alphaMode": "MASK", "alphaCutoff": 0},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "MASK", "alphaCutoff": 1.5},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "MASK", "alphaCutoff": 0.25}])");
  json["textures"] = Json::parse(R"([{"source": 0}])");
  json["images"] = {{{"uri", "data:image/png;base64,aGVsbG8="}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  const Model model = read(json);
  EXPECT_FALSE(model.materials[0].opacityFromMap);
  EXPECT_EQ(model.materials[0].opacity, 1);
  EXPECT_FALSE(model.materials[1].opacityFromMap);
  EXPECT_EQ(model.materials[1].opacity, 0);
  EXPECT_TRUE(model.materials[2].opacityFromMap);
  EXPECT_EQ(model.materials[2].cutoff, 0.25);
}

TEST_F(ReadGltf, MaterialsAreBlinnsOfTheSameLobe) {
  Json json = square();
  json["materials"] = Json::parse(R"([
    {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 0, "roughnessFactor": 0.5},
     "alphaMode": "BLEND", "doubleSided": true},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 1, "roughnessFactor": 1}},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
       {"offset": [0, 1], "rotation": 1.5707963267948966, "scale": [0.5, 0.5]}}}, "roughnessFactor": 0},
     "normalTexture": {"index": 1, "scale": 0.5}, "alphaMode": "MASK"}])");
  json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}, {"source": 1}])");
  json["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])");
  json["images"] = {{{"uri", "data:image/png;base64,aGVsbG8="}}, {{"uri", "gone.png"}}};
  json["meshes"][0]["primitives"][0]["material"] = 2;
  const Model model = read(json);
  const ModelMaterial &plastic = model.materials[0], &metal = model.materials[1],
                      &mapped = model.materials[2];
  EXPECT_EQ(plastic.diffuse, Vec3(0.5, 0.25, 1));
  EXPECT_NEAR(plastic.shininess, 2 / std::pow(0.5, 4) - 2, 1e-12);  // 30
  EXPECT_LT(glm::distance(plastic.specular, Vec3(0.04 * 32 / 8)), 1e-15);
  EXPECT_FALSE(plastic.ambient);  // as the diffuse one
  EXPECT_EQ(plastic.opacity, 0.75);
  EXPECT_TRUE(plastic.twoSided);
  EXPECT_EQ(metal.diffuse, Vec3(0));
  EXPECT_EQ(metal.ambient, Vec3(0.5, 0.25, 1));
  EXPECT_EQ(metal.shininess, 0);
  EXPECT_EQ(metal.opacity, 1);  // opaque, whatever its alpha
  EXPECT_EQ(mapped.shininess, 1000);
  EXPECT_EQ(mapped.cutoff, 0.5);
  EXPECT_TRUE(mapped.opacityFromMap);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].bytes->size(), 5u);
  EXPECT_EQ(mapped.map.wrapU, ModelMap::Wrap::Clamp);
  EXPECT_EQ(mapped.map.wrapV, ModelMap::Wrap::Mirror);
  EXPECT_TRUE(mapped.map.nearest);
  EXPECT_FALSE(mapped.normalMap.given());
  // Its colour, the ambient one too, is the map's.
  EXPECT_EQ(mapped.diffuse, Vec3(1));
  EXPECT_FALSE(mapped.ambient);
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("materials[2]: a metal whose colour is a map"),
                                          HasSubstr("there is no image"), HasSubstr("it has no TEXCOORD_0")));
  // The extension's own example: the lower left quarter of the image, turned.
  const auto turned = [&](double u, double v) {
    const Vec2 s(u * mapped.map.scale.x, v * mapped.map.scale.y);
    const double c = std::cos(mapped.map.angle), n = std::sin(mapped.map.angle);
    return Vec2(c * s.x - n * s.y, n * s.x + c * s.y) + mapped.map.offset;
  };
  EXPECT_LT(glm::distance(turned(0, 0), Vec2(0, 1)), 1e-15);
  EXPECT_LT(glm::distance(turned(1, 1), Vec2(0.5, 0.5)), 1e-15);
}

TEST_F(ReadGltf, AMapOfMetalAndRoughnessIsToldOnceAMaterial) {
  Json json = square();
  json["materials"].push_back({{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}});
  const Model model = read(json);
  EXPECT_EQ(model.materials.at(0).diffuse, Vec3(1));  // no metal, though a map may say where it is one
  EXPECT_THAT(model.warnings,
              ElementsAre(HasSubstr("materials[0]: its metallic and roughness map is not read")));
}

TEST_F(ReadGltf, StripsFansAndUnindexedTrianglesAreTheSame) {
  Json json = square();
  json["accessors"][1]["count"] = 3;
  Json primitive = json["meshes"][0]["primitives"][0];
  json["meshes"][0]["primitives"][0].erase("indices");
  json["meshes"][0]["primitives"][0]["mode"] = 6;
  EXPECT_EQ(trianglesOf(read(json).meshes[0]), trianglesOf(read(square()).meshes[0]));
  json["meshes"][0]["primitives"][0]["mode"] = 5;
  EXPECT_EQ(read(json).triangleCount(), 2u);
  primitive["mode"] = 1;
  json["meshes"][0]["primitives"].push_back(primitive);
  EXPECT_THAT(read(json).warnings, ElementsAre(HasSubstr("points and lines are not drawn")));
}

TEST_F(ReadGltf, BadFilesAreRefused) {
  const auto with = [&](const char* pointer, const Json& value) {
    Json json = square();
    json[Json::json_pointer(pointer)] = value;
    return refusal(json);
  };
  EXPECT_THAT(folder_.refusal("a.gltf", "{\n\"asset\": }"), HasSubstr("a.gltf:2: it is no JSON at byte"));
  EXPECT_THAT(folder_.refusal("a.gltf", "[1]"), HasSubstr("its JSON is no object"));
  EXPECT_THAT(with("/asset/version", "1.0"), HasSubstr("version '1.0' of glTF is not supported"));
  EXPECT_THAT(with("/asset/minVersion", "2.1"), HasSubstr("it needs version '2.1' of glTF"));
  EXPECT_EQ(with("/asset/minVersion", "2.0"), "");
  EXPECT_THAT(with("/materials", {{{"alphaMode", "FOO"}}}),
              HasSubstr("materials[0].alphaMode: it is none of OPAQUE, MASK and BLEND"));
  EXPECT_THAT(with("/extensionsRequired", {"KHR_draco_mesh_compression"}),
              HasSubstr("which is not supported"));
  EXPECT_THAT(with("/nodes/0/children", {1}), HasSubstr("its own ancestor"));
  EXPECT_THAT(with("/nodes/1/children", {0, 0}), HasSubstr("hangs on node 1 already"));
  EXPECT_THAT(with("/nodes/1/children", {7}),
              HasSubstr("nodes[1].children[0]: 7 is not a whole number from 0 to 1"));
  EXPECT_THAT(with("/nodes/0/skin", 0), HasSubstr("skins are not supported"));
  EXPECT_THAT(with("/nodes/0/rotation", {0, 0, 0, 2}), HasSubstr("its length is 2, not 1"));
  EXPECT_THAT(with("/meshes/0/primitives/0/targets", Json::array({Json::object()})),
              HasSubstr("morph targets are not supported"));
  EXPECT_THAT(with("/meshes/0/primitives", Json::array()), HasSubstr("it has no triangles"));
  EXPECT_THAT(with("/buffers/0/byteLength", 4'000'000'000),
              HasSubstr("it promises 4000000000 bytes, and has 92"));
  EXPECT_THAT(with("/bufferViews/0/byteLength", 93),
              HasSubstr("bufferViews[0]: bytes 0 to 93 of a buffer of 92"));
  EXPECT_THAT(with("/accessors/0/count", 5), HasSubstr("5 elements of 12 bytes do not fit the 48"));
  EXPECT_THAT(with("/accessors/0/count", 2'000'000'000), HasSubstr("do not fit"));
  EXPECT_THAT(with("/accessors/0/byteOffset", 1), HasSubstr("do not fit"));
  EXPECT_THAT(with("/accessors/0/type", "VEC2"), HasSubstr("3 numbers are wanted"));
  EXPECT_THAT(with("/accessors/0/sparse", {{"count", 5}}), HasSubstr("5 is not a whole number from 0 to 4"));
  EXPECT_THAT(with("/accessors/1/byteOffset", -2), HasSubstr("-2 is not a whole number"));
  EXPECT_THAT(with("/accessors/0/count", 3), HasSubstr("there is vertex 3 of 3"));
  EXPECT_THAT(with("/bufferViews/0/byteStride", 4), HasSubstr("4 bytes between elements of 12"));
  Json outside = square();
  outside["buffers"][0]["uri"] = "../../etc/passwd";
  EXPECT_THAT(folder_.refusal("b.gltf", outside.dump()), HasSubstr("outside of the model's folder"));
  Json nan = square();
  std::string bytes = buffer();
  bytes.replace(0, 4, std::string("\0\0\xc0\x7f", 4));
  nan["buffers"][0]["uri"] = dataOf(bytes);
  EXPECT_THAT(folder_.refusal("b.gltf", nan.dump()), HasSubstr("accessors[0]: number 0 of element 0 is nan"));
}

// The last point is moved, and of indices that are 0 where nothing says more, the middle four are given.
TEST_F(ReadGltf, SparseAccessorsReplaceSomeElements) {
  const std::string points = bytesOf({1, 3, 0}), places = std::string("\3\0\0\0", 4);
  const std::string numbers = std::string("\1\2\3\4", 4), corners = std::string("\1\0\2\0\2\0\3\0", 8);
  Json json = square();
  json["buffers"].push_back({{"uri", dataOf(points + places + numbers + corners)}, {"byteLength", 28}});
  const auto view = [&](int offset, int length) {
    json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", offset}, {"byteLength", length}});
    return json["bufferViews"].size() - 1;
  };
  json["accessors"][0]["sparse"] = {{"count", 1},
                                    {"indices", {{"bufferView", view(12, 4)}, {"componentType", 5125}}},
                                    {"values", {{"bufferView", view(0, 12)}}}};
  json["accessors"][1].erase("bufferView");
  json["accessors"][1]["sparse"] = {{"count", 4},
                                    {"indices", {{"bufferView", view(16, 4)}, {"componentType", 5121}}},
                                    {"values", {{"bufferView", view(20, 8)}}}};
  const TriangleMesh mesh = read(json).meshes.at(0);  // 0 1 2, 2 3 0
  EXPECT_EQ(mesh.triangleCount(), 2u);
  EXPECT_EQ(mesh.bounds(), (Box{Vec3(0), Vec3(1, 3, 0)}));
  Json wrong = json;
  wrong["accessors"][0]["sparse"]["indices"]["componentType"] = 5123;
  wrong["accessors"][0]["sparse"]["indices"]["byteOffset"] = 2;
  EXPECT_EQ(read(wrong).meshes.at(0).bounds().max.y, 3);  // element 0
  wrong = json;
  wrong["accessors"][0]["sparse"]["indices"]["bufferView"] = 5;  // 1, 2, 3, 4
  EXPECT_THAT(refusal(wrong), HasSubstr("accessors[0].sparse.indices: there is element 67305985 of 4"));
  for (const char* order : {"\1\2\2\3", "\1\3\2\4"}) {
    Json unsorted = json;
    unsorted["accessors"][1]["sparse"]["indices"]["bufferView"] = json["bufferViews"].size();
    unsorted["buffers"].push_back({{"uri", dataOf(std::string(order, 4))}, {"byteLength", 4}});
    unsorted["bufferViews"].push_back({{"buffer", 2}, {"byteLength", 4}});
    EXPECT_THAT(refusal(unsorted), HasSubstr("accessors[1].sparse.indices: element 2 does not come after"));
  }
  wrong["accessors"][0]["sparse"]["indices"]["componentType"] = 5120;
  EXPECT_THAT(refusal(wrong), HasSubstr("indices are unsigned"));
  wrong = json;
  wrong["accessors"][0]["sparse"]["values"]["bufferView"] = 3;
  EXPECT_THAT(refusal(wrong),
              HasSubstr("accessors[0].sparse.values: 1 elements of 12 bytes do not fit the 4"));
}

// Of two pairs of uvs the maps' own.
TEST_F(ReadGltf, MapsUseTheUvsThatTheySay) {
  Json json = square();
  json["images"] = {{{"uri", "a.png"}}};
  json["textures"] = {{{"source", 0}}};
  json["materials"] =
      Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}},
                                       "normalTexture": {"index": 0},
                                       "emissiveTexture": {"index": 0, "texCoord": 0, "extensions":
                                                           {"KHR_texture_transform": {"texCoord": 1}}}}])");
  json["accessors"].push_back(
      {{"bufferView", 0}, {"byteOffset", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  json["accessors"].push_back(
      {{"bufferView", 0}, {"byteOffset", 16}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["attributes"]["TEXCOORD_0"] = 4;
  primitive["attributes"]["TEXCOORD_1"] = 5;
  folder_.write("a.png", "");
  const Model model = read(json);
  const TriangleMesh& mesh = model.meshes.at(0);
  ASSERT_EQ(mesh.uvs().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3f& at = mesh.positions()[i];
    const std::size_t given = at.x == 0 ? (at.y == 0 ? 0 : 3) : (at.y == 0 ? 1 : 2);
    EXPECT_EQ(mesh.uvs()[i], Vec2f(kPoints[4 + 2 * given], kPoints[5 + 2 * given])) << i;
  }
  EXPECT_TRUE(model.materials[0].map.given() && model.materials[0].glowMap.given());
  EXPECT_FALSE(model.materials[0].normalMap.given());
  EXPECT_THAT(model.warnings, Contains(HasSubstr("it uses uvs 0, other maps of the material 1")));
}

TEST_F(ReadGltf, AGlbCutShortIsRefused) {
  const std::string whole = glb(square().dump(), buffer());
  for (std::size_t length = 0; length < whole.size(); length += 5)
    EXPECT_NE(folder_.refusal("a.glb", whole.substr(0, length)), "") << length;
  std::string lie = whole;
  lie.replace(12, 4, "\xff\xff\xff\xff");
  EXPECT_THAT(folder_.refusal("a.glb", lie), HasSubstr("a chunk of 4294967295 bytes"));
}

TEST_F(ReadGltf, WhatIsReadOverAndOverIsRefused) {
  Json json = square();
  for (int i = 0; i < 3000; ++i) {
    json["accessors"].push_back(json["accessors"][0]);
    json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 4 + i}}}, {"indices", 1}});
  }
  EXPECT_EQ(read(json).triangleCount(), 6002u);  // that much JSON says as much
  json["buffers"][0]["byteLength"] = 60000;
  json["bufferViews"][0]["byteLength"] = 60000;
  for (auto& accessor : json["accessors"])
    if (accessor["type"] == "VEC3" && accessor["bufferView"] == 0) accessor["count"] = 5000;
  json["buffers"][0]["uri"] = dataOf(buffer() + std::string(60000, '\0'));
  EXPECT_THAT(folder_.refusal("a.gltf", json.dump()), HasSubstr("cannot be meant"));
}

/// Copies of what views see of a buffer: each view's once, and no more than there is.
TEST_F(ReadGltf, WhatIsCopiedOverAndOverIsRefused) {
  Json json = square();
  Json &views = json["bufferViews"], &formulas = json["extensions"]["LUXO_parametric_surface"];
  formulas["scene"] = "scene";
  const auto name = [&](std::size_t view) {
    formulas["files"].push_back(
        {{"name", std::to_string(formulas["files"].size()) + ".png"}, {"bufferView", view}});
  };
  for (int i = 0; i < 100; ++i) name(0);
  Model model = read(json);
  EXPECT_EQ(model.sceneFiles.size(), 100U);
  EXPECT_EQ(model.sceneFiles.at("0.png"), model.sceneFiles.at("99.png"));
  EXPECT_EQ(std::memcmp(model.sceneFiles.at("7.png")->data(), kPoints.data(), 48), 0);

  // As many bytes as the file has, twenty times.
  json["buffers"][0]["byteLength"] = 60000;
  json["buffers"][0]["uri"] = dataOf(buffer() + std::string(60000, '\0'));
  const std::size_t first = views.size();
  for (std::size_t i = 0; i < 20; ++i) views.push_back({{"buffer", 0}, {"byteLength", 60000}});
  for (std::size_t i = 0; i < 20; ++i) name(first + i);
  EXPECT_THAT(folder_.refusal("a.gltf", json.dump()), HasSubstr("cannot be meant"));
  formulas["files"] = Json::array();
  EXPECT_EQ(folder_.refusal("a.gltf", json.dump()), "");
  for (std::size_t i = 0; i < 20; ++i) {
    json["images"].push_back({{"mimeType", "image/png"}, {"bufferView", first + i}});
    json["textures"].push_back({{"source", i}});
    json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
  }
  EXPECT_THAT(folder_.refusal("a.gltf", json.dump()), HasSubstr("cannot be meant"));

  formulas["files"] = Json::parse(R"([{"name": "a", "bufferView": 99}])");
  json.erase("materials");
  EXPECT_THAT(folder_.refusal("a.gltf", json.dump()), HasSubstr("bufferViews: there is no element 99"));
}

// Accessors without bytes are zeros.
TEST_F(ReadGltf, MeshesWithoutAreaAreLeftOutUnlessNothingIsLeft) {
  Json json = square();
  json["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 4}}}, {"indices", 1}}}}});
  json["meshes"].push_back({{"primitives", Json::array()}});
  json["nodes"][0]["mesh"] = 1;
  json["nodes"][1]["mesh"] = 0;
  json["nodes"].push_back({{"mesh", 2}});
  json["scenes"][0]["nodes"] = {1, 2};
  const Model model = read(json);
  EXPECT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.nodes.size(), 3u);
  EXPECT_EQ(model.nodes[1].mesh, kNone);
  EXPECT_THAT(model.warnings,
              ElementsAre(HasSubstr("a.gltf: meshes[1]: it has no triangle with an area and is left out"),
                          HasSubstr("a.gltf: meshes[2]: it has no triangle with an area and is left out")));
  json["nodes"][1]["mesh"] = 1;
  EXPECT_THAT(refusal(json), HasSubstr("a.gltf: it has no triangles with an area"));
}

TEST_F(ReadGltf, UvsThatMapsNeedAndColoursOfVerticesAreMissed) {
  Json json = square();
  json["images"] = {{{"uri", "a.png"}}};
  json["textures"] = {{{"source", 0}}};
  json["materials"] = Json::parse(R"([
    {"name": "plain"}, {"name": "bent", "normalTexture": {"index": 0, "texCoord": 1}},
    {"name": "mapped", "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}])");
  json["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  const Json primitive = json["meshes"][0]["primitives"][0];
  const auto with = [&](int material, const std::vector<const char*>& attributes) {
    Json& made = json["meshes"][0]["primitives"].emplace_back(primitive);
    made["material"] = material;
    for (const char* attribute : attributes) made["attributes"][attribute] = 4;
  };
  folder_.write("a.png", "");
  json["meshes"][0]["primitives"] = Json::array();
  with(0, {"COLOR_0"});
  EXPECT_THAT(read(json).warnings,
              ElementsAre(HasSubstr("meshes[0].primitives[0]: colours of vertices are not read")));
  EXPECT_TRUE(read(json).meshes[0].tangents().empty());  // its material has no map of normals
  json["meshes"][0]["primitives"] = Json::array();
  with(1, {"TEXCOORD_1"});
  with(2, {"TEXCOORD_0"});
  EXPECT_THAT(read(json).warnings, Not(Contains(HasSubstr("TEXCOORD"))));
  EXPECT_FALSE(read(json).meshes[0].tangents().empty());
  json["meshes"][0]["primitives"] = Json::array();
  with(1, {"TEXCOORD_0"});
  with(2, {});
  EXPECT_THAT(
      read(json).warnings,
      IsSupersetOf(
          {HasSubstr("primitives[0]: it has no TEXCOORD_1, which the maps of its material 'bent' need"),
           HasSubstr("primitives[1]: it has no TEXCOORD_0, which the maps of its material 'mapped' need")}));
}

TEST_F(ReadGltf, ImagesAreNamedByTheirPlace) {
  Json json = square();
  json["images"] =
      Json::parse(R"([{"uri": "https://a.org/b.png"}, {"uri": "data:image/png;base64,aGVsbG8="}])");
  json["textures"] = Json::parse(R"([{"source": 1}, {"source": 0}, {"source": 0}])");
  json["materials"] = Json::parse(
      R"([{"normalTexture": {"index": 0}, "emissiveTexture": {"index": 1}, "occlusionTexture": {"index": 2}}])");
  const Model model = read(json);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_THAT(model.images[0].place, EndsWith("a.gltf: images[1]"));
  EXPECT_THAT(model.warnings,
              Contains(HasSubstr("a.gltf: images[0]: there is no image 'https://a.org/b.png'")));
}

}  // namespace
}  // namespace luxo
