// SPDX-License-Identifier: Apache-2.0
// Shaders compiled at run time, and what is kept of them on disk.
#include "gpu/shader_compiler.h"

#include "base/error.h"
#include "gpu/cache_file.h"
#include "luxo/shaders/sources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <thread>
#include <utility>

namespace luxo::gpu {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::uint32_t kSpirvMagic = 0x07230203;
constexpr std::string_view kMain = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/one.glsl"
layout(location = 0) out vec4 color;
void main() { color = vec4(one()); }
)";
constexpr ShaderSource kOne{"lib/one.glsl", "float one() { return 1.0; }\n"};
constexpr ShaderSource kUnused{"lib/unused.glsl", "nonsense"};

ShaderDesc descOf(std::span<const ShaderSource> includes, std::string_view text = kMain) {
  return {.source = {"main.frag", text}, .includes = includes};
}

class ShaderCompilerTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(directory_); }

  [[nodiscard]] ShaderCompiler compiler() const { return ShaderCompiler(directory_); }
  [[nodiscard]] std::vector<fs::path> files() const {
    std::vector<fs::path> result;
    for (const auto& entry : fs::recursive_directory_iterator(directory_))
      if (entry.is_regular_file()) result.push_back(entry.path());
    return result;
  }

  const fs::path directory_ =
      fs::path(testing::TempDir()) / ("luxo-shader-compiler-" + std::to_string(getpid()));
};

TEST_F(ShaderCompilerTest, TheSecondTimeNothingIsCompiled) {
  const std::array includes{kOne};
  const auto first = compiler().compile(descOf(includes));
  EXPECT_TRUE(first.compiled);
  ASSERT_FALSE(first.spirv.empty());
  EXPECT_EQ(first.spirv.front(), kSpirvMagic);
  const auto second = compiler().compile(descOf(includes));
  EXPECT_FALSE(second.compiled);
  EXPECT_EQ(second.spirv, first.spirv);
}

TEST_F(ShaderCompilerTest, ContentDecides) {
  const std::array includes{kOne};
  const auto first = compiler().compile(descOf(includes));
  const auto compiledWith = [&](const ShaderDesc& desc) { return compiler().compile(desc).compiled; };

  const std::array withUnused{kOne, kUnused};
  EXPECT_FALSE(compiledWith(descOf(withUnused))) << "what is not included does not count";
  const std::array changed{ShaderSource{kOne.name, "float one() { return 2.0; }\n"}};
  const auto other = compiler().compile(descOf(changed));
  EXPECT_TRUE(other.compiled);
  EXPECT_NE(other.spirv, first.spirv);
  EXPECT_TRUE(compiledWith(descOf(includes, std::string(kMain) + "// more\n")));
  const std::array deep{
      ShaderSource{kOne.name, "#include \"lib/value.glsl\"\nfloat one() { return kValue; }\n"},
      ShaderSource{"lib/value.glsl", "const float kValue = 3.0;\n"}};
  EXPECT_TRUE(compiledWith(descOf(deep)));
  auto deeper = deep;
  deeper[1].text = "const float kValue = 4.0;\n";
  EXPECT_TRUE(compiledWith(descOf(deeper))) << "what an include includes counts";
  EXPECT_FALSE(compiledWith(descOf(deep)));

  ShaderDesc vertex{.source = {"main.frag", "#version 460\nvoid main() {}\n"}, .stage = ShaderStage::Vertex};
  EXPECT_TRUE(compiledWith(vertex));
  vertex.stage = ShaderStage::Compute;
  EXPECT_TRUE(compiledWith(vertex));
}

