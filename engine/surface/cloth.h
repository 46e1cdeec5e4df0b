// SPDX-License-Identifier: Apache-2.0
// Cloth: a woven rectangle that hangs, falls and lies on a ball, in steps of a fixed length counted from time
// 0.
//
//     Node{.surface = Surface(Cloth{.pins = {{0, 0}, {1, 0}}})}                 // held at two corners
//
// A grid of points with masses. Springs along threads resist stretch, those across the cells shear, second
// differences along threads bending (M. Bergou et al., "A quadratic bending model for inextensible surfaces",
// SGP 2006). All three are those of a continuous sheet, shared among the springs: finer cells are the same
// cloth. What is between two threads of it is neither felt by the ball nor by the cloth itself, which may
// pass through itself.
//
// A step of length h takes positions x and velocities v to x' = x + z, v' = z / h, where
//
//     (M (1 + h damping) / h^2 + H) z = M v / h - grad U(x),
//
// U being the energy of springs, bending, weight and contact, and H the Hessian of the quadratic that is
// nowhere below U and touches it at x: of a spring k/2 (|d| - L)^2 it is k/2 |d - L d(x)/|d(x)||^2. This is
// one iteration of T. Liu et al., "Fast simulation of mass-spring systems", SIGGRAPH Asia 2013, and S.
// Bouaziz et al., "Projective dynamics", SIGGRAPH 2014. As U(x') is at most that quadratic at x', the energy
// E = U + v M v / 2 never increases:
//
//     E' <= E - |v' - v|_M^2 / 2 - h^2 |v'|_H^2 / 2 - h damping |v'|_M^2,
//
// for any length of a step, any stiffness, and however far springs are stretched or pressed. The price is the
// third term: the longer steps are, the sooner what swings is at rest.
//
// Contact is a spring of stiffness M / h^2 from where a point is in the ball to the ball's surface, which H
// has of points that are in it or whose x + h v is. Of any other point x + h v is outside, so that its energy
// in the ball, at most M |x' - (x + h v)|^2 / (2 h^2) = M |v' - v|^2 / 2, is no more than the second term
// takes.
//
// The equations are solved by Chebyshev's iteration,
// run twice from zero: then its residual r = A z - b is -q(A)^2 b, and r.z <= 0, so that the inequality holds
// however few iterations there are. What is left is rounding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"
#include "surface/surface.h"

namespace luxo {

/// Cells along each side, steps from time 0, and iterations of a step: the most. The last bounds what a step
/// costs; it is reached where a step is so long that sound crosses some eight cells in it.
inline constexpr std::uint32_t kMaxClothCells = 128;
inline constexpr std::uint32_t kMaxClothSteps = 100000;
inline constexpr std::uint32_t kMaxClothIterations = 128;

/// At rest it lies in the plane y = 0 as a rectangle does: u runs along +x, v along -z, both from 0 to 1.
struct Cloth {
  std::uint32_t columns = 24, rows = 24;  ///< cells along x and z
  std::vector<Vec2> pins = {};            ///< (u, v) of what is held; the nearest points of the grid are

  Vec2 size{1, 1};       ///< metres, along x and z
  double density = 0.2;  ///< kilograms per square metre
  double stretch =
      60;  ///< newtons per metre, along threads: the force on each metre of an edge that doubles a length
  double shear = 15;          ///< newtons per metre
  double bend = 1e-5;         ///< newton metres
  double damping = 0.2;       ///< per second: what air takes of the velocity
  Vec3 gravity{0, -9.81, 0};  ///< metres per second squared, along the axes of the cloth
  double step = 0.001;        ///< seconds
  Vec3 ballCenter{0};         ///< what it lies on, in the space of the cloth
  double ballRadius = 0;      ///< metres; 0: nothing
  double ballFriction = 10;   ///< per second: what the ball takes of the velocity where it touches

  friend bool operator==(const Cloth&, const Cloth&) = default;
};

/// The numbers of a cloth that may depend on a scene's parameters, in this order. Names as in scene files.
struct ClothNumber {
  const char* name;
  Interval range;     ///< ends included; devices compute with floats
  const char* words;  ///< the same
};
inline constexpr std::size_t kClothNumbers = 16;
[[nodiscard]] std::span<const ClothNumber, kClothNumbers> clothNumbers();
[[nodiscard]] std::array<double, kClothNumbers> numbersOf(const Cloth& cloth);
[[nodiscard]] Cloth withNumbers(Cloth cloth, std::span<const double> numbers);

/// Positions and velocities of (columns + 1) (rows + 1) points, x fastest, from u = v = 0 on. Metres and
/// seconds.
struct ClothState {
  std::vector<Vec3f> positions, velocities;

  friend bool operator==(const ClothState&, const ClothState&) = default;
};

/// What the step needs beside the state: masses, springs and how to solve its equations.
struct ClothSystem {
  std::vector<float> masses;   ///< kilograms, of each point
  std::vector<float> rowSums;  ///< of |H|, of each point; a diagonal of them is nowhere below H
  std::vector<bool> pinned;
  double stretchX = 0, stretchZ = 0,
         diagonal = 0;          ///< newtons per metre, of a spring inside; half at borders
  double bendX = 0, bendZ = 0;  ///< of a second difference, the same
  /// Of one run of Chebyshev's iteration: what of the last change goes on, and how much of the residual is
  /// added.
  std::vector<Vec2f> iterations;
};

/// Error(Scene), naming the number, its value and what it may be: numbers out of range, cells or pins that
/// are none, a step that is too long for its stiffness (kMaxClothIterations).
void validate(const Cloth& cloth);
/// The same errors. Cost: linear.
[[nodiscard]] ClothSystem clothSystem(const Cloth& cloth);
/// Flat, and not moving.
[[nodiscard]] ClothState clothAtRest(const Cloth& cloth);
/// The triangles that are drawn, with smooth normals, u and v.
[[nodiscard]] Surface clothSurface(const Cloth& cloth, std::span<const Vec3f> positions);

/// Steps from 0 to a time: the largest number whose time is not later, but for rounding; 0 before time 0.
/// Error(Scene): more than kMaxClothSteps.
[[nodiscard]] std::uint32_t clothSteps(const Cloth& cloth, double timeSeconds);

}  // namespace luxo
