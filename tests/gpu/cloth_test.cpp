// SPDX-License-Identifier: Apache-2.0
// The compute shader that moves cloth, against energies and steps worked out here in double from the
// definitions of surface/cloth.h, and against what mechanics says of strips at rest and of bodies that fall.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "draw/device_cloth_simulation.h"
#include "support/gpu_fixture.h"

namespace luxo::test {
namespace {

using ClothSteps = GpuTest;

struct Spring {
  std::size_t a, b;
  double stiffness, rest;
};
struct Bend {
  std::size_t a, middle, b;
  double stiffness;
};

/// A cloth as lists of masses, springs and bends: the sheet's energies per area, each spring standing for its
/// part.
struct Model {
  explicit Model(const Cloth& c) : cloth(c), nx(c.columns + 1), nz(c.rows + 1), masses(std::size_t{nx} * nz) {
    const double dx = c.size.x / c.columns, dz = c.size.y / c.rows, slanted = std::hypot(dx, dz);
    const auto part = [](std::uint32_t k, std::uint32_t points) {
      return k == 0 || k + 1 == points ? 0.5 : 1.0;
    };
    for (std::uint32_t j = 0; j < nz; ++j)
      for (std::uint32_t i = 0; i < nx; ++i) {
        const double across = dz * part(j, nz), along = dx * part(i, nx);
        masses[at(i, j)] = c.density * across * along;
        if (i + 1 < nx) springs.push_back({at(i, j), at(i + 1, j), c.stretch * across / dx, dx});
        if (j + 1 < nz) springs.push_back({at(i, j), at(i, j + 1), c.stretch * along / dz, dz});
        if (i + 1 < nx && j + 1 < nz)
          for (const auto& [p, q] : {std::pair{at(i, j), at(i + 1, j + 1)}, {at(i + 1, j), at(i, j + 1)}})
            springs.push_back({p, q, c.shear * slanted * slanted / (2 * dx * dz), slanted});
        if (i > 0 && i + 1 < nx)
          bends.push_back({at(i - 1, j), at(i, j), at(i + 1, j), c.bend * across / std::pow(dx, 3)});
        if (j > 0 && j + 1 < nz)
          bends.push_back({at(i, j - 1), at(i, j), at(i, j + 1), c.bend * along / std::pow(dz, 3)});
      }
    pinned.resize(masses.size());
    for (const Vec2& pin : c.pins)
      pinned[at(static_cast<std::uint32_t>(std::lround(pin.x * c.columns)),
                static_cast<std::uint32_t>(std::lround(pin.y * c.rows)))] = true;
  }

  [[nodiscard]] std::size_t at(std::uint32_t i, std::uint32_t j) const { return std::size_t{j} * nx + i; }
  [[nodiscard]] double contact(std::size_t i) const { return masses[i] / (cloth.step * cloth.step); }
  [[nodiscard]] double depth(const Vec3& x) const {
    return cloth.ballRadius > 0 ? std::max(0.0, cloth.ballRadius - glm::length(x - cloth.ballCenter)) : 0;
  }

