// SPDX-License-Identifier: Apache-2.0
// The state tracker against an independent model of what Vulkan's barriers guarantee (specification, chapter
// "Synchronization and Cache Control": execution dependencies chain, writes are made available, then
// visible).
#include "gpu/usage.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <vector>

namespace luxo::gpu {
namespace {

int numberOf(Use use) { return static_cast<int>(use); }

std::vector<Use> usesOf(ResourceKind kind) {
  using enum Use;
  if (kind == ResourceKind::Buffer) {
    return {TransferSource, TransferDestination, VertexBuffer, IndexBuffer,
            StorageWrite,   ComputeStorage,      HostRead};
  }
  return {ColorAttachment,     ResolveTarget,   DepthAttachment, TransferSource,
          TransferDestination, SampledFragment, StorageWrite,    Present};
}

constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                   VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                                   VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

// One access of one stage by an earlier use (or the write of a layout transition, which belongs to no stage),
// and what later commands may rely on.
struct Event {
  VkPipelineStageFlags2 stage = 0;  // one bit; 0 for a transition
  VkAccessFlags2 access = 0;        // one bit
  bool write = false;
  bool available = false;
  VkPipelineStageFlags2 before = 0;  // stages of later commands that happen after it
  std::set<std::pair<VkPipelineStageFlags2, VkAccessFlags2>> visible;
};

template <class Visit>
void forEachBit(VkFlags64 bits, Visit visit) {
  for (; bits != 0; bits &= bits - 1) visit(bits & ~(bits - 1));
}

class Model {
 public:
  explicit Model(ResourceKind kind) : kind_(kind) {}

  void barrier(const Dependency& d) {
    const bool transition = kind_ == ResourceKind::Image && d.oldLayout != d.newLayout;
    for (Event& event : events_) {
      const bool inSource = (event.stage & d.sourceStages) != 0;
      const bool chained = (event.before & d.sourceStages) != 0;
      if (transition) {
        EXPECT_TRUE(inSource || chained) << "the transition races with an earlier use";
      }
      if (!inSource && !chained) continue;
      event.before |= d.destinationStages;
      if (inSource && (event.access & d.sourceAccesses) != 0) event.available = true;
      if (transition && event.write) {
        EXPECT_TRUE(event.available) << "the transition races with a write";
      }
      if (event.available) show(event, d);
    }
    if (transition) {
      EXPECT_TRUE(d.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED || d.oldLayout == layout_) << "wrong old layout";
      layout_ = d.newLayout;
      Event event{.write = true, .available = true, .before = d.destinationStages};
      show(event, d);
      events_.push_back(event);
    }
  }

  void use(Use use) {
    const Scope scope = scopeOf(use);
    if (kind_ == ResourceKind::Image) {
      EXPECT_EQ(layout_, scope.layout);
    }
    std::vector<Event> added;
    forEachBit(scope.stages, [&](VkPipelineStageFlags2 stage) {
      forEachBit(scope.accesses, [&](VkAccessFlags2 access) {
        const bool write = (access & kWrites) != 0;
        for (const Event& event : events_) {
          if (!event.write && !write) continue;
          EXPECT_NE(event.before & stage, 0u) << "not ordered after an earlier use";
          if (event.write) {
            EXPECT_TRUE(event.visible.contains({stage, access})) << "a write is not visible";
          }
        }
        added.push_back({.stage = stage, .access = access, .write = write});
      });
    });
    events_.insert(events_.end(), added.begin(), added.end());
  }

 private:
  static void show(Event& event, const Dependency& d) {
    forEachBit(d.destinationStages, [&](VkPipelineStageFlags2 stage) {
      forEachBit(d.destinationAccesses, [&](VkAccessFlags2 access) {
        event.visible.insert({stage, access});
      });
    });
  }

  ResourceKind kind_;
  VkImageLayout layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
  std::vector<Event> events_;
};

// Follows the tracker through a sequence of uses; false when the model found a hazard.
void expectSafe(ResourceKind kind, const std::vector<Use>& uses) {
  std::string text;
  ResourceState state(kind);
  Model model(kind);
  for (const Use use : uses) {
    text += " " + std::to_string(numberOf(use));
    SCOPED_TRACE(text);
    if (const auto dependency = state.advance(use)) model.barrier(*dependency);
    model.use(use);
  }
}

TEST(Usage, EveryScopeIsCompleteAndWritesWhatItSays) {
  for (int i = 0; i <= numberOf(kLastUse); ++i) {
    const Use use = static_cast<Use>(i);
    const Scope scope = scopeOf(use);
    EXPECT_NE(scope.stages, 0u) << numberOf(use);
    EXPECT_EQ(scope.accesses == 0, use == Use::Present) << numberOf(use);
    EXPECT_EQ(scope.writes, (scope.accesses & kWrites) != 0) << numberOf(use);
  }
}

TEST(Usage, EveryPairIsSafe) {
  for (const ResourceKind kind : {ResourceKind::Buffer, ResourceKind::Image}) {
    for (const Use a : usesOf(kind)) {
      for (const Use b : usesOf(kind)) expectSafe(kind, {a, b});
    }
  }
}

TEST(Usage, EveryTripleIsSafe) {
  for (const ResourceKind kind : {ResourceKind::Buffer, ResourceKind::Image}) {
    for (const Use a : usesOf(kind)) {
      for (const Use b : usesOf(kind)) {
        for (const Use c : usesOf(kind)) expectSafe(kind, {a, b, c});
      }
    }
  }
}

TEST(Usage, RandomSequencesAreSafe) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    const ResourceKind kind = seed % 2 == 0 ? ResourceKind::Buffer : ResourceKind::Image;
    const std::vector<Use> all = usesOf(kind);
    std::vector<Use> uses;
    for (int i = 0; i < 10; ++i) uses.push_back(all[random() % all.size()]);
    SCOPED_TRACE(seed);
    expectSafe(kind, uses);
  }
}

