// SPDX-License-Identifier: Apache-2.0
// luxo_grandpa, luxo doctor, the first image of the README; and that none of them needs a window system.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "image/format.h"
#include "support/gpu_fixture.h"

namespace luxo::test {
namespace {

class LampProgram : public DeviceRenderTest {
 protected:
  [[nodiscard]] Outcome lamp(const Arguments& arguments) const {
    return run({.arguments = arguments, .folder = folder.path(), .program = LUXO_LAMP_PROGRAM});
  }
};

TEST_F(LampProgram, DrawsWhatRenderDraws) {
  const Arguments optionSets[] = {
      {"--size", "67x45"},
      {"--size", "67x45", "--time", "3", "--samples", "4", "--shading", "gouraud", "--tolerance", "0.1"},
      {"--size", "67x45", "--aov", "position", "--camera", "orbit", "--skip", "none", "--device", "0"},
      {"--size", "67x45", "--frames", "7", "--fps", "12"}};
  for (Arguments arguments : optionSets) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(arguments, " ")));
    const std::string expected = fileOf(arguments, "render.exr");
    arguments.insert(arguments.end(), {"-o", "lamp.exr"});
    const Outcome outcome = lamp(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(textOf(folder / "lamp.exr") == expected);
  }
}

TEST_F(LampProgram, DefaultsAreTheStillAt21Seconds) {
  EXPECT_EQ(lamp({"-o", "a.png", "--report", "report.json"}).code, 0);
  const auto report = nlohmann::json::parse(textOf(folder / "report.json"));
  EXPECT_EQ(report["size"], nlohmann::json({1280, 720}));
  EXPECT_EQ(report["frames"][0]["time"], 21.0);
  EXPECT_EQ(report["scene"], "luxo-grandpa");
}

TEST_F(LampProgram, FailsAsRenderFails) {
  expectFailure(lamp({"-o", "a.jpg"}), 2, "'.jpg'", ".png");
  expectFailure(lamp({"-o", "a.png", "--sise", "1x1"}), 2, "--sise", "did you mean '--size'?");
  expectFailure(lamp({"-o", "missing/a.png", "--size", "3x3"}), 5, "cannot write 'missing/a.png'",
                "mkdir -p");
  expectFailure(lamp({"-o", "a.png", "luxo-grandpa"}), 2, "unexpected argument 'luxo-grandpa'", "--help");
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Doctor, FindsAMachineReady) {
  requireDevice();
  if (testing::Test::IsSkipped()) return;
  const ScratchFolder folder;
  const Outcome text = run(folder, {"doctor"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.err, "");
  EXPECT_TRUE(text.out.ends_with("\nready\n")) << text.out;
  EXPECT_TRUE(contains(text.out, "device 0: ")) << text.out;
  const Outcome outcome = run(folder, {"doctor", "--json"});
  EXPECT_EQ(outcome.code, 0);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["ready"], true);
  ASSERT_FALSE(json["devices"].empty());
  EXPECT_TRUE(contains(text.out, json["devices"][0]["name"]));
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Doctor, SaysWhatToInstall) {
  const ScratchFolder folder;
  {
    const ScopedVariable hidden("VK_DRIVER_FILES", "/nonexistent");
    const Outcome text = run(folder, {"doctor"});
    EXPECT_EQ(text.code, 4);
    EXPECT_TRUE(contains(text.out, "VK_DRIVER_FILES=/nonexistent")) << text.out;
    EXPECT_FALSE(contains(text.out, "ready")) << text.out;
    EXPECT_TRUE(contains(text.err, "help: VK_DRIVER_FILES names /nonexistent")) << text.err;
    const Outcome json = run(folder, {"doctor", "--json"});
    EXPECT_EQ(json.code, 4);
    EXPECT_EQ(nlohmann::json::parse(json.out)["ready"], false);
  }
  const ScopedVariable none("VK_DRIVER_FILES", nullptr), legacy("VK_ICD_FILENAMES", nullptr),
      disabled("VK_LOADER_DRIVERS_DISABLE", "*");
  EXPECT_TRUE(
      contains(run(folder, {"doctor"}).err, "help: install a driver: apt install mesa-vulkan-drivers"));
}

TEST(FirstImage, NeedsNothingButAFolder) {
  requireDevice();
  if (testing::Test::IsSkipped()) return;
  const ScratchFolder folder;
  const Outcome outcome = run({.arguments = {}, .folder = folder.path(), .program = LUXO_FIRST_IMAGE});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.entries(), 1u);
  const Image image = loadImage(folder / "first.png");
  EXPECT_EQ(image.width(), 640);
  EXPECT_EQ(image.height(), 480);
  const auto [least, most] = std::minmax_element(image.samples().begin(), image.samples().end());
  EXPECT_GT(*most, *least + 0.25f) << "lit sides and dark ones";
}

/// A listening socket that stands for a display server; nobody answers there.
class Display {
 public:
  Display(int domain, const sockaddr* address, socklen_t length) : socket_(socket(domain, SOCK_STREAM, 0)) {
    if (bind(socket_, address, length) != 0 || listen(socket_, 8) != 0)
      throw std::runtime_error("cannot listen");
  }
  ~Display() { close(socket_); }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  [[nodiscard]] int port() const {
    sockaddr_in address{};
    socklen_t length = sizeof address;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length);
    return ntohs(address.sin_port);
  }
  /// Whether anyone ever connected; a connection waits here until it is accepted.
  [[nodiscard]] bool called() const {
    pollfd waiting{socket_, POLLIN, 0};
    return poll(&waiting, 1, 0) == 1;
  }

 private:
  int socket_;
};

class Headless : public DeviceRenderTest {};

TEST_F(Headless, NeedsNoDisplay) {
  const ScopedVariable x("DISPLAY", nullptr), wayland("WAYLAND_DISPLAY", nullptr),
      runtime("XDG_RUNTIME_DIR", nullptr);
  EXPECT_NE(fileOf({}, "a.png"), "");
  EXPECT_EQ(run(folder, {"doctor"}).code, 0);
  const Arguments lamp = {"-o", "b.png", "--size", "67x45"};
  EXPECT_EQ(run({.arguments = lamp, .folder = folder.path(), .program = LUXO_LAMP_PROGRAM}).code, 0);
}

TEST_F(Headless, NeverCallsADisplayThatIsThere) {
  sockaddr_in anyPort{};
  anyPort.sin_family = AF_INET;
  anyPort.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const Display x(AF_INET, reinterpret_cast<const sockaddr*>(&anyPort), sizeof anyPort);
  sockaddr_un file{};
  file.sun_family = AF_UNIX;
  const ScratchFolder sockets;
  (sockets / "wayland").string().copy(file.sun_path, sizeof file.sun_path - 1);
  const Display wayland(AF_UNIX, reinterpret_cast<const sockaddr*>(&file), sizeof file);
  ASSERT_GE(x.port(), 6000);  // display n listens at port 6000 + n
  const ScopedVariable xName("DISPLAY", fmt::format("127.0.0.1:{}", x.port() - 6000).c_str()),
      waylandName("WAYLAND_DISPLAY", file.sun_path);

  EXPECT_NE(fileOf({}, "a.png"), "");
  const Arguments lamp = {"-o", "b.png", "--size", "67x45"};
  EXPECT_EQ(run({.arguments = lamp, .folder = folder.path(), .program = LUXO_LAMP_PROGRAM}).code, 0);
  EXPECT_EQ(run(folder, {"doctor"}).code, 0);
  EXPECT_FALSE(x.called());
  EXPECT_FALSE(wayland.called());
}

}  // namespace
}  // namespace luxo::test
