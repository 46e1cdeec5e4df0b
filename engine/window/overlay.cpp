// SPDX-License-Identifier: Apache-2.0
#include "window/overlay.h"

#include "base/error.h"
#include "gpu/debug.h"
#include "gpu/result.h"

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace luxo::window {
namespace {

// All lengths in pixels at content scale 1.
constexpr float kFontSize = 14, kMargin = 14, kPadding = 11, kColumnGap = 14, kRounding = 7;
constexpr float kLineSpacing = 1.3f;     // of the letters' height
constexpr float kTitleGap = 4;           // below a title
constexpr float kSmallestShrink = 0.6f;  // below it nobody can read
constexpr float kDiscreetShare = 0.25f;  // of the window's area
constexpr float kTrackWidth = 160, kTrackHeight = 4, kHandleRadius = 6;
constexpr float kValueWidth = 56;  // at least, so that a panel keeps its size while a value changes
constexpr float kButtonPadding = 6;

constexpr ImU32 kBackground = IM_COL32(9, 10, 13, 168);
constexpr ImU32 kBorder = IM_COL32(255, 255, 255, 20);
constexpr ImU32 kTitle = IM_COL32(255, 214, 150, 255);
constexpr ImU32 kLabel = IM_COL32(186, 168, 138, 255);
constexpr ImU32 kText = IM_COL32(224, 224, 228, 255);
constexpr ImU32 kAlert = IM_COL32(255, 150, 130, 255);
constexpr ImU32 kTrack = IM_COL32(255, 255, 255, 46);
constexpr ImU32 kHandle = IM_COL32(255, 214, 150, 255);
constexpr ImU32 kButton = IM_COL32(255, 255, 255, 26);

// Where distributions keep a readable font; without any of them ImGui's own bitmap font serves.
constexpr const char* kTextFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                      "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                      "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                      "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"};
constexpr const char* kMonospacedFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
                                            "/usr/share/fonts/TTF/DejaVuSansMono.ttf",
                                            "/usr/share/fonts/dejavu-sans-mono-fonts/DejaVuSansMono.ttf",
                                            "/usr/share/fonts/truetype/noto/NotoSansMono-Regular.ttf"};

void addFont(ImFontAtlas& atlas, std::span<const char* const> paths, float sizePx) {
  for (const char* path : paths) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.empty()) continue;
    void* owned = ImGui::MemAlloc(bytes.size());  // by the atlas
    std::memcpy(owned, bytes.data(), bytes.size());
    atlas.AddFontFromMemoryTTF(owned, static_cast<int>(bytes.size()), std::round(sizePx));
    return;
  }
  ImFontConfig config;
  config.SizePixels = 13 * std::max(1.0f, std::round(sizePx / 13));  // bitmaps scale in whole steps
  atlas.AddFontDefault(&config);
}

gpu::Handle<VkRenderPass> createPass(gpu::Context& context, VkFormat format) {
  const VkAttachmentDescription image{.format = format,
                                      .samples = VK_SAMPLE_COUNT_1_BIT,
                                      .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                      .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                      .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                      .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                      .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference color{.attachment = 0, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                     .colorAttachmentCount = 1,
                                     .pColorAttachments = &color};
  const VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                    .attachmentCount = 1,
                                    .pAttachments = &image,
                                    .subpassCount = 1,
                                    .pSubpasses = &subpass};
  VkRenderPass pass = VK_NULL_HANDLE;
  gpu::check(vkCreateRenderPass(context.device(), &info, nullptr, &pass), "create the overlay's pass");
  gpu::setName(context, pass, "overlay");
  return {context, pass};
}

gpu::Handle<VkDescriptorPool> createDescriptorPool(gpu::Context& context) {
  const VkDescriptorPoolSize font{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, .descriptorCount = 1};
  const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .maxSets = 1,
                                        .poolSizeCount = 1,
                                        .pPoolSizes = &font};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  gpu::check(vkCreateDescriptorPool(context.device(), &info, nullptr, &pool),
             "create the overlay's descriptors");
  return {context, pool};
}