  Cloth cloth;
  std::uint32_t nx, nz;
  std::vector<double> masses;
  std::vector<Spring> springs;
  std::vector<Bend> bends;
  std::vector<bool> pinned;
};

std::vector<Vec3> inDouble(const std::vector<Vec3f>& from) { return {from.begin(), from.end()}; }

double energyOf(const Model& m, const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  double energy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (m.pinned[i]) continue;
    energy += m.masses[i] * (glm::dot(v[i], v[i]) / 2 - glm::dot(m.cloth.gravity, x[i]));
    energy += m.contact(i) / 2 * std::pow(m.depth(x[i]), 2);
  }
  for (const Spring& s : m.springs)
    energy += s.stiffness / 2 * std::pow(glm::length(x[s.b] - x[s.a]) - s.rest, 2);
  for (const Bend& b : m.bends) {
    const Vec3 bent = x[b.a] - 2.0 * x[b.middle] + x[b.b];
    energy += b.stiffness / 2 * glm::dot(bent, bent);
  }
  return energy;
}

/// Forces of all but inertia, and the sum of the lengths of what each is the sum of.
struct Forces {
  std::vector<Vec3> force;
  std::vector<double> terms;
};

Forces forcesOn(const Model& m, const std::vector<Vec3>& x) {
  Forces f{std::vector<Vec3>(x.size(), Vec3(0)), std::vector<double>(x.size())};
  const auto add = [&](std::size_t i, const Vec3& force, double size) {
    f.force[i] += force;
    f.terms[i] += size;
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    add(i, m.masses[i] * m.cloth.gravity, m.masses[i] * glm::length(m.cloth.gravity));
    if (m.depth(x[i]) > 0) {
      const Vec3 outward = glm::normalize(x[i] - m.cloth.ballCenter);
      add(i, m.contact(i) * m.depth(x[i]) * outward, m.contact(i) * (m.cloth.ballRadius + glm::length(x[i])));
    }
  }
  for (const Spring& s : m.springs) {
    const Vec3 apart = x[s.b] - x[s.a];
    const Vec3 pull = s.stiffness * (glm::length(apart) - s.rest) * glm::normalize(apart);
    add(s.a, pull, s.stiffness * (glm::length(apart) + s.rest));
    add(s.b, -pull, s.stiffness * (glm::length(apart) + s.rest));
  }
  for (const Bend& b : m.bends) {
    const Vec3 bent = b.stiffness * (x[b.a] - 2.0 * x[b.middle] + x[b.b]);
    // Differences of places, whose rounding is of their size.
    const double size =
        b.stiffness * (glm::length(x[b.a]) + 2 * glm::length(x[b.middle]) + glm::length(x[b.b]));
    add(b.a, -bent, size);
    add(b.middle, 2.0 * bent, 2 * size);
    add(b.b, -bent, size);
  }
  return f;
}

/// What rounding may add to the energy in the step that led to x, v from `before`.
///
/// In exact arithmetic E' <= E + r.z, r = A z - b <= 0 there. Rounding moves r: a point gathers at most 8
/// springs, 2 bends of 3 second differences and 3 forces, each of at most 8 roundings of its terms; what one
/// iteration rounds is contracted by those after it, to no more than twice. And x + z is rounded: E moves by
/// its gradient.
double roundingOf(const Model& m, const ClothState& before, const std::vector<Vec3>& x,
                  const std::vector<Vec3>& v) {
  constexpr double kUnit = 0x1p-24, kRoundings = 2 * 8;
  const Forces then = forcesOn(m, x), at = forcesOn(m, inDouble(before.positions));
  const double rate = 1 / m.cloth.step;
  double slack = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (m.pinned[i]) continue;
    const Vec3 was(before.velocities[i]);
    const double move = glm::length(v[i]) * m.cloth.step;
    const double inertia = m.masses[i] * rate * (glm::length(was) + glm::length(v[i])) *
                           (2 + m.cloth.step * (m.cloth.damping + m.cloth.ballFriction));
    slack += kRoundings * kUnit * move * (at.terms[i] + then.terms[i] + inertia);
    slack += kUnit * glm::length(x[i]) * (glm::length(then.force[i]) + kUnit * then.terms[i]);
    slack += 4 * kUnit * m.masses[i] * glm::dot(v[i], v[i]);
  }
  return slack + 0x1p-50 * std::abs(energyOf(m, x, v));
}

void expectNoEnergyGained(ClothSimulation& simulation, const Cloth& cloth, std::uint32_t steps) {
  const Model model(cloth);
  ClothState before = clothAtRest(cloth);
  double energy = energyOf(model, inDouble(before.positions), inDouble(before.velocities));
  const double first = energy;
  std::uint32_t gains = 0;
  for (std::uint32_t n = 1; n <= steps; ++n) {
    const ClothState state = simulation.stateAfter(cloth, n);
    const std::vector<Vec3> x = inDouble(state.positions), v = inDouble(state.velocities);
    const double next = energyOf(model, x, v), slack = roundingOf(model, before, x, v);
    ASSERT_LE(next, energy + slack) << "step " << n;
    gains += next > energy;
    energy = next;
    before = state;
  }
  EXPECT_LT(energy, first);
  EXPECT_LE(gains, steps / 20) << "rounding is below what steps lose";
}

TEST_F(ClothSteps, AHangingClothGainsNoEnergy) {
  DeviceClothSimulation simulation(context());
  expectNoEnergyGained(
      simulation, {.columns = 12, .rows = 10, .pins = {{0, 1}, {1, 1}}, .damping = 0, .step = 0.002}, 600);
}

