// SPDX-License-Identifier: Apache-2.0
// What finds the exact shadows of a picture: for each light, the casters that may keep it from what is seen.
#pragma once

#include <span>

#include "draw/draw_list.h"
#include "draw/material_list.h"

namespace luxo {

/// Fills the shadows of list.groups, for the lights that are left to do, and leaves to rays (list.byRays)
/// where no shader finds a shadow.
void listShadows(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                 Geometry& geometry, MaterialList& materials, DrawList& list);

/// Whether some of a light gets through what casts its shadow.
[[nodiscard]] bool transmits(const Snapshot& snapshot, const SnapshotLight& light);

/// Whether lights in lamp shades know where they light a point what their shades keep from it: but where they
/// are more than one set of lights has room for, and in pictures with light between vertices, which would not
/// tell where a shadow's border is.
[[nodiscard]] bool hasClosedForms(const Snapshot& snapshot, const DrawOptions& options);
/// Whether the shadow of a light has to be found; `closedForms`: hasClosedForms() of its picture.
[[nodiscard]] bool asksCasters(const SnapshotLight& light, bool closedForms);

/// Whether some light of a picture may have a shadow that has to be found.
[[nodiscard]] bool findsShadows(const Snapshot& snapshot, const DrawOptions& options);

}  // namespace luxo
