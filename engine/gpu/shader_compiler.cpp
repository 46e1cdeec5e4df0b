// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_compiler.h"

#include "base/diagnostic.h"
#include "base/error.h"
#include "gpu/cache_file.h"
#include "gpu/deep_stack.h"
#include "gpu/shader_optimizer.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace luxo::gpu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".spv";

const ShaderSource* find(std::span<const ShaderSource> sources, std::string_view name) {
  const auto found = std::ranges::find(sources, name, &ShaderSource::name);
  return found == sources.end() ? nullptr : &*found;
}

/// What a file of that name means by a name: what is beside it, or whatever is called so.
const ShaderSource* find(std::span<const ShaderSource> sources, std::string_view name,
                         std::string_view includer) {
  const fs::path beside = (fs::path(includer).parent_path() / name).lexically_normal();
  const ShaderSource* source = find(sources, beside.string());
  return source ? source : find(sources, name);
}

/// The names in `#include "..."` of a text. Those in comments count, too, which is more than enough.
std::vector<std::string_view> includedBy(std::string_view text) {
  constexpr std::string_view kBlank = " \t", kDirective = "include";
  std::vector<std::string_view> names;
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at + 1)) {
    std::size_t name = text.find_first_not_of(kBlank, at + 1);
    if (name == text.npos || !text.substr(name).starts_with(kDirective)) continue;
    name = text.find_first_not_of(kBlank, name + kDirective.size());
    if (name == text.npos || text[name] != '"') continue;
    ++name;
    names.push_back(text.substr(name, std::min(text.find('"', name), text.find('\n', name)) - name));
  }
  return names;
}

// -------------------------------------------------------------------------------------------------------------------
// The name of a shader: all that decides its words.

class ContentHash {
 public:
  void add(std::string_view text) {
    const std::uint64_t size = text.size();
    for (std::uint64_t& hash : halves_)
      hash = hashOf(std::as_bytes(std::span(text)), hashOf(std::as_bytes(std::span(&size, 1)), hash));
  }
  [[nodiscard]] std::string name() const { return fmt::format("{:016x}{:016x}", halves_[0], halves_[1]); }

 private:
  std::array<std::uint64_t, 2> halves_{0xcbf29ce484222325, 0x6c62272e07bb0142};
};

std::string contentName(const ShaderDesc& desc) {
  ContentHash hash;
  hash.add(fmt::format("{}.{}.{} {}", GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR, GLSLANG_VERSION_PATCH,
                       static_cast<int>(desc.stage) + (desc.forReflection ? 100 : 0)));
  hash.add(optimizerVersion());
  hash.add(desc.preamble);
  hash.add(desc.sharedFunction);
  std::vector<const ShaderSource*> open{&desc.source};
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < open.size(); ++i) {
    hash.add(open[i]->name);
    hash.add(open[i]->text);
    for (const std::string_view name : includedBy(open[i]->text))
      if (const ShaderSource* source = find(desc.includes, name, open[i]->name);
          source && seen.insert(source->name).second)
        open.push_back(source);
  }
  return hash.name();
}

// -------------------------------------------------------------------------------------------------------------------
// The file of a shader: a checksum and its words.

std::vector<std::byte> pack(std::span<const std::uint32_t> words) {
  const auto data = std::as_bytes(words);
  const std::uint64_t checksum = hashOf(data);
  std::vector<std::byte> file(sizeof checksum + data.size());
  std::memcpy(file.data(), &checksum, sizeof checksum);
  std::copy(data.begin(), data.end(), file.begin() + sizeof checksum);
  return file;
}

/// Empty unless whole.
std::vector<std::uint32_t> unpack(std::span<const std::byte> file) {
  std::uint64_t checksum = 0;
  if (file.size() <= sizeof checksum || file.size() % sizeof(std::uint32_t) != 0) return {};
  std::memcpy(&checksum, file.data(), sizeof checksum);
  const auto data = file.subspan(sizeof checksum);
  if (hashOf(data) != checksum) return {};
  std::vector<std::uint32_t> words(data.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), data.data(), data.size());
  return words;
}

/// Removes the older half when there are too many.
void prune(const fs::path& directory) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == kSuffix)
      files.emplace_back(entry->last_write_time(error), entry->path());
  if (files.size() <= ShaderCompiler::kMaxFiles) return;
  std::ranges::sort(files);
  for (std::size_t i = 0; i < files.size() / 2; ++i) fs::remove(files[i].second, error);
}

// -------------------------------------------------------------------------------------------------------------------
// The compiler.

class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(std::span<const ShaderSource> sources) : sources_(sources) {}

  IncludeResult* includeLocal(const char* name, const char* includer, std::size_t depth) override {
    constexpr std::size_t kDeepest = 32;
    constexpr std::string_view kTooDeep = "files include each other without end";
    if (depth > kDeepest) return new IncludeResult("", kTooDeep.data(), kTooDeep.size(), nullptr);
    const ShaderSource* source = find(sources_, name, includer);
    return source ? new IncludeResult(std::string(source->name), source->text.data(), source->text.size(),
                                      nullptr)
                  : nullptr;
  }
  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  std::span<const ShaderSource> sources_;
};

EShLanguage languageOf(ShaderStage stage) {
  switch (stage) {
    case ShaderStage::Vertex:
      return EShLangVertex;
    case ShaderStage::Fragment:
      return EShLangFragment;
    case ShaderStage::Compute:
      return EShLangCompute;
  }
  return EShLangFragment;
}

