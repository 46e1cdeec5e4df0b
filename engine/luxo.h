// SPDX-License-Identifier: Apache-2.0
// The one include for users of luxo: surfaces, scenes, the renderer, images.
#pragma once

#include "draw/renderer.h"
#include "export/exported_model.h"
#include "image/compare.h"
#include "image/format.h"
#include "image/image.h"
#include "mesh/model.h"
#include "mesh/model_writer.h"
#include "scene/model_scene.h"
#include "scene/scene.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"
#include "surface/catalogue.h"
#include "surface/cloth.h"
#include "surface/library.h"
#include "surface/surface.h"
