// SPDX-License-Identifier: Apache-2.0
#include "surface/cloth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "mesh/triangle_mesh.h"

namespace luxo {
namespace {

/// What is left of an equation's error in a step: far below what the step itself is off by, as it is no more
/// than the change of a spring's direction in 1/4096 of a step.
constexpr double kResidual = 0x1p-12;

constexpr ClothNumber kLengthwise{"size", {1e-3, 1e3}, "from 0.001 to 1000 m"};
constexpr ClothNumber kGravity{"gravity", {-1e3, 1e3}, "from -1000 to 1000 m/s^2"};
constexpr ClothNumber kCenter{"ball center", {-1e3, 1e3}, "from -1000 to 1000 m"};
constexpr std::array<ClothNumber, kClothNumbers> kNumbers{{
    kLengthwise,
    kLengthwise,
    {"density", {1e-3, 1e3}, "from 0.001 to 1000 kg/m^2"},
    {"stretch", {1e-3, 1e6}, "from 0.001 to 1e6 N/m"},
    {"shear", {0, 1e6}, "from 0 to 1e6 N/m"},
    {"bend", {0, 1e3}, "from 0 to 1000 N m"},
    {"damping", {0, 1e3}, "from 0 to 1000 per second"},
    kGravity,
    kGravity,
    kGravity,
    {"step", {1e-5, 0.1}, "from 0.00001 to 0.1 s"},
    kCenter,
    kCenter,
    kCenter,
    {"ball radius", {0, 1e3}, "from 0 to 1000 m"},
    {"ball friction", {0, 1e6}, "from 0 to 1e6 per second"},
}};

/// Points of the grid, and the parts of a cell's width that threads at the border stand for.
struct Grid {
  explicit Grid(const Cloth& cloth)
      : columns(cloth.columns), rows(cloth.rows), dx(cloth.size.x / columns), dz(cloth.size.y / rows) {}

  [[nodiscard]] std::size_t points() const { return std::size_t{columns + 1} * (rows + 1); }
  [[nodiscard]] std::size_t at(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row} * (columns + 1) + column;
  }
  [[nodiscard]] double alongX(std::uint32_t row) const { return row == 0 || row == rows ? 0.5 : 1; }
  [[nodiscard]] double alongZ(std::uint32_t column) const {
    return column == 0 || column == columns ? 0.5 : 1;
  }

