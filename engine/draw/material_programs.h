// SPDX-License-Identifier: Apache-2.0
// The programs of the shaders that a picture's materials have.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "cull/cull.h"
#include "draw/material_program.h"
#include "scene/snapshot.h"

namespace luxo {

/// Keeps those of the last pictures' shaders.
class MaterialPrograms {
 public:
  [[nodiscard]] const MaterialProgram& of(const MaterialShaderPtr& shader);
  /// Of all materials that are on something in the picture: MaterialProgram::check(). What is not used is
  /// logged, once.
  void check(const Snapshot& snapshot, const VisibleList& visible);
  /// Since the last time: shaders that no run before had.
  [[nodiscard]] std::uint64_t takeCompiled() { return std::exchange(compiled_, 0); }

 private:
  void tellShadows(const Snapshot& snapshot);

  std::map<MaterialShaderPtr, MaterialProgram> programs_;
  std::uint64_t compiled_ = 0;
  std::set<std::string> told_;
};

}  // namespace luxo
