// SPDX-License-Identifier: Apache-2.0
// From a model to what scenes are made of.
//
//     Scene scene = modelScene(readModel("lamp.glb"));
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/model.h"
#include "scene/scene.h"

namespace luxo {

/// All that a model shows at time 0, as one surface: its mesh as it is, where one stands at one place that is
/// not moved; else all of them, put together. Error(Scene): it shows nothing.
[[nodiscard]] Surface surfaceOf(const Model& model);

/// The scene of a model: its nodes with their movements, a node below for each material of a mesh that has
/// several; materials with their maps, cameras and lights. One without lights, unless it says how much
/// ambient light there is, gets two, of a picture from (1, 0.8, 1.5), where a camera that is fitted looks
/// from. Candela and lux are divided by pi: reflection here is not. Error(Scene): an image cannot be read.
[[nodiscard]] Scene modelScene(const std::shared_ptr<const Model>& model);

/// Adds a model below a node of a scene, as modelScene() has it, without cameras, and with no lights but its
/// own. Names of nodes follow the parent's and a slash. The nodes that have a surface. `materials`: the
/// model's in that scene; where there are none they are made. Errors as modelScene().
std::vector<NodeId> addModel(Scene& scene, NodeId parent, const std::shared_ptr<const Model>& model,
                             std::vector<MaterialId>& materials);

}  // namespace luxo
