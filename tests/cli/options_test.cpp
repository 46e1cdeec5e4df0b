// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "command_line.h"
#include "unit/image_test_support.h"

namespace luxo {
namespace {

/// Parses `luxo render ARGUMENTS`.
RenderRequest parse(std::vector<const char*> arguments, SceneArgument scene = SceneArgument::Taken) {
  CLI::App app("test", "luxo");
  CLI::App* render = app.add_subcommand("render", "draw");
  const RenderOptions options(*render, scene);
  arguments.insert(arguments.begin(), {"luxo", "render"});
  EXPECT_TRUE(parseCommandLine(app, int(arguments.size()), arguments.data()));
  return options.request();
}

Error failureOf(const std::vector<const char*>& arguments, SceneArgument scene = SceneArgument::Taken) {
  try {
    static_cast<void>(parse(arguments, scene));
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {ErrorKind::Internal, ""};
}

void expectEveryOption(const RenderRequest& request) {
  EXPECT_EQ(request.scene, "lamp");
  EXPECT_EQ(request.output, "a.exr");
  EXPECT_EQ(request.size, (PixelSize{640, 480}));
  EXPECT_EQ(request.frames, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(request.fps, 30.0);
  EXPECT_EQ(request.samples, 4);
  EXPECT_EQ(request.tolerancePx, 0.25);
  EXPECT_EQ(request.shading, Shading::Flat);
  EXPECT_EQ(request.camera, "top");
  EXPECT_EQ(request.parameters, (std::vector<ParameterValue>{{"n", "5"}, {"m", "-2"}}));
  EXPECT_EQ(request.aov, Output::Depth);
  EXPECT_EQ(request.report, "r.json");
  EXPECT_FALSE(request.skips.frustum);
  EXPECT_EQ(request.requireErrorPx, 0.5);
  EXPECT_EQ(request.device, "cpu");
  EXPECT_TRUE(request.validate);
  EXPECT_EQ(request.verbosity, Verbosity::Quiet);
  EXPECT_FALSE(request.time.has_value());
}

TEST(RenderOptions, OrderDoesNotMatter) {
  expectEveryOption(parse({"lamp",   "-o",        "a.exr",  "--size",     "640x480", "--frames",
                           "1-3",    "--fps",     "30",     "--samples",  "4",       "--tolerance",
                           "0.25px", "--shading", "flat",   "--engine",   "vulkan",  "--camera",
                           "top",    "-P",        "n=5",    "-P",         "m=-2",    "--aov",
                           "depth",  "--report",  "r.json", "--skip",     "none",    "--require-error",
                           "0.5px",  "--device",  "cpu",    "--validate", "-q"}));
  expectEveryOption(parse({"-q",
                           "--validate",
                           "--device=cpu",
                           "--require-error",
                           "0.5",
                           "--skip=none",
                           "--report=r.json",
                           "--aov",
                           "depth",
                           "-P",
                           "n=5",
                           "lamp",
                           "-Pm=-2",
                           "--camera",
                           "top",
                           "--engine",
                           "vulkan",
                           "--shading",
                           "flat",
                           "--tolerance",
                           "1/4",
                           "--samples=4",
                           "--fps",
                           "30",
                           "--frames",
                           "1-3",
                           "--size",
                           "640x480",
                           "--output",
                           "a.exr"}));
}

TEST(RenderOptions, WhatIsNotSaidStaysOpen) {
  const RenderRequest request = parse({"lamp", "-o", "a.png"});
  EXPECT_FALSE(request.size || request.time || request.fps || request.samples || request.tolerancePx ||
               request.shading || request.camera || request.sweep || request.report ||
               request.requireErrorPx);
  EXPECT_TRUE(request.frames.empty());
  EXPECT_TRUE(request.parameters.empty());
  EXPECT_EQ(request.aov, Output::Color);
  EXPECT_EQ(request.skips, Skips{});
  EXPECT_EQ(request.device, "auto");
  EXPECT_FALSE(request.validate);
  EXPECT_FALSE(request.hiddenLines);
  EXPECT_EQ(request.verbosity, Verbosity::Normal);
}

TEST(RenderOptions, HiddenLinesAreAskedFor) {
  EXPECT_TRUE(parse({"lamp", "-o", "a.png", "--hidden-lines"}).hiddenLines);
}

TEST(RenderOptions, NegativeTimeIsAValueNotAnOption) {
  EXPECT_EQ(parse({"lamp", "-o", "a.png", "--time", "-1.5"}).time, -1.5);
}

TEST(RenderOptions, ListNeedsNothingElse) { EXPECT_TRUE(parse({"--list"}).listScenes); }

TEST(RenderOptions, AProgramWithItsOwnSceneTakesNone) {
  EXPECT_EQ(parse({"-o", "a.png"}, SceneArgument::None).scene, "");
  EXPECT_EQ(failureOf({"lamp", "-o", "a.png"}, SceneArgument::None).kind(), ErrorKind::Usage);
}

TEST(RenderOptions, MistakesAreUsageErrorsThatSayWhat) {
  struct Case {
    std::vector<const char*> arguments;
    const char* said;
  };
  const Case cases[] = {
      {{"-o", "a.png"}, "no scene"},
      {{"lamp"}, "no output"},
      {{"lamp", "-o", "a.jpg"}, ".jpg"},
      {{"lamp", "-o", "a"}, "suffix"},
      {{"lamp", "-o", "a.png", "--size", "1280"}, "--size '1280'"},
      {{"lamp", "-o", "a.png", "--time", "1", "--frames", "1-2"}, "--time and --frames"},
      {{"lamp", "-o", "a.png", "--sweep", "n=1:2:1", "--frames", "1-2"}, "--sweep and --frames"},
      {{"lamp", "-o", "a.png", "-P", "n=1", "-P", "n=2"}, "'n' twice"},
      {{"lamp", "-o", "a.png", "-P", "n=1", "--sweep", "n=1:2:1"}, "'n'"},
      {{"lamp", "-o", "a.png", "-q", "-v"}, "-q and -v"},
      {{"lamp", "-o", "a.png", "--device", ""}, "--device"},
      {{"lamp", "-o", "a.png", "-o", "b.png"}, "more than once"},
      {{"lamp", "-o", "a.png", "--fps"}, "needs a value"},
      {{"lamp", "other", "-o", "a.png"}, "unexpected argument 'other'"},
      {{"lamp", "-o", "a.png", "--sizes", "1x1"}, "unknown option '--sizes'"},
      {{"--sizes=1x1", "lamp", "-o", "a.png"}, "unknown option '--sizes'"},
      {{"lamp", "-o", "a.png", "-z"}, "unknown option '-z'"},
  };
  for (const Case& c : cases) {
    const Error error = failureOf(c.arguments);
    EXPECT_EQ(error.kind(), ErrorKind::Usage) << error.what();
    EXPECT_NE(std::string(error.what()).find(c.said), std::string::npos) << error.what();
    EXPECT_FALSE(error.hint().empty()) << error.what();
  }
}

TEST(RenderOptions, SuggestsTheOptionMeant) {
  EXPECT_EQ(failureOf({"lamp", "-o", "a.png", "--sizes", "1x1"}).hint(), "did you mean '--size'?");
  EXPECT_EQ(failureOf({"lamp", "-o", "a.png", "--tolerence=1"}).hint(), "did you mean '--tolerance'?");
  EXPECT_EQ(failureOf({"lamp", "-o", "a.png", "--resolution", "1x1"}).hint(), "see luxo render --help");
}

TEST(RenderOptions, WhatComesLaterIsAnErrorOfTheScene) {
  for (const char* later : {"overdraw", "lod"}) {
    const Error error = failureOf({"--shading", later, "lamp", "-o", "a.png"});
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_NE(std::string(error.what()).find("not supported yet"), std::string::npos) << error.what();
  }
}

TEST(RenderOptions, ExactnessIsAnOptionLikeOthers) {
  const RenderRequest request =
      parse({"lamp", "-o", "a.png", "--shading", "exact", "--aov", "residual", "--samples", "256"});
  EXPECT_EQ(request.shading, Shading::Exact);
  EXPECT_EQ(request.aov, Output::Residual);
  EXPECT_EQ(request.samples, 256);
}

TEST(CommandLine, OptionsBeforeTheVerbAndUnknownVerbs) {
  const auto failure = [](std::vector<const char*> arguments) {
    CLI::App app("test", "luxo");
    CLI::App* render = app.add_subcommand("render", "draw");
    const RenderOptions options(*render, SceneArgument::Taken);
    try {
      static_cast<void>(parseCommandLine(app, int(arguments.size()), arguments.data()));
    } catch (const Error& error) {
      return fmt::format("{} | {}", error.what(), error.hint());
    }
    return std::string("nothing was thrown");
  };
  EXPECT_EQ(failure({"luxo", "rendre", "lamp"}), "unknown verb 'rendre' | did you mean 'render'?");
  EXPECT_EQ(failure({"luxo", "paint"}), "unknown verb 'paint' | one of render");
  EXPECT_EQ(failure({"luxo", "--size", "1x1", "render", "lamp"}),
            "option '--size' stands before the verb | write luxo render ... --size");
  EXPECT_EQ(failure({"luxo", "--nonsense"}), "unknown option '--nonsense' | see luxo --help");
}

}  // namespace
}  // namespace luxo
