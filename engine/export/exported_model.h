// SPDX-License-Identifier: Apache-2.0
// A scene at one moment -> a model, whose triangles are proven to be near the scene's surfaces.
//
//     const ExportedModel ring = exportedModel(scene, 0, {.tolerance = 1e-5, .kept = keptBy("ring.stl")});
//     filesOf(ring.model, "ring.stl", ring.claim);      // mesh/model_writer.h
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesh/model.h"
#include "mesh/model_writer.h"
#include "scene/scene.h"

namespace luxo {

struct ExportDesc {
  /// Metres in the world, positive: how far triangles may be from their surfaces, what rounding to single
  /// precision moves them included. Where that alone takes half of it, or tessellation reaches its limits
  /// (tessellate/tessellator.h), it is met as far as it can be, and the claim says how far. None: a 2000th of
  /// the diagonal of all that is shown.
  std::optional<double> tolerance = std::nullopt;
  /// Metres in the world; 0: none. Surfaces that are open become plates.
  double thickness = 0;
  CameraId camera = {};  ///< the model's first; none: the scene's first
  /// What the file keeps; of what it does not, as far as the scene has it, there is a warning. Kept::All is a
  /// GLB: it has maps, and the uvs for them (not of plates, nor of normals in the axes of the object), light
  /// and background. Kept::Materials is an OBJ: it has the maps, too, that an MTL can say. All but a GLB have
  /// coordinates in the world, in single precision.
  Kept kept = Kept::All;
  bool ownLights = true;  ///< false: luxo lights a model that has none, and nothing is lost with these lights
  /// Called now and then, in the caller's thread, with the part that is done: 0 to 1, ascending. It may
  /// throw.
  std::function<void(double)> progress = {};
};

struct ExportedModel {
  Model model;  ///< a node, without a parent, for each visible node with a surface, each camera, each light
  ModelClaim claim;
  std::vector<std::string> warnings;  ///< what a model cannot say of the scene
};

/// Nodes of one surface and one material share a mesh. Those whose place is no rotation and scale, and
/// plates, stand in the world as they are. A colour that is a formula becomes its mean; lights that do not
/// fall off with distance are as bright as they are at the middle of the scene; soft ones shine from theirs.
/// Images are of 8 bits, as large as the textures; between vertices uvs are linear. `segments` of nodes are
/// not looked at: the tolerance decides. Error(Scene): what takeSnapshot() says, nothing that is visible has
/// an area. Cost: that of tessellating each surface, and of triangleMesh().
[[nodiscard]] ExportedModel exportedModel(const Scene& scene, double timeSeconds, const ExportDesc& desc);

}  // namespace luxo
