// SPDX-License-Identifier: Apache-2.0
#include "image/file_source.h"

#include <fmt/format.h>

#include <system_error>

#include "base/error.h"
#include "base/printable.h"
#include "image/file.h"

namespace luxo {

bool FileSource::has(const std::filesystem::path& path) const {
  std::error_code ignored;
  return isDisk() ? std::filesystem::is_regular_file(path, ignored)
                  : files_->contains(path.lexically_normal().string());
}

std::uintmax_t FileSource::sizeOf(const std::filesystem::path& path) const {
  std::error_code ignored;
  return isDisk() ? std::filesystem::file_size(path, ignored) : read(path)->size();
}

FileBytes FileSource::read(const std::filesystem::path& path) const {
  if (isDisk()) return std::make_shared<const std::vector<std::byte>>(readFile(path));
  const auto file = files_->find(path.lexically_normal().string());
  if (file == files_->end())
    throw Error(ErrorKind::Scene,
                fmt::format("cannot read '{}': it is not among the files that the scene carries",
                            printable(path.string())));
  return file->second;
}

}  // namespace luxo