// The fonts as they were added.
ImFont* fontOf(const Panel& panel) { return ImGui::GetIO().Fonts->Fonts[panel.monospaced ? 1 : 0]; }

// One panel, measured for letters of a given size.
struct Layout {
  ImFont* font;
  float size, line, titleGap = 0, labelWidth = 0, trackWidth = 0, width = 0, height = 0;

  Layout(const Panel& panel, float size_)
      : font(fontOf(panel)), size(size_), line(std::round(size_ * kLineSpacing)) {
    float textWidth = 0, lineWidth = widthOf(panel.title);
    for (const Panel::Row& row : panel.rows) {
      if (row.label.empty()) {
        lineWidth = std::max(lineWidth, widthOf(row.text));
      } else {
        labelWidth = std::max(labelWidth, widthOf(row.label));
        textWidth = std::max(textWidth, widthOf(row.text));
      }
      if (row.slider || row.swatch) {
        trackWidth = std::round(unit(kTrackWidth));
        textWidth = std::max(textWidth, unit(kValueWidth));
      }
    }
    if (labelWidth > 0) labelWidth = std::round(labelWidth + unit(kColumnGap));
    const float tracks = trackWidth > 0 ? trackWidth + unit(kColumnGap) : 0;
    const std::size_t lines = panel.rows.size() + (panel.title.empty() ? 0 : 1);
    width = std::ceil(std::max(lineWidth, labelWidth + tracks + textWidth) + 2 * unit(kPadding));
    if (!panel.title.empty() && !panel.rows.empty()) titleGap = std::round(unit(kTitleGap));
    height = std::ceil(line * static_cast<float>(lines) - (line - size) + titleGap + 2 * unit(kPadding));
  }

  [[nodiscard]] float unit(float length) const { return length * size / kFontSize; }
  [[nodiscard]] float widthOf(const std::string& text) const {
    return font->CalcTextSizeA(size, 1e9f, 0, text.data(), text.data() + text.size()).x;
  }
};

// How much of its size a panel may keep: 1, or less where the window is small.
float shrinkFor(const Panel& panel, const Layout& layout, ImVec2 window) {
  const float margins = 2 * layout.unit(kMargin);
  const float fit =
      std::min({1.0f, (window.x - margins) / layout.width, (window.y - margins) / layout.height});
  if (!panel.discreet) return fit;
  return std::min(fit, std::sqrt(kDiscreetShare * window.x * window.y / (layout.width * layout.height)));
}

// Where a panel goes.
struct Placed {
  const Panel& panel;
  Layout layout;
  ImVec2 corner;

  Placed(const Panel& panel_, const Layout& layout_, ImVec2 window) : panel(panel_), layout(layout_) {
    const float margin = layout.unit(kMargin);
    corner = {margin, margin};
    if (panel.place == Panel::Place::TopRight) corner.x = window.x - layout.width - margin;
    if (panel.place == Panel::Place::BottomLeft) corner.y = window.y - layout.height - margin;
    if (panel.place == Panel::Place::Top) corner.x = (window.x - layout.width) / 2;
    if (panel.place == Panel::Place::Center)
      corner = {(window.x - layout.width) / 2, (window.y - layout.height) / 2};
    corner = {std::round(corner.x), std::round(corner.y)};
  }

  [[nodiscard]] bool overlaps(const Placed& other) const {
    return corner.x < other.corner.x + other.layout.width && other.corner.x < corner.x + layout.width &&
           corner.y < other.corner.y + other.layout.height && other.corner.y < corner.y + layout.height;
  }
};

