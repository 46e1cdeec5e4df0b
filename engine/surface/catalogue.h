// SPDX-License-Identifier: Apache-2.0
// The named surfaces as data: what each is called, its equation, where it comes from, its arguments with
// their meaning and range, and how it is made. Scene files, their schema, the documentation and the C++
// functions of surface/library.h all read this one table. surface/CATALOGUE.md shows it to people.
//
// Common conventions: the axis is +Y; u and v run over the unit square; u goes around the axis from +X toward
// -Z (right-handed about +Y), v along the axis or outward; lengths in metres, angles in radians.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/animated.h"
#include "math/interval.h"
#include "surface/surface.h"

namespace luxo {

enum class ArgumentKind {
  Length,  ///< metres
  Number,  ///< a pure number
  Angle,   ///< radians
  Count,   ///< a whole number that decides the formula's structure: constant
};

/// One named input of a surface.
struct CatalogueArgument {
  std::string_view name, meaning;
  ArgumentKind kind = ArgumentKind::Length;
  std::vector<double> initial;  ///< used where the author says nothing; its size = how many numbers it takes
  Interval range;               ///< what each number may be, ends included
  bool fixed = false;           ///< must be constant, because the surface is not one formula of it

  /// Whether it may be a formula of time and parameters.
  [[nodiscard]] bool mayMove() const { return !fixed && kind != ArgumentKind::Count; }
};

/// A value of the argument `name`; as many components as the table asks for, each constant or moving.
struct SurfaceArgument {
  std::string name;
  std::vector<Animated<double>> components;
};

class SurfaceInputs;

struct CatalogueEntry {
  std::string_view name, summary;
  std::string_view equation;  ///< in the y-up frame; u and v as in the conventions, phi = 2 pi u
  std::string_view source;    ///< where the equation can be looked up
  std::vector<CatalogueArgument> arguments;
  std::string_view requirement;  ///< what the arguments must fulfil together, in words; empty: nothing

  // What topology gives for the initial arguments.
  bool borderless = false;      ///< every edge is joined or collapsed
  bool orientable = true;       ///< has two sides
  int eulerCharacteristic = 1;  ///< of the whole surface, seams, poles and apexes closed

  // For makeSurface() only. The components of all arguments, in order, are what `meets` reads.
  bool (*meets)(std::span<const double> components) = nullptr;
  std::uint32_t patchConstants = 0;
  Surface (*make)(const SurfaceInputs& inputs) = nullptr;
};

/// All named surfaces, in the order in which a reader should meet them.
[[nodiscard]] std::span<const CatalogueEntry> catalogue();

/// The entry of that name, or null.
[[nodiscard]] const CatalogueEntry* findCatalogueEntry(std::string_view name);

/// Arguments left out take their initial values. Constant ones are folded into the formula, moving ones
/// become its free parameters: changing them never compiles anything. Throws Error(Scene) that names the
/// surface, the argument, its value and what is allowed: for an argument that is unknown, given twice, has
/// the wrong number of components, must not move, or is out of range; for arguments that do not go together
/// (a torus whose tube is thicker than its ring). Moving arguments are checked at every moment they are asked
/// for. Without arguments it is the same surface each time. The topology is that of the moment `start`, which
/// must have what moving arguments read.
[[nodiscard]] Surface makeSurface(const CatalogueEntry& entry,
                                  std::span<const SurfaceArgument> arguments = {}, const Moment& start = {});
/// As above, by name. Throws Error(Scene) with a suggestion when there is no such surface.
[[nodiscard]] Surface makeSurface(std::string_view name, const std::vector<SurfaceArgument>& arguments = {},
                                  const Moment& start = {});

}  // namespace luxo
