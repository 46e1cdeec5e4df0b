// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_compiler.h"

#include "base/error.h"
#include "gpu/cache_file.h"
#include "gpu/deep_stack.h"
#include "gpu/shader_errors.h"
#include "gpu/shader_optimizer.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <functional>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

namespace luxo::gpu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".spv";

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
  for (const ShaderSource* source : reachedSources(desc)) {
    hash.add(source->name);
    hash.add(source->text);
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
    const ShaderSource* source = includedSource(sources_, name, includer);
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
    case ShaderStage::Geometry:
      return EShLangGeometry;
    case ShaderStage::TessellationControl:
      return EShLangTessControl;
    case ShaderStage::TessellationEvaluation:
      return EShLangTessEvaluation;
  }
  return EShLangFragment;
}

/// From its first use to the end of the process: its tables take long to build.
void startGlslang() {
  struct Glslang {
    Glslang() { glslang::InitializeProcess(); }
    ~Glslang() { glslang::FinalizeProcess(); }
  };
  static const Glslang started;
}

std::string withoutPrefix(std::string_view message) {
  constexpr std::string_view kPrefix = "ERROR: ";
  return std::string(message.substr(message.starts_with(kPrefix) ? kPrefix.size() : 0));
}

/// A shader that the compiler reads.
class Translation {
 public:
  explicit Translation(const ShaderDesc& desc)
      : desc_(desc), language_(languageOf(desc.stage)), name_(desc.source.name), preamble_(desc.preamble) {}

  /// False: it has errors.
  bool parse() {
    const char* const text = desc_.source.text.data();
    const char* const names = name_.c_str();
    const int size = static_cast<int>(desc_.source.text.size());
    shader_.setStringsWithLengthsAndNames(&text, &size, &names, 1);
    shader_.setPreamble(preamble_.c_str());
    shader_.setEnvInput(glslang::EShSourceGlsl, language_, glslang::EShClientVulkan, 100);
    shader_.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader_.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    if (desc_.forReflection) {
      shader_.setEnvInputVulkanRulesRelaxed();
      shader_.setAutoMapBindings(true);
      shader_.setAutoMapLocations(true);
    }
    Includer includer(desc_.includes);
    return shader_.parse(GetDefaultResources(), 460, false, messages(), includer);
  }

  /// Of one without errors; throws what makes none of its parts a program.
  std::vector<std::uint32_t> words() {
    glslang::TProgram program;
    program.addShader(&shader_);
    if (!program.link(messages()) || (desc_.forReflection && !program.mapIO()))
      reject(program.getInfoLog(), withoutPrefix);
    std::vector<std::uint32_t> words;
    glslang::GlslangToSpv(*program.getIntermediate(language_), words);
    return words;
  }

  [[nodiscard]] std::string_view log() { return shader_.getInfoLog(); }

  [[noreturn]] void reject(std::string_view log,
                           const std::function<std::string(std::string_view)>& explained) const {
    std::string message = fmt::format("cannot compile the shader {}:", desc_.source.name);
    while (!log.empty()) {
      const std::string_view line = log.substr(0, log.find('\n'));
      log.remove_prefix(std::min(line.size() + 1, log.size()));
      // The last line only counts the others.
      if (line.empty() || line.find("compilation errors.") != line.npos) continue;
      if (const std::string told = explained(line); !told.empty()) message += fmt::format("\n{}", told);
    }
    throw Error(ErrorKind::Scene, message);
  }

 private:
  [[nodiscard]] EShMessages messages() const {
    return static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules |
                                    (desc_.forReflection ? EShMsgKeepUncalled : EShMsgDefault));
  }

  const ShaderDesc& desc_;
  EShLanguage language_;
  std::string name_, preamble_;
  glslang::TShader shader_{language_};
};

std::vector<std::uint32_t> translateHere(const ShaderDesc& desc) {
  startGlslang();
  Translation translation(desc);
  if (translation.parse()) return translation.words();
  const WordLines byWords(desc);
  Translation again(byWords.desc());
  if (again.parse()) translation.reject(translation.log(), withoutPrefix);  // it asks for its own lines
  again.reject(again.log(), [&](std::string_view line) { return byWords.explain(line); });
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
