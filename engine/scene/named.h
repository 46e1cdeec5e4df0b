// SPDX-License-Identifier: Apache-2.0
// The things of a scene file by name, while the scene is built.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/suggestion.h"
#include "scene/scene_file.h"
#include "scene/scene_problems.h"

namespace luxo {

/// Things of one kind by name, for the references to them.
template <class Thing>
class Named {
 public:
  explicit Named(std::string_view kind) : kind_(kind) {}

  void add(const FileName& name, Thing thing, SceneProblems& problems) {
    if (!things_.emplace(name.text, thing).second)
      problems.add(name.place, fmt::format("there are two {}s '{}'", kind_, name.text));
  }

  /// The first of a name stays.
  void addFirst(const FileName& name, Thing thing) { things_.emplace(name.text, thing); }

  /// Nothing for an empty name and, which is a problem, for one that does not exist.
  [[nodiscard]] const Thing* find(const FileName& name, SceneProblems& problems) const {
    if (name.empty()) return nullptr;
    const auto found = things_.find(name.text);
    if (found != things_.end()) return &found->second;
    if (problems.full()) {
      problems.add(name.place, {});
      return nullptr;
    }
    constexpr std::size_t kMaxToCompare = 1000;
    std::vector<std::string> names;
    for (const auto& [known, thing] : things_)
      if (names.size() < kMaxToCompare) names.emplace_back(known);
    std::ranges::sort(names);
    constexpr std::size_t kFew = 12;
    problems.add(name.place, fmt::format("there is no {} '{}'", kind_, name.text),
                 didYouMean(name.text, names,
                            names.empty()          ? fmt::format("the scene has no {}s", kind_)
                            : names.size() <= kFew ? fmt::format("the {}s are {}", kind_, listed(names))
                                                   : std::string()));
    return nullptr;
  }

 private:
  std::string_view kind_;
  std::unordered_map<std::string_view, Thing> things_;
};

}  // namespace luxo