// What is not needed is not there: a pair needs a barrier exactly when one of the two writes or the layout
// changes.
TEST(Usage, BarriersOnlyWhereNeeded) {
  for (const ResourceKind kind : {ResourceKind::Buffer, ResourceKind::Image}) {
    for (const Use a : usesOf(kind)) {
      for (const Use b : usesOf(kind)) {
        const Scope before = scopeOf(a);
        const Scope after = scopeOf(b);
        const bool moves = kind == ResourceKind::Image && before.layout != after.layout;
        ResourceState state(kind);
        EXPECT_EQ(state.advance(a).has_value(), kind == ResourceKind::Image) << numberOf(a);
        EXPECT_EQ(state.advance(b).has_value(), before.writes || after.writes || moves)
            << numberOf(a) << " then " << numberOf(b);
      }
    }
  }
}

TEST(Usage, RepeatedReadsAfterAWriteNeedOneBarrierEach) {
  ResourceState state(ResourceKind::Buffer);
  EXPECT_FALSE(state.advance(Use::TransferDestination)) << "nothing came before";
  EXPECT_TRUE(state.advance(Use::VertexBuffer));
  EXPECT_TRUE(state.advance(Use::IndexBuffer)) << "another stage has not seen the write";
  EXPECT_FALSE(state.advance(Use::VertexBuffer));
  EXPECT_FALSE(state.advance(Use::IndexBuffer));
}

// The exact barriers of the passes that every picture has, written down from the specification's examples.
TEST(Usage, KnownDependencies) {
  ResourceState color(ResourceKind::Image);
  EXPECT_EQ(color.advance(Use::ColorAttachment, Contents::Discard),
            (Dependency{.destinationStages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                        .destinationAccesses =
                            VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                        .newLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}));
  EXPECT_EQ(color.advance(Use::TransferSource),
            (Dependency{.sourceStages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                        .sourceAccesses =
                            VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                        .destinationStages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                        .destinationAccesses = VK_ACCESS_2_TRANSFER_READ_BIT,
                        .oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                        .newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL}));
  // The next frame draws over it: only the copy must be over, and the old picture may go.
  EXPECT_EQ(color.advance(Use::ColorAttachment, Contents::Discard),
            (Dependency{.sourceStages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                        .destinationStages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                        .destinationAccesses =
                            VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                        .newLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}));

  ResourceState depth(ResourceKind::Image);
  static_cast<void>(depth.advance(Use::DepthAttachment, Contents::Discard));
  const auto again = depth.advance(Use::DepthAttachment, Contents::Discard);
  ASSERT_TRUE(again) << "the clear must wait for the tests of the frame before";
  EXPECT_EQ(again->sourceStages,
            VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT);
  EXPECT_EQ(again->sourceAccesses & kWrites, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(again->oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(again->newLayout, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);

  ResourceState readback(ResourceKind::Buffer);
  static_cast<void>(readback.advance(Use::TransferDestination));
  EXPECT_EQ(readback.advance(Use::HostRead), (Dependency{.sourceStages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                                         .sourceAccesses = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                                         .destinationStages = VK_PIPELINE_STAGE_2_HOST_BIT,
                                                         .destinationAccesses = VK_ACCESS_2_HOST_READ_BIT}));
}

TEST(Usage, AnAcquiredImageFollowsItsSemaphore) {
  ResourceState state = ResourceState::acquired(VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
  const auto first = state.advance(Use::ColorAttachment);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sourceStages, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
  EXPECT_EQ(first->oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  const auto present = state.advance(Use::Present);
  ASSERT_TRUE(present);
  EXPECT_EQ(present->sourceAccesses & kWrites, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(present->newLayout, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

TEST(UsageDeathTest, ImagesAndBuffersHaveTheirOwnUses) {
  ResourceState image(ResourceKind::Image);
  EXPECT_DEATH(static_cast<void>(image.advance(Use::VertexBuffer)), "assertion failed");
  ResourceState buffer(ResourceKind::Buffer);
  EXPECT_DEATH(static_cast<void>(buffer.advance(Use::ColorAttachment)), "assertion failed");
}

}  // namespace
}  // namespace luxo::gpu
