// SPDX-License-Identifier: Apache-2.0
// The Vulkan picture against the ground truth, which shares nothing with it below the snapshot: coverage,
// depth, normals and light of whole scenes.
#include "reference/reference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "luxo_grandpa/lamp.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scenes/embedded_scenes.h"
#include "scenes/primitives.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kReferenceSize{160, 90};
constexpr double kTolerancePx = 0.1;

Scene embedded(std::string_view name) {
  for (const EmbeddedScene& scene : embeddedScenes())
    if (scene.name == name) return buildScene(parseScene(std::string(scene.text), std::string(name)));
  throw std::runtime_error("no such scene");
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Whether a node is a plane: every triangle of it has the one true normal.
bool flat(const Snapshot& snapshot, std::uint32_t number) {
  return std::ranges::any_of(snapshot.nodes, [&](const SnapshotNode& node) {
    return node.number == number && node.surface.flatNormal().has_value();
  });
}

/// The truth of a snapshot, and which of its pixels lie where.
class Truth {
 public:
  explicit Truth(const Snapshot& snapshot) : snapshot_(snapshot), picture_(castPicture(snapshot)) {}

  [[nodiscard]] const ReferencePicture& operator*() const { return picture_; }
  [[nodiscard]] const ReferencePicture* operator->() const { return &picture_; }

  /// Whether all nine pixels around this one show the same node, or nothing.
  [[nodiscard]] bool sameNodeAround(int x, int y) const {
    return aroundHolds(
        x, y, [&](std::size_t i, std::size_t j) { return picture_.number[i] == picture_.number[j]; });
  }

  /// Whether the nine pixels show one smooth piece of a surface that nowhere grazes the ray: a silhouette, a
  /// crease and an edge are at least a pixel away.
  [[nodiscard]] bool smoothAround(int x, int y) const {
    return sameNodeAround(x, y) && picture_.number[indexOf(x, y)] != 0 &&
           aroundHolds(x, y, [&](std::size_t i, std::size_t j) {
             const Vec3 toViewer = unit(snapshot_.view.eye - picture_.position[j]);
             const double pixel = picture_.depth[i] / snapshot_.view.pixelsPerUnit;  // metres
             // Under a cosine of 0.2 a diagonal neighbour is up to 1.41 / 0.2 = 7 pixels away in space.
             return std::abs(glm::dot(picture_.normal[j], toViewer)) > 0.2 &&
                    glm::dot(picture_.normal[i], picture_.normal[j]) > 0.9 &&
                    glm::distance(picture_.position[i], picture_.position[j]) < 10 * pixel;
           });
  }

  [[nodiscard]] static std::size_t indexOf(int x, int y) {
    return static_cast<std::size_t>(y) * kReferenceSize.width + static_cast<std::size_t>(x);
  }

 private:
  template <class Condition>
  [[nodiscard]] bool aroundHolds(int x, int y, const Condition& condition) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (!condition(indexOf(x, y), indexOf(std::clamp(x + dx, 0, kReferenceSize.width - 1),
                                              std::clamp(y + dy, 0, kReferenceSize.height - 1))))
          return false;
    return true;
  }

  const Snapshot& snapshot_;
  ReferencePicture picture_;
};

class AgainstReference : public PictureTest {
 protected:
  [[nodiscard]] Image drawn(const Snapshot& snapshot, Shading shading, Output output) {
    return renderer()
        .render(snapshot, {.shading = shading, .output = output, .tolerancePx = kTolerancePx})
        .image;
  }

  /// `smallestRadiusPx`: of curvature, of what the curved part of the picture mostly shows.
  void compare(const Scene& scene, Shading shading, double time, double smallestRadiusPx) {
    const Snapshot snapshot = takeSnapshot(scene, time, kReferenceSize);
    const Truth truth(snapshot);
    EXPECT_EQ(truth->undecided, 0U);

    const Image color = drawn(snapshot, shading, Output::Color),
                depth = drawn(snapshot, shading, Output::Depth),
                normal = drawn(snapshot, shading, Output::Normal),
                number = drawn(snapshot, shading, Output::Id);
    std::vector<double> angles, depthErrors;
    double squares = 0;
    for (int y = 0; y < kReferenceSize.height; ++y)
      for (int x = 0; x < kReferenceSize.width; ++x) {
        const std::size_t i = Truth::indexOf(x, y);
        // A mesh within 0.1 px shows another node only where the truth changes within a pixel; so does what
        // is exact.
        if (number.pixel(x, y)[0] != static_cast<float>(truth->number[i])) {
          EXPECT_FALSE(truth.sameNodeAround(x, y))
              << x << ',' << y << " shows node " << number.pixel(x, y)[0] << " for " << truth->number[i];
          continue;
        }
        if (!truth.smoothAround(x, y)) continue;
        const Vec3 n = colorAt(normal, x, y), d = colorAt(color, x, y) - colorAt(truth->color, x, y);
        if (!flat(snapshot, truth->number[i]))
          angles.push_back(std::asin(std::min(glm::length(glm::cross(n, truth->normal[i])), 1.0)) * 180 /
                           kPi);
        EXPECT_GT(glm::dot(n, truth->normal[i]), 0.9) << x << ',' << y;
        depthErrors.push_back(std::abs(depth.pixel(x, y)[0] / truth->depth[i] - 1));
        squares += glm::dot(d, d) / 3;
      }
    ASSERT_GT(depthErrors.size(), 4000U) << "too little of the picture is compared";
    ASSERT_GT(angles.size(), 30U) << "too little of it is curved";
    // Between vertices normals are mixed linearly: across an arc that turns by 2h they are off by up to
    // 0.19 h^3, where a sagitta of 0.1 px leaves h = sqrt(0.2 / R) on a surface of radius R pixels.
    EXPECT_LT(median(angles), 0.19 * std::pow(2 * kTolerancePx / smallestRadiusPx, 1.5) * 180 / kPi);
    // Half of the pixels are on planes or face the eye, where only single precision is left: a few 6e-8.
    EXPECT_LT(median(depthErrors), 1e-5);
    // Measured: 54 dB of the primitives, whose tubes are a few pixels wide, 62 to 92 elsewhere.
    EXPECT_GT(-10 * std::log10(squares / static_cast<double>(depthErrors.size())), 45);
  }
};

TEST_F(AgainstReference, LuxoGrandpa) {
  compare(luxoGrandpa(), Shading::Exact, 21, 2);
  compare(luxoGrandpa(), Shading::Phong, 21, 2);
}

TEST_F(AgainstReference, Primitives) { compare(primitives(), Shading::Phong, 0, 2); }

TEST_F(AgainstReference, Teapot) {
  compare(embedded("teapot"), Shading::Exact, 0, 5);
  compare(embedded("teapot"), Shading::Phong, 0, 5);
}

TEST_F(AgainstReference, Showcase) {
  compare(embedded("showcase"), Shading::Exact, 0, 4);
  compare(embedded("showcase"), Shading::Phong, 0, 4);
}

}  // namespace
}  // namespace luxo::test
