# SPDX-License-Identifier: Apache-2.0
# The architecture as data: every folder of engine/, in flow order, with the folders it may include and link.
# engine/CMakeLists.txt builds one library per row; the test `lint.layers` fails on any include a row does not name.

set(LUXO_LAYERS base math formula mesh surface scene cull tessellate export shell shadow gpu image reference draw window)

set(LUXO_LAYER_base)
set(LUXO_LAYER_math base)
set(LUXO_LAYER_formula base math)
set(LUXO_LAYER_mesh base math image)
set(LUXO_LAYER_surface base math formula mesh)
set(LUXO_LAYER_scene base math formula image mesh surface)
set(LUXO_LAYER_cull base math mesh surface scene)
set(LUXO_LAYER_tessellate base math mesh surface)
set(LUXO_LAYER_export base math image mesh surface scene tessellate)
set(LUXO_LAYER_shell base math surface tessellate)
set(LUXO_LAYER_shadow base math surface tessellate)
set(LUXO_LAYER_gpu base)
set(LUXO_LAYER_image base)
set(LUXO_LAYER_reference base math formula surface scene image)
set(LUXO_LAYER_draw base math formula mesh surface scene cull tessellate shell shadow gpu image reference)
set(LUXO_LAYER_window base math gpu)

# Third-party headers that only the named folders may include: "<header regex>" -> folders.
set(LUXO_EXCLUSIVE_INCLUDES "vulkan/" "glslang/" "spirv_cross" "GLFW/" "imgui" "glm/" "png\\.h" "Imf" "tbb/" "spirv-tools/" "meshoptimizer" "nlohmann/" "jpeglib")
set(LUXO_EXCLUSIVE_vulkan/ gpu)
set(LUXO_EXCLUSIVE_glslang/ gpu)
set(LUXO_EXCLUSIVE_spirv_cross gpu)
set(LUXO_EXCLUSIVE_GLFW/ window)
set(LUXO_EXCLUSIVE_imgui window)
set(LUXO_EXCLUSIVE_glm/ math)
set(LUXO_EXCLUSIVE_png\\.h image)
set(LUXO_EXCLUSIVE_Imf image)
set(LUXO_EXCLUSIVE_tbb/ mesh tessellate shell gpu reference draw)
set(LUXO_EXCLUSIVE_spirv-tools/ gpu)
set(LUXO_EXCLUSIVE_meshoptimizer mesh)
set(LUXO_EXCLUSIVE_nlohmann/ mesh)
set(LUXO_EXCLUSIVE_jpeglib image)
