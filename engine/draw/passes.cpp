// SPDX-License-Identifier: Apache-2.0
#include "draw/passes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/assert.h"

namespace luxo {
namespace {

std::vector<Attachment> color(Begin begin, gpu::Blend blend = gpu::Blend::None) {
  return {{Target::Color, begin, blend}};
}

/// What triangles that are drawn again draw to. Of a drawing the lightest of its levels counts. Other light
/// is added: but of all triangles that are as near in a pixel, as where a model has them twice, one alone is
/// what is seen. So it is drawn apart, each over the one before, and then added.
Attachment attachmentOf(const DrawState& again) {
  if (addsMoreLight(again)) return {Target::MoreLight, Begin::Clear};
  return {Target::Color, Begin::Keep, again.addsLight ? gpu::Blend::Lighten : gpu::Blend::None};
}

/// Whether they are drawn in one pass.
bool drawnTogether(const DrawState& a, const DrawState& b) {
  return attachmentOf(a) == attachmentOf(b) && a.firstLight == b.firstLight;
}

const std::array<DrawState, 1> kAddLight{DrawState{.form = Form::AddLight}};
const std::array<DrawState, 1> kOpenness{DrawState{.form = Form::Openness}};

/// What the first pass draws, and what is drawn over that.
struct Opaque {
  std::span<const DrawBatch> found, meshes;
};

Opaque opaqueOf(const DrawList& list) {
  const auto firstOther = std::ranges::find_if(list.opaque, [&](const DrawBatch& batch) {
    return list.deferred ? batch.state.form == Form::Fused : !batch.finds();
  });
  return {{list.opaque.begin(), firstOther}, {firstOther, list.opaque.end()}};
}

Pass lightDepths(std::size_t group) {
  return {.name = "light depths",
          .depth = Begin::Clear,
          .depthTarget = Target::LightDepth,
          .group = group,
          .drawsLightMap = true};
}

/// Points are found, by searches and triangles or by rays, and then lit, by one group of lights after the
/// other.
class DeferredPasses {
 public:
  /// `replaces`: points of rays replace what the last frame has found.
  DeferredPasses(const DrawList& list, const FrameDesc& frame, bool replaces)
      : list_(list),
        frame_(frame),
        replaces_(replaces),
        // Points of rays are compared with a map, too.
        shadowsStay_(replaces && list.keepsShadows() && !list.hasLightMaps()) {}

  [[nodiscard]] std::vector<Pass> of(std::span<const DrawBatch> found) && {
    const auto firstMesh = std::ranges::find_if(found, [](const DrawBatch& b) { return !b.finds(); });
    const std::span<const DrawBatch> searched(found.begin(), firstMesh), meshes(firstMesh, found.end());
    findPoints(searched, meshes);
    if (!replaces_) {
      findMeshes(meshes);
      findPlaces();
    }
    findOpenness();
    for (std::size_t group = 0; group < list_.groups.size(); ++group) {
      findShadows(group);
      drawLightMap(group);
      findTransmittance(group);
      shade(group);
      drawAgain(group);
    }
    return std::move(passes_);
  }

  [[nodiscard]] std::vector<Pass> ofLight() && {
    for (std::size_t group = 0; group < list_.groups.size(); ++group) {
      shade(group);
      drawAgain(group);
    }
    return std::move(passes_);
  }

 private:
  /// What light may ask of a point.
  [[nodiscard]] std::vector<Target> foundTargets() const {
    std::vector<Target> targets{Target::Found};
    if (list_.findsParameters) targets.push_back(Target::FoundParameters);
    if (list_.findsFootprints) targets.push_back(Target::FoundFootprint);
    if (list_.findsFrames) targets.push_back(Target::FoundFrame);
    return targets;
  }

  [[nodiscard]] std::vector<Attachment> foundAttachments(Begin begin) const {
    std::vector<Attachment> all;
    for (const Target target : foundTargets()) all.push_back({target, begin});
    return all;
  }

  void findPoints(std::span<const DrawBatch> searched, std::span<const DrawBatch> meshes) {
    const Begin begin = replaces_ ? Begin::Keep : Begin::Clear;
    passes_.push_back(
        {.name = replaces_ ? "rays" : "found",
         .colors = foundAttachments(begin),
         .depth = begin,
         .searches = list_.exact() && !replaces_,
         .batches = replaces_ ? std::span<const DrawBatch>() : searched,
         .rays = frame_.rays,
         .probes = frame_.probes && (!replaces_ || meshes.empty())});  // else meshes have been drawn over it
  }

