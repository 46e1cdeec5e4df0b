// SPDX-License-Identifier: Apache-2.0
// The options of `luxo render`, shared with every program that renders to files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "console.h"
#include "option_values.h"

namespace CLI {
class App;
}

namespace luxo {

/// What the command line asks for. What it leaves open (nullopt) is the scene's to say, then the default's.
struct RenderRequest {
  std::string scene;             ///< file or built-in name; empty where the program has its own
  std::filesystem::path output;  ///< may hold a place for the frame number (frame_names.h)
  std::optional<PixelSize> size = std::nullopt;
  std::optional<double> time = std::nullopt;  ///< seconds; never together with frames
  std::vector<int> frames = {};               ///< empty: one picture. Frame n is at (n - 1) / fps.
  std::optional<double> fps = std::nullopt;
  std::optional<int> samples = std::nullopt;
  std::optional<double> tolerancePx = std::nullopt;
  std::optional<Shading> shading = std::nullopt;
  bool hiddenLines = false;  ///< of wireframes, shown even if the scene does not say so
  Engine engine = Engine::Vulkan;
  std::optional<std::string> camera = std::nullopt;
  std::vector<ParameterValue> parameters = {};
  std::optional<Sweep> sweep = std::nullopt;  ///< one picture per value; never together with frames
  Output aov = Output::Color;
  bool fromLight = false;  ///< --aov light-depth: the depth of what casts a shadow, as its light sees it
  std::optional<std::string> light = std::nullopt;  ///< --aov light-depth:NODE: that node's
  std::optional<int> sample = std::nullopt;  ///< only that one of each pixel; below the number of samples
  Composition composition = Composition::Auto;
  Skips skips = {};
  Audit audit = {};
  std::optional<std::filesystem::path> report = std::nullopt;
  std::optional<double> requireErrorPx = std::nullopt;
  std::string device = "auto";
  bool validate = false;  ///< Vulkan validation layers on; any message fails the run
  bool listScenes = false;
  bool allowOutside = false;  ///< what scenes and models name may be outside of their folders
  Verbosity verbosity = Verbosity::Normal;
};

enum class SceneArgument { Taken, None };

/// A window takes fewer options: nothing that is about files or several pictures.
enum class RenderTarget { File, Window };

/// Adds the options to a command; after it has been parsed, request() checks and gives their values.
class RenderOptions {
 public:
  RenderOptions(CLI::App& command, SceneArgument scene, RenderTarget destination = RenderTarget::File);
  RenderOptions(const RenderOptions&) = delete;
  RenderOptions& operator=(const RenderOptions&) = delete;
  ~RenderOptions();

  /// Whether an output file was named.
  [[nodiscard]] bool hasOutput() const;

  /// Error(Usage): a value is wrong, two options exclude each other, scene or output is missing, or an option
  /// means nothing in a window. Error(Scene): a value is known but not supported yet.
  [[nodiscard]] RenderRequest request(RenderTarget destination = RenderTarget::File) const;

 private:
  struct Texts;
  std::unique_ptr<Texts> texts_;
};

}  // namespace luxo