  std::uint32_t columns, rows;
  double dx, dz;
};

void requireCells(const Cloth& cloth) {
  for (const std::uint32_t cells : {cloth.columns, cloth.rows})
    if (cells < 1 || cells > kMaxClothCells)
      throw Error(ErrorKind::Scene, fmt::format("a cloth of {} x {} cells; each number must be from 1 to {}",
                                                cloth.columns, cloth.rows, kMaxClothCells));
}

void requireNumbers(const Cloth& cloth) {
  requireCells(cloth);
  const auto numbers = numbersOf(cloth);
  for (std::size_t i = 0; i < kClothNumbers; ++i)
    if (!kNumbers[i].range.contains(numbers[i]))
      throw Error(ErrorKind::Scene, fmt::format("the {} of a cloth is {}; it must be {}", kNumbers[i].name,
                                                numbers[i], kNumbers[i].words));
  for (const Vec2& pin : cloth.pins)
    if (!(pin.x >= 0 && pin.x <= 1 && pin.y >= 0 && pin.y <= 1))
      throw Error(ErrorKind::Scene,
                  fmt::format("a cloth is pinned at u = {}, v = {}; both must be from 0 to 1", pin.x, pin.y));
}

ClothSystem springsOf(const Cloth& cloth) {
  const Grid grid(cloth);
  ClothSystem system{.masses = std::vector<float>(grid.points()),
                     .rowSums = std::vector<float>(grid.points()),
                     .pinned = std::vector<bool>(grid.points())};
  const double dx = grid.dx, dz = grid.dz;
  system.stretchX = cloth.stretch * dz / dx;
  system.stretchZ = cloth.stretch * dx / dz;
  // Of a shear by an angle both diagonals of a cell change by angle dx dz / length; together they take
  // shear / 2 angle^2 dx dz.
  system.diagonal = cloth.shear * (dx * dx + dz * dz) / (2 * dx * dz);
  system.bendX = cloth.bend * dz / (dx * dx * dx);
  system.bendZ = cloth.bend * dx / (dz * dz * dz);

  std::vector<double> sums(grid.points());
  const auto addSpring = [&](std::size_t a, std::size_t b, double stiffness) {
    sums[a] += 2 * stiffness;
    sums[b] += 2 * stiffness;
  };
  const auto addBend = [&](std::size_t a, std::size_t middle, std::size_t b, double stiffness) {
    sums[a] += 4 * stiffness;  // of (1, -2, 1)
    sums[middle] += 8 * stiffness;
    sums[b] += 4 * stiffness;
  };
  for (std::uint32_t row = 0; row <= grid.rows; ++row)
    for (std::uint32_t column = 0; column <= grid.columns; ++column) {
      const std::size_t i = grid.at(column, row);
      const double x = grid.alongX(row), z = grid.alongZ(column);
      system.masses[i] = static_cast<float>(cloth.density * dx * dz * x * z);
      const bool right = column < grid.columns, up = row < grid.rows;
      if (right) addSpring(i, grid.at(column + 1, row), system.stretchX * x);
      if (up) addSpring(i, grid.at(column, row + 1), system.stretchZ * z);
      if (right && up) {
        addSpring(i, grid.at(column + 1, row + 1), system.diagonal);
        addSpring(grid.at(column + 1, row), grid.at(column, row + 1), system.diagonal);
      }
      if (right && column > 0)
        addBend(grid.at(column - 1, row), i, grid.at(column + 1, row), system.bendX * x);
      if (up && row > 0) addBend(grid.at(column, row - 1), i, grid.at(column, row + 1), system.bendZ * z);
    }
  for (std::size_t i = 0; i < sums.size(); ++i) system.rowSums[i] = static_cast<float>(sums[i]);
  for (const Vec2& pin : cloth.pins)
    system.pinned[grid.at(static_cast<std::uint32_t>(std::lround(pin.x * grid.columns)),
                          static_cast<std::uint32_t>(std::lround(pin.y * grid.rows)))] = true;
  return system;
}

/// All eigenvalues of the equations, each divided by its row's sum, are from this to 1: what contact adds is
/// on the diagonal.
double smallestEigenvalue(const Cloth& cloth, const ClothSystem& system) {
  double smallest = 1;
  for (std::size_t i = 0; i < system.masses.size(); ++i) {
    const double inertia =
        static_cast<double>(system.masses[i]) * (1 + cloth.step * cloth.damping) / (cloth.step * cloth.step);
    smallest = std::min(smallest, inertia / (inertia + static_cast<double>(system.rowSums[i])));
  }
  return smallest;
}

/// Chebyshev's iteration for eigenvalues from `smallest` to 1, as long as its polynomial, squared, leaves
/// more than kResidual. Y. Saad, "Iterative methods for sparse linear systems", 2003, algorithm 12.1.
std::vector<Vec2f> iterationsFor(double smallest) {
  const double middle = (1 + smallest) / 2, radius = std::max((1 - smallest) / 2, 0x1p-20);
  const double sigma = middle / radius;
  const double wanted = std::acosh(1 / std::sqrt(kResidual)) / std::acosh(sigma);
  if (!(wanted <= kMaxClothIterations / 2)) return {};
  std::vector<Vec2f> iterations{Vec2f(0, static_cast<float>(1 / middle))};
  double rho = 1 / sigma;
  for (int i = 1; i < std::ceil(wanted); ++i) {
    const double next = 1 / (2 * sigma - rho);
    iterations.emplace_back(static_cast<float>(next * rho), static_cast<float>(2 * next / radius));
    rho = next;
  }
  return iterations;
}

}  // namespace

std::span<const ClothNumber, kClothNumbers> clothNumbers() { return kNumbers; }

