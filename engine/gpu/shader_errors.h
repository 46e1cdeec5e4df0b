// SPDX-License-Identifier: Apache-2.0
// What a compiler says of a shader, at the words that it is about.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "gpu/shader_compiler.h"

namespace luxo::gpu {

/// What `#include "..."` in a file of that name means: what is beside it, or whatever is called so; null:
/// nothing.
[[nodiscard]] const ShaderSource* includedSource(std::span<const ShaderSource> sources, std::string_view name,
                                                 std::string_view includer);

/// The source, and of its includes those that it may reach: where a text names one in a comment, too.
[[nodiscard]] std::vector<const ShaderSource*> reachedSources(const ShaderDesc& desc);

/// A shader with each word of its texts on a line of its own. A compiler tells lines and no columns: of these
/// it tells words. Directives, which are lines, stay whole. Single-threaded; `desc` must outlive it.
class WordLines {
 public:
  /// Cost: linear in what it reaches; so is that of explain().
  explicit WordLines(const ShaderDesc& desc);
  WordLines(const WordLines&) = delete;
  WordLines& operator=(const WordLines&) = delete;

  /// To be compiled instead: the same program. Valid as long as this.
  [[nodiscard]] const ShaderDesc& desc() const { return split_; }

  /// Of a message about that, "ERROR: lib/pattern.glsl:12: 'foo' : undeclared identifier", what people read:
  /// at the line and column of the word in the text as they wrote it (base/diagnostic.h). What a macro stands
  /// for has the place where it is used. Other messages as they are;
  /// empty: it says no more than others have.
  [[nodiscard]] std::string explain(std::string_view message) const;

 private:
  struct File {
    const ShaderSource* source = nullptr;
    std::string text;                 ///< a word on each line
    std::vector<SourceRange> places;  ///< of each line, in the source's text
  };

  [[nodiscard]] static File split(const ShaderSource& source);
  /// Of what a message quotes and tells the line of, in the source's text; and the macro that stands there
  /// for it, or nothing.
  struct Place {
    SourceRange where;
    std::string_view macro = {};
  };
  [[nodiscard]] Place placeOf(const File& file, std::size_t line, std::string_view quoted) const;
  /// The same in what people wrote, of which the text has words more, or less, or spelled otherwise.
  [[nodiscard]] SourceRange shown(const ShaderSource& source, const SourceRange& where) const;
  [[nodiscard]] std::string asShown(std::string_view text) const;

  const ShaderDesc& of_;
  std::vector<File> files_;  ///< the shader's own first
  std::vector<ShaderSource> includes_;
  ShaderDesc split_;
  std::set<std::string_view> macros_;  ///< that people wrote
};

}  // namespace luxo::gpu
