// SPDX-License-Identifier: Apache-2.0
// File names of numbered frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace luxo {

/// A file name in which `####`, `%d`, `%04d`, `{frame}` or `{frame:04}` stands for the frame's number, padded
/// with zeros to that many digits. Folders are taken as they are.
class FrameNames {
 public:
  /// Several frames in a name without a place for the number get `.0001` before the suffix.
  /// Error(Usage): a placeholder of another shape, such as `%4d` or `{frame:x}`.
  FrameNames(const std::filesystem::path& pattern, bool severalFrames);

  [[nodiscard]] std::filesystem::path of(int frame) const;

  /// True when a place for the number had to be added; worth telling the user.
  [[nodiscard]] bool numberAdded() const { return numberAdded_; }

 private:
  /// A text and, except after the last, the number with at least `digits` digits.
  struct Piece {
    std::string text;
    int digits = -1;  ///< -1: no number follows
  };

  std::filesystem::path folder_;
  std::vector<Piece> pieces_;
  bool numberAdded_ = false;
};

}  // namespace luxo
