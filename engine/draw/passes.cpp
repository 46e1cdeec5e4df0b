// SPDX-License-Identifier: Apache-2.0
#include "draw/passes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace luxo {
namespace {

std::vector<Attachment> color(Begin begin) { return {{Target::Color, begin}}; }

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
  return {.name = "light depths", .depth = Begin::Clear, .group = group, .drawsLightMap = true};
}

/// Points are found, by searches and triangles or by rays, and then lit, by one group of lights after the
/// other.
std::vector<Pass> deferredPasses(const DrawList& list, const FrameDesc& frame,
                                 std::span<const DrawBatch> found, Begin begin, bool replaces) {
  const auto firstMesh = std::ranges::find_if(found, [](const DrawBatch& batch) { return !batch.finds(); });
  const std::span<const DrawBatch> searched(found.begin(), firstMesh), meshes(firstMesh, found.end());
  std::vector<Attachment> targets{{Target::Found, begin}};
  std::vector<Target> reads{Target::Found};
  if (list.findsParameters) {
    targets.push_back({Target::FoundParameters, begin});
    reads.push_back(Target::FoundParameters);
  }
  if (list.findsFootprints) {
    targets.push_back({Target::FoundFootprint, begin});
    reads.push_back(Target::FoundFootprint);
  }
  if (list.findsFrames) {
    targets.push_back({Target::FoundFrame, begin});
    reads.push_back(Target::FoundFrame);
  }
  Pass finds{.name = replaces ? "rays" : "found",
             .colors = targets,
             .depth = begin,
             .searches = list.exact() && !replaces,
             .batches = replaces ? std::span<const DrawBatch>() : searched,
             .rays = frame.rays,
             .probes = frame.probes && (!replaces || meshes.empty())};  // else meshes have been drawn over it
  std::vector<Pass> passes{std::move(finds)};
  // After rays, which know nothing of meshes.
  if (!replaces && !meshes.empty()) {
    for (Attachment& target : targets) target.begin = Begin::Keep;
    if (list.findsPlaces && !list.findsParameters) targets.push_back({Target::FoundParameters, begin});
    passes.push_back({.name = "found meshes", .colors = targets, .batches = meshes});
  }
  if (!replaces && !list.places.empty())
    passes.push_back({.name = "places",
                      .colors = {{Target::Places, Begin::Clear}},
                      .reads = {Target::Found, Target::FoundParameters},
                      .searches = true,
                      .casters = list.places});
  // The shadows of many groups share one target, which holds those of the last; and points of rays are
  // compared with a map, too.
  const bool shadowsStay = replaces && list.groups.size() == 1 && !list.hasLightMaps();
  // Rays tell the shadows of all their pixels: the light of the others is there. A miss is cleared with all.
  const bool shadesStay = shadowsStay && !frame.answers && frame.rays->misses.empty() && !list.layers.any() &&
                          frame.rays->shadows.size() == 1 && !frame.rays->shadows[0].empty() &&
                          !list.occludes;
  if (list.occludes) {
    passes.push_back({.name = "openness",
                      .colors = {{Target::Openness, Begin::Clear}},
                      .reads = {Target::Found},
                      .shades = kOpenness});
    reads.push_back(Target::Openness);
  }
  for (std::size_t i = 0; i < list.groups.size(); ++i) {
    const LightGroup& group = list.groups[i];
    Pass shades{.name = "shade",
                .colors = color(i == 0 && !shadesStay ? Begin::Clear : Begin::Keep),
                .reads = reads,
                .group = i,
                .shades = group.shades,
                .asks = list.traces};
    if (shadesStay) shades.pixels = frame.rays->shadows[i];
    // Meshes that are drawn again ask for the shadows of every group: one without has to say so.
    const bool asks = !group.again.empty() && list.findsShadows();
    if (!group.lights.empty() || group.transmits || asks) {
      passes.push_back({.name = "shadows",
                        .colors = {{Target::Shadows, shadowsStay ? Begin::Keep : Begin::Clear}},
                        .reads = {Target::Found, Target::Places},
                        .searches = !shadowsStay,
                        .group = i,
                        .casters = shadowsStay ? std::span<const CasterDraw>() : group.shadows,
                        .flatShadows = shadowsStay ? std::span<const FlatShadowDraw>() : group.flatShadows,
                        .rays = frame.rays,
                        .probes = frame.probes});
      shades.reads.push_back(Target::Shadows);
    }
    if (group.map) passes.push_back(lightDepths(i));
    if (group.transmits) {
      passes.push_back(
          {.name = "transmittance",
           .colors = {{Target::Transmittance, shadowsStay ? Begin::Keep : Begin::Clear}},
           .reads = {Target::Found, Target::Places},
           .searches = !shadowsStay,
           .group = i,
           .casters = shadowsStay ? std::span<const CasterDraw>() : group.transmittances,
           .flatShadows = shadowsStay ? std::span<const FlatShadowDraw>() : group.flatTransmittances,
           .readsLightMap = group.map.has_value(),
           .rays = frame.rays,
           .probes = frame.probes});
      if (group.map) passes.back().reads.push_back(Target::LightDepth);
      shades.reads.push_back(Target::Transmittance);
    }
    Pass again{.name = "meshes again",
               .colors = color(Begin::Keep),
               .reads = shades.reads,
               .batches = group.again,
               .group = i};
    if (asks && list.findsTransmittances() && !group.transmits) again.reads.push_back(Target::Transmittance);
    passes.push_back(std::move(shades));
    if (!group.again.empty()) passes.push_back(std::move(again));
  }
  return passes;
}

/// What is seen through: its points are found, in any order, lit by one group of lights after the other, and
/// blended over what is not.
void addLayers(const DrawList& list, const FrameDesc& frame, LayerBand band, bool replaces,
               std::vector<Pass>& passes) {
  std::vector<Target> reads{Target::Depth};
  if (list.occludes) reads.push_back(Target::Found);
  const auto add = [&](const char* name, Pass pass) {
    pass.name = name;
    pass.depth = std::nullopt;
    pass.reads = reads;
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
  // A point holds the shadows of one group.
  const bool shadowsStay = replaces && list.groups.size() == 1;
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
  add("blend layers", {.colors = color(Begin::Keep),
                       .searches = true,
                       .countsLayers = true,
                       .shades = {&list.layers.blend, 1}});
}

}  // namespace

std::vector<Pass> passesOf(const DrawList& list, const FrameDesc& frame) {
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
    passes = deferredPasses(list, frame, opaque.found, begin, replaces);
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
  if (!list.transparent.empty() || frame.emptyPasses)
    passes.push_back({.name = "transparent", .colors = color(Begin::Keep), .batches = list.transparent});
  return passes;
}

void appendStates(const Pass& pass, std::vector<DrawState>& states) {
  const auto append = [&](const auto& draws) {
    for (const auto& draw : draws) states.push_back(draw.state);
  };
  append(pass.batches);
  append(pass.casters);
  append(pass.flatShadows);
  states.insert(states.end(), pass.shades.begin(), pass.shades.end());
  if (pass.drawsLightMap) states.push_back({.form = Form::LightDepth});
  if (pass.readsLightMap)
    states.push_back({.form = pass.colors.empty() ? Form::LayerLightMap : Form::LightMap});
}

}  // namespace luxo
