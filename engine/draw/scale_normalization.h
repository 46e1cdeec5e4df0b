// SPDX-License-Identifier: Apache-2.0
// Objects in about the proportions in which the world has them. A formula may be a million times as long as
// it is thick and its node's scale make it round again: around such a surface no shell and no mesh is near by
// any one distance, as distances are measured in the object's space.
#pragma once

#include <array>
#include <map>
#include <utility>

#include "scene/snapshot.h"

namespace luxo {

class ScaleNormalization {
 public:
  /// The same world. Where transforms undo large differences of scale, surfaces are scaled by powers of two
  /// instead: what is left of the transform stretches all axes alike, within a factor of two. Valid until the
  /// next call. Cost: nothing where no node is of that kind; a surface is made when it is first seen.
  const Snapshot& of(const Snapshot& snapshot);

 private:
  struct Known {
    Surface from, scaled;
    bool used = false;
  };

  std::map<std::pair<const void*, std::array<double, 3>>, Known> known_;
  Snapshot evened_;
};

}  // namespace luxo