// From the last to the first: the later ones matter more.
std::vector<Placed> place(std::span<const Panel> panels, ImVec2 window) {
  const float fontSize = ImGui::GetFont()->FontSize;
  std::vector<Placed> placed;
  for (auto panel = panels.rbegin(); panel != panels.rend(); ++panel) {
    const Layout wanted(*panel, fontSize);
    const float shrink = shrinkFor(*panel, wanted, window);
    if (shrink < kSmallestShrink) continue;
    const Placed next(*panel, shrink < 1 ? Layout(*panel, std::floor(fontSize * shrink)) : wanted, window);
    const bool covered =
        std::ranges::any_of(placed, [&](const Placed& later) { return later.overlaps(next); });
    if (!covered) placed.push_back(next);
  }
  return placed;
}

ImVec2 toImVec(Vec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

// Where a row can be grabbed whose slider or text begins there: as high as a line, for unsteady hands.
GrabArea areaOf(const Layout& layout, const Panel::Row& row, ImVec2 at) {
  const bool isTrack = row.slider || row.swatch;
  const float padding = isTrack ? 0 : layout.unit(kButtonPadding);
  const float width = isTrack ? layout.trackWidth : layout.widthOf(row.text);
  const float gap = (layout.line - layout.size) / 2;
  return {row.key, {at.x - padding, at.y - gap}, {at.x + width + padding, at.y - gap + layout.line}};
}

void drawSlider(ImDrawList& list, const Layout& layout, const GrabArea& area, double position) {
  const float y = static_cast<float>(area.minPx.y + area.maxPx.y) / 2, half = layout.unit(kTrackHeight) / 2;
  const float left = static_cast<float>(area.minPx.x), right = static_cast<float>(area.maxPx.x);
  const float handle = left + static_cast<float>(position) * (right - left);
  list.AddRectFilled({left, y - half}, {right, y + half}, kTrack, half);
  list.AddRectFilled({left, y - half}, {handle, y + half}, kLabel, half);
  list.AddCircleFilled({handle, y}, layout.unit(kHandleRadius), kHandle);
}

void drawSwatch(ImDrawList& list, const Layout& layout, const std::array<float, 3>& codes, ImVec2 at) {
  const ImU32 color = ImGui::ColorConvertFloat4ToU32({codes[0], codes[1], codes[2], 1});
  const ImVec2 opposite{at.x + layout.trackWidth, at.y + layout.size};
  list.AddRectFilled(at, opposite, color, layout.unit(kRounding) / 2);
  list.AddRect(at, opposite, kTrack, layout.unit(kRounding) / 2);
}

void draw(ImDrawList& list, const Placed& placed, std::vector<GrabArea>& areas) {
  const auto& [panel, layout, corner] = placed;
  const ImVec2 opposite{corner.x + layout.width, corner.y + layout.height};
  list.AddRectFilled(corner, opposite, kBackground, layout.unit(kRounding));
  list.AddRect(corner, opposite, kBorder, layout.unit(kRounding));

  const float left = std::round(corner.x + layout.unit(kPadding));
  float y = std::round(corner.y + layout.unit(kPadding));
  const auto write = [&list, font = layout.font, size = layout.size, &y](float x, ImU32 color,
                                                                         const std::string& text) {
    list.AddText(font, size, {x, y}, color, text.data(), text.data() + text.size());
  };
  if (!panel.title.empty()) {
    write(left, panel.alert ? kAlert : kTitle, panel.title);
    y += layout.line + layout.titleGap;
  }
  for (const Panel::Row& row : panel.rows) {
    float x = row.label.empty() ? left : left + layout.labelWidth;
    const GrabArea area = areaOf(layout, row, {x, y});
    write(left, kLabel, row.label);
    if (row.slider) {
      drawSlider(list, layout, area, *row.slider);
      x += layout.trackWidth + std::round(layout.unit(kColumnGap));
    } else if (row.swatch) {
      drawSwatch(list, layout, *row.swatch, {x, y});
      x += layout.trackWidth + std::round(layout.unit(kColumnGap));
    } else if (row.key >= 0) {
      list.AddRectFilled(toImVec(area.minPx), toImVec(area.maxPx), kButton, layout.unit(kRounding) / 2);
    }
    write(x, row.key >= 0 && !row.slider && !row.swatch ? kTitle : kText, row.text);
    if (row.key >= 0) areas.push_back(area);
    y += layout.line;
  }
}

}  // namespace

