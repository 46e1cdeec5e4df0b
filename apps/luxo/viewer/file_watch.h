// SPDX-License-Identifier: Apache-2.0
// Tells when one of some files has been saved.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <thread>
#include <vector>

namespace luxo {

/// Watches their folders, since editors save by renaming: a file itself may be another one each time. Looks
/// at nothing while nothing happens there. Behind a symbolic link, the folder of its target is watched, too.
class FileWatch {
 public:
  /// `notify` is called from another thread after a file was saved. Where the system cannot watch one a
  /// warning is logged.
  FileWatch(const std::vector<std::filesystem::path>& files, std::function<void()> notify);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Whether one was saved since the last time.
  [[nodiscard]] bool takeSaved() { return saved_.exchange(false); }

 private:
  struct Descriptor {
    int number = -1;
    ~Descriptor();
  };
  struct Place {
    int watch = -1;
    std::string name;  ///< of the file in the watched folder
  };

  void watch(const std::filesystem::path& file);
  void add(const std::filesystem::path& file);
  void listen();

  std::function<void()> notify_;
  Descriptor events_, end_;
  std::vector<Place> places_;
  std::atomic<bool> saved_ = false;
  std::thread listener_;
};

}  // namespace luxo
