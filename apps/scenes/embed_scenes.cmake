# SPDX-License-Identifier: Apache-2.0
# cmake -DSCENES=<files> -DGALLERY_SCENES=<files> -DGALLERY_SHADERS=<files> -DOUT=<source> -P embed_scenes.cmake
# Writes files as C++ strings, each with its name: the file's, without .luxo.json. As bytes: a string literal has an
# upper limit, a scene file has none.

set(text "#include \"scenes/embedded_scenes.h\"\n\n#include <array>\n\nnamespace luxo {\n")

# A function of that name, which gives the files as values of that type.
function(embed function type prefix)
  list(SORT ARGN)
  set(arrays)
  set(entries)
  foreach(file IN LISTS ARGN)
    get_filename_component(name ${file} NAME)
    string(REPLACE ".luxo.json" "" name ${prefix}${name})
    string(MAKE_C_IDENTIFIER ${name} identifier)
    file(READ ${file} hex HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
    string(APPEND arrays "constexpr char k_${identifier}[] = {${bytes}};\n")
    string(APPEND entries "    {\"${name}\", {k_${identifier}, sizeof k_${identifier}}},\n")
  endforeach()
  list(LENGTH ARGN count)
  string(APPEND text "namespace {\n\n${arrays}constexpr std::array<${type}, ${count}> k_${function} = {{\n${entries}}};\n\n"
    "}  // namespace\n\nstd::span<const ${type}> ${function}() { return k_${function}; }\n\n")
  set(text "${text}" PARENT_SCOPE)
endfunction()

embed(embeddedScenes EmbeddedScene "" ${SCENES})
embed(galleryScenes EmbeddedScene gallery/ ${GALLERY_SCENES})
embed(galleryShaders EmbeddedShader gallery/ ${GALLERY_SHADERS})
file(WRITE ${OUT} "${text}}  // namespace luxo\n")