Overlay::Overlay(gpu::Context& context, VkFormat format)
    : context_(&context), pass_(createPass(context, format)) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // writes nothing to the current folder
  io.LogFilename = nullptr;
  io.DeltaTime = 1.0f / 60;  // nothing here moves, but it must be positive
}

Overlay::~Overlay() {
  try {
    stop();
  } catch (const Error&) {  // the device is lost; what it held is gone with it
  }
  ImGui::DestroyContext();
}

void Overlay::start(double contentScale) {
  stop();
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  addFont(atlas, kTextFonts, kFontSize * static_cast<float>(contentScale));
  addFont(atlas, kMonospacedFonts, kFontSize * static_cast<float>(contentScale));
  descriptors_ = createDescriptorPool(*context_);
  ImGui_ImplVulkan_InitInfo info{.Instance = context_->instance(),
                                 .PhysicalDevice = context_->physicalDevice(),
                                 .Device = context_->device(),
                                 .QueueFamily = context_->queueFamily(),
                                 .Queue = context_->queue(),
                                 .PipelineCache = context_->pipelineCache(),
                                 .DescriptorPool = descriptors_,
                                 .MinImageCount = gpu::FrameRing::kFrames,
                                 // Its vertex buffers go round like our frames.
                                 .ImageCount = gpu::FrameRing::kFrames,
                                 .MSAASamples = VK_SAMPLE_COUNT_1_BIT,
                                 .CheckVkResultFn = [](VkResult result) { gpu::check(result, "draw text"); }};
  ImGui_ImplVulkan_Init(&info, pass_);
  contentScale_ = contentScale;
  uploaded_ = false;
}

void Overlay::stop() {
  if (contentScale_ == 0) return;
  contentScale_ = 0;
  context_->waitIdle();
  ImGui_ImplVulkan_Shutdown();
  descriptors_.reset();
}

void Overlay::prepareFramebuffers(const Swapchain& swapchain) {
  if (generation_ == swapchain.generation()) return;
  framebuffers_.clear();
  for (const VkImageView view : swapchain.views()) {
    const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .renderPass = pass_,
                                       .attachmentCount = 1,
                                       .pAttachments = &view,
                                       .width = swapchain.extent().width,
                                       .height = swapchain.extent().height,
                                       .layers = 1};
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    gpu::check(vkCreateFramebuffer(context_->device(), &info, nullptr, &framebuffer),
               "draw text into the window");
    framebuffers_.emplace_back(*context_, framebuffer);
  }
  generation_ = swapchain.generation();
}

std::vector<GrabArea> Overlay::record(VkCommandBuffer commands, const Swapchain& swapchain,
                                      double contentScale, std::span<const Panel> panels) {
  std::vector<GrabArea> areas;
  if (panels.empty()) return areas;
  if (contentScale != contentScale_) start(contentScale);
  if (!uploaded_) {
    ImGui_ImplVulkan_CreateFontsTexture(commands);
    uploaded_ = true;
  }
  prepareFramebuffers(swapchain);

  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(swapchain.extent().width),
                    static_cast<float>(swapchain.extent().height)};
  ImGui_ImplVulkan_NewFrame();
  ImGui::NewFrame();
  for (const Placed& placed : place(panels, io.DisplaySize))
    draw(*ImGui::GetForegroundDrawList(), placed, areas);
  ImGui::Render();

  const gpu::Label label(*context_, commands, "overlay");
  const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                    .renderPass = pass_,
                                    .framebuffer = framebuffers_[swapchain.index()],
                                    .renderArea = {{0, 0}, swapchain.extent()}};
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
  vkCmdEndRenderPass(commands);
  return areas;
}

}  // namespace luxo::window