/// "ERROR: lib/pattern.glsl:12: 'foo' : undeclared identifier" with the line it is about. Other lines as they
/// are.
std::string explain(std::string_view line, const ShaderDesc& desc) {
  constexpr std::string_view kPrefix = "ERROR: ";
  if (!line.starts_with(kPrefix)) return std::string(line);
  const std::string_view rest = line.substr(kPrefix.size());
  const auto isNamed = [&](const ShaderSource& source) {
    return rest.starts_with(source.name) && rest.substr(source.name.size()).starts_with(':');
  };
  const auto included = std::ranges::find_if(desc.includes, isNamed);
  const ShaderSource* source = isNamed(desc.source)              ? &desc.source
                               : included != desc.includes.end() ? &*included
                                                                 : nullptr;
  if (!source) return std::string(rest);
  const std::string_view name = source->name, all = source->shown.empty() ? source->text : source->shown;
  const std::size_t nameEnd = name.size(), numberEnd = rest.find(": ", nameEnd + 1);
  if (numberEnd == rest.npos) return std::string(rest);
  std::size_t number = 0;
  std::from_chars(rest.data() + nameEnd + 1, rest.data() + numberEnd, number);
  if (number == 0) return std::string(rest);

  std::size_t begin = 0;
  for (std::size_t i = 1; i < number; ++i) {
    const std::size_t end = all.find('\n', begin);
    if (end == all.npos) break;
    begin = end + 1;
  }
  const std::string_view text = all.substr(begin, std::min(all.find('\n', begin), all.size()) - begin);
  const std::string told(rest.substr(numberEnd + 2)), spelled = desc.asShown ? desc.asShown(told) : told;
  std::string_view message = spelled;
  constexpr std::string_view kNoToken = "'' : ";
  if (message.starts_with(kNoToken)) message.remove_prefix(kNoToken.size());
  message = message.substr(std::min(message.find_first_not_of(' '), message.size()));
  message = message.substr(0, message.find_last_not_of(' ') + 1);
  if (message == "memory exhausted") message = "this is nested too deep";  // of the compiler's parser
  // The compiler knows the line and the token, not the column.
  const std::string_view token =
      message.starts_with('\'') ? message.substr(1, message.find('\'', 1) - 1) : "";
  const std::size_t column = token.empty() ? text.npos : text.find(token);
  const std::size_t from = begin + (column == text.npos ? 0 : column);
  return describe(name, all,
                  {.where = {from, column == text.npos ? begin + text.size() : from + token.size()},
                   .message = std::string(message),
                   .hint = {}});
}

[[noreturn]] void reject(const ShaderDesc& desc, std::string_view log) {
  std::string message = fmt::format("cannot compile the shader {}:", desc.source.name);
  while (!log.empty()) {
    const std::string_view line = log.substr(0, log.find('\n'));
    log.remove_prefix(std::min(line.size() + 1, log.size()));
    // The last line only counts the others.
    if (!line.empty() && line.find("compilation errors.") == line.npos)
      message += fmt::format("\n{}", explain(line, desc));
  }
  throw Error(ErrorKind::Scene, message);
}

/// From its first use to the end of the process: its tables take long to build.
void startGlslang() {
  struct Glslang {
    Glslang() { glslang::InitializeProcess(); }
    ~Glslang() { glslang::FinalizeProcess(); }
  };
  static const Glslang started;
}

std::vector<std::uint32_t> translateHere(const ShaderDesc& desc) {
  startGlslang();

  const EShLanguage language = languageOf(desc.stage);
  const std::string name(desc.source.name), preamble(desc.preamble);
  const char* const text = desc.source.text.data();
  const char* const names = name.c_str();
  const int size = static_cast<int>(desc.source.text.size());
  glslang::TShader shader(language);
  shader.setStringsWithLengthsAndNames(&text, &size, &names, 1);
  shader.setPreamble(preamble.c_str());
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules |
                                                 (desc.forReflection ? EShMsgKeepUncalled : EShMsgDefault));
  if (desc.forReflection) {
    shader.setEnvInputVulkanRulesRelaxed();
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
  }
  Includer includer(desc.includes);
  if (!shader.parse(GetDefaultResources(), 460, false, messages, includer)) reject(desc, shader.getInfoLog());
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) reject(desc, program.getInfoLog());
  if (desc.forReflection && !program.mapIO()) reject(desc, program.getInfoLog());
  std::vector<std::uint32_t> words;
  glslang::GlslangToSpv(*program.getIntermediate(language), words);
  return words;
}

std::vector<std::uint32_t> translate(const ShaderDesc& desc) {
  // Its first use of each language version is not safe from several threads.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  std::vector<std::uint32_t> words;
  onDeepStack([&] { words = translateHere(desc); });
  return words;
}

std::vector<std::uint32_t> compileNow(const ShaderDesc& desc) {
  return desc.forReflection ? translate(desc) : optimized(translate(desc), desc.sharedFunction);
}

}  // namespace

ShaderCompiler::ShaderCompiler() : ShaderCompiler(cacheDirectory()) {}

ShaderCompiler::ShaderCompiler(fs::path directory)
    : directory_(directory.empty() ? std::move(directory) : directory / "shaders") {}

ShaderCompiler::Result ShaderCompiler::compile(const ShaderDesc& desc) const {
  if (directory_.empty()) return {compileNow(desc), true};
  const fs::path file = directory_ / (contentName(desc) + std::string(kSuffix));
  if (auto words = unpack(readCacheFile(file)); !words.empty()) {
    std::error_code ignored;  // used now: the last to be removed
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return {std::move(words), false};
  }
  Result result{compileNow(desc), true};
  replaceCacheFile(file, pack(result.spirv));
  prune(directory_);
  return result;
}

}  // namespace luxo::gpu
