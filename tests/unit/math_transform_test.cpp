// SPDX-License-Identifier: Apache-2.0
#include "math/transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "math/animated.h"

namespace luxo {
namespace {

using Real = long double;
constexpr double kUlp = 0x1p-52;
const Real kTauReal = 2 * std::acos(Real(-1));

class RandomTransforms {
 public:
  explicit RandomTransforms(std::uint64_t seed) : engine_(seed) {}
  double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  Vec3 vector(double size = 1) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Mat3 matrix(double size = 1) { return {vector(size), vector(size), vector(size)}; }
  Mat3 turn() { return rotation(vector(), between(-10, 10)); }

 private:
  std::mt19937_64 engine_;
};

double distance(const Mat3& a, const Mat3& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a[i][j] - b[i][j]));
  return largest;
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << "(" << a.x << ", " << a.y << ", " << a.z << ") versus (" << b.x << ", " << b.y << ", " << b.z << ")";
}

TEST(Unit, LengthsFromTheSmallestToTheLargest) {
  RandomTransforms random(1);
  for (int exponent = -300; exponent <= 300; exponent += 10)
    for (int i = 0; i < 20; ++i) {
      const Vec3 direction = random.vector() + Vec3(0.1, 0, 0);
      const Vec3 n = unit(direction * std::pow(10.0, exponent));
      const Real length = std::sqrt(Real(n.x) * n.x + Real(n.y) * n.y + Real(n.z) * n.z);
      EXPECT_NEAR(double(length), 1, 4 * kUlp) << "1e" << exponent;
      expectNear(n, direction / glm::length(direction), 8 * kUlp);
    }
  EXPECT_EQ(unit(Vec3(0)), Vec3(0));
  EXPECT_EQ(unit(Vec3(0, -1e-300, 0)), Vec3(0, -1, 0));
  EXPECT_EQ(unit(Vec3(3, 0, 4)), Vec3(0.6, 0, 0.8));
}

TEST(Rotation, KnownAnswers) {
  // Right-handed: about +Y, +Z goes to +X; about +Z, +X goes to +Y; about +X, +Y goes to +Z.
  expectNear(rotation({0, 1, 0}, kPi / 2) * Vec3(0, 0, 1), {1, 0, 0}, 2 * kUlp);
  expectNear(rotation({0, 0, 1}, kPi / 2) * Vec3(1, 0, 0), {0, 1, 0}, 2 * kUlp);
  expectNear(rotation({1, 0, 0}, kPi / 2) * Vec3(0, 1, 0), {0, 0, 1}, 2 * kUlp);
  // A third of a turn about the diagonal permutes the axes.
  expectNear(rotation({1, 1, 1}, kTau / 3) * Vec3(1, 2, 3), {3, 1, 2}, 16 * kUlp);
  EXPECT_EQ(rotation({1, 2, 3}, 0), Mat3(1));
}

TEST(Rotation, EqualsTheQuaternion) {
  // q v q* written out in long double, with the axis normalised there.
  RandomTransforms random(2);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 axis = random.vector(10), v = random.vector();
    const double angle = random.between(-7, 7);
    const Real length = std::sqrt(Real(axis.x) * axis.x + Real(axis.y) * axis.y + Real(axis.z) * axis.z);
    const Real w = std::cos(Real(angle) / 2), s = std::sin(Real(angle) / 2) / length;
    const std::array<Real, 3> q{axis.x * s, axis.y * s, axis.z * s};
    const auto cross = [](const std::array<Real, 3>& a, const std::array<Real, 3>& b) {
      return std::array<Real, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                 a[0] * b[1] - a[1] * b[0]};
    };
    const auto qv = cross(q, {v.x, v.y, v.z});
    const auto qqv = cross(q, qv);
    const Vec3 expected(double(v.x + 2 * (w * qv[0] + qqv[0])), double(v.y + 2 * (w * qv[1] + qqv[1])),
                        double(v.z + 2 * (w * qv[2] + qqv[2])));
    expectNear(rotation(axis, angle) * v, expected, 16 * kUlp);
  }
}

