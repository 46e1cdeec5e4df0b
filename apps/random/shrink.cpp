// SPDX-License-Identifier: Apache-2.0
#include "random/shrink.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "random/hard_camera.h"

namespace luxo::random {
namespace {

using Texts = std::vector<std::string>;

constexpr int kSmallestSide = 6;  // pixels
constexpr int kMaxHalvings = 8;   // of a domain's side in one round

/// Every formula and number of surfaces, nodes and the camera.
void visit(Json& json, const std::function<void(Json&)>& leaf) {
  if (json.is_structured())
    for (Json& child : json) visit(child, leaf);
  else
    leaf(json);
}

/// The end of the term that begins at `begin`: the next sign, comma or bracket of its own depth.
std::size_t endOfTerm(const std::string& text, std::size_t begin) {
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(') ++depth;
    if (c == ')' && depth-- == 0) return i;
    const bool exponent =
        i >= 2 && (text[i - 1] == 'e') && std::isdigit(static_cast<unsigned char>(text[i - 2])) != 0;
    if (depth == 0 && i > begin && (c == '+' || c == '-' || c == ',') && !exponent) return i;
  }
  return text.size();
}

/// The formula without one of its terms or factors, at any depth. Not all of them are formulas.
Texts shorter(const std::string& text) {
  Texts found;
  if (text.size() > 1) found.emplace_back("0");
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == '(' || text[i - 1] == ',';
    if (text[i] == '+' || text[i] == '-' || text[i] == '*') {
      std::size_t end = endOfTerm(text, i + 1);
      if (text[i] == '*') {  // one factor
        int depth = 0;
        for (end = i + 1; end < text.size(); ++end) {
          const char c = text[end];
          if (depth == 0 && (c == '*' || c == '+' || c == '-' || c == ',' || c == ')' || c == '/')) break;
          depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        }
      }
      found.push_back(text.substr(0, i) + text.substr(end));
    }
    if (begins) {
      std::size_t end = endOfTerm(text, i);
      if (end < text.size() && (text[end] == '+')) found.push_back(text.substr(0, i) + text.substr(end + 1));
      for (end = i; end < text.size() &&
                    (std::isdigit(static_cast<unsigned char>(text[end])) != 0 || text[end] == '.');)
        ++end;
      if (end > i && end < text.size() && text[end] == '*')
        found.push_back(text.substr(0, i) + text.substr(end + 1));
    }
  }
  std::ranges::stable_sort(found, {}, &std::string::size);
  return found;
}

/// All numbers of a formula with at most that many digits.
std::string rounder(const std::string& text, int digits) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const bool inName = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0);
    if (std::isdigit(static_cast<unsigned char>(text[i])) == 0 || inName) {
      out += text[i++];
      continue;
    }
    char* end = nullptr;
    const double value = std::strtod(text.c_str() + i, &end);
    out += Json(rounded(value, digits)).dump();
    i = static_cast<std::size_t>(end - text.c_str());
  }
  return out;
}

double numberOf(const Json& json) {
  if (json.is_number()) return json.get<double>();
  if (json == "tau") return kTau;
  if (json == "pi") return kPi;
  return std::nan("");
}

class Shrinker {
 public:
  Shrinker(Json scene, Trial trial, const Failure& failure, const ShrinkLimits& limits)
      : scene_(std::move(scene)), trial_(std::move(trial)), failure_(failure), limits_(limits) {}

  Json run() {
    for (bool smaller = true; smaller && !spent();) {
      const int before = taken_;
      fewerNodes();
      crop();
      plainer();
      fewerTerms();
      smallerDomains();
      rounderNumbers();
      smaller = taken_ > before;
    }
    scene_["x-wrong"] = {{"hit_miss", trial_.wrong.hitMiss},
                         {"layer", trial_.wrong.layer},
                         {"point", trial_.wrong.point},
                         {"light", trial_.wrong.light},
                         {"color", trial_.wrongColors}};
    return scene_;
  }

