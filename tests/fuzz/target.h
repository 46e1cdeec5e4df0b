// SPDX-License-Identifier: Apache-2.0
// What is fuzzed: each takes any bytes and aborts (LUXO_REQUIRE) when a promise does not hold.
#pragma once

#include <string_view>

namespace luxo {

/// Lines: the first is a formula of u, v and a parameter k, each other one a definition, name=formula.
/// Parsed, described, differentiated twice, compiled, evaluated on a grid, bounded over it.
void fuzzFormula(std::string_view input);

/// A scene file: read; if it is good, written, read again, built, and looked at at two moments.
void fuzzScene(std::string_view input);

/// Model files of each kind, beside which there are no others: read; if they are good, their meshes are held
/// to what triangle_mesh.h promises, and their nodes looked at at two moments.
void fuzzObj(std::string_view input);
void fuzzMtl(std::string_view input);
void fuzzPly(std::string_view input);
void fuzzStl(std::string_view input);
void fuzzGltf(std::string_view input);

/// An image file as a texture, as colours and as data: its levels are held to what texture.h promises.
void fuzzTexture(std::string_view input);

}  // namespace luxo