TEST_F(ClothSteps, AClothOnABallGainsNoEnergy) {
  DeviceClothSimulation simulation(context());
  expectNoEnergyGained(simulation,
                       {.columns = 12,
                        .rows = 12,
                        .damping = 0,
                        .step = 0.002,
                        .ballCenter = {0.02, -0.35, 0.05},
                        .ballRadius = 0.3},
                       500);
}

// Where nothing is lost any more rounding is all there is.
TEST_F(ClothSteps, AClothAtRestGainsNoEnergy) {
  DeviceClothSimulation simulation(context());
  const Cloth cloth{.columns = 2,
                    .rows = 6,
                    .pins = {{0, 1}, {1, 1}},
                    .damping = 20,
                    .gravity = {0, 0, 9.81},
                    .step = 0.004};
  const Model model(cloth);
  ClothState before = simulation.stateAfter(cloth, 3000);
  const auto energy = [&](const ClothState& s) {
    return energyOf(model, inDouble(s.positions), inDouble(s.velocities));
  };
  for (std::uint32_t n = 3001; n <= 3100; ++n) {
    const ClothState after = simulation.stateAfter(cloth, n);
    const double slack = roundingOf(model, before, inDouble(after.positions), inDouble(after.velocities));
    ASSERT_LE(energy(after), energy(before) + slack) << "step " << n;
    ASSERT_LT(slack, 1e-7);
    before = after;
  }
}

// Whatever it is made of, and however long its steps are.
TEST_F(ClothSteps, NoClothGainsEnergy) {
  DeviceClothSimulation simulation(context());
  std::mt19937 random(22);
  const auto number = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(random);
  };
  const auto scale = [&](double from, double to) { return std::exp(number(std::log(from), std::log(to))); };
  int judged = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Cloth cloth{.columns = static_cast<std::uint32_t>(number(1, 9)),
                .rows = static_cast<std::uint32_t>(number(1, 9)),
                .size = {scale(0.3, 3), scale(0.3, 3)},
                .density = scale(0.05, 2),
                .stretch = scale(1, 3000),
                .shear = number(0, 1) < 0.2 ? 0 : scale(0.1, 3000),
                .bend = number(0, 1) < 0.2 ? 0 : scale(1e-6, 0.5),
                .damping = number(0, 1) < 0.5 ? 0 : scale(0.01, 10),
                .gravity = {number(-5, 5), number(-15, 15), number(-5, 5)},
                .step = scale(2e-4, 2e-2),
                .ballCenter = {number(-1, 1), number(-1, 0), number(-1, 1)},
                .ballRadius = number(0, 1) < 0.4 ? 0 : scale(0.1, 1)};
    for (int pins = static_cast<int>(number(0, 4)); pins > 0; --pins)
      cloth.pins.emplace_back(std::round(number(0, 1)), number(0, 1));
    try {
      validate(cloth);
    } catch (const Error&) {  // too long a step
      continue;
    }
    ++judged;
    expectNoEnergyGained(simulation, cloth, 60);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(judged, 40);
}

/// Solves A z = b for symmetric A of few rows, by elimination; b has three columns.
std::vector<Vec3> solved(std::vector<std::vector<double>> a, std::vector<Vec3> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) {
      const double part = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= part * a[k][j];
      b[i] -= part * b[k];
    }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// The next step's velocities, by the definition; `touching` has what the ball counts for.
std::vector<Vec3> velocitiesAfter(const Model& m, const ClothState& state,
                                  const std::vector<bool>& touching) {
  const std::vector<Vec3> x = inDouble(state.positions), v = inDouble(state.velocities);
  const std::size_t n = x.size();
  const double rate = 1 / m.cloth.step;
  std::vector<std::vector<double>> a(n, std::vector<double>(n));
  std::vector<Vec3> b = forcesOn(m, x).force;
  for (const Spring& s : m.springs)
    for (const auto& [i, j, sign] :
         {std::tuple{s.a, s.a, 1.0}, {s.b, s.b, 1.0}, {s.a, s.b, -1.0}, {s.b, s.a, -1.0}})
      a[i][j] += sign * s.stiffness;
  for (const Bend& bend : m.bends)
    for (const auto& [i, p] : {std::pair{bend.a, 1.0}, {bend.middle, -2.0}, {bend.b, 1.0}})
      for (const auto& [j, q] : {std::pair{bend.a, 1.0}, {bend.middle, -2.0}, {bend.b, 1.0}})
        a[i][j] += p * q * bend.stiffness;
  for (std::size_t i = 0; i < n; ++i) {
    b[i] += m.masses[i] * rate * v[i];
    a[i][i] += m.masses[i] * rate * (rate + m.cloth.damping);
    if (touching[i]) a[i][i] += m.masses[i] * rate * (rate + m.cloth.ballFriction);
    if (!m.pinned[i]) continue;
    b[i] = Vec3(0);
    for (std::size_t j = 0; j < n; ++j) a[i][j] = a[j][i] = i == j;
  }
  std::vector<Vec3> moved = solved(std::move(a), std::move(b));
  for (Vec3& move : moved) move *= rate;
  return moved;
}