TEST_F(ShaderCompilerTest, DamagedFilesAreCompiledAgain) {
  const std::array includes{kOne};
  const auto good = compiler().compile(descOf(includes));
  ASSERT_EQ(files().size(), 1u) << "one file, no temporary ones";
  const fs::path file = files().front();
  const std::vector<std::byte> whole = readCacheFile(file);

  const auto recovers = [&](std::span<const std::byte> damaged) {
    replaceCacheFile(file, damaged);
    const auto again = compiler().compile(descOf(includes));
    return again.compiled && again.spirv == good.spirv && readCacheFile(file) == whole;
  };
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{8}, std::size_t{12}, whole.size() - 4})
    EXPECT_TRUE(recovers(std::span(whole).first(size))) << size;
  for (std::size_t i = 0; i < whole.size(); i += 37) {
    std::vector<std::byte> damaged = whole;
    damaged[i] ^= std::byte{4};
    EXPECT_TRUE(recovers(damaged)) << i;
  }
  fs::remove(file);
  EXPECT_TRUE(compiler().compile(descOf(includes)).compiled);
  EXPECT_FALSE(compiler().compile(descOf(includes)).compiled);
}

TEST_F(ShaderCompilerTest, WorksWithoutADisk) {
  const std::array includes{kOne};
  EXPECT_TRUE(ShaderCompiler(fs::path()).compile(descOf(includes)).compiled);
  EXPECT_TRUE(ShaderCompiler(fs::path()).compile(descOf(includes)).compiled) << "nothing is kept";
  fs::create_directories(directory_);
  std::ofstream(directory_ / "file") << "in the way";
  EXPECT_TRUE(ShaderCompiler(directory_ / "file").compile(descOf(includes)).compiled);
}

TEST_F(ShaderCompilerTest, KeepsOnlySoManyFiles) {
  fs::create_directories(directory_ / "shaders");
  for (std::size_t i = 0; i < ShaderCompiler::kMaxFiles; ++i)
    std::ofstream(directory_ / "shaders" / (std::to_string(i) + ".spv")) << "old";
  const std::array includes{kOne};
  ASSERT_TRUE(compiler().compile(descOf(includes)).compiled);
  EXPECT_LE(files().size(), ShaderCompiler::kMaxFiles);
  EXPECT_FALSE(compiler().compile(descOf(includes)).compiled) << "the newest stays";
}

std::string messageOf(std::span<const ShaderSource> includes, std::string_view text = kMain) {
  try {
    static_cast<void>(ShaderCompiler(fs::path()).compile(descOf(includes, text)));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return error.what();
  }
  return "no error";
}

TEST(ShaderCompilerErrors, NameTheFileTheLineAndTheToken) {
  const std::array includes{ShaderSource{"lib/one.glsl", "// first line\nfloat one() { return two; }\n"}};
  const std::string message = messageOf(includes);
  EXPECT_THAT(message, HasSubstr("cannot compile the shader main.frag"));
  EXPECT_THAT(message, HasSubstr("lib/one.glsl:2:22: 'two' : undeclared identifier"));
  EXPECT_THAT(message, HasSubstr("float one() { return two; }"));
  EXPECT_THAT(message, HasSubstr("^^^"));
  EXPECT_THAT(messageOf({}), HasSubstr("main.frag:3"));
  EXPECT_THAT(messageOf({}), HasSubstr("lib/one.glsl"));
}

/// A shader of that body, and what is said of it without its first line.
std::string errorIn(std::string_view body, std::string_view before = "") {
  const std::string message =
      messageOf({}, "#version 460\n" + std::string(before) + "void main() {\n" + std::string(body) + "\n}\n");
  return message.substr(std::min(message.find('\n'), message.size() - 1) + 1);
}