TEST(Rotation, IsOrthonormalAndRightHanded) {
  RandomTransforms random(3);
  for (int i = 0; i < 10'000; ++i) {
    const Mat3 r = random.turn();
    EXPECT_LE(distance(glm::transpose(r) * r, Mat3(1)), 16 * kUlp);
    EXPECT_NEAR(glm::determinant(r), 1, 16 * kUlp);
  }
}

TEST(Rotation, TheAxisHasAnyLengthButNotZero) {
  const Mat3 expected = rotation({1, 5, 1}, 0.7);
  for (const double scale : {1e-290, 1e-10, 1e10, 1e290})
    EXPECT_LE(distance(rotation(Vec3(1, 5, 1) * scale, 0.7), expected), 4 * kUlp) << scale;
  EXPECT_EQ(rotation(Vec3(0), 0), Mat3(1));
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const auto& [axis, angle] : {std::pair{Vec3(0), 1e-9},
                                    {Vec3(nan, 0, 1), 1.0},
                                    {Vec3(0, 1, nan), 0.0},
                                    {Vec3(0, infinity, 0), 1.0}}) {
    try {
      static_cast<void>(rotation(axis, angle));
      ADD_FAILURE() << "axis (" << axis.x << ", " << axis.y << ", " << axis.z << ") was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      EXPECT_NE(std::string(error.what()).find("axis"), std::string::npos) << error.what();
      EXPECT_FALSE(error.hint().empty());
    }
  }
}

TEST(Transform, ScalesThenTurnsThenMoves) {
  const Transform t = compose({1, 2, 3}, rotation({0, 0, 1}, kPi / 2), {2, 3, 4});
  expectNear(transformPoint(t, {1, 0, 0}), {1, 4, 3}, 4 * kUlp);
  expectNear(transformPoint(t, {0, 1, 0}), {-2, 2, 3}, 4 * kUlp);
  expectNear(transformPoint(t, {0, 0, 1}), {1, 2, 7}, 4 * kUlp);
  expectNear(transformDirection(t, {1, 0, 0}), {0, 2, 0}, 4 * kUlp);
}

TEST(Transform, ProductsChain) {
  RandomTransforms random(4);
  for (int i = 0; i < 1'000; ++i) {
    const Transform a{random.matrix(), random.vector()}, b{random.matrix(), random.vector()};
    const Vec3 p = random.vector();
    expectNear(transformPoint(a * b, p), transformPoint(a, transformPoint(b, p)), 32 * kUlp);
    expectNear(transformDirection(a * b, p), transformDirection(a, transformDirection(b, p)), 32 * kUlp);
  }
  EXPECT_EQ(Transform{} * Transform{}, Transform{});
}

TEST(Transform, KnowsAMirror) {
  EXPECT_FALSE(mirrors({}));
  EXPECT_TRUE(mirrors(compose(Vec3(0), Mat3(1), {-1, 1, 1})));
  EXPECT_FALSE(mirrors(compose(Vec3(0), rotation({1, 2, 3}, 1), {-1, 2, -3})));
}

