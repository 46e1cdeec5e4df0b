// SPDX-License-Identifier: Apache-2.0
// luxo inspect: what is in a scene, a picture or a shader?
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "console.h"
#include "exit_code.h"
#include "image/format.h"
#include "open_scene.h"
#include "options.h"
#include "pixel_inspection.h"
#include "scene_inspection.h"
#include "scene_request.h"
#include "shader_inspection.h"
#include "shader_options.h"
#include "shader_scene.h"
#include "verbs.h"

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

struct InspectOptions {
  std::unique_ptr<RenderOptions> scene;
  ShaderOptions shader;
  std::optional<std::string> pixel, vertex;
  bool json = false;
};

struct Pixel {
  int x, y;
};

Pixel parsePixel(const std::string& text, PixelSize size) {
  const std::string hint = "give X,Y, counted from the top left, as in --pixel 312,88";
  Pixel pixel{};
  const char* const end = text.data() + text.size();
  const auto [comma, badX] = std::from_chars(text.data(), end, pixel.x);
  if (badX != std::errc{} || comma == end || *comma != ',')
    throw Error(ErrorKind::Usage, fmt::format("--pixel '{}': not a pixel", text), hint);
  const auto [rest, badY] = std::from_chars(comma + 1, end, pixel.y);
  if (badY != std::errc{} || rest != end)
    throw Error(ErrorKind::Usage, fmt::format("--pixel '{}': not a pixel", text), hint);
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.width || pixel.y >= size.height)
    throw Error(ErrorKind::Usage,
                fmt::format("--pixel '{}': the picture has {} x {} pixels", text, size.width, size.height),
                hint);
  return pixel;
}

Json sampleJson(float value) { return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value)); }

/// Of the finite samples.
Json channelJson(const Image& image, int channel) {
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
  std::uint64_t finite = 0, total = 0;
  for (std::size_t i = static_cast<std::size_t>(channel); i < image.samples().size();
       i += static_cast<std::size_t>(image.channels())) {
    const double value = image.samples()[i];
    ++total;
    if (!std::isfinite(value)) continue;
    ++finite;
    low = std::min(low, value);
    high = std::max(high, value);
    sum += value;
  }
  return {{"min", finite > 0 ? Json(low) : Json()},
          {"max", finite > 0 ? Json(high) : Json()},
          {"mean", finite > 0 ? Json(sum / static_cast<double>(finite)) : Json()},
          {"not_finite", total - finite}};
}

std::string imageText(const Json& json) {
  std::string text = fmt::format("{}\n  {} x {} pixels, {} channels, {}\n", json["image"].get<std::string>(),
                                 json["size"][0].get<int>(), json["size"][1].get<int>(),
                                 json["channels"].size(), json["encoding"].get<std::string>());
  const auto number = [](const Json& value) {
    return value.is_null() ? std::string("none") : fmt::format("{:.7g}", value.get<double>());
  };
  for (std::size_t i = 0; i < json["channels"].size(); ++i) {
    const Json& channel = json["channels"][i];
    text += fmt::format("  channel {}: from {} to {}, mean {}, {} not finite\n", i, number(channel["min"]),
                        number(channel["max"]), number(channel["mean"]),
                        channel["not_finite"].get<std::uint64_t>());
  }
  if (json.contains("pixel"))
    text += fmt::format("  pixel {},{}: {}\n", json["pixel"]["x"].get<int>(), json["pixel"]["y"].get<int>(),
                        json["pixel"]["value"].dump());
  return text;
}

Json inspectImage(const std::string& path, const std::optional<std::string>& pixel) {
  const Image image = loadImage(path);
  Json json = {{"luxo", LUXO_VERSION},
               {"inspect", 1},
               {"image", path},
               {"size", {image.width(), image.height()}},
               {"encoding",
                storesSrgb8(requireImageFormat(path)) ? "8 bit, sRGB (values are linear)" : "float, linear"},
               {"channels", Json::array()}};
  for (int channel = 0; channel < image.channels(); ++channel)
    json["channels"].push_back(channelJson(image, channel));
  if (pixel) {
    const auto [x, y] = parsePixel(*pixel, {image.width(), image.height()});
    json["pixel"] = {{"x", x}, {"y", y}, {"value", Json::array()}};
    for (const float sample : image.pixel(x, y)) json["pixel"]["value"].push_back(sampleJson(sample));
  }
  return json;
}

int runInspect(const InspectOptions& options) {
  const RenderRequest request = options.scene->request(RenderTarget::Window);
  const std::string& name = request.scene;
  if (name.empty())
    throw Error(ErrorKind::Usage, "nothing is named to inspect", "as in luxo inspect luxo-grandpa");
  showLog(request.verbosity);
  const auto print = [&](const Json& json, const auto& textOf) {
    printData(options.json ? json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n" : textOf(json));
    return exit_code::kDone;
  };
  const ShaderUse use = shaderUse(name, options.shader);
  const bool asScene = namesMaterialShader(name) && (options.pixel || options.vertex);
  if (isShader(name) && !asScene) {
    if (options.pixel || options.vertex)
      throw Error(ErrorKind::Usage, "a shader has no pixels and no points",
                  "give a scene whose material has it");
    return print(inspectShader(name, use), shaderText);
  }
  if (options.pixel && options.vertex)
    throw Error(ErrorKind::Usage, "--pixel and --vertex exclude each other",
                "--pixel tells the way of the point that is seen there, too");
  if (imageFormatOf(name)) {
    if (options.vertex)
      throw Error(ErrorKind::Usage, "--vertex: a picture has no vertices", "give a scene or a model");
    return print(inspectImage(name, options.pixel), imageText);
  }
  std::vector<std::string> warnings;
  const Opening opening{.parameters = request.parameters,
                        .warnings = &warnings,
                        .allowOutside = request.allowOutside,
                        .showsProgress = request.verbosity == Verbosity::Normal};
  Scene scene = namesMaterialShader(name) ? openShader(name, use, opening).scene : openScene(name, opening);
  const ViewedScene viewed = viewedScene(std::move(scene), request);
  if (options.pixel) {
    const auto [x, y] = parsePixel(*options.pixel, viewed.settings.size);
    return print(inspectPixel(name, viewed, request.device, x, y), pixelText);
  }
  if (options.vertex) return print(inspectVertex(name, viewed, *options.vertex), vertexText);
  return print(inspectScene(name, viewed, std::move(warnings)), inspectionText);
}

}  // namespace

void addInspect(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("inspect", "tell what is in a scene, a picture or a shader");
  verb->group("Verbs");
  const auto options = std::make_shared<InspectOptions>();
  options->scene = std::make_unique<RenderOptions>(*verb, SceneArgument::Taken, RenderTarget::Window);
  addShaderOptions(*verb, options->shader);
  verb->add_option("--pixel", options->pixel,
                   "one pixel, from the top left: of a picture its value, of a scene why it looks so")
      ->type_name("X,Y");
  verb->add_option("--vertex", options->vertex,
                   "a point of a node's surface, or a vertex of its triangles, on the way to the screen")
      ->type_name("NODE:U,V|NODE:I");
  verb->add_flag("--json", options->json, "as JSON");
  verb->callback([options, &chosen] { chosen = [options] { return runInspect(*options); }; });
}

}  // namespace luxo
