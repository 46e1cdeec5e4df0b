// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_validation.h"

#include <fmt/format.h>
#include <spirv-tools/libspirv.hpp>

#include <string>

#include "base/error.h"
#include "base/printable.h"
#include "gpu/deep_stack.h"

namespace luxo::gpu {

void requireValid(std::span<const std::uint32_t> spirv) {
  std::string problem = "it is empty";  // of what is found first
  bool isValid = false;
  onDeepStack([&] {
    spvtools::SpirvTools tools(SPV_ENV_UNIVERSAL_1_6);
    tools.SetMessageConsumer(
        [&](spv_message_level_t, const char*, const spv_position_t& at, const char* message) {
          problem = fmt::format("at word {}: {}", at.index, printable(message));
        });
    spvtools::ValidatorOptions options;
    options.SetScalarBlockLayout(true);
    isValid = tools.Validate(spirv.data(), spirv.size(), options);
  });
  if (!isValid) throw Error(ErrorKind::Scene, fmt::format("this is no valid SPIR-V: {}", problem));
}

}  // namespace luxo::gpu
