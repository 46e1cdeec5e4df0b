// SPDX-License-Identifier: Apache-2.0
#include "scene/shader_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "base/error.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;

std::string readText(const fs::path& path, const FileSource& from) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::Scene, fmt::format("cannot read the shader '{}': {}", path.string(), why));
  };
  std::error_code failure;
  if (!from.has(path))
    refuse(from.isDisk() && fs::exists(path, failure) ? "it is no regular file" : "there is no such file");
  if (const std::uintmax_t size = from.sizeOf(path); size > kMaxShaderBytes)
    refuse(fmt::format("it has {} bytes; at most {} are read", size, kMaxShaderBytes));
  const FileBytes bytes = from.read(path);
  std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (text.find('\0') != text.npos) refuse("it is no text");
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

struct Include {
  std::string name;
  SourceRange where;
};

/// The next `#include "..."` that begins a line. One in a comment counts, too: its file is read, and not
/// used.
std::optional<Include> nextInclude(const std::string& text, std::size_t from) {
  for (std::size_t at = text.find('#', from); at != text.npos; at = text.find('#', at + 1)) {
    const std::size_t line = text.rfind('\n', at) + 1;  // 0 where there is none
    if (text.find_first_not_of(" \t", line) != at) continue;
    const std::size_t word = text.find_first_not_of(" \t", at + 1);
    if (word == text.npos || text.compare(word, 7, "include") != 0) continue;
    const std::size_t end = std::min(text.find('\n', at), text.size()), open = text.find('"', word);
    const std::size_t close = open < end ? text.find('"', open + 1) : text.npos;
    if (close < end) return Include{text.substr(open + 1, close - open - 1), {open, close + 1}};
  }
  return std::nullopt;
}

}  // namespace

const MaterialShader::File kFixedFragments = {
    "fixed functionality", "void main() { gl_FragColor = gl_Color * texture2D(0, gl_TexCoord[0].st); }\n"};

std::vector<fs::path> filesNamedBy(const fs::path& shader) {
  std::vector<fs::path> files{shader.lexically_normal()};
  for (std::size_t i = 0; i < files.size() && i < kMaxShaderFiles; ++i) {
    std::string text;
    try {
      text = readText(files[i], {});
    } catch (const Error&) {
      continue;
    }
    std::size_t from = 0;
    while (const std::optional<Include> include = nextInclude(text, from)) {
      from = include->where.end;
      fs::path file = (files[i].parent_path() / include->name).lexically_normal();
      if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
    }
  }
  return files;
}

void ShaderFiles::addIncluded(std::vector<MaterialShader::File>& files, std::size_t index,
                              const fs::path& folder) const {
  std::size_t from = 0;
  while (const std::optional<Include> include = nextInclude(files[index].text, from)) {
    from = include->where.end;
    const fs::path here = fs::path(files[index].name).parent_path();
    try {
      const fs::path inFolder = (here / include->name).lexically_relative(folder.empty() ? "." : folder);
      const fs::path file = fileInFolder(folder, inFolder.empty() ? include->name : inFolder.string(),
                                         "included file", options_);
      const std::string name = file.lexically_normal().string();
      if (std::ranges::find(files, name, &MaterialShader::File::name) != files.end()) continue;
      if (files.size() == kMaxShaderFiles)
        throw Error(ErrorKind::Scene, fmt::format("the shader has more than {} files", kMaxShaderFiles));
      files.push_back({name, readText(file, options_.from)});
    } catch (const Error& error) {
      const MaterialShader::File& by = files[index];
      const TextPosition at = positionAt(by.text, include->where.begin);
      throw Error(ErrorKind::Scene, fmt::format("{}:{}:{}: {}", by.name, at.line, at.column, error.what()),
                  error.hint());
    }
  }
}

MaterialShaderPtr ShaderFiles::get(const std::string& name, const std::string& vertex) {
  const std::lock_guard lock(mutex_);
  MaterialShaderPtr& known = shaders_[{name, vertex}];
  if (known) return known;
  const fs::path path = name.empty() ? fs::path() : fileInFolder(folder_, name, "shader", options_);
  const fs::path normal = path.lexically_normal();
  std::vector<MaterialShader::File> files{
      name.empty() ? kFixedFragments : MaterialShader::File{normal.string(), readText(path, options_.from)}};
  for (std::size_t i = 0; i < files.size(); ++i) addIncluded(files, i, normal.parent_path());
  std::size_t first = 0;
  if (!vertex.empty()) {
    const fs::path program = fileInFolder(folder_, vertex, "vertex program", options_).lexically_normal();
    const auto same = std::ranges::find(files, program.string(), &MaterialShader::File::name);
    if (same != files.end())
      throw Error(ErrorKind::Scene,
                  fmt::format("the vertex program '{}' is a part of the shader, too", vertex),
                  "a vertex program and a fragment program are two files");
    first = files.size();
    files.push_back({program.string(), readText(program, options_.from)});
    for (std::size_t i = first; i < files.size(); ++i) addIncluded(files, i, program.parent_path());
  }
  known = std::make_shared<const MaterialShader>(MaterialShader{std::move(files), first});
  return known;
}

void ShaderFiles::put(const std::string& name, MaterialShaderPtr shader) {
  const std::lock_guard lock(mutex_);
  shaders_[{name, {}}] = std::move(shader);
}

std::vector<fs::path> ShaderFiles::files() {
  if (!options_.from.isDisk()) return {};
  std::vector<fs::path> files = read();
  const std::lock_guard lock(mutex_);
  for (const auto& [names, shader] : shaders_)
    for (const std::string* name : {&names.first, &names.second})
      if (!shader && !name->empty()) {
        const std::vector<fs::path> named = filesNamedBy(folder_ / *name);
        files.insert(files.end(), named.begin(), named.end());
      }
  return files;
}

FilesInMemory ShaderFiles::inMemory() {
  return luxo::inMemory(read(), folder_.lexically_normal(), options_.from);
}

std::vector<fs::path> ShaderFiles::read() {
  const std::lock_guard lock(mutex_);
  std::vector<fs::path> paths;
  for (const auto& [name, shader] : shaders_)
    if (shader)
      for (const MaterialShader::File& file : shader->files)
        if (file.name != kFixedFragments.name) paths.emplace_back(file.name);
  return paths;
}

}  // namespace luxo
