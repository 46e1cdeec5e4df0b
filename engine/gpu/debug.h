// SPDX-License-Identifier: Apache-2.0
// Names and labels that validation messages, RenderDoc and friends show. Free without VK_EXT_debug_utils.
#pragma once

#include "gpu/context.h"
#include "gpu/object.h"
#include "gpu/vk.h"

#include <string_view>

namespace luxo::gpu {

/// Names an object; nothing for an empty name.
template <class T>
void setName(const Context& context, T object, std::string_view name) {
  context.setName(objectType(object), reinterpret_cast<std::uint64_t>(object), name);
}

/// Groups the commands recorded while it lives.
class Label {
 public:
  Label(const Context& context, VkCommandBuffer commands, std::string_view name)
      : context_(context), commands_(commands) {
    context_.beginLabel(commands_, name);
  }
  ~Label() { context_.endLabel(commands_); }
  Label(const Label&) = delete;
  Label& operator=(const Label&) = delete;

 private:
  const Context& context_;
  VkCommandBuffer commands_;
};

}  // namespace luxo::gpu