 private:
  [[nodiscard]] bool spent() const { return trials_ >= limits_.trials || watch_.seconds() > limits_.seconds; }

  bool attempt(Json candidate) {
    if (spent() || candidate == scene_) return false;
    ++trials_;
    std::optional<Trial> trial = failure_(candidate);
    if (!trial) return false;
    scene_ = std::move(candidate);
    trial_ = std::move(*trial);
    ++taken_;
    return true;
  }

  void fewerNodes() {
    for (std::size_t i = scene_["nodes"].size(); i-- > 0 && scene_["nodes"].size() > 1;) {
      Json fewer = scene_;
      fewer["nodes"].erase(i);
      attempt(std::move(fewer));
    }
    Json used = scene_;
    for (const char* list : {"surfaces", "materials"}) {
      if (!used.contains(list)) continue;
      const std::string key = std::string(list) == "surfaces" ? "surface" : "material";
      Json kept = Json::object();
      for (const Json& node : used["nodes"])
        if (node.contains(key)) kept[node[key].get<std::string>()] = used[list][node[key].get<std::string>()];
      used[list] = std::move(kept);
    }
    if (used != scene_) attempt(std::move(used));
  }

  /// Half the picture each way, around a wrong pixel, which keeps its ray within a pixel.
  void crop() {
    while (!spent()) {
      const int width = scene_["render"]["size"][0], height = scene_["render"]["size"][1];
      const int w = std::max(width / 2, kSmallestSide), h = std::max(height / 2, kSmallestSide);
      if (w >= width || h >= height) return;
      if (!cropTo(w, h) && !coarser(w, h)) return;
    }
  }

  bool cropTo(int w, int h) {
    if (trial_.wrong.pixels.empty()) return false;
    const std::size_t count = trial_.wrong.pixels.size();
    for (const std::size_t which : {count / 2, std::size_t{0}, count - 1})
      if (attempt(aimed(trial_.wrong.pixels[which], w, h))) return true;
    return false;
  }

  [[nodiscard]] Json aimed(std::uint32_t pixel, int w, int h) const {
    const int width = scene_["render"]["size"][0], height = scene_["render"]["size"][1];
    Json candidate = scene_;
    const View view = viewAt(cameraOf(scene_["camera"]), {}, {width, height}, Box{Vec3(-1), Vec3(1)});
    const double px = pixel % static_cast<std::uint32_t>(width) + 0.5,
                 py = pixel / static_cast<std::uint32_t>(width) + 0.5;
    const Vec3 across = (2 * px / width - 1) * view.halfExtent.x * view.right() +
                        (1 - 2 * py / height) * view.halfExtent.y * view.up();
    Json& camera = candidate["camera"];
    const auto set = [](Json& to, const Vec3& v) { to = Json::array({v.x, v.y, v.z}); };
    const Vec3 eye = cameraOf(camera).eye.at({}), target = cameraOf(camera).lookAt.at({});
    const double part = static_cast<double>(h) / height;
    if (view.perspective()) {
      set(camera["look_at"], eye + glm::distance(eye, target) * (view.forward() + across));
      const double half = std::tan(camera["fov_y"].get<double>() / 2) * part;
      camera["fov_y"] = 2 * std::atan(half / (1 + glm::dot(across, across)));
    } else {
      set(camera["eye"], eye + across);
      set(camera["look_at"], target + across);
      camera["height"] = camera["height"].get<double>() * part;
    }
    candidate["render"]["size"] = {w, h};
    return candidate;
  }

  bool coarser(int w, int h) {
    Json candidate = scene_;
    candidate["render"]["size"] = {w, h};
    return attempt(std::move(candidate));
  }

  /// Without what is not needed: samples, transforms, materials' and cameras' own values.
  void plainer() {
    Json one = scene_;
    one["render"]["samples"] = 1;
    attempt(std::move(one));
    for (std::size_t i = 0; i < scene_["nodes"].size(); ++i)
      for (const char* key : {"rotate", "scale", "translate", "material"}) erase(i, key);
    Json level = scene_;
    level["camera"]["up"] = {0, 1, 0};
    attempt(std::move(level));
  }

