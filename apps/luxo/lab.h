// SPDX-License-Identifier: Apache-2.0
// A shader in a window, its uniforms in its user's hands.
#pragma once

#include <string>

#include "options.h"
#include "shader_options.h"

namespace luxo {

/// Until its user closes the window; gives the exit code. Errors as openShader() and runViewer() have them.
[[nodiscard]] int showShader(const std::string& shader, const ShaderUse& use, const RenderRequest& request);

}  // namespace luxo
