// SPDX-License-Identifier: Apache-2.0
// The tables of engine/CONVENTIONS.md: the courses' formulas, computed as they are written there, against
// luxo's own numbers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/snapshot.h"
#include "surface/library.h"
#include "tessellate/tessellator.h"
#include "unit/scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;

/// A matrix as the lecture writes it: rows, multiplied from the left by a row vector.
struct Rows {
  std::array<std::array<double, 4>, 4> m{};
};
Rows operator*(const Rows& a, const Rows& b) {
  Rows product;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) product.m[i][j] += a.m[i][k] * b.m[k][j];
  return product;
}
Vec4 operator*(const Vec4& row, const Rows& matrix) {
  Vec4 product(0);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t k = 0; k < 4; ++k) product[int(j)] += row[int(k)] * matrix.m[k][j];
  return product;
}

Rows scaling(const Vec3& s) { return {{{{s.x, 0, 0, 0}, {0, s.y, 0, 0}, {0, 0, s.z, 0}, {0, 0, 0, 1}}}}; }
Rows translation(const Vec3& t) { return {{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {t.x, t.y, t.z, 1}}}}; }
Vec3 rodrigues(const Vec3& r, const Vec3& d, double angle) {
  return r * std::cos(angle) + d * glm::dot(r, d) * (1 - std::cos(angle)) +
         glm::cross(d, r) * std::sin(angle);
}
/// The rows are the images of the axes.
Rows rotationRows(const Vec3& d, double angle) {
  Rows rows{{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}}}};
  for (int i = 0; i < 3; ++i) {
    Vec3 axis(0);
    axis[i] = 1;
    const Vec3 image = rodrigues(axis, d, angle);
    for (int j = 0; j < 3; ++j) rows.m[std::size_t(i)][std::size_t(j)] = image[j];
  }
  return rows;
}

const Vec3 kEye(3, 2, 9), kLookAt(0.5, -1, 0.25), kUp(0.1, 1, 0);
const Vec3 kAxis = glm::normalize(Vec3(1, 5, 1));
constexpr PixelSize kConventionSize{96, 64};
constexpr double kFov = 0.9, kNear = 0.25;
const Vec3 kScale(2, 3, 4), kMove(1, 2, 3), kPoint(0.3, -0.2, 0.4);

Camera camera() { return {.eye = kEye, .lookAt = kLookAt, .up = kUp, .fovY = kFov, .near = kNear}; }
View view(PixelSize size = kConventionSize) { return viewAt(camera(), {}, size); }

/// T_View of the lecture.
Rows viewRows() {
  const Vec3 w = glm::normalize(kEye - kLookAt), u = glm::normalize(glm::cross(kUp, w)), v = glm::cross(w, u);
  return translation(-kEye) *
         Rows{{{{u.x, v.x, w.x, 0}, {u.y, v.y, w.y, 0}, {u.z, v.z, w.z, 0}, {0, 0, 0, 1}}}};
}
Rows projectionRows(double far) {
  const double sy = 1 / std::tan(kFov / 2), asp = double(kConventionSize.width) / kConventionSize.height;
  return {{{{sy / asp, 0, 0, 0},
            {0, sy, 0, 0},
            {0, 0, -(kNear + far) / (far - kNear), -1},
            {0, 0, -2 * kNear * far / (far - kNear), 0}}}};
}

/// A child of a turned parent, placed by luxo.
Transform placed() {
  Scene scene;
  const NodeId parent = scene.add(Node{.translation = Vec3(0, 1, 0), .rotation = Rotation{{0, 0, 1}, 0.4}});
  scene.add(Node{.parent = parent,
                 .translation = kMove,
                 .rotation = Rotation{Vec3(1, 5, 1), 0.7},
                 .scale = kScale,
                 .surface = sphere(1)});
  scene.add(camera());
  return takeSnapshot(scene, 0, kConventionSize).nodes.at(0).worldFromObject;
}
Rows placedRows() {
  return scaling(kScale) * rotationRows(kAxis, 0.7) * translation(kMove) * rotationRows({0, 0, 1}, 0.4) *
         translation({0, 1, 0});
}

TEST(Conventions, ModelMatricesAreTheLecturesReadFromTheRight) {
  expectNear(transformPoint(placed(), kPoint), Vec3(Vec4(kPoint, 1) * placedRows()), 1e-12);
  // S = (2, 3, 4), 90 degrees about z, (1, 2, 3): the same point in either.
  const Rows known = scaling({2, 3, 4}) * rotationRows({0, 0, 1}, kPi / 2) * translation({1, 2, 3});
  expectNear(Vec3(Vec4(1, 0, 0, 1) * known), {1, 4, 3}, 1e-12);
}