/// Not where a word like it stands first.
TEST(ShaderCompilerErrors, AreAtTheWordThatTheyAreAbout) {
  using testing::StartsWith;
  EXPECT_THAT(
      errorIn("  float a = 1.0; vec2 b = 1.0;"),
      StartsWith("main.frag:3:25: '=' :  cannot convert from ' const float' to ' temp highp 2-component"));
  EXPECT_THAT(errorIn("  /* two */ float one = 1.0; one = two; // two"),
              StartsWith("main.frag:3:36: 'two' : undeclared identifier\n"
                         "  3 |   /* two */ float one = 1.0; one = two; // two\n"
                         "    |                                    ^^^"));
  EXPECT_THAT(errorIn("\tfloat one =\ttwo;"), StartsWith("main.frag:3:14: 'two' : undeclared identifier\n"
                                                         "  3 | \tfloat one =\ttwo;\n"
                                                         "    | \t           \t^^^"));
  EXPECT_THAT(errorIn("  float x = 1.0; x = x + x.q.x - x.x;"), StartsWith("main.frag:3:28: 'q' : "));
  EXPECT_THAT(errorIn("  float a = 1.0 return; float b;"),
              StartsWith("main.frag:3:17: syntax error, unexpected RETURN, expecting COMMA or SEMICOLON\n"));
  EXPECT_THAT(errorIn("  vec3 v = vec3(1.0) + vec3(vec2(1.0));"),
              StartsWith("main.frag:3:24: 'constructor' : "));
  EXPECT_THAT(errorIn("  float a = sin(1.0) + sin();"), StartsWith("main.frag:3:24: 'sin' : no matching"));
  EXPECT_THAT(errorIn("  float a = 1.0;\n  float b = a\n    + c; float d = c;"),
              StartsWith("main.frag:5:7: 'c' : undeclared identifier"));
}

/// Words of what a macro stands for are nowhere in the text.
TEST(ShaderCompilerErrors, InMacrosAreWhereTheseAreUsed) {
  using testing::StartsWith;
  const std::string macros =
      "#define TWICE(x) (2.0 * (x) * none)\n#define HALF (0.5 * none)\n#define SAME(x) (x)\n";
  EXPECT_THAT(
      errorIn("  float a = 1.0, b = HALF;", macros),
      StartsWith("main.frag:6:22: 'none' : undeclared identifier, in what the macro 'HALF' stands for\n"
                 "  6 |   float a = 1.0, b = HALF;\n"
                 "    |                      ^^^^"));
  EXPECT_THAT(
      errorIn("  float a = 1.0, b = a + TWICE((a));", macros),
      StartsWith("main.frag:6:26: 'none' : undeclared identifier, in what the macro 'TWICE' stands for\n"
                 "  6 |   float a = 1.0, b = a + TWICE((a));\n"
                 "    |                          ^^^^^"));
  EXPECT_THAT(errorIn("  float a = sin();", "#define sin sin\n"),
              StartsWith("main.frag:4:13: 'sin' : no matching"));
  EXPECT_THAT(errorIn("  float a = 1.0, b = a + SAME(a + other);", macros),
              StartsWith("main.frag:6:35: 'other' : undeclared identifier\n"));
  EXPECT_THAT(errorIn("  float a = 1.0, b = a +\n SAME(\n a + (2.0 * other));", macros),
              StartsWith("main.frag:8:13: 'other' : undeclared identifier\n"));
}

TEST(ShaderCompilerErrors, OfDirectivesAreOnTheirLines) {
  using testing::StartsWith;
  EXPECT_THAT(errorIn("", "#if 1 +\n#endif\n"), StartsWith("main.frag:2:"));
  EXPECT_THAT(errorIn("", "#error too late\n"), StartsWith("main.frag:2:1: '#error' : too late"));
  EXPECT_THAT(errorIn("", "\n  #version 330\n"), StartsWith("main.frag:3:3: '#version' : must occur first"));
  // What asks for its line is as it was.
  EXPECT_THAT(errorIn("#if __LINE__ == 3\n none;\n#endif"), testing::HasSubstr("main.frag:4"));
}

