// SPDX-License-Identifier: Apache-2.0
#include "output_files.h"

#include <fmt/format.h>

#include <system_error>

#include "base/error.h"
#include "image/file.h"

namespace luxo {

namespace fs = std::filesystem;

bool sameFile(const fs::path& a, const fs::path& b) {
  std::error_code failure;
  const fs::file_status ofA = fs::status(a, failure), ofB = fs::status(b, failure);
  if ((fs::exists(ofA) && !fs::is_regular_file(ofA)) || (fs::exists(ofB) && !fs::is_regular_file(ofB)))
    return false;
  if (fs::exists(ofA) && fs::exists(ofB)) return fs::equivalent(a, b, failure);
  if (a.filename() != b.filename()) return false;  // cheap, as sequences ask for each of their files
  // weakly_canonical() leaves a name without a folder as it is.
  const fs::path pathA = fs::weakly_canonical(fs::absolute(a, failure), failure);
  return !failure && pathA == fs::weakly_canonical(fs::absolute(b, failure), failure) && !failure;
}

void requireOutputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs) {
  const auto refuseIfSame = [](const NamedFile& output, const NamedFile& other) {
    if (output.path.empty() || other.path.empty() || !sameFile(output.path, other.path)) return;
    throw Error(ErrorKind::Usage,
                fmt::format("{} '{}' would overwrite {}", output.what, output.path.string(), other.what),
                "choose another name");
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const NamedFile& input : inputs) refuseIfSame(outputs[i], input);
    for (std::size_t j = 0; j < i; ++j) refuseIfSame(outputs[i], outputs[j]);
  }
  for (const NamedFile& output : outputs)
    if (!output.path.empty()) requireWritable(output.path);
}

}  // namespace luxo
