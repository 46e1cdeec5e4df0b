// SPDX-License-Identifier: Apache-2.0
// The named surfaces, for tests that are made for each.
#pragma once

#include <string>
#include <vector>

#include "surface/catalogue.h"

namespace luxo {

inline std::vector<std::string> catalogueNames() {
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : catalogue()) names.emplace_back(entry.name);
  return names;
}

}  // namespace luxo