  /// After rays, which know nothing of meshes.
  void findMeshes(std::span<const DrawBatch> meshes) {
    if (meshes.empty()) return;
    std::vector<Attachment> colors = foundAttachments(Begin::Keep);
    if (list_.findsPlaces && !list_.findsParameters)
      colors.push_back({Target::FoundParameters, Begin::Clear});
    passes_.push_back({.name = "found meshes", .colors = std::move(colors), .batches = meshes});
  }

  void findPlaces() {
    if (list_.places.empty()) return;
    passes_.push_back({.name = "places",
                       .colors = {{Target::Places, Begin::Clear}},
                       .reads = {Target::Found, Target::FoundParameters},
                       .searches = true,
                       .casters = list_.places});
  }

  void findOpenness() {
    if (!list_.occludes) return;
    passes_.push_back({.name = "openness",
                       .colors = {{Target::Openness, Begin::Clear}},
                       .reads = {Target::Found},
                       .shades = kOpenness});
  }

  void findShadows(std::size_t index) {
    const LightGroup& group = list_.groups[index];
    if (!list_.asksForShadows(group)) return;
    const std::size_t before = passes_.size();
    if (!shadowsStay_)
      passes_.push_back(occlusion("shadows", {Target::Shadows, Begin::Clear, gpu::Blend::Or}, index,
                                  group.shadows, group.flatShadows));
    if (raysTell(index)) passes_.push_back(occlusionOfRays("shadows of rays", Target::Shadows, index));
    if (list_.findsShadows()) probeLastSince(before);
  }

  void drawLightMap(std::size_t index) {
    if (list_.groups[index].map) passes_.push_back(lightDepths(index));
  }

  void findTransmittance(std::size_t index) {
    const LightGroup& group = list_.groups[index];
    if (!group.transmits) return;
    const std::size_t before = passes_.size();
    if (!shadowsStay_)
      passes_.push_back(occlusion("transmittance",
                                  {Target::Transmittance, Begin::Clear, gpu::Blend::Multiply}, index,
                                  group.transmittances, group.flatTransmittances));
    if (raysTell(index))
      passes_.push_back(occlusionOfRays("transmittance of rays", Target::Transmittance, index));
    if (group.map) compareWithMap(index);
    probeLastSince(before);
  }

  /// What keeps lights from what was found.
  [[nodiscard]] static Pass occlusion(const char* name, Attachment target, std::size_t group,
                                      std::span<const CasterDraw> casters,
                                      std::span<const FlatShadowDraw> flat) {
    return {.name = name,
            .colors = {target},
            .reads = {Target::Found, Target::Places},
            .searches = true,
            .group = group,
            .casters = casters,
            .flatShadows = flat};
  }

  [[nodiscard]] bool raysTell(std::size_t group) const {
    if (!frame_.rays) return false;
    return frame_.emptyPasses || (!frame_.rays->shadows.empty() && !frame_.rays->shadows[group].empty());
  }

  /// What rays have found of that, which replaces what is there.
  [[nodiscard]] Pass occlusionOfRays(const char* name, Target target, std::size_t group) const {
    return {.name = name, .colors = {{target}}, .group = group, .rays = frame_.rays};
  }

  /// Along with the casters, unless points of rays come in between, which know nothing of the map.
  void compareWithMap(std::size_t group) {
    if (raysTell(group))
      passes_.push_back({.name = "light map",
                         .colors = {{Target::Transmittance, Begin::Keep, gpu::Blend::Multiply}},
                         .reads = {Target::Found},
                         .group = group});
    passes_.back().readsLightMap = true;
    passes_.back().reads.push_back(Target::LightDepth);
  }

  /// Of passes onto one target, all since there were so many, the last leaves what probes are of.
  void probeLastSince(std::size_t before) {
    if (passes_.size() > before) passes_.back().probes = frame_.probes;
  }

