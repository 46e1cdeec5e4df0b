// SPDX-License-Identifier: Apache-2.0
// Pictures of materials with maps of normals, highlights and glow: against known answers, and against the
// ground truth in every pixel.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"
#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

constexpr PixelSize kMapsSize{160, 120};
constexpr double kCode = 1.0 / 255;

/// A texture of what is at a place, (0, 0) in the upper left corner of the image.
TextureMap baked(int width, int height, const std::function<Vec3(double, double)>& at) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3 value = at((x + 0.5) / width, (y + 0.5) / height);
      for (std::size_t c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = static_cast<float>(value[static_cast<int>(c)]);
    }
  return {.texture = std::make_shared<const Texture>(makeTexture(image, "baked", Codes::Data))};
}

Vec3 texelOf(const Vec3& vector) { return 0.5 * vector + 0.5; }

/// Dents all over, leaning up to 40 degrees.
TextureMap dents() {
  return baked(64, 64, [](double x, double y) {
    return texelOf(unit(Vec3(0.8 * std::sin(25 * x), 0.8 * std::cos(19 * y), 1)));
  });
}

/// Vectors in all directions.
TextureMap directions() {
  return baked(64, 64, [](double x, double y) {
    const double height = 2 * y - 1, radius = std::sqrt(1 - height * height);
    return texelOf(Vec3(radius * std::cos(kTau * x), height, radius * std::sin(kTau * x)));
  });
}

TextureMap spots(const Vec3& color) {
  return baked(32, 32, [color](double x, double y) {
    return color * (0.5 + 0.5 * std::sin(31 * x) * std::sin(31 * y));
  });
}

Material mapped(NormalSpace space) {
  return {.diffuse = Vec3(0.7, 0.6, 0.5),
          .specular = Vec3(0.8),
          .shininess = 20,
          .normalMap = space == NormalSpace::Tangent ? dents() : directions(),
          .normalSpace = space,
          .specularMap = spots({1, 0.9, 0.6}),
          .glowMap = spots({0.05, 0.1, 0.2})};
}

constexpr std::array kSpaces = {NormalSpace::Tangent, NormalSpace::Object};

TriangleMesh withTangents(const TriangleMesh& mesh) {
  MeshArrays arrays;
  for (const Vec3f& position : mesh.positions()) arrays.positions.emplace_back(position);
  arrays.normals.assign(mesh.normals().begin(), mesh.normals().end());
  arrays.uvs.assign(mesh.uvs().begin(), mesh.uvs().end());
  arrays.indices.assign(mesh.indices().begin(), mesh.indices().end());
  return triangleMesh(std::move(arrays), std::string(mesh.name()) + " with tangents", {.tangents = true});
}

Scene litMap(Surface surface, const Material& material, const Node& place = {}) {
  Scene scene;
  Node node = place;
  node.surface = std::move(surface);
  node.material = scene.add(material);
  scene.add(std::move(node));
  scene.add(Node{.translation = Vec3(3, 5, 4), .light = Light{.intensity = 0.9}});
  scene.add(Node{.translation = Vec3(-3, 2, 4), .light = Light{.intensity = 0.4}});
  return scene;
}

class MapPicture : public VerifiedPictureTest {
 protected:
  /// Of pixels within so much of the middle.
  static void expectSame(const Image& a, const Image& b, double tolerance = kCode, double radius = 1e3) {
    double worst = 0;
    for (int y = 0; y < a.height(); ++y)
      for (int x = 0; x < a.width(); ++x)
        if (std::hypot(x + 0.5 - a.width() / 2.0, y + 0.5 - a.height() / 2.0) < radius) {
          const Vec3 off = glm::abs(colorAt(a, x, y) - colorAt(b, x, y));
          worst = std::max({worst, off.x, off.y, off.z});
        }
    EXPECT_LE(worst, tolerance);
  }
};

