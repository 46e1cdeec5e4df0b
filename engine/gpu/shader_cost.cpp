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

constexpr std::uint64_t kMax = 1'000'000'000'000'000;

std::uint64_t product(std::uint64_t a, std::uint64_t b) { return a != 0 && b > kMax / a ? kMax : a * b; }

std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return std::min(a + b, kMax); }

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
    struct Call {
      std::uint32_t function = 0;
      std::uint64_t nesting = 0;  ///< where it is
    };
    std::vector<Call> calls;
    std::size_t next = 0;  ///< call to be added
    bool isOpen = false;   ///< or known
  };
  /// A branch or a loop, of which there may be some around it.
  struct Construct {
    std::uint64_t outside = 0;  ///< nesting
    std::size_t left = 0;       ///< how many constructs are around where jumps out of it go to
  };

  void read(spv::Op op, std::span<const std::uint32_t> words) {
    if (op == spv::OpEntryPoint && words.size() > 1) entry_ = words[1];
    if (function_) readStructure(op, words);
    if (words.size() < 2) return count();
    readType(op, words);
    if (op == spv::OpFunction) {
      function_ = &functions_[words[1]];
      constructs_.clear();
      ends_.clear();
      loops_.clear();
      nesting_ = 0;
    } else if (op == spv::OpFunctionCall && function_ && words.size() > 2) {
      function_->calls.push_back({words[2], nesting_});
    } else if (op == spv::OpVariable && words.size() > 2) {
      const std::uint64_t bytes = bytes_[words[0]];
      if (words[2] == spv::StorageClassPrivate) globalBytes_ = sum(globalBytes_, bytes);
      if (words[2] == spv::StorageClassFunction && function_)
        function_->own.variableBytes = sum(function_->own.variableBytes, bytes);
    }
    count();
  }

  void readStructure(spv::Op op, std::span<const std::uint32_t> words) {
    if (op == spv::OpReturn || op == spv::OpReturnValue || op == spv::OpKill ||
        op == spv::OpTerminateInvocation)
      return leaveTo(0);
    if (words.empty()) return;
    if (op == spv::OpSelectionMerge || op == spv::OpLoopMerge) {
      constructs_.push_back({nesting_, constructs_.size() + 1});
      ends_[words[0]] = constructs_.size();
      if (op == spv::OpLoopMerge)
        for (const std::uint32_t label : words.first(std::min<std::size_t>(2, words.size())))
          loops_[label] = constructs_.size();
      function_->own.nesting = std::max(function_->own.nesting, ++nesting_);
    } else if (op == spv::OpLabel) {
      if (const auto end = ends_.find(words[0]); end != ends_.end()) close(end->second);
    } else if (op == spv::OpBranch || op == spv::OpBranchConditional) {
      for (const std::uint32_t label : words)
        if (const auto loop = loops_.find(label); loop != loops_.end()) leaveTo(loop->second);
    }
  }

  /// To what that many constructs are around.
  void leaveTo(std::size_t constructs) {
    if (!constructs_.empty()) constructs_.back().left = std::min(constructs_.back().left, constructs);
  }

  /// All from that one on.
  void close(std::size_t number) {
    while (constructs_.size() >= number) {
      const Construct construct = constructs_.back();
      const bool isLeft = construct.left < constructs_.size();
      constructs_.pop_back();
      nesting_ = construct.outside + (isLeft ? 1 : 0);
      leaveTo(construct.left);
    }
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
      const auto [called, nesting] = function.calls[function.next];
      const Function& other = functions_[called];
      if (!other.isOpen) {
        open.push_back(called);
        continue;
      }
      function.total.instructions = sum(function.total.instructions, other.total.instructions);
      function.total.variableBytes = sum(function.total.variableBytes, other.total.variableBytes);
      function.total.nesting = std::max(function.total.nesting, sum(nesting, other.total.nesting));
      ++function.next;
    }
    return functions_[id].total;
  }

  std::map<std::uint32_t, std::uint64_t> bytes_, constants_, elements_;
  std::map<std::uint32_t, Function> functions_;
  Function* function_ = nullptr;
  std::vector<Construct> constructs_;                  ///< of the function, that are open
  std::map<std::uint32_t, std::size_t> ends_, loops_;  ///< by labels: the number of a construct
  std::uint64_t nesting_ = 0;
  std::uint64_t globalBytes_ = 0, longestTable_ = 0;
  std::uint32_t entry_ = 0;
};

}  // namespace

ShaderCost costOf(std::span<const std::uint32_t> spirv) { return Costs(spirv).ofEntry(); }

}  // namespace luxo::gpu
