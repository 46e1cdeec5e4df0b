// SPDX-License-Identifier: Apache-2.0
// Wavefront's MTL: materials of OBJ files.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "mesh/model_source.h"

namespace luxo {

using MtlLibrary = std::unordered_map<std::string, ModelMaterial>;

/// Adds the materials of a file; the first of a name stays. Numbers are linear. Kd, Ks, Ns, Ke, d and Tr, and
/// map_Kd, map_Ks, map_Ke, norm and map_Bump with -o, -s, -clamp and -bm are read. A map of a colour that is
/// not given, or black, is taken as it is (the colour is 1). Ka is not: programs write 1 1 1 whatever the
/// colour is, so the ambient colour is the diffuse one. map_Bump is taken for a normal map, with a warning;
/// map_d only as the alpha of the same image as map_Kd. Of maps that are not read there is a warning, one for
/// each of their words.
void readMtl(const ModelSource& source, std::string_view name, std::string_view text, Model& model,
             MtlLibrary& library);

}  // namespace luxo