  /// Rays tell the shadows of all their pixels: the light of the others is there. A miss is cleared with all.
  /// Where shaders send rays, all ask anew: what has been asked is gone.
  [[nodiscard]] bool shadesStay() const {
    return shadowsStay_ && !list_.traces && frame_.rays->misses.empty() && !list_.layers.any() &&
           frame_.rays->shadows.size() == 1 && !frame_.rays->shadows[0].empty() && !list_.occludes;
  }

  [[nodiscard]] std::vector<Target> readsOf(const LightGroup& group) const {
    std::vector<Target> reads = foundTargets();
    if (list_.occludes) reads.push_back(Target::Openness);
    if (list_.asksForShadows(group)) reads.push_back(Target::Shadows);
    if (group.transmits) reads.push_back(Target::Transmittance);
    return reads;
  }

  void shade(std::size_t index) {
    const LightGroup& group = list_.groups[index];
    Pass pass{.name = "shade",
              .colors = color(index == 0 && !shadesStay() ? Begin::Clear : Begin::Keep,
                              index == 0 ? gpu::Blend::None : gpu::Blend::Add),
              .reads = readsOf(group),
              .group = index,
              .shades = group.shades,
              .asks = list_.traces};
    if (shadesStay()) pass.pixels = frame_.rays->shadows[index];
    passes_.push_back(std::move(pass));
  }

  void drawAgain(std::size_t index) {
    const LightGroup& group = list_.groups[index];
    const std::vector<Target> reads = readsOf(group);
    for (auto first = group.again.begin(); first != group.again.end();) {
      const auto end = std::find_if(first, group.again.end(), [&first](const DrawBatch& batch) {
        return !drawnTogether(batch.state, first->state);
      });
      passes_.push_back({.name = "meshes again",
                         .colors = {attachmentOf(first->state)},
                         .reads = reads,
                         .batches = {first, end},
                         .group = index});
      if (addsMoreLight(first->state))
        passes_.push_back({.name = "more light",
                           .colors = color(Begin::Keep, gpu::Blend::Add),
                           .reads = {Target::MoreLight},
                           .group = index,
                           .shades = kAddLight});
      first = end;
    }
  }

