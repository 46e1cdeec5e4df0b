# SPDX-License-Identifier: Apache-2.0
# cmake -DFILES=<scene files> -DOUT=<source> -P embed_scenes.cmake
# Writes scene files as C++ strings, each with its name: the file's, without .luxo.json. As bytes: a string
# literal has an upper limit, a scene file has none.

list(SORT FILES)
set(arrays)
set(entries)
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  string(REPLACE ".luxo.json" "" name ${name})
  string(MAKE_C_IDENTIFIER ${name} identifier)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
  string(APPEND arrays "constexpr char k_${identifier}[] = {${bytes}};\n")
  string(APPEND entries "    {\"${name}\", {k_${identifier}, sizeof k_${identifier}}},\n")
endforeach()
list(LENGTH FILES count)
file(WRITE ${OUT} "#include \"scenes/embedded_scenes.h\"\n\n#include <array>\n\nnamespace luxo {\nnamespace {\n\n${arrays}"
  "constexpr std::array<EmbeddedScene, ${count}> kScenes = {{\n${entries}}};\n\n}  // namespace\n\n"
  "std::span<const EmbeddedScene> embeddedScenes() { return kScenes; }\n\n}  // namespace luxo\n")
