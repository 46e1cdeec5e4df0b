// SPDX-License-Identifier: Apache-2.0
// A shader in a window, its uniforms in its user's hands.
#pragma once

#include <string>

#include "options.h"
#include "shader_options.h"

namespace luxo {

/// Until its user closes the window; gives the exit code. Errors as openShader() and runViewer() have them;
/// but one of the shader itself, where that is there, is shown in the window until it is mended.
[[nodiscard]] int showShader(const std::string& shader, const ShaderUse& use, const RenderRequest& request);

}  // namespace luxo