std::array<double, kClothNumbers> numbersOf(const Cloth& c) {
  return {c.size.x,       c.size.y,       c.density,    c.stretch,     c.shear, c.bend,
          c.damping,      c.gravity.x,    c.gravity.y,  c.gravity.z,   c.step,  c.ballCenter.x,
          c.ballCenter.y, c.ballCenter.z, c.ballRadius, c.ballFriction};
}

Cloth withNumbers(Cloth cloth, std::span<const double> n) {
  LUXO_REQUIRE_COMPARE(n.size(), ==, kClothNumbers);
  cloth.size = {n[0], n[1]};
  cloth.density = n[2];
  cloth.stretch = n[3];
  cloth.shear = n[4];
  cloth.bend = n[5];
  cloth.damping = n[6];
  cloth.gravity = {n[7], n[8], n[9]};
  cloth.step = n[10];
  cloth.ballCenter = {n[11], n[12], n[13]};
  cloth.ballRadius = n[14];
  cloth.ballFriction = n[15];
  return cloth;
}

void validate(const Cloth& cloth) { static_cast<void>(clothSystem(cloth)); }

ClothSystem clothSystem(const Cloth& cloth) {
  requireNumbers(cloth);
  ClothSystem system = springsOf(cloth);
  system.iterations = iterationsFor(smallestEigenvalue(cloth, system));
  if (system.iterations.empty())
    throw Error(
        ErrorKind::Scene,
        fmt::format("a step of {} s is too long for how stiff and light a cloth is: it would take more than "
                    "{} iterations",
                    cloth.step, kMaxClothIterations),
        "shorten \"step\", or lower \"stretch\", \"shear\" or \"bend\", or take fewer cells");
  return system;
}

ClothState clothAtRest(const Cloth& cloth) {
  requireNumbers(cloth);
  const Grid grid(cloth);
  ClothState state{.velocities = std::vector<Vec3f>(grid.points(), Vec3f(0))};
  for (std::uint32_t row = 0; row <= grid.rows; ++row)
    for (std::uint32_t column = 0; column <= grid.columns; ++column)
      state.positions.emplace_back((static_cast<double>(column) / grid.columns - 0.5) * cloth.size.x, 0,
                                   (0.5 - static_cast<double>(row) / grid.rows) * cloth.size.y);
  return state;
}

Surface clothSurface(const Cloth& cloth, std::span<const Vec3f> positions) {
  const Grid grid(cloth);
  LUXO_REQUIRE_COMPARE(positions.size(), ==, grid.points());
  MeshArrays arrays;
  for (std::uint32_t row = 0; row <= grid.rows; ++row)
    for (std::uint32_t column = 0; column <= grid.columns; ++column) {
      arrays.positions.emplace_back(positions[grid.at(column, row)]);
      arrays.uvs.emplace_back(static_cast<float>(column) / static_cast<float>(grid.columns),
                              static_cast<float>(row) / static_cast<float>(grid.rows));
    }
  // Diagonals take turns, so that folds do not all run one way.
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const auto corner = [&](std::uint32_t c, std::uint32_t r) {
        return static_cast<std::uint32_t>(grid.at(column + c, row + r));
      };
      const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
      if ((row + column) % 2 == 0)
        arrays.indices.insert(arrays.indices.end(), {a, b, c, a, c, d});
      else
        arrays.indices.insert(arrays.indices.end(), {a, b, d, b, c, d});
    }
  return triangleMesh(std::move(arrays), "cloth",
                      {.normals = NormalRule::Smooth, .crease = kPi, .tangents = true});
}

std::uint32_t clothSteps(const Cloth& cloth, double timeSeconds) {
  if (!(timeSeconds > 0)) return 0;
  // A time that is a multiple of the step, each rounded once, and so is their quotient.
  const double steps =
      std::floor(timeSeconds / cloth.step * (1 + 4 * std::numeric_limits<double>::epsilon()));
  if (steps > kMaxClothSteps)
    throw Error(ErrorKind::Scene,
                fmt::format("time {} s is step {:.0f} of a cloth; the last one that is simulated is {}",
                            timeSeconds, steps, kMaxClothSteps),
                "ask for an earlier time, or take a longer \"step\"");
  return static_cast<std::uint32_t>(steps);
}

}  // namespace luxo