TEST_F(MapPicture, OnFormulasEveryPixelIsTheTruths) {
  const std::array<Surface, 7> surfaces = {
      sphere(1),
      torus(0.8, 0.35),
      cylinder(0.8, 1.2),
      rectangle(3, 3),
      cone(1, 0.2, 1.4),
      makeSurface("ellipsoid", {{"radii", {1, 0.7, 1.2}}}),
      surface([](auto u, auto v) { return point(u, 0.2 * sin(3 * u) * cos(2 * v), v); },
              {{-1.2, 1.2}, {-1, 1}})};
  // Of open ones the other side, too.
  const std::pair<Node, double> placesAndHeights[] = {
      {{}, 1.6}, {{.rotation = Rotation{{1, 0.3, 0}, -0.9}, .scale = Vec3(1.2, -0.8, 1)}, -1.4}};
  for (const NormalSpace space : kSpaces)
    for (const Surface& s : surfaces)
      for (const auto& [place, height] : placesAndHeights) {
        SCOPED_TRACE(s.name() + (space == NormalSpace::Object ? " object " : " ") + std::to_string(height));
        expectTrueColors(takeSnapshot(litMap(s, mapped(space), place), 0, kMapsSize,
                                      Camera{.eye = Vec3(2, height, 3), .lookAt = Vec3(0, 0.2, 0)}),
                         1000);
      }
}

TEST_F(MapPicture, OnTrianglesEveryPixelIsTheTruths) {
  for (const NormalSpace space : kSpaces)
    for (const Surface& s :
         {Surface(withTangents(quadMesh())), Surface(withTangents(meshOf(torus(0.7, 0.3), 1e-4)))})
      for (const double x : {1.0, -1.0})
        for (const double eye : {3.2, -3.2}) {
          SCOPED_TRACE(s.name() + (space == NormalSpace::Object ? " object " : " ") +
                       std::to_string(x * eye));
          const Scene scene =
              litMap(s, mapped(space),
                     Node{.rotation = Rotation{{1, 0.3, 0}, -1.1}, .scale = Vec3(1.2 * x, 0.9, 1)});
          expectTrueColors(takeSnapshot(scene, 0, kMapsSize, Camera{.eye = Vec3(1, 0.8, eye)}), 2000);
        }
}

/// Lit later: what is found tells the frames.
TEST_F(MapPicture, WithShadowsEveryPixelIsTheTruths) {
  for (const NormalSpace space : kSpaces) {
    Scene scene;
    const MaterialId bumpy = scene.add(mapped(space)), plain = scene.add(Material{});
    scene.add(Node{.translation = Vec3(0, -1, 0), .surface = rectangle(8, 8), .material = bumpy});
    scene.add(Node{.surface = sphere(0.8), .material = bumpy});
    scene.add(
        Node{.translation = Vec3(1.5, 0, 0), .scale = Vec3(0.5), .surface = icosphere(2), .material = plain});
    scene.add(Node{.translation = Vec3(-1.5, 0, 0),
                   .scale = Vec3(0.6, 0.6, -0.6),
                   .surface = withTangents(quadMesh()),
                   .material = bumpy});
    scene.add(
        Node{.translation = Vec3(2, 4, 3), .light = Light{.intensity = 0.9, .shadow = Light::Shadow::Exact}});
    scene.add(Node{.translation = Vec3(-2, 4, 3), .light = Light{.intensity = 0.3}});
    expectTrueColors(takeSnapshot(scene, 0, kMapsSize, Camera{.eye = Vec3(1, 1.6, 4)}), 10000);
  }
}

// From straight above, a relief shows the same points of (x, y) as its plate, and directions to the eye and
// the light are the same everywhere: a map that says its normals says all.
constexpr double kRelief = 0.05, kMapWaves = 9;

Vec3 reliefNormal(double x, double y) {
  return unit(Vec3(-kRelief * kMapWaves * std::cos(kMapWaves * x) * std::cos(kMapWaves * y),
                   kRelief * kMapWaves * std::sin(kMapWaves * x) * std::sin(kMapWaves * y), 1));
}

Scene fromAbove(Surface surface, const Material& material, const Node& place, bool shadows) {
  Scene scene;
  scene.set(plainSettings());
  Node node = place;
  node.surface = std::move(surface);
  node.material = scene.add(material);
  scene.add(std::move(node));
  scene.add(Node{.rotation = Rotation{{0, 1, 0}, 0.6},
                 .light = Light{.type = Light::Type::Directional,
                                .intensity = 0.8,
                                .shadow = shadows ? Light::Shadow::Exact : Light::Shadow::None,
                                .casters = std::vector<NodeId>{}}});
  return scene;
}

const Camera kAbove{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 2};