TEST(NormalMatrix, KeepsNormalsAcrossTangents) {
  // Stretching x by 2: a normal that went along with its tangent would end up 0.6 (in cosine) off.
  const Mat3 stretch(Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  const Vec3 normal = Vec3(1, 1, 0) / std::sqrt(2.0), tangent = Vec3(1, -1, 0) / std::sqrt(2.0);
  EXPECT_EQ(glm::dot(normalMatrix(stretch) * normal, stretch * tangent), 0);
  EXPECT_NEAR(glm::dot(unit(stretch * normal), unit(stretch * tangent)), 0.6, 4 * kUlp);
}

TEST(NormalMatrix, IsTheSignedCofactor) {
  RandomTransforms random(5);
  for (int i = 0; i < 10'000; ++i) {
    const Mat3 m = random.matrix();
    const Vec3 a = random.vector(), b = random.vector();
    const double sign = glm::determinant(m) < 0 ? -1 : 1;
    if (std::abs(glm::determinant(m)) < 1e-12) continue;  // the sign itself is rounding
    expectNear(normalMatrix(m) * glm::cross(a, b), sign * glm::cross(m * a, m * b), 128 * kUlp);
  }
}

TEST(NormalMatrix, SingularAndMirrored) {
  // Flattened to a disc: its normal is exactly the flattened axis.
  const Mat3 flat(Vec3(3, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 0));
  EXPECT_EQ(unit(normalMatrix(flat) * Vec3(0, 0, 1)), Vec3(0, 0, 1));
  EXPECT_EQ(unit(normalMatrix(flat) * unit(Vec3(1, 1, 1))), Vec3(0, 0, 1));
  // Mirrored: the outward normal at +x is at -x now, and still outward.
  const Mat3 mirror(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  EXPECT_EQ(normalMatrix(mirror) * Vec3(1, 0, 0), Vec3(-1, 0, 0));
  EXPECT_EQ(normalMatrix(mirror) * Vec3(0, 1, 0), Vec3(0, 1, 0));
  EXPECT_EQ(unit(normalMatrix(Mat3(-1)) * Vec3(0, 1, 0)), Vec3(0, -1, 0));
  // Very unequal scales: the plane x / 1e-6 + z / 1e6 = const keeps its normal.
  const Mat3 extreme(Vec3(1e-6, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1e6));
  const Vec3 n(1, 1, 1), along(1, 0, -1);
  EXPECT_NEAR(glm::dot(unit(normalMatrix(extreme) * n), unit(extreme * along)), 0, 4 * kUlp);
}

/// Largest singular value by the power method in long double: B = A^T A squared 60 times leaves the projector
/// P on the vectors that grow most, and trace(B P) / trace(P) is the mean of their eigenvalues: those within
/// 2^-55 of the largest.
Real largestSingularValue(const Mat3& m) {
  using Matrix = std::array<std::array<Real, 3>, 3>;
  const auto product = [](const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
  };
  const auto trace = [](const Matrix& a) { return a[0][0] + a[1][1] + a[2][2]; };
  Matrix a{}, transposed{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a[i][j] = transposed[j][i] = m[j][i];
  const Matrix b = product(transposed, a);
  Matrix power = b;
  for (int k = 0; k < 60; ++k) {
    const Real size = trace(power);
    for (auto& row : power)
      for (Real& entry : row) entry /= size;
    power = product(power, power);
  }
  return std::sqrt(trace(product(b, power)) / trace(power));
}

void expectLargestStretch(const Mat3& m) {
  const Real exact = largestSingularValue(m);
  EXPECT_NEAR(double(Real(largestStretch(m)) / exact), 1, 2e-12) << "true value " << exact;
}

TEST(LargestStretch, EqualsTheLargestSingularValue) {
  RandomTransforms random(6);
  for (int i = 0; i < 10'000; ++i) expectLargestStretch(random.matrix(std::exp(random.between(-20, 20))));
  expectLargestStretch(Mat3(Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(-1, -2, -3)));  // rank 1
  EXPECT_EQ(largestStretch(Mat3(0)), 0);
  EXPECT_NEAR(largestStretch(Mat3(1)), 1, 2e-12);
  EXPECT_NEAR(largestStretch(Mat3(1e200)) / 1e200, 1, 2e-12);
  EXPECT_NEAR(largestStretch(Mat3(1e-200)) / 1e-200, 1, 2e-12);
}

TEST(LargestStretch, EqualAndNearlyEqualStretches) {
  // Two equal largest stretches make the characteristic polynomial ill-conditioned: half the digits of its
  // root would be lost. Rotations on both sides make every entry non-zero.
  RandomTransforms random(7);
  for (int i = 0; i < 3'000; ++i)
    for (const Vec3& stretch : {Vec3(2, 2, 1), Vec3(2, 2, 0), Vec3(2, 1, 1), Vec3(1, 1, 1), Vec3(3, 0, 0),
                                Vec3(1, 1 + 1e-9, 1e-3), Vec3(-5, 5, 5 - 1e-7)})
      expectLargestStretch(random.turn() * compose(Vec3(0), Mat3(1), stretch).linear * random.turn());
}

/// The same angle in long double: the product split exactly in two, each part's sine and cosine (which the C
/// library reduces exactly), the sum by the addition theorems. Its error is about 1e-18.
Real angleReference(double rate, double time) {
  const Real high = Real(rate) * time;
  const Real low = std::fma(Real(rate), Real(time), -high);
  const Real s = std::sin(high) * std::cos(low) + std::cos(high) * std::sin(low);
  const Real c = std::cos(high) * std::cos(low) - std::sin(high) * std::sin(low);
  return std::atan2(s, c);
}

double angleError(double rate, double time) {
  Real difference = Real(angleAt(rate, time)) - angleReference(rate, time);
  difference -= kTauReal * std::round(difference / kTauReal);
  return double(std::abs(difference));
}

TEST(AngleAt, KnownAnswers) {
  EXPECT_EQ(angleAt(0, 1e9), 0);
  EXPECT_EQ(angleAt(0.5, 0), 0);
  EXPECT_NEAR(angleAt(0.5, 3), 1.5, 1e-15);
  EXPECT_NEAR(angleAt(-0.75, 2), -1.5, 1e-15);
  // sin and cos of 1e22 are the classic test of argument reduction; 1e11 * 1e11 is exact in double.
  EXPECT_NEAR(angleAt(1e11, 1e11), std::atan2(-0.8522008497671888017727, 0.5232147853951389454975), 1e-15);
}

TEST(AngleAt, ExactAtAnyAge) {
  RandomTransforms random(8);
  for (int i = 0; i < 200'000; ++i) {
    const double rate = random.between(-10, 10), time = std::exp(random.between(-5, std::log(1e9)));
    const double angle = angleAt(rate, time);
    ASSERT_LT(angleError(rate, time), 1e-15) << rate << " rad/s at " << time << " s";
    ASSERT_TRUE(-kPi <= angle && angle <= kPi) << angle;
  }
  // 0.1 rad/s is not a tenth: after 1e9 s the difference between product and rounded product shows.
  ASSERT_LT(angleError(0.1, 1e9), 1e-15);
}

TEST(AngleAt, ExactForAnyFiniteProduct) {
  RandomTransforms random(9);
  for (int i = 0; i < 20'000; ++i) {
    const double rate = std::exp(random.between(-300, 350)), time = std::exp(random.between(-300, 350));
    const double angle = angleAt(rate, time);
    ASSERT_LT(angleError(rate, time), 1e-15) << rate << " rad/s at " << time << " s";
    ASSERT_TRUE(-kPi <= angle && angle <= kPi) << angle;
  }
}

TEST(AngleAt, ComesBackAfterThePeriod) {
  // 8 pi s is a whole number of turns at 0.25, 0.5, 0.75 and 1 rad/s. What is left is the rounding of t + 8
  // pi (half an ulp of 64) and of 8 pi itself (2e-15), times the rate, and the two angles' own errors.
  for (double t = 0; t < 25; t += 0.37)
    for (const double rate : {0.25, 0.5, 0.75, 1.0}) {
      const double later = angleAt(rate, t + 4 * kTau), now = angleAt(rate, t);
      EXPECT_NEAR(std::remainder(later - now, kTau), 0, 1e-14) << rate << " rad/s at " << t;
    }
}

TEST(Animated, ConstantsAndFunctionsOfTime) {
  const Animated<double> constant = 3, moving = [](double t) { return 2 * t; };
  EXPECT_TRUE(constant.isConstant());
  EXPECT_FALSE(moving.isConstant());
  EXPECT_EQ(constant.at(17), 3);
  EXPECT_EQ(moving.at(17), 34);
  EXPECT_TRUE(Animated<Vec3>{}.isConstant());
  EXPECT_TRUE(moving.movesWithTime());
  EXPECT_FALSE(constant.movesWithTime());
}

TEST(Animated, FunctionsOfTheMoment) {
  const auto scaledTime = [](const Moment& m) { return m.parameters[1] * m.time; };
  const Animated<double> both = scaledTime;
  const Animated<double> parametersOnly = {[](const Moment& m) { return m.parameters[0]; },
                                           DependsOn::Parameters};
  const std::array values{5.0, 7.0};
  EXPECT_EQ(both.at({3, values}), 21);
  EXPECT_EQ(parametersOnly.at({3, values}), 5);
  EXPECT_TRUE(both.movesWithTime());
  EXPECT_FALSE(parametersOnly.movesWithTime());
  EXPECT_FALSE(parametersOnly.isConstant()) << "it is another value when the parameter is";
}

}  // namespace
}  // namespace luxo
