// SPDX-License-Identifier: Apache-2.0
// What is behind a surface, and the hash-consing of it: formulas that are made alike are one description.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "surface/surface.h"
#include "surface/surface_triangles.h"

namespace luxo {

struct SurfaceDescription {
  std::vector<Patch> patches;
  SurfaceTraits traits;
  std::vector<double> initial;  ///< of the patches' parameters
  std::size_t parameterCount = 0;
  std::optional<SurfaceTriangles> triangles;  ///< instead of patches

  // What follows from these.
  Domain domain;
  Topology topology;
  // Proven bounds of a surface without parameters never change: they are found when first asked for.
  mutable std::once_flag boundsOnce, partialsOnce;
  mutable Box bounds;
  mutable PartialBounds partials;
};

/// Whether two descriptions of patches say the same, bit by bit: all that follows from them is the same,
/// then. Of formulas that are written in two ways it says no.
[[nodiscard]] bool madeAlike(const SurfaceDescription& a, const SurfaceDescription& b);

/// The descriptions of patches that surfaces have now; it keeps none alive. Safe from any thread.
class SurfaceDescriptions {
 public:
  /// Of all surfaces.
  [[nodiscard]] static SurfaceDescriptions& all();

  /// Null: there is none that is made like it. Cost: linear in the formula.
  [[nodiscard]] std::shared_ptr<const SurfaceDescription> find(const SurfaceDescription& like);
  /// The one that is made like it, and was there before; else itself.
  [[nodiscard]] std::shared_ptr<const SurfaceDescription> add(
      const std::shared_ptr<const SurfaceDescription>& description);

 private:
  [[nodiscard]] std::shared_ptr<const SurfaceDescription> findLocked(std::uint64_t hash,
                                                                     const SurfaceDescription& like);
  void forgetTheGone();

  std::mutex mutex_;
  std::unordered_multimap<std::uint64_t, std::weak_ptr<const SurfaceDescription>> byHash_;
  std::size_t mostBeforeLook_ = 64;  ///< entries, before those of surfaces that are gone are taken out
};

}  // namespace luxo
