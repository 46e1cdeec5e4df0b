// SPDX-License-Identifier: Apache-2.0
// The lights that reach a node, as shaders read them: those with a shadow last.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "draw/options.h"
#include "scene/snapshot.h"
#include "shared/scene_data.h"

namespace luxo {

/// Whether more lights may reach a node that is lit than a set has room for: it is lit by one group after the
/// other then, in deferred form.
[[nodiscard]] inline bool hasManyLights(const Snapshot& snapshot, const DrawOptions& options) {
  return snapshot.lights.size() > shared::kMaxLights && !showsData(options.shading) &&
         options.shading != Shading::Wireframe;
}

/// Collects the distinct sets of lights of a picture; equal sets share one entry.
class LightSets {
 public:
  /// All three must outlive this. The first set has no light: draws without any have one to bind.
  /// `origin`: shadingOrigin().
  LightSets(const Snapshot& snapshot, const DrawOptions& options, const Vec3& origin,
            std::vector<shared::LightSet>& sets);

  struct Choice {
    std::uint32_t index = 0, plain = 0, shaded = 0;
    std::uint32_t spots = 0;    ///< which of them are spots, a bit each
    std::uint32_t shadeOf = 0;  ///< ShadeData::number of the lights that it is the shade of; 0: of none
    std::vector<std::uint32_t> lights = {};  ///< indices into Snapshot::lights, in the set's order
  };

  /// The set of the lights (indices into Snapshot::lights) that reach a node. Throws Error(Scene) when these
  /// are more than a shader takes (shared::kMaxLights).
  [[nodiscard]] Choice choose(std::span<const std::uint32_t> lights, const SnapshotNode& node);

 private:
  [[nodiscard]] shared::ShadeData shadeData(const ShadeRule& rule) const;
  [[nodiscard]] bool isShaded(const SnapshotLight& light) const { return closedForms_ && light.shade; }
  std::uint32_t indexOf(const std::vector<std::uint32_t>& order);
  [[nodiscard]] shared::LightSet build(const std::vector<std::uint32_t>& order) const;
  /// From 1, of the first of the shaded lights that sit in the caster; 0 where none does.
  [[nodiscard]] std::uint32_t numberOf(NodeId caster, std::span<const std::uint32_t> shaded) const;

  const Snapshot& snapshot_;
  const DrawOptions& options_;
  bool closedForms_;
  Vec3 origin_;
  std::vector<shared::LightSet>& sets_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known_;
};

}  // namespace luxo