TEST(Conventions, RotationsAreRodrigues) {
  expectNear(rotation(Vec3(1, 5, 1), 0.7) * kPoint, rodrigues(kPoint, kAxis, 0.7), 1e-14);
}

TEST(Conventions, ViewMatricesHaveTheLecturesColumnsAsRows) {
  expectNear(eyeFromWorldPoint(view(), kPoint), Vec3(Vec4(kPoint, 1) * viewRows()), 1e-12);
}

TEST(Conventions, ClipSpaceIsTheLecturesButForDepth) {
  const Vec4 luxos = view().clipFromEye * Vec4(eyeFromWorldPoint(view(), kPoint), 1);
  const Vec4 lectures = Vec4(kPoint, 1) * viewRows() * projectionRows(1e12);
  EXPECT_NEAR(luxos.x, lectures.x, 1e-12);
  EXPECT_NEAR(luxos.y, lectures.y, 1e-12);
  EXPECT_NEAR(luxos.w, lectures.w, 1e-12);
  EXPECT_NEAR(luxos.z / luxos.w, (1 - lectures.z / lectures.w) / 2, 1e-11);
  EXPECT_NEAR(luxos.z / luxos.w, kNear / luxos.w, 1e-15);
}

TEST(Conventions, TheScreensYPointsDown) {
  const Vec4 lectures = Vec4(kPoint, 1) * viewRows() * projectionRows(100);
  const Vec2 pixel = pixelFromEye(view(), eyeFromWorldPoint(view(), kPoint));
  EXPECT_NEAR(pixel.x, (lectures.x / lectures.w + 1) / 2 * kConventionSize.width, 1e-10);
  EXPECT_NEAR(pixel.y, kConventionSize.height - (lectures.y / lectures.w + 1) / 2 * kConventionSize.height,
              1e-10);
}

TEST(Conventions, NormalsAreTheLecturesByTheInverse) {
  const Vec3 n = glm::normalize(Vec3(1, -2, 0.5));
  // Minv = T_parent^-1 ... S^-1, a row matrix, times the column [N 0].
  const Rows inverse = translation({0, -1, 0}) * rotationRows({0, 0, 1}, -0.4) * translation(-kMove) *
                       rotationRows(kAxis, -0.7) * scaling(1.0 / kScale);
  Vec3 lectures(0);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) lectures[int(i)] += inverse.m[i][k] * n[int(k)];
  expectNear(unit(normalMatrix(placed().linear) * n), unit(lectures), 1e-12);
}

// tiny: ModelView is looked at from the centre; the division by 1 - z / c is a camera c away.
TEST(Conventions, TinyrenderersProjectionIsACamera) {
  const double c = glm::distance(kEye, kLookAt);
  const Vec3 z = glm::normalize(kEye - kLookAt), x = glm::normalize(glm::cross(kUp, z)), y = glm::cross(z, x);
  const Vec3 p(glm::dot(x, kPoint - kLookAt), glm::dot(y, kPoint - kLookAt), glm::dot(z, kPoint - kLookAt));
  const Vec2 tiny = Vec2(p) / (1 - p.z / c);
  Camera square = camera();
  square.fovY = 2 * std::atan(1 / c);
  const View luxos = viewAt(square, {}, {200, 200});
  const Vec4 clip = luxos.clipFromEye * Vec4(eyeFromWorldPoint(luxos, kPoint), 1);
  EXPECT_NEAR(clip.x / clip.w, tiny.x, 1e-12);
  EXPECT_NEAR(clip.y / clip.w, tiny.y, 1e-12);
}

TEST(Conventions, GlslsNormalMatrixPointsTheSameWay) {
  const Mat3 modelView = view().eyeFromWorld * placed().linear;
  const Vec3 n(0.2, 0.9, -0.4);
  expectNear(unit(normalMatrix(modelView) * n), unit(glm::transpose(glm::inverse(modelView)) * n), 1e-12);
}

TEST(Conventions, FrontFacesAreCounterClockwiseFromOutside) {
  const Mesh ball = tessellate(sphere(1), {}, {.tolerance = 0.05});
  for (std::size_t i = 0; i < ball.indices.size(); i += 3) {
    const Vec3 &a = ball.positions[ball.indices[i]], &b = ball.positions[ball.indices[i + 1]],
               &c = ball.positions[ball.indices[i + 2]];
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0);
    EXPECT_LT(glm::dot(glm::cross(c - a, b - a), a + b + c), 0);  // the lecture's
  }
}

}  // namespace
}  // namespace luxo
