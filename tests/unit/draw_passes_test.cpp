// SPDX-License-Identifier: Apache-2.0
// The passes of every kind of frame, as names with what they begin with, and how their colours join.
#include "draw/passes.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace luxo {
namespace {

/// "name+" keeps its targets, "name" clears them; then how many batches it draws, and "*" for points of rays.
std::vector<std::string> told(const DrawList& list, const FrameDesc& frame) {
  std::vector<std::string> names;
  for (const Pass& pass : passesOf(list, frame)) {
    std::string name = pass.name;
    for (const Attachment& color : pass.colors) EXPECT_EQ(color.begin, pass.depth) << name;
    if (pass.depth == Begin::Keep) name += '+';
    name += ' ' + std::to_string(pass.batches.size());
    if (pass.rays) name += '*';
    names.push_back(name);
  }
  return names;
}

/// So many draws of shells, of meshes, and of what is seen through.
DrawList listOf(int shells, int meshes, int transparent) {
  DrawList list;
  for (int i = 0; i < shells; ++i) {
    list.opaque.push_back({.shell = std::make_shared<Shell>()});
    list.exactPatches.resize(1);
  }
  for (int i = 0; i < meshes; ++i) list.opaque.push_back({.mesh = std::make_shared<Mesh>()});
  for (int i = 0; i < transparent; ++i) list.transparent.push_back({.mesh = std::make_shared<Mesh>()});
  return list;
}

using Names = std::vector<std::string>;

TEST(Passes, APictureClearsItsTargetsOnce) {
  EXPECT_EQ(told(listOf(2, 0, 0), {}), (Names{"found 2"}));
  EXPECT_EQ(told(listOf(0, 3, 0), {}), (Names{"opaque 3"}));
  EXPECT_EQ(told(listOf(2, 3, 1), {}), (Names{"found 2", "meshes+ 3", "transparent+ 1"}));
  EXPECT_EQ(told(listOf(0, 0, 0), {}), (Names{"found 0"})) << "the background";
  EXPECT_EQ(told(listOf(1, 0, 0), {.emptyPasses = true}), (Names{"found 1", "transparent+ 0"}));
}

TEST(Passes, PointsOfRaysReplaceWhatNothingWasDrawnOver) {
  const RayPoints points;
  EXPECT_EQ(told(listOf(2, 0, 0), {.rays = &points}), (Names{"rays+ 0*"}));
  EXPECT_EQ(told(listOf(2, 1, 0), {.rays = &points}), (Names{"found 2*", "meshes+ 1"}));
  EXPECT_EQ(told(listOf(2, 0, 1), {.rays = &points}), (Names{"found 2*", "transparent+ 1"}));
}

TEST(Passes, ThoseThatSearchSaySo) {
  const DrawList mixed = listOf(1, 1, 1), meshes = listOf(0, 1, 0);
  const std::vector<Pass> passes = passesOf(mixed, {.probes = true});
  ASSERT_EQ(passes.size(), 3u);
  EXPECT_TRUE(passes[0].searches && !passes[1].searches && !passes[2].searches);
  EXPECT_TRUE(passes[0].probes && !passes[1].probes && !passes[2].probes)
      << "depths are those of what was found, before meshes are drawn over it";
  EXPECT_FALSE(passesOf(meshes, {})[0].searches);
}

/// Two draws that find points, which one group of lights lights.
DrawList deferredList() {
  DrawList list = listOf(2, 0, 0);
  for (DrawBatch& batch : list.opaque) batch.state.form = Form::Found;
  list.deferred = true;
  list.groups.resize(1);
  return list;
}

TEST(Passes, WhatIsLitAtOnceIsDrawnWhereNothingIsLitLater) {
  DrawList list = listOf(0, 2, 0);
  list.deferred = true;
  list.groups.resize(1);
  const std::vector<Pass> passes = passesOf(list, {});
  ASSERT_EQ(passes.size(), 3U);
  EXPECT_EQ(passes[2].name, std::string("meshes"));
  EXPECT_EQ(passes[2].batches.size(), 2U);
  EXPECT_EQ(passes[2].colors.front().begin, Begin::Keep);
}

/// Once the shadows of its lights are known, after what was cleared for each group.
TEST(Passes, MeshesAreDrawnAgainForEachGroupOfLights) {
  DrawList list = deferredList();
  list.groups.resize(2);
  for (LightGroup& group : list.groups) {
    group.lights.resize(1);
    group.again.resize(1);
  }
  Names names;
  for (const Pass& pass : passesOf(list, {})) names.emplace_back(pass.name);
  EXPECT_EQ(names, (Names{"found", "shadows", "shade", "meshes again", "shadows", "shade", "meshes again"}));
}

/// Once for all lights, and where nothing replaces what was found.
TEST(Passes, PlacesOfMeshesAreFoundBeforeShadows) {
  DrawList list = deferredList();
  list.opaque.push_back({.state = {.form = Form::FoundWithParameters}, .mesh = std::make_shared<Mesh>()});
  list.findsPlaces = true;
  list.places.resize(2);
  list.groups.resize(2);
  for (LightGroup& group : list.groups) group.lights.resize(1);
  const auto namesOf = [&](const FrameDesc& frame) {
    Names names;
    for (const Pass& pass : passesOf(list, frame)) names.emplace_back(pass.name);
    return names;
  };
  EXPECT_EQ(namesOf({}), (Names{"found", "found meshes", "places", "shadows", "shade", "shadows", "shade"}));
  const std::vector<Pass> passes = passesOf(list, {});
  EXPECT_EQ(passes[0].colors.size(), 1U) << "of exact surfaces no light asks for parameters";
  EXPECT_EQ(passes[1].colors.size(), 2U);
  EXPECT_EQ(passes[2].casters.size(), 2U);
  const RayPoints points;
  EXPECT_EQ(namesOf({.rays = &points}), (Names{"rays", "shade", "shade"}));
  EXPECT_FALSE(passesOf(list, {.rays = &points, .probes = true})[0].probes) << "there are meshes over it";
}

/// No pass has a target that no light asks for.
TEST(Passes, WhatIsFoundIsWhatIsAskedFor) {
  DrawList list = deferredList();
  const auto targets = [&] {
    const std::vector<Pass> passes = passesOf(list, {});
    EXPECT_EQ(passes[0].colors.size(), passes[1].reads.size());
    return passes[0].colors.size();
  };
  EXPECT_EQ(targets(), 1U);
  list.findsParameters = true;
  EXPECT_EQ(targets(), 2U);
  list.findsFootprints = true;
  EXPECT_EQ(targets(), 3U);
  list.findsFrames = true;
  EXPECT_EQ(targets(), 4U);
}

/// Else their shader would see those of another group.
TEST(Passes, MeshesThatAreDrawnAgainSeeNoOtherGroupsShadows) {
  DrawList list = deferredList();
  list.groups.resize(2);
  list.groups[1].lights.resize(1);
  for (LightGroup& group : list.groups) group.again.resize(1);
  Names names;
  for (const Pass& pass : passesOf(list, {})) names.emplace_back(pass.name);
  EXPECT_EQ(names, (Names{"found", "shadows", "shade", "meshes again", "shadows", "shade", "meshes again"}));
}

TEST(Passes, ShadowsAreFoundBetweenPointsAndLight) {
  DrawList list = deferredList();
  const auto namesOf = [&](const FrameDesc& frame) {
    Names names;
    for (const Pass& pass : passesOf(list, frame)) {
      const Attachment& target = pass.colors.front();
      names.push_back(std::string(pass.name) + (target.begin == Begin::Keep ? "+" : "") +
                      (pass.rays ? "*" : "") + " " + std::to_string(pass.casters.size()));
    }
    return names;
  };
  EXPECT_EQ(namesOf({}), (Names{"found 0", "shade 0"}));
  list.groups[0].lights.resize(1);
  list.groups[0].shadows.resize(3);
  EXPECT_EQ(namesOf({}), (Names{"found 0", "shadows 3", "shade 0"}));
  const RayPoints points;
  EXPECT_EQ(namesOf({.rays = &points}), (Names{"rays+* 0", "shade 0"})) << "what was found stays";
  const RayPoints shadows{.shadows = {{{.place = Vec2f(7.5, 3.5)}}}};
  EXPECT_EQ(namesOf({.rays = &shadows}), (Names{"rays+* 0", "shadows of rays+* 0", "shade+ 0"}))
      << "so does the light, but in the pixels of rays";
  EXPECT_EQ(passesOf(list, {.rays = &shadows})[2].pixels.size(), 1U);
  const RayPoints missed{.misses = {{9, 3}}, .shadows = shadows.shadows};
  EXPECT_EQ(namesOf({.rays = &missed}), (Names{"rays+* 0", "shadows of rays+* 0", "shade 0"}))
      << "where a ray meets nothing there is no light";
  list.traces = true;
  EXPECT_EQ(namesOf({.rays = &shadows}), (Names{"rays+* 0", "shadows of rays+* 0", "shade 0"}))
      << "every shader asks anew";
  EXPECT_TRUE(passesOf(list, {.rays = &shadows})[2].pixels.empty());
  list.traces = false;

  list.groups.resize(3);  // the last without shadows
  list.groups[1].lights.resize(1);
  list.groups[1].shadows.resize(2);
  EXPECT_EQ(namesOf({}), (Names{"found 0", "shadows 3", "shade 0", "shadows 2", "shade+ 0", "shade+ 0"}))
      << "light is added to light";
  EXPECT_EQ(namesOf({.rays = &points}), (Names{"rays+* 0", "shade 0", "shade+ 0", "shade+ 0"}))
      << "each group's shadows stay";
  EXPECT_EQ(passesOf(list, {})[4].group, 1U);

  const std::vector<Pass> passes = passesOf(list, {});
  EXPECT_EQ(passes[1].colors.front().target, Target::Shadows);
  EXPECT_EQ(passes[1].reads, (std::vector{Target::Found, Target::Places}));
  EXPECT_TRUE(passes[1].searches) << "what it leaves open is told";
  EXPECT_EQ(passes[2].reads, (std::vector{Target::Found, Target::Shadows}));

  list.groups.resize(kKeptGroups + 1);
  EXPECT_EQ(namesOf({.rays = &points}), (Names{"rays+* 0", "shadows 3", "shade 0", "shadows 2", "shade+ 0",
                                               "shade+ 0", "shade+ 0", "shade+ 0"}))
      << "of so many groups those of the first are gone";
}

TEST(Passes, GroupsOfLightsHaveTargetsOfTheirOwnWhereTheyAreFew) {
  DrawList list = deferredList();
  list.groups.resize(kKeptGroups);
  EXPECT_TRUE(list.keepsShadows());
  EXPECT_EQ(list.shadowSlot(kKeptGroups - 1), kKeptGroups - 1);
  EXPECT_FALSE(list.asksForShadows(list.groups[1]));
  list.groups[0].lights.resize(1);
  EXPECT_TRUE(list.asksForShadows(list.groups[0]) && !list.asksForShadows(list.groups[1]));
  list.groups[1].again.resize(1);
  EXPECT_TRUE(list.asksForShadows(list.groups[1])) << "what is drawn again asks for all";
  list.groups.resize(kKeptGroups + 1);
  EXPECT_FALSE(list.keepsShadows());
  EXPECT_EQ(list.shadowSlot(kKeptGroups), 0U);
}

/// How the colours of every pass join those that are there, one word for each of its targets.
Names joined(const std::vector<Pass>& passes) {
  const auto word = [](gpu::Blend blend) -> std::string {
    switch (blend) {
      case gpu::Blend::None:
        return " none";
      case gpu::Blend::Or:
        return " or";
      case gpu::Blend::Multiply:
        return " multiply";
      case gpu::Blend::Add:
        return " add";
      case gpu::Blend::Lighten:
        return " lighten";
      case gpu::Blend::Color:
        return " color";
      case gpu::Blend::Through:
        return " through";
      default:
        return " other";
    }
  };
  Names names;
  for (const Pass& pass : passes) {
    std::string& name = names.emplace_back(pass.name);
    for (const Attachment& color : pass.colors) name += word(color.blend);
  }
  return names;
}

/// Two groups: light of one gets through its casters, and is compared with a depth map.
DrawList listInShadow() {
  DrawList list = deferredList();
  list.findsParameters = true;
  list.groups.resize(2);
  for (LightGroup& group : list.groups) {
    group.lights.resize(1);
    group.shadows.resize(2);
  }
  list.groups[1].transmits = true;
  list.groups[1].transmittances.resize(2);
  list.groups[1].map.emplace();
  return list;
}

TEST(Passes, ShadowsAreUnitedAndLightIsAdded) {
  const DrawList list = listInShadow();
  EXPECT_EQ(joined(passesOf(list, {})), (Names{"found none none", "shadows or", "shade none", "shadows or",
                                               "light depths", "transmittance multiply", "shade add"}));
  EXPECT_EQ(joined(passesOf(list, {.relights = true})), (Names{"shade none", "shade add"}));
}

/// They know nothing of the depth map, which they are compared with after that.
TEST(Passes, ShadowsOfRaysReplaceWhatCastersLeave) {
  const DrawList list = listInShadow();
  const RayPoints points{.shadows = {{{.place = Vec2f(7.5, 3.5)}}, {{.place = Vec2f(7.5, 3.5)}}}};
  const std::vector<Pass> passes = passesOf(list, {.rays = &points, .probes = true});
  ASSERT_EQ(joined(passes),
            (Names{"rays none none", "shadows or", "shadows of rays none", "shade none", "shadows or",
                   "shadows of rays none", "light depths", "transmittance multiply",
                   "transmittance of rays none", "light map multiply", "shade add"}));
  for (const std::size_t ofRays : {2, 5, 8}) {
    EXPECT_EQ(passes[ofRays].colors.front().begin, Begin::Keep);
    EXPECT_EQ(passes[ofRays].group, ofRays == 2 ? 0U : 1U);
    EXPECT_EQ(passes[ofRays].rays, &points);
    EXPECT_FALSE(passes[ofRays].searches);
  }
  EXPECT_TRUE(passes[1].searches && passes[4].searches && passes[7].searches);
  EXPECT_TRUE(passes[9].readsLightMap && !passes[7].readsLightMap);
  EXPECT_EQ(passes[9].reads, (std::vector{Target::Found, Target::LightDepth}));
  EXPECT_EQ(passes[9].colors.front().begin, Begin::Keep);
  std::vector<std::size_t> probed;
  for (std::size_t i = 0; i < passes.size(); ++i)
    if (passes[i].probes) probed.push_back(i);
  EXPECT_EQ(probed, (std::vector<std::size_t>{0, 2, 5, 9})) << "once each, of what is complete";

  const RayPoints none;
  EXPECT_EQ(joined(passesOf(list, {.rays = &none})),
            (Names{"rays none none", "shadows or", "shade none", "shadows or", "light depths",
                   "transmittance multiply", "shade add"}));
  EXPECT_EQ(passesOf(list, {.rays = &none, .emptyPasses = true}).size(), passes.size());
}

/// A pass for each way in which light joins that of others.
TEST(Passes, LightOnMeshesThatAreDrawnAgainJoinsThatOfOthers) {
  DrawList list = deferredList();
  list.groups.resize(2);
  const auto again = [](Shading shading, bool addsLight, std::uint32_t firstLight = 0) {
    return DrawBatch{
        .state = {.shading = shading, .form = Form::Again, .addsLight = addsLight, .firstLight = firstLight}};
  };
  EXPECT_FALSE(list.addsLight());
  list.groups[0].again = {again(Shading::Gouraud, false), again(Shading::Toon, false),
                          again(Shading::Gouraud, true, 8)};
  list.groups[1].again = {again(Shading::Gouraud, true), again(Shading::Gouraud, true),
                          again(Shading::Gouraud, true, 8), again(Shading::Toon, true)};
  EXPECT_TRUE(list.addsLight());
  const std::vector<Pass> passes = passesOf(list, {});
  // They ask which lights do not get there, of groups without shadows, too.
  ASSERT_EQ(joined(passes),
            (Names{"found none", "shadows or", "shade none", "meshes again none", "meshes again none",
                   "more light add", "shadows or", "shade add", "meshes again none", "more light add",
                   "meshes again none", "more light add", "meshes again lighten"}));
  EXPECT_EQ(passes[3].batches.size(), 2U);
  EXPECT_EQ(passes[4].batches.size(), 1U);
  EXPECT_EQ(passes[8].batches.size(), 2U);
  EXPECT_EQ(passes[12].batches.data(), &list.groups[1].again[3]);
  // One triangle of each pixel counts, of as many lights as are drawn at once.
  for (const std::size_t i : {4U, 8U, 10U}) {
    EXPECT_EQ(passes[i].colors, (std::vector<Attachment>{{Target::MoreLight, Begin::Clear}}));
    EXPECT_EQ(passes[i + 1].reads, std::vector{Target::MoreLight});
  }
}

TEST(Passes, WhatIsSeenThroughIsBlendedUnlessItIsOfTheGeometry) {
  DrawList list = listOf(1, 0, 1);
  list.groups.resize(1);
  list.layers.found.resize(1);
  list.layers.searches.resize(1);
  EXPECT_EQ(joined(passesOf(list, {})),
            (Names{"found none", "layers", "blend layers through", "transparent color"}));
  list.groups[0].layerShadows.resize(2);
  list.groups[0].layerShades.resize(1);
  EXPECT_EQ(joined(passesOf(list, {.relights = true})),
            (Names{"shade none", "shade layers", "blend layers through"}));
  list.groups[0] = {};
  list.layers.blend.output = list.transparent[0].state.output = Output::Depth;
  EXPECT_EQ(joined(passesOf(list, {})),
            (Names{"found none", "layers", "blend layers none", "transparent none"}));
}

TEST(Passes, PipelinesAreOfTheTargetsOfTheirPass) {
  const PictureFormat picture{.color = VK_FORMAT_R16G16B16A16_SFLOAT, .samples = VK_SAMPLE_COUNT_4_BIT};
  const DrawList list = listInShadow();
  const std::vector<Pass> passes = passesOf(list, {});
  const auto formats = [&](std::size_t pass) { return formatOf(passes[pass], picture); };
  EXPECT_EQ(formats(0).colors[0], (gpu::ColorAttachment{VK_FORMAT_R32G32B32A32_SFLOAT}));
  EXPECT_EQ(formats(0).colors[1], (gpu::ColorAttachment{VK_FORMAT_R32G32_SFLOAT}));
  EXPECT_EQ(formats(0).colors[2], gpu::ColorAttachment{});
  EXPECT_EQ(formats(1).colors[0], (gpu::ColorAttachment{VK_FORMAT_R32_UINT, gpu::Blend::Or}));
  EXPECT_EQ(formats(1).depth, picture.depth);
  EXPECT_EQ(formats(4).colors[0], gpu::ColorAttachment{}) << "depths alone";
  EXPECT_EQ(formats(4).depth, picture.depth);
  EXPECT_EQ(formats(5).colors[0],
            (gpu::ColorAttachment{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::Multiply}));
  EXPECT_EQ(formats(6).colors[0], (gpu::ColorAttachment{picture.color, gpu::Blend::Add}));
  EXPECT_EQ(formats(6).samples, picture.samples);
  EXPECT_EQ(formatOf(Pass{.depth = std::nullopt}, picture).depth, VK_FORMAT_UNDEFINED);
  EXPECT_EQ(statesOf(passes[5]).size(), 3U) << "two casters, and the depth map";
}

/// What comes through casters, and through a depth map, is known before the light that asks for it.
TEST(Passes, EachStepComesBeforeWhatReadsIt) {
  DrawList list = deferredList();
  list.occludes = list.traces = true;
  LightGroup& group = list.groups[0];
  group.transmits = true;
  group.map.emplace();
  group.transmittances.resize(2);
  group.again.resize(1);
  const std::vector<Pass> passes = passesOf(list, {});
  Names names;
  for (const Pass& pass : passes) names.emplace_back(pass.name);
  ASSERT_EQ(names, (Names{"found", "openness", "shadows", "light depths", "transmittance", "shade",
                          "meshes again"}));
  EXPECT_EQ(passes[3].depthTarget, Target::LightDepth);
  EXPECT_EQ(passes[3].depth, Begin::Clear);
  EXPECT_TRUE(passes[3].colors.empty() && passes[3].reads.empty());
  for (const std::size_t other : {0, 2, 4, 5, 6}) EXPECT_EQ(passes[other].depthTarget, Target::Depth);
  EXPECT_EQ(passes[4].casters.size(), 2U);
  EXPECT_TRUE(passes[4].readsLightMap && !passes[2].readsLightMap);
  EXPECT_EQ(passes[4].reads, (std::vector{Target::Found, Target::Places, Target::LightDepth}));
  const std::vector read{Target::Found, Target::Openness, Target::Shadows, Target::Transmittance};
  EXPECT_EQ(passes[5].reads, read);
  EXPECT_EQ(passes[6].reads, read);
  EXPECT_TRUE(passes[5].asks) << "shaders may send rays";
}

TEST(Passes, WhatIsSeenThroughComesAfterWhatIsNot) {
  DrawList list = deferredList();
  const auto namesOf = [&](const FrameDesc& frame) {
    Names names;
    for (const Pass& pass : passesOf(list, frame))
      names.push_back(std::string(pass.name) + (pass.rays ? "*" : "") + " " +
                      std::to_string(pass.casters.size()) + (pass.clearsLayers ? " cleared" : ""));
    return names;
  };
  EXPECT_EQ(namesOf({}), (Names{"found 0", "shade 0"})) << "opaque scenes have no pass for it";
  list.layers.found.resize(1);
  list.layers.searches.resize(2);
  list.groups[0].layerShades.resize(2);
  const Names rest{"shade layers 0", "shade layers 0", "blend layers 0"};
  const auto with = [&](Names names) {
    names.insert(names.end(), rest.begin(), rest.end());
    return names;
  };
  EXPECT_EQ(namesOf({}), with({"found 0", "shade 0", "layers 2 cleared"}));
  const RayPoints points;
  EXPECT_EQ(namesOf({.rays = &points}), with({"rays* 0", "shade 0", "layers of rays* 0"}))
      << "what was found stays, but for what rays replace";
  list.groups[0].lights.resize(1);
  list.groups[0].shadows.resize(3);
  list.groups[0].layerShadows.resize(2);
  EXPECT_EQ(namesOf({}), with({"found 0", "shadows 3", "shade 0", "layers 2 cleared", "layer shadows 1",
                               "layer shadows 1"}))
      << "each reads what the one before it has written";
  EXPECT_EQ(namesOf({.rays = &points}), with({"rays* 0", "shade 0", "layers of rays* 0"}))
      << "shadows stay, and come with what rays replace";
  list.groups.resize(2);
  list.groups[1].layerShades.resize(1);
  EXPECT_EQ(namesOf({.rays = &points}),
            (Names{"rays* 0", "shade 0", "shade 0", "layers of rays* 0", "shade layers 0", "shade layers 0",
                   "light on layers of rays* 0", "shade layers 0", "blend layers 0"}))
      << "those of each group stay";
  list.groups.resize(kKeptGroups + 1);
  const Names ofMany = namesOf({.rays = &points});
  EXPECT_EQ(std::ranges::count(ofMany, "layer shadows 1"), 2) << "but of many groups the last alone has some";
  list.groups.resize(2);
  // What is not lit later is drawn again, where rays add something to it: else layers would be blended twice.
  list.deferred = false;
  for (DrawBatch& batch : list.opaque) batch.state.form = Form::Fused;
  EXPECT_EQ(namesOf({.rays = &points})[1], "layers 2 cleared");
}

}  // namespace
}  // namespace luxo