TEST_F(MapPicture, ABakedReliefIsTheFormulas) {
  const Surface relief =
      surface([](auto x, auto y) { return point(x, y, kRelief * sin(kMapWaves * x) * cos(kMapWaves * y)); },
              {{-1, 1}, {-1, 1}});
  const Material plain{.diffuse = Vec3(0.6), .specular = Vec3(0.5), .shininess = 20};
  Material bumpy = plain;
  const auto normals = [](double x, double y) { return texelOf(reliefNormal(2 * x - 1, 1 - 2 * y)); };
  bumpy.normalMap = baked(512, 512, normals);
  bumpy.normalMap.wrapU = bumpy.normalMap.wrapV = TextureWrap::Clamp;
  Material down = bumpy;  // the quad's image has its top at y = -1, and that of (0, 1) up is down
  down.normalMap.texture = baked(512, 512, [](double x, double y) {
                             const Vec3 n = reliefNormal(2 * x - 1, 2 * y - 1);
                             return texelOf({n.x, -n.y, n.z});
                           }).texture;
  const Node upright = plate(Vec3(0), {2, 2}, MaterialId{});
  for (const bool shadows : {false, true})
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat}) {
      SCOPED_TRACE(std::string(nameOf(shading)) + (shadows ? " with shadows" : ""));
      const Scene wanted = fromAbove(relief, plain, {}, shadows);
      const Image truth = draw(wanted, kAbove, {96, 96}).image;
      const auto expectTruth = [&](const Scene& scene) {
        expectSame(draw(scene, kAbove, {96, 96}, {.shading = shading}).image, truth, kCode, 46);
      };
      expectTruth(fromAbove(upright.surface, bumpy, upright, shadows));
      expectTruth(fromAbove(withTangents(quadMesh()), down, {}, shadows));
      Material object = bumpy;  // of a plate that lies in the object's x and z, with y up
      object.normalSpace = NormalSpace::Object;
      object.normalMap.texture = baked(512, 512, [](double x, double y) {
                                   const Vec3 n = reliefNormal(2 * x - 1, 1 - 2 * y);
                                   return texelOf({n.x, n.z, -n.y});
                                 }).texture;
      expectTruth(fromAbove(upright.surface, object, upright, shadows));
    }
}

/// A ball of facets, with the map of its formula's normals, is as round as the formula.
TEST_F(MapPicture, TheBakedNormalsOfASphereAreItsFormulas) {
  const Surface ball = sphere(1);
  const Material plain{.diffuse = Vec3(0.6), .specular = Vec3(0.5), .shininess = 20};
  Material bumpy = plain;
  bumpy.normalSpace = NormalSpace::Object;
  const auto [columns, rows] = ball.domain();
  const auto along = [](const Interval& range, double part) { return glm::mix(range.lo, range.hi, part); };
  // A formula's image has its top at the highest v, a mesh's at the lowest.
  const auto normals = [&, columns = columns, rows = rows](bool down) {
    return baked(1024, 512, [&, down](double x, double y) {
      return texelOf(ball.normal(along(columns, x), along(rows, down ? y : 1 - y)));
    });
  };
  bumpy.normalMap = normals(false);
  const Scene wanted = fromAbove(ball, plain, {}, false);
  bumpy.normalMap.wrapV = TextureWrap::Clamp;
  const Image truth = draw(wanted, kAbove, {96, 96}).image;
  constexpr double kInside = 46;  // of 48: beside the outline a pixel sees much of the map
  expectSame(draw(fromAbove(ball, bumpy, {}, false), kAbove, {96, 96}).image, truth, kCode, kInside);
  bumpy.normalMap.texture = normals(true).texture;
  bumpy.normalMap.scale = {1 / columns.width(), 1 / rows.width()};
  bumpy.normalMap.offset = -Vec2(columns.lo, rows.lo) * bumpy.normalMap.scale;
  expectSame(
      draw(fromAbove(meshOf(ball, 1e-5), bumpy, {}, false), kAbove, {96, 96}, {.shading = Shading::Flat})
          .image,
      truth, kCode, kInside);
}

/// Where the image lies mirrored the relief is the mirrored one, on both of MikkTSpace's sides.
TEST_F(MapPicture, MirroredUvsLeanTheOtherWay) {
  const TriangleMesh strip =
      triangleMesh({.positions = {{-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}},
                    .uvs = {{1, 1}, {0, 1}, {1, 1}, {1, 0}, {0, 0}, {1, 0}},
                    .indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}},
                   "strip", {.tangents = true});
  const Vec3 lean = unit(Vec3(0.4, 0.3, 1));
  Material material{.diffuse = Vec3(1), .ambient = Vec3(0), .specular = Vec3(0)};
  material.normalMap = baked(1, 1, [&](double, double) { return texelOf(lean); });
  for (const bool shadows : {false, true}) {
    const Image image = draw(fromAbove(strip, material, {}, shadows), kAbove, {32, 32}).image;
    const Vec3 toLight(std::sin(0.6), 0, std::cos(0.6));
    const double right = 0.8 * glm::dot(lean, toLight),
                 left = 0.8 * glm::dot(Vec3(-lean.x, lean.y, lean.z), toLight);
    EXPECT_TRUE(near(colorAt(image, 24, 10), Vec3(right), 1e-3)) << shadows;
    EXPECT_TRUE(near(colorAt(image, 8, 10), Vec3(left), 1e-3)) << shadows;
  }
}

