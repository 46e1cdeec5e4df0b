# SPDX-License-Identifier: Apache-2.0
# cmake --install: the programs, the libraries with their headers (include/luxo), and what find_package(luxo) reads.

set(config lib/cmake/luxo)
set(libraries luxo luxo_scene_shaders luxo_exact_table)
if(LUXO_WINDOW)
  list(APPEND libraries luxo_window_shaders)
endif()
foreach(layer IN LISTS LUXO_LAYERS)
  if(TARGET luxo_${layer})
    list(APPEND libraries luxo_${layer})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/engine/${layer} DESTINATION include/luxo FILES_MATCHING PATTERN *.h)
  endif()
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/engine/luxo.h DESTINATION include/luxo)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/shared DESTINATION include/luxo FILES_MATCHING PATTERN *.h)
install(TARGETS ${libraries} EXPORT luxo ARCHIVE DESTINATION lib)
install(EXPORT luxo NAMESPACE luxo:: FILE luxoTargets.cmake DESTINATION ${config})

include(CMakePackageConfigHelpers)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/luxoConfig.cmake.in ${PROJECT_BINARY_DIR}/luxoConfig.cmake
                              INSTALL_DESTINATION ${config})
# Before 1.0 every minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/luxoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/luxoConfig.cmake ${PROJECT_BINARY_DIR}/luxoConfigVersion.cmake DESTINATION ${config})

if(LUXO_APPS)
  install(TARGETS luxo_program luxo_grandpa RUNTIME DESTINATION bin)
endif()