/// Of text that was added, and words that are spelled otherwise or gone.
TEST(ShaderCompilerErrors, AreInTheTextAsItWasWritten) {
  const std::string
      shown =
          "#version 460\nvoid main() {\n  for (;;) { layout() int b = 1; } mode = 1; float model = mode; }\n",
      text =
          "#version 460\nvoid mAin() {\n  for (;;)  ASK  {          int b = 1; } mOde = 1; float model "
          "= mOde; }\n";
  const auto told = [&](std::string_view in) {
    try {
      static_cast<void>(ShaderCompiler(fs::path())
                            .compile({.source = {"main.frag", in, shown},
                                      .preamble = "#define ASK if (false) break; else\n",
                                      .asShown = [](std::string_view message) {
                                        std::string all(message);
                                        for (std::size_t at = all.find("mOde"); at != all.npos;
                                             at = all.find("mOde", at))
                                          all[at + 1] = 'o';
                                        return all;
                                      }}));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(told(text), HasSubstr("main.frag:3:36: 'mode' : undeclared identifier"));
}

TEST(ShaderCompilerErrors, AreFoundInWhatGlslForbids) {
  const auto body = [](std::string_view statement) {
    return "#version 460\nlayout(location = 0) out vec4 c;\nvoid main() {\n  vec4 v4 = vec4(1); vec2 v2; " +
           std::string(statement) + "\n  c = v4;\n}\n";
  };
  EXPECT_EQ(messageOf({}, body("v2 = v4.xy;")), "no error");
  EXPECT_THAT(messageOf({}, body("v2 = v4;")), HasSubstr("main.frag:4"));
  EXPECT_THAT(messageOf({}, body("v2 = v4.xyq;")), HasSubstr("main.frag:4"));
  EXPECT_THAT(messageOf({}, body("int i = 1.5;")), HasSubstr("main.frag:4"));
  EXPECT_THAT(messageOf({}, body("c = texture2D(s, v2)")), HasSubstr("main.frag:"));
  EXPECT_THAT(messageOf({}, body("int i = 1.5; v2 = v4;")), HasSubstr("v2 = v4"))
      << "all errors, not the first";
}

/// On a thread whose own stack would not do.
TEST(ShaderCompilerThreads, HaveRoomForWhatIsNestedDeep) {
  std::string sum = "x";
  for (int i = 0; i < 2000; ++i) sum = i % 2 == 0 ? "-(" + sum + ")" : sum + "+x";
  const std::string text =
      "#version 460\nlayout(location = 0) in float x;\nlayout(location = 0) out float c;\n"
      "void main() { c = " +
      sum + "; }\n";
  const std::string small = "#version 460\nlayout(location = 0) out float c;\nvoid main() { c = 1.5; }\n";
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, std::size_t{512} << 10);
  std::pair<std::string, std::size_t> given{text, 0};
  pthread_t thread{};
  ASSERT_EQ(pthread_create(
                &thread, &attributes,
                [](void* argument) -> void* {
                  auto& [source, size] = *static_cast<std::pair<std::string, std::size_t>*>(argument);
                  size = ShaderCompiler(fs::path()).compile(descOf({}, source)).spirv.size();
                  return nullptr;
                },
                &given),
            0);
  pthread_attr_destroy(&attributes);
  pthread_join(thread, nullptr);
  EXPECT_GT(given.second, ShaderCompiler(fs::path()).compile(descOf({}, small)).spirv.size());
}

TEST(ShaderCompilerThreads, CompileTheSameAsOne) {
  const auto textOf = [](int i) {
    return "#version 460\nlayout(location = 0) out float c;\nvoid main() { c = " + std::to_string(i) +
           ".5; }\n";
  };
  std::array<std::vector<std::uint32_t>, 8> together;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i)
      threads.emplace_back(
          [&, i] { together[i] = ShaderCompiler(fs::path()).compile(descOf({}, textOf(i))).spirv; });
  }
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(ShaderCompiler(fs::path()).compile(descOf({}, textOf(i))).spirv, together[i]) << i;
}

TEST(ShaderSources, AreThoseOfTheTree) {
  const auto lines = [](std::string_view name) {
    const auto source = std::ranges::find(kShaderSources, name, &ShaderSource::name);
    return source == std::end(kShaderSources) ? 0 : std::ranges::count(source->text, '\n');
  };
  EXPECT_GT(lines("lib/formula.glsl"), 100);
  EXPECT_GT(lines("shared/scene_data.h"), 50);
}

}  // namespace
}  // namespace luxo::gpu