/// What is below the surface's own horizon stays dark, and what a map turns away does.
TEST_F(MapPicture, ALightBelowTheHorizonAddsNothing) {
  Material material{.diffuse = Vec3(1), .ambient = Vec3(0), .specular = Vec3(1), .shininess = 0};
  material.normalMap = baked(1, 1, [](double, double) { return texelOf(unit(Vec3(1, 0, 0.5))); });
  for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Toon})
    for (const bool isMesh : {false, true})
      for (const Light::Shadow shadow : {Light::Shadow::None, Light::Shadow::Exact})
        for (const double angle : {0.3, -0.6, 1.7}) {
          SCOPED_TRACE(std::string(nameOf(shading)) + (isMesh ? " mesh " : " ") + std::to_string(angle));
          Scene scene;
          scene.set(plainSettings());
          const MaterialId id = scene.add(material);
          if (isMesh)
            scene.add(Node{.surface = withTangents(quadMesh()), .material = id});
          else
            scene.add(plate(Vec3(0), {2, 2}, id));
          scene.add(Node{.rotation = Rotation{{0, 1, 0}, angle},
                         .light = Light{.type = Light::Type::Directional, .shadow = shadow}});
          const double level = draw(scene, kAbove, {32, 32}, {.shading = shading}).image.pixel(14, 16)[0];
          if (angle == 0.3)
            EXPECT_GT(level, 0.6);
          else if (shading == Shading::Toon)
            EXPECT_LE(level, 0.5);
          else
            EXPECT_EQ(level, 0);
        }
}

TEST_F(MapPicture, GlowAndHighlightsAreInEveryShading) {
  for (const Shading shading :
       {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon})
    for (const bool shadows : {false, true}) {
      SCOPED_TRACE(std::string(nameOf(shading)) + (shadows ? " with shadows" : ""));
      const bool drawn = shading == Shading::Toon;
      const Node upright = plate(Vec3(0), {2, 2}, MaterialId{});
      const auto level = [&](const Material& material) {
        return colorAt(draw(fromAbove(upright.surface, material, upright, shadows), kAbove, {32, 32},
                            {.shading = shading})
                           .image,
                       16, 16);
      };
      const auto all = [](const Vec3& value) { return baked(1, 1, [=](double, double) { return value; }); };
      const Material plain{.diffuse = Vec3(0.3), .specular = Vec3(0.25), .shininess = 4};
      const Vec3 before = level(plain);
      Material glows = plain;
      glows.glow = Vec3(0.5);
      glows.glowMap = all({0.25, 0.5, 1});
      EXPECT_TRUE(near(level(glows), before + Vec3(0.125, 0.25, 0.5), 2e-4));
      Material shines = plain, shinesLess = plain;
      shines.specularMap = all({1, 0.5, 0});
      shinesLess.specular = Vec3(0.25, 0.125, 0);
      EXPECT_TRUE(near(level(shines), level(shinesLess), 2e-4));
      if (!drawn) {
        EXPECT_GT(before.z, level(shines).z + 0.01);
      }
    }
}

TEST_F(MapPicture, BetweenVerticesNormalsOfMapsAreUnknown) {
  for (const Surface& s : {sphere(1), Surface(withTangents(meshOf(sphere(1), 1e-2)))})
    for (const bool shadows : {false, true}) {
      const auto drawn = [&](const Material& material) {
        return draw(fromAbove(s, material, {}, shadows), kAbove, {96, 96}, {.shading = Shading::Gouraud})
            .image;
      };
      expectSame(drawn({.normalMap = dents()}), drawn({}), 1e-5);
    }
}

/// A mesh without tangents has no such relief.
TEST_F(MapPicture, WithoutTangentsThereIsNoRelief) {
  for (const bool shadows : {false, true}) {
    const auto drawn = [&](const Material& material) {
      return draw(fromAbove(quadMesh(), material, {}, shadows), kAbove, {32, 32}).image;
    };
    expectSame(drawn({.normalMap = dents()}), drawn({}), 1e-5);
  }
}

}  // namespace
}  // namespace luxo::test