/// Both velocities, but for 2^-10 of the fastest: a step's equations are solved to 2^-12 in the norm of their
/// matrix.
void expectStep(const Model& model, const ClothState& before, const ClothState& after,
                const std::vector<bool>& touching) {
  const std::vector<Vec3> expected = velocitiesAfter(model, before, touching);
  double fastest = 0;
  for (const Vec3& v : expected) fastest = std::max(fastest, glm::length(v));
  ASSERT_GT(fastest, 0);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_LE(glm::length(Vec3(after.velocities[i]) - expected[i]), 0x1p-10 * fastest) << "point " << i;
    const Vec3 place = Vec3(before.positions[i]) + model.cloth.step * Vec3(after.velocities[i]);
    ASSERT_LE(glm::length(Vec3(after.positions[i]) - place), 0x1p-22 * (glm::length(place) + 1))
        << "point " << i;
  }
}

TEST_F(ClothSteps, EachIsThatOfItsDefinition) {
  DeviceClothSimulation simulation(context());
  const Cloth cloth{.columns = 5,
                    .rows = 4,
                    .pins = {{0, 1}, {1, 0.5}},
                    .size = {1.2, 0.8},
                    .stretch = 90,
                    .shear = 20,
                    .bend = 0.05,
                    .damping = 0.7,
                    .gravity = {0.5, -9.81, 1},
                    .step = 0.004};
  const Model model(cloth);
  for (const std::uint32_t n : {0U, 1U, 40U, 200U})
    expectStep(model, simulation.stateAfter(cloth, n), simulation.stateAfter(cloth, n + 1),
               std::vector<bool>(model.masses.size()));
}

// All points are in the ball from the first step on: it touches each.
TEST_F(ClothSteps, OnABallEachIsThatOfItsDefinition) {
  DeviceClothSimulation simulation(context());
  const Cloth cloth{.columns = 4,
                    .rows = 3,
                    .size = {0.3, 0.3},
                    .step = 0.002,
                    .ballCenter = {0.01, -0.5, 0.02},
                    .ballRadius = 0.6};
  const Model model(cloth);
  expectStep(model, simulation.stateAfter(cloth, 0), simulation.stateAfter(cloth, 1),
             std::vector<bool>(model.masses.size(), true));
}

// A strip one cell wide, held at one end, along its own plane: the part below each spring hangs on it.
TEST_F(ClothSteps, AHangingStripStretchesByItsWeight) {
  DeviceClothSimulation simulation(context());
  const Cloth cloth{.columns = 1,
                    .rows = 8,
                    .pins = {{0, 1}, {1, 1}},
                    .size = {0.1, 0.8},
                    .density = 0.3,
                    .stretch = 40,
                    .shear = 0,
                    .bend = 0,
                    .damping = 8,
                    .gravity = {0, 0, 9.81},
                    .step = 0.004};
  const ClothState state = simulation.stateAfter(cloth, 3000);
  const Model model(cloth);
  double below = 0;
  for (std::uint32_t row = 0; row < cloth.rows; ++row) {  // from the free end
    below += 0.3 * 0.1 / 2 * 0.1 * (row == 0 ? 0.5 : 1);
    const double stiffness = 40 * (0.1 / 2) / 0.1;
    for (const std::uint32_t column : {0U, 1U}) {
      const Vec3f apart = state.positions[model.at(column, row)] - state.positions[model.at(column, row + 1)];
      EXPECT_NEAR(apart.z, 0.1 + below * 9.81 / stiffness, 2e-6) << "row " << row;
      EXPECT_NEAR(apart.x, 0, 1e-6);
    }
  }
  // The whole, whatever the cells: density g length^2 / (2 stretch).
  EXPECT_NEAR(state.positions[0].z - state.positions[model.at(0, 8)].z, 0.8 + 0.3 * 9.81 * 0.64 / (2 * 40),
              1e-5);
}

