// SPDX-License-Identifier: Apache-2.0
// Model files that tests write and read.
#pragma once

#include <fstream>
#include <string>

#include "base/error.h"
#include "mesh/model.h"
#include "unit/image_test_support.h"
#include "unit/mesh_test_support.h"

namespace luxo {

class ModelFolder : public ScratchFolder {
 public:
  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(*this / name, std::ios::binary) << bytes;
  }
  [[nodiscard]] Model read(const std::string& name, std::string_view bytes,
                           const ModelOptions& options = {}) const {
    write(name, bytes);
    return readModel(*this / name, options);
  }
  /// What is said of a file that cannot be read; empty if it can.
  [[nodiscard]] std::string refusal(const std::string& name, std::string_view bytes) const {
    try {
      (void)read(name, bytes);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      return error.what();
    }
    return {};
  }
};

}  // namespace luxo
