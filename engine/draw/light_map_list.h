// SPDX-License-Identifier: Apache-2.0
// What a light's depth map shows, and how points are compared with it.
#pragma once

#include <optional>
#include <span>

#include "draw/draw_list.h"

namespace luxo {

/// The map of these casters, as far as they may stand before `receivers` (world); nothing where none does.
/// `origin`: what positions are relative to. Throws Error(Scene) where its faces have too many texels.
[[nodiscard]] std::optional<LightMapDrawn> listLightMap(const SnapshotLight& light,
                                                        std::span<const SnapshotNode* const> casters,
                                                        const Box& receivers, const Vec3& origin,
                                                        MeshCache& meshes);

}  // namespace luxo