// After n steps it has fallen g h^2 n (n + 1) / 2, as one.
TEST_F(ClothSteps, AFreeClothFalls) {
  DeviceClothSimulation simulation(context());
  const Cloth cloth{.columns = 6, .rows = 6, .damping = 0, .step = 0.001};
  const ClothState state = simulation.stateAfter(cloth, 400);
  for (const Vec3f& place : state.positions) EXPECT_NEAR(place.y, -9.81 * 1e-6 * 400 * 401 / 2, 0x1p-12);
}

TEST_F(ClothSteps, AreAFunctionOfTheirNumber) {
  const Cloth cloth{.columns = 9, .rows = 9, .pins = {{0, 1}}, .ballCenter = {0, -0.4, 0}, .ballRadius = 0.3};
  DeviceClothSimulation direct(context()), wandering(context());
  const ClothState state = direct.stateAfter(cloth, clothSteps(cloth, 1.0));
  for (const double time : {0.3, 2.0, 0.5})
    static_cast<void>(wandering.stateAfter(cloth, clothSteps(cloth, time)));
  Cloth other = cloth;
  other.stretch = 80;
  static_cast<void>(wandering.stateAfter(other, 700));
  EXPECT_EQ(wandering.stateAfter(cloth, 1000), state);
  EXPECT_NE(wandering.stateAfter(other, 1000), state);
  EXPECT_EQ(wandering.surfaceAfter(cloth, 1000).identity(), wandering.surfaceAfter(cloth, 1000).identity());
}

// Nor does it matter that they were interrupted: what was done is not done again.
TEST_F(ClothSteps, GoOnWhereTheyWereInterrupted) {
  const Cloth cloth{.columns = 9, .rows = 9, .pins = {{0, 1}}};
  DeviceClothSimulation direct(context()), interrupted(context());
  const ClothState state = direct.stateAfter(cloth, 1000);
  const std::uint64_t submits = context().counters().submits;
  int asked = 0;
  interrupted.setInterruption([&] { return ++asked % 5 == 0; });
  for (const char* reached :
       {"after 256 of the 1000 steps", "after 512 of the 1000", "after 768 of the 1000"}) {
    try {
      static_cast<void>(interrupted.stateAfter(cloth, 1000));
      FAIL() << "not interrupted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Retry);
      EXPECT_THAT(error.what(), testing::HasSubstr(reached));
    }
  }
  EXPECT_EQ(interrupted.stateAfter(cloth, 1000), state);
  EXPECT_LE(context().counters().submits - submits, 16u) << "steps are done again";
  // What there is already takes no step.
  interrupted.setInterruption([] { return true; });
  EXPECT_EQ(interrupted.stateAfter(cloth, 1000), state);
}

// No point is deeper in the ball than what lies on it presses it: all its weight, on one point.
TEST_F(ClothSteps, ABallHoldsAClothUp) {
  DeviceClothSimulation simulation(context());
  const Cloth cloth{
      .columns = 16, .rows = 16, .damping = 1, .step = 0.001, .ballCenter = {0, -0.45, 0}, .ballRadius = 0.4};
  const Model model(cloth);
  const ClothState state = simulation.stateAfter(cloth, 1500);
  int lying = 0;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const double depth = model.depth(Vec3(state.positions[i]));
    lying += depth > 0;
    EXPECT_LT(depth, 0.2 * 9.81 / model.contact(i)) << "point " << i;
  }
  EXPECT_GT(lying, 20);
}

TEST_F(ClothSteps, NothingIsMadeBeforeAClothMoves) {
  const gpu::Counters before = context().counters();
  DeviceClothSimulation simulation(context());
  static_cast<void>(simulation.surfaceAfter(Cloth{}, 0));
  EXPECT_EQ(context().counters().objects, before.objects);
  static_cast<void>(simulation.surfaceAfter(Cloth{}, 1));
  EXPECT_EQ(context().counters().pipelinesCreated, before.pipelinesCreated + 1);
}

}  // namespace
}  // namespace luxo::test
