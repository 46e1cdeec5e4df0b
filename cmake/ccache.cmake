# SPDX-License-Identifier: Apache-2.0
# Compilations go through ccache where it is installed. Paths below the source tree are seen relative to the
# build folder, so that sibling build folders (build/release, build/no-window) share what compiles alike; so do
# builds by ctest, which sets a locale.

if(NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(LUXO_CCACHE ccache)
  if(LUXO_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_SLOPPINESS=locale
        ${LUXO_CCACHE})
  endif()
endif()
