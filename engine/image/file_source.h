// SPDX-License-Identifier: Apache-2.0
// Where files are read from: the disk, or memory that holds them by their paths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace luxo {

using FileBytes = std::shared_ptr<const std::vector<std::byte>>;
/// By lexically normal paths.
using FilesInMemory = std::map<std::string, FileBytes>;

/// Copies are cheap. Reading is safe from any thread.
class FileSource {
 public:
  FileSource() = default;  ///< the disk
  /// These files alone: what reads them never reads the disk.
  explicit FileSource(FilesInMemory files)
      : files_(std::make_shared<const FilesInMemory>(std::move(files))) {}

  [[nodiscard]] bool isDisk() const { return files_ == nullptr; }
  /// Whether there is a regular file.
  [[nodiscard]] bool has(const std::filesystem::path& path) const;
  /// In bytes, without reading it. Required: there is a regular file.
  [[nodiscard]] std::uintmax_t sizeOf(const std::filesystem::path& path) const;
  /// Error(Scene): there is no such file; of the disk what readFile() says.
  [[nodiscard]] FileBytes read(const std::filesystem::path& path) const;

 private:
  std::shared_ptr<const FilesInMemory> files_;
};

}  // namespace luxo
