// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "surface/catalogue.h"

namespace luxo::test {

/// Values of all arguments of a named surface, none the initial one: a little larger, lengths in
/// proportion, counts by one; smaller where that is too large.
[[nodiscard]] inline std::vector<SurfaceArgument> otherArguments(const CatalogueEntry& entry) {
  std::vector<SurfaceArgument> arguments;
  for (const CatalogueArgument& argument : entry.arguments) {
    SurfaceArgument& other = arguments.emplace_back(SurfaceArgument{std::string(argument.name), {}});
    for (const double initial : argument.initial) {
      const double more = argument.kind == ArgumentKind::Count ? initial + 1
                          : initial == 0                       ? 0.125
                                                               : initial * 1.0625;
      other.components.emplace_back(argument.range.contains(more) ? more : initial / 1.0625);
    }
  }
  return arguments;
}

}  // namespace luxo::test