  void erase(std::size_t node, const char* key) {
    if (!scene_["nodes"][node].contains(key)) return;
    Json without = scene_;
    without["nodes"][node].erase(key);
    attempt(std::move(without));
  }

  void fewerTerms() {
    const Json surfaces = scene_["surfaces"];
    for (const auto& [name, surface] : surfaces.items()) {
      for (std::size_t i = 0; surface.contains("position") && i < 3; ++i)
        shorten([&name = name, i](Json& scene) -> Json& { return scene["surfaces"][name]["position"][i]; });
      if (surface.contains("let"))
        for (const auto& [letName, unused] : surface["let"].items())
          shorten([&name = name, &letName = letName](Json& scene) -> Json& {
            return scene["surfaces"][name]["let"][letName];
          });
      for (const auto& [key, unused] : surface.items()) {  // arguments that may take their default
        if (key == "type" || key == "u" || key == "v" || key == "position") continue;
        Json without = scene_;
        without["surfaces"][name].erase(key);
        attempt(std::move(without));
      }
    }
  }

  void shorten(const std::function<Json&(Json&)>& place) {
    for (bool smaller = true; smaller && !spent();) {
      smaller = false;
      const Json& now = place(scene_);
      if (!now.is_string()) return;
      for (const std::string& text : shorter(now.get<std::string>())) {
        Json candidate = scene_;
        place(candidate) = text;
        if (attempt(std::move(candidate))) {
          smaller = true;
          break;
        }
      }
    }
  }

  void smallerDomains() {
    const Json surfaces = scene_["surfaces"];
    for (const auto& [name, surface] : surfaces.items())
      for (const char* key : {"u", "v"}) {
        if (!surface.contains(key)) continue;
        bool smaller = true;
        for (int halvings = 0; smaller && halvings < kMaxHalvings && !spent(); ++halvings) {
          smaller = false;
          const Json& range = scene_["surfaces"][name][key];
          const double lo = numberOf(range[0]), hi = numberOf(range[1]);
          if (!std::isfinite(lo + hi)) break;
          const double middle = rounded((lo + hi) / 2, 4);
          for (const auto& [from, to] : {std::pair(lo, middle), std::pair(middle, hi)}) {
            Json candidate = scene_;
            candidate["surfaces"][name][key] = {from, to};
            if (attempt(std::move(candidate))) {
              smaller = true;
              break;
            }
          }
        }
      }
  }

  /// Everything at once first, then number by number.
  void rounderNumbers() {
    for (const int digits : {1, 2, 3}) {
      const auto round = [&](Json& leaf) {
        if (leaf.is_number_float()) leaf = rounded(leaf.get<double>(), digits);
        if (leaf.is_string()) leaf = rounder(leaf.get<std::string>(), digits);
      };
      for (const char* part : {"surfaces", "camera", "nodes"}) {
        if (!scene_.contains(part)) continue;
        Json candidate = scene_;
        visit(candidate[part], round);
        if (attempt(std::move(candidate))) continue;
        std::size_t leaves = 0;
        Json counted = scene_[part];
        visit(counted, [&](Json&) { ++leaves; });
        for (std::size_t chosen = 0; chosen < leaves && !spent(); ++chosen) {
          candidate = scene_;
          std::size_t at = 0;
          visit(candidate[part], [&](Json& leaf) {
            if (at++ == chosen) round(leaf);
          });
          attempt(std::move(candidate));
        }
      }
    }
  }

  Json scene_;
  Trial trial_;
  const Failure& failure_;
  ShrinkLimits limits_;
  int trials_ = 0, taken_ = 0;
  Stopwatch watch_;
};

}  // namespace

Json shrunk(const Json& scene, const Trial& first, const Failure& failure, const ShrinkLimits& limits) {
  return Shrinker(scene, first, failure, limits).run();
}

}  // namespace luxo::random
