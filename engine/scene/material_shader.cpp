// SPDX-License-Identifier: Apache-2.0
#include "scene/material_shader.h"

namespace luxo {

std::string TextPlace::describe(const std::string& message, const std::string& hint) const {
  if (text) return luxo::describe(name, *text, {where, message, hint});
  return hint.empty() ? message : message + "\n  help: " + hint;
}

}  // namespace luxo
