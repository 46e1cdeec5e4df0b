# SPDX-License-Identifier: Apache-2.0
# GLSL -> SPIR-V -> validated -> a C array in a header <luxo/shaders/NAME.h>, so that a program carries its shaders.
# NAME is the file name with dots as underscores; the array is `luxo_NAME`.

find_program(LUXO_GLSLANG glslangValidator REQUIRED)
find_program(LUXO_SPIRV_OPT spirv-opt REQUIRED)
find_program(LUXO_SPIRV_VAL spirv-val REQUIRED)
find_package(SPIRV-Tools REQUIRED)
find_package(TBB REQUIRED)

function(luxo_shaders target)
  set(out ${PROJECT_BINARY_DIR}/generated/luxo/shaders)
  file(MAKE_DIRECTORY ${out})
  set(headers)
  foreach(source IN LISTS ARGN)
    get_filename_component(file ${source} NAME)
    string(REPLACE "." "_" name ${file})
    # Names and lines alone: the compiler of Debian 12 (12.0) crashes on some sources where it is to tell more (-gVS).
    set(compile ${LUXO_GLSLANG} --quiet --target-env vulkan1.3 -I${PROJECT_SOURCE_DIR}/shaders $<$<CONFIG:Debug>:-g>)
    # Of what a shader includes it keeps what it uses: drivers and pipelines hold all of a module in memory.
    add_custom_command(
      OUTPUT ${out}/${name}.spv
      COMMAND ${compile} --depfile ${out}/${name}.d -o ${out}/${name}.spv ${source}
      COMMAND ${LUXO_SPIRV_OPT} --target-env=vulkan1.3 --scalar-block-layout --eliminate-dead-functions --eliminate-dead-const
              ${out}/${name}.spv -o ${out}/${name}.spv
      COMMAND ${LUXO_SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout ${out}/${name}.spv
      DEPENDS ${source} DEPFILE ${out}/${name}.d
      COMMENT "Compiling shader ${file}" COMMAND_EXPAND_LISTS VERBATIM)
    add_custom_command(
      OUTPUT ${out}/${name}.h
      COMMAND ${CMAKE_COMMAND} -DFILE=${out}/${name}.spv -DNAME=luxo_${name} -DOUT=${out}/${name}.h
              -P ${PROJECT_SOURCE_DIR}/cmake/embed_words.cmake
      DEPENDS ${out}/${name}.spv ${PROJECT_SOURCE_DIR}/cmake/embed_words.cmake
      COMMENT "Embedding shader ${file}" COMMAND_EXPAND_LISTS VERBATIM)
    list(APPEND headers ${out}/${name}.h)
  endforeach()
  add_custom_target(${target}_spirv DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_spirv)
  # Installed, the headers that C++ and GLSL share lie beside those of the engine; bytes are in the libraries.
  target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
                             $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/shaders>)
endfunction()

# Texts that programs compile themselves: <luxo/shaders/sources.h> with `luxo::kShaderSources`, for targets that link
# `target`. The files are named by their paths below shaders/.
function(luxo_shader_sources target)
  set(out ${PROJECT_BINARY_DIR}/generated/luxo/shaders/sources.h)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/shaders/ OUTPUT_VARIABLE paths)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}/shaders "-DFILES=${ARGN}" -DOUT=${out}
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_sources.cmake
    DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/embed_sources.cmake
    COMMENT "Embedding shader sources" VERBATIM)
  add_custom_target(${target}_sources DEPENDS ${out})
  add_dependencies(${target} ${target}_sources)
endfunction()

# The exact shaders of the named surfaces and of scene files, in a library luxo_exact_table. Nothing else waits for them: most
# of the engine compiles meanwhile. The program that writes them compiles the texts of luxo_shader_sources(target). Under
# sanitizers that takes six times as long, as the optimiser does little but allocate: such builds may take the header that
# another build has written.
set(LUXO_EXACT_SHADERS "" CACHE FILEPATH "exact_shaders.h of another build of these sources, instead of one's own")
function(luxo_exact_shaders target source table)
  set(scenes ${ARGN})
  set(out ${PROJECT_BINARY_DIR}/generated/luxo/shaders/exact_shaders.h)
  if(LUXO_EXACT_SHADERS)
    add_custom_command(OUTPUT ${out} COMMAND ${CMAKE_COMMAND} -E copy ${LUXO_EXACT_SHADERS} ${out}
                       DEPENDS ${LUXO_EXACT_SHADERS} VERBATIM)
  else()
    add_executable(luxo_exact_shaders ${source})
    target_include_directories(luxo_exact_shaders PRIVATE ${PROJECT_BINARY_DIR}/generated)
    target_link_libraries(luxo_exact_shaders PRIVATE luxo_scene luxo_gpu SPIRV-Tools TBB::tbb)
    luxo_warnings(luxo_exact_shaders)
    add_dependencies(luxo_exact_shaders ${target}_sources)
    add_custom_command(
      OUTPUT ${out} COMMAND luxo_exact_shaders ${out} ${scenes} DEPENDS luxo_exact_shaders ${scenes}
      COMMENT "Compiling the exact shaders" VERBATIM)
  endif()
  add_library(luxo_exact_table STATIC ${table} ${out})
  target_compile_features(luxo_exact_table PUBLIC cxx_std_20)
  target_include_directories(luxo_exact_table PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/shaders>
                             PRIVATE ${PROJECT_BINARY_DIR}/generated)
  luxo_warnings(luxo_exact_table)
endfunction()
