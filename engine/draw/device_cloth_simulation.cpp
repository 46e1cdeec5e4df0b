// SPDX-License-Identifier: Apache-2.0
#include "draw/device_cloth_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "base/error.h"
#include "gpu/barrier.h"
#include "gpu/buffer.h"
#include "gpu/descriptor.h"
#include "gpu/frame.h"
#include "gpu/pipeline.h"
#include "luxo/shaders/cloth_comp.h"
#include "shared/cloth_data.h"

namespace luxo {
namespace {

shared::ClothData clothData(const Cloth& cloth, const ClothSystem& system) {
  const auto f = [](double number) { return static_cast<float>(number); };
  const double dx = cloth.size.x / cloth.columns, dz = cloth.size.y / cloth.rows;
  return {.columns = cloth.columns,
          .rows = cloth.rows,
          .steps = 0,
          .iterations = static_cast<std::uint32_t>(system.iterations.size()),
          .step = f(cloth.step),
          .damping = f(cloth.damping),
          .friction = f(cloth.ballFriction),
          .restX = f(dx),
          .restZ = f(dz),
          .restDiagonal = f(std::hypot(dx, dz)),
          .stretchX = f(system.stretchX),
          .stretchZ = f(system.stretchZ),
          .diagonal = f(system.diagonal),
          .bendX = f(system.bendX),
          .bendZ = f(system.bendZ),
          .ballRadius = f(cloth.ballRadius),
          .ballCenter = Vec3f(cloth.ballCenter),
          .gravity = Vec3f(cloth.gravity)};
}

/// The parts of the buffer of points that are written before steps, and read after them.
std::vector<Vec4f> packed(const ClothState& state, const ClothSystem& system) {
  const std::size_t count = state.positions.size();
  std::vector<Vec4f> points(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i] = Vec4f(state.positions[i], system.pinned[i] ? -system.masses[i] : system.masses[i]);
    points[count + i] = Vec4f(state.velocities[i], system.rowSums[i]);
  }
  return points;
}

void unpack(std::span<const Vec4f> points, ClothState& state) {
  const std::size_t count = state.positions.size();
  for (std::size_t i = 0; i < count; ++i) {
    state.positions[i] = Vec3f(points[i]);
    state.velocities[i] = Vec3f(points[count + i]);
  }
}

void requireFinite(const ClothState& state) {
  const auto finite = [](const Vec3f& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  if (!std::ranges::all_of(state.positions, finite) || !std::ranges::all_of(state.velocities, finite))
    throw Error(ErrorKind::Scene, "a cloth's points have left the range of a float",
                "its \"stretch\", \"bend\", \"density\" or \"gravity\" is too large or too small for its "
                "cells and its step");
}

}  // namespace

class DeviceClothSimulation::Stepper {
 public:
  explicit Stepper(gpu::Context& context)
      : context_(context),
        layout_(context, std::vector<gpu::DescriptorBinding>(shared::kClothBindings,
                                                             {.stages = VK_SHADER_STAGE_COMPUTE_BIT})),
        pipeline_(context, {.name = "cloth", .shader = luxo_cloth_comp, .setLayouts = {layout_}}),
        frames_(context) {}

  void advance(const Cloth& cloth, ClothState& state, std::uint32_t steps) {
    const ClothSystem system = clothSystem(cloth);
    const std::size_t count = state.positions.size();
    prepare(count, system.iterations.size());
    std::vector<Vec4f> points = packed(state, system);
    points_.write(0, std::as_bytes(std::span(points)));
    iterations_.write(0, std::as_bytes(std::span(system.iterations)));
    shared::ClothData data = clothData(cloth, system);
    data.steps = steps;
    submit(data);
    std::memcpy(points.data(), read_.read().data(), points.size() * sizeof(Vec4f));
    unpack(points, state);
    requireFinite(state);
  }

 private:
  void prepare(std::size_t count, std::size_t iterations) {
    const VkDeviceSize state = 2 * count * sizeof(Vec4f);
    if (read_ && read_.size() == state && iterations_.size() >= iterations * sizeof(Vec2f)) return;
    points_ =
        gpu::Buffer(context_, {.size = shared::kClothParts * count * sizeof(Vec4f),
                               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                               .name = "points of a cloth"});
    iterations_ = gpu::Buffer(context_, {.size = iterations * sizeof(Vec2f),
                                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                         .name = "iterations of a cloth"});
    read_ = gpu::Buffer(context_, {.size = state,
                                   .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                   .memory = gpu::MemoryUse::Readback,
                                   .name = "state of a cloth"});
  }

  void submit(const shared::ClothData& data) {
    const VkCommandBuffer commands = frames_.begin();
    gpu::use(commands, {{points_, gpu::Use::ComputeStorage}});
    pipeline_.bind(commands);
    pipeline_.push(commands, std::as_bytes(std::span(&data, 1)));
    pipeline_.bindSet(commands, shared::kSetCloth,
                      frames_.descriptors().write(layout_, {points_, iterations_}));
    vkCmdDispatch(commands, 1, 1, 1);
    gpu::use(commands, {{points_, gpu::Use::TransferSource}, {read_, gpu::Use::TransferDestination}});
    const VkBufferCopy state{.size = read_.size()};
    vkCmdCopyBuffer(commands, points_, read_, 1, &state);
    gpu::use(commands, {{read_, gpu::Use::HostRead}});
    frames_.wait(frames_.submit());
  }

  gpu::Context& context_;
  gpu::DescriptorLayout layout_;
  gpu::ComputePipeline pipeline_;
  gpu::Buffer points_, iterations_, read_;
  gpu::FrameRing frames_;
};

DeviceClothSimulation::DeviceClothSimulation(gpu::ContextDesc desc) : context_(std::move(desc)) {}
DeviceClothSimulation::DeviceClothSimulation(gpu::Context& context) : context_(context) {}
DeviceClothSimulation::~DeviceClothSimulation() = default;

void DeviceClothSimulation::advance(const Cloth& cloth, ClothState& state, std::uint32_t steps) {
  if (!stepper_) stepper_ = std::make_unique<Stepper>(context_.get());
  stepper_->advance(cloth, state, steps);
}

}  // namespace luxo
