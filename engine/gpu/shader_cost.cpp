// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_cost.h"

#include <spirv_cross/spirv.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "gpu/spirv_instructions.h"

namespace luxo::gpu {
namespace {

constexpr std::uint64_t kMost = 1'000'000'000'000'000;

std::uint64_t product(std::uint64_t a, std::uint64_t b) { return a != 0 && b > kMost / a ? kMost : a * b; }

std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return std::min(a + b, kMost); }

class Costs {
 public:
  explicit Costs(std::span<const std::uint32_t> spirv) {
    forEachInstruction(
        spirv, [&](const Instruction& i) { read(static_cast<spv::Op>(i.operation), i.words.subspan(1)); });
  }

  ShaderCost ofEntry() {
    ShaderCost cost = of(entry_);
    cost.variableBytes = sum(cost.variableBytes, globalBytes_);
    cost.longestTable = longestTable_;
    return cost;
  }

 private:
  struct Function {
    ShaderCost own, total;  ///< without calls, and with them
    std::vector<std::uint32_t> calls;
    std::size_t next = 0;  ///< call to be added
    bool isOpen = false;   ///< or known
  };

  void read(spv::Op op, std::span<const std::uint32_t> words) {
    if (op == spv::OpEntryPoint && words.size() > 1) entry_ = words[1];
    if (words.size() < 2) return count();
    readType(op, words);
    if (op == spv::OpFunction) {
      function_ = &functions_[words[1]];
    } else if (op == spv::OpFunctionCall && function_ && words.size() > 2) {
      function_->calls.push_back(words[2]);
    } else if (op == spv::OpVariable && words.size() > 2) {
      const std::uint64_t bytes = bytes_[words[0]];
      if (words[2] == spv::StorageClassPrivate) globalBytes_ = sum(globalBytes_, bytes);
      if (words[2] == spv::StorageClassFunction && function_)
        function_->own.variableBytes = sum(function_->own.variableBytes, bytes);
    }
    count();
  }

  void count() {
    if (function_) ++function_->own.instructions;
  }

  /// Of a pointer what it points to.
  void readType(spv::Op op, std::span<const std::uint32_t> words) {
    const std::uint32_t id = words[0];
    if (op == spv::OpTypeBool) {
      bytes_[id] = 4;
    } else if (op == spv::OpTypeInt || op == spv::OpTypeFloat) {
      bytes_[id] = words[1] / 8;
    } else if ((op == spv::OpTypeVector || op == spv::OpTypeMatrix) && words.size() > 2) {
      bytes_[id] = product(bytes_[words[1]], words[2]);
    } else if (op == spv::OpTypeArray && words.size() > 2) {
      bytes_[id] = product(bytes_[words[1]], constants_[words[2]]);
      const auto inner = elements_.find(words[1]);
      elements_[id] = product(constants_[words[2]], inner == elements_.end() ? 1 : inner->second);
    } else if (op == spv::OpTypeStruct) {
      std::uint64_t all = 0;
      for (const std::uint32_t member : words.subspan(1)) all = sum(all, bytes_[member]);
      bytes_[id] = all;
    } else if (op == spv::OpTypePointer && words.size() > 2) {
      bytes_[id] = bytes_[words[2]];
    } else if (op == spv::OpConstant && words.size() > 2) {
      constants_[words[1]] = words[2];
    } else if (op == spv::OpConstantComposite) {
      if (const auto table = elements_.find(id); table != elements_.end())
        longestTable_ = std::max(longestTable_, table->second);
    }
  }

  /// Without recursion: a thousand functions may call each other in a row.
  ShaderCost of(std::uint32_t id) {
    std::vector<std::uint32_t> open{id};
    while (!open.empty()) {
      Function& function = functions_[open.back()];
      if (!std::exchange(function.isOpen, true)) function.total = function.own;
      if (function.next == function.calls.size()) {
        open.pop_back();
        continue;
      }
      const std::uint32_t called = function.calls[function.next];
      const Function& other = functions_[called];
      if (!other.isOpen) {
        open.push_back(called);
        continue;
      }
      function.total.instructions = sum(function.total.instructions, other.total.instructions);
      function.total.variableBytes = sum(function.total.variableBytes, other.total.variableBytes);
      ++function.next;
    }
    return functions_[id].total;
  }

  std::map<std::uint32_t, std::uint64_t> bytes_, constants_, elements_;
  std::map<std::uint32_t, Function> functions_;
  Function* function_ = nullptr;
  std::uint64_t globalBytes_ = 0, longestTable_ = 0;
  std::uint32_t entry_ = 0;
};

}  // namespace

ShaderCost costOf(std::span<const std::uint32_t> spirv) { return Costs(spirv).ofEntry(); }

}  // namespace luxo::gpu