  const DrawList& list_;
  const FrameDesc& frame_;
  bool replaces_, shadowsStay_;
  std::vector<Pass> passes_;
};

/// What is seen through: its points are found, in any order, lit by one group of lights after the other, and
/// blended over what is not. `replaces`: they are there, and rays replace some, where there are any.
void addLayers(const DrawList& list, const FrameDesc& frame, LayerBand band, bool replaces,
               std::vector<Pass>& passes) {
  std::vector<Target> reads{Target::Depth};
  if (list.occludes) reads.push_back(Target::Found);
  const auto add = [&](const char* name, Pass pass) {
    pass.name = name;
    pass.depth = std::nullopt;
    pass.reads = reads;
    pass.layers = true;
    pass.band = band;
    passes.push_back(std::move(pass));
  };
  // Draws of one pass add points. Those that read what others have written are in passes of their own.
  if (!replaces)
    add("layers", {.searches = true,
                   .batches = list.layers.meshes,
                   .casters = list.layers.searches,
                   .clearsLayers = true});
  if (!replaces && !list.layers.places.empty())
    add("places of layers", {.searches = true, .casters = list.layers.places});
  if (frame.rays) add("layers of rays", {.rays = frame.rays});
  const bool shadowsStay = replaces && list.keepsShadows();
  for (std::size_t i = 0; i < list.groups.size(); ++i) {
    const LightGroup& group = list.groups[i];
    for (const std::span<const CasterDraw> casters :
         {std::span(group.layerShadows), std::span(group.layerTransmittances)})
      for (std::size_t k = 0; !shadowsStay && k < casters.size(); ++k)
        add("layer shadows", {.searches = true, .group = i, .casters = casters.subspan(k, 1)});
    // That of the first group comes with the points that rays have found.
    if (frame.rays && i > 0) add("light on layers of rays", {.group = i, .rays = frame.rays});
    if (group.map && group.lightsLayers()) {
      passes.push_back(lightDepths(i));
      add("light map on layers", {.group = i, .readsLightMap = true});
      passes.back().reads.push_back(Target::LightDepth);
    }
    for (std::size_t k = 0; k < group.layerShades.size(); ++k)
      add("shade layers",
          {.searches = true, .group = i, .shades = std::span(group.layerShades).subspan(k, 1)});
    for (std::size_t k = 0; k < group.layerAgain.size(); ++k)
      add("layers again", {.batches = std::span(group.layerAgain).subspan(k, 1), .group = i});
  }
  const bool ofGeometry = inspectionOf(list.layers.blend).has_value();
  add("blend layers", {.colors = color(Begin::Keep, ofGeometry ? gpu::Blend::None : gpu::Blend::Through),
                       .searches = true,
                       .countsLayers = true,
                       .shades = {&list.layers.blend, 1}});
}

}  // namespace

std::vector<Pass> passesOf(const DrawList& list, const FrameDesc& frame) {
  if (frame.relights) {
    std::vector<Pass> passes = DeferredPasses(list, frame, false).ofLight();
    if (list.layers.any()) addLayers(list, frame, {}, true, passes);
    return passes;
  }
  const Opaque opaque = opaqueOf(list);
  const bool searches = list.exact();
  std::vector<Pass> passes;
  // Points of rays replace what was found, as long as nothing was drawn over that which is not drawn again.
  // Shadows and layers of rays replace those of meshes, too.
  const bool onlyLater = frame.rays && list.deferred && frame.rays->vertices.empty() &&
                         frame.rays->misses.empty() && opaque.meshes.empty() && list.transparent.empty();
  const bool replaces =
      frame.rays && (list.onlyFound() || onlyLater) &&
      (!list.layers.any() || (list.deferred && frame.layerBands == 1 && !list.hasLightMaps()));
  const Begin begin = replaces ? Begin::Keep : Begin::Clear;
  if (list.deferred)
    passes = DeferredPasses(list, frame, replaces).of(opaque.found);
  else if (replaces)
    passes.push_back({.name = "rays", .colors = color(begin), .depth = begin, .rays = frame.rays});
  else if (opaque.found.empty() && !opaque.meshes.empty())
    passes.push_back({.name = "opaque",
                      .colors = color(begin),
                      .depth = begin,
                      .batches = opaque.meshes,
                      .rays = frame.rays});
  else
    passes.push_back({.name = "found",
                      .colors = color(begin),
                      .depth = begin,
                      .searches = searches,
                      .batches = opaque.found,
                      .rays = frame.rays});
  if (!list.deferred) passes.back().probes = frame.probes;
  if (!replaces && (list.deferred || !opaque.found.empty()) && !opaque.meshes.empty())
    passes.push_back({.name = "meshes", .colors = color(Begin::Keep), .batches = opaque.meshes});
  for (std::uint32_t band = 0; list.layers.any() && band < frame.layerBands; ++band)
    addLayers(list, frame, {band, frame.layerBands}, replaces, passes);
  if (replaces) return passes;
  if (list.transparent.empty() && !frame.emptyPasses) return passes;
  // Of geometry the nearest counts.
  const bool ofGeometry = !list.transparent.empty() && inspectionOf(list.transparent.front().state);
  passes.push_back({.name = "transparent",
                    .colors = color(Begin::Keep, ofGeometry ? gpu::Blend::None : gpu::Blend::Color),
                    .batches = list.transparent});
  return passes;
}

TargetFormat formatOf(const Pass& pass, const PictureFormat& picture) {
  TargetFormat format{.samples =
                          pass.depthTarget == Target::LightDepth ? VK_SAMPLE_COUNT_1_BIT : picture.samples};
  if (pass.depth) format.depth = formatOf(pass.depthTarget, picture);
  LUXO_REQUIRE_COMPARE(pass.colors.size(), <=, format.colors.size());
  for (std::size_t i = 0; i < pass.colors.size(); ++i)
    format.colors[i] = {formatOf(pass.colors[i].target, picture), pass.colors[i].blend};
  return format;
}

std::vector<DrawState> statesOf(const Pass& pass) {
  std::vector<DrawState> states;
  const auto append = [&](const auto& draws) {
    for (const auto& draw : draws) states.push_back(draw.state);
  };
  append(pass.batches);
  append(pass.casters);
  append(pass.flatShadows);
  states.insert(states.end(), pass.shades.begin(), pass.shades.end());
  if (pass.drawsLightMap) states.push_back({.form = Form::LightDepth});
  if (pass.readsLightMap) states.push_back({.form = pass.layers ? Form::LayerLightMap : Form::LightMap});
  return states;
}

}  // namespace luxo
