// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "gpu/device.h"
#include "support/gpu_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace luxo::gpu {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<DeviceInfo> kMachine{
    {"llvmpipe (LLVM 15)", DeviceType::Cpu, "llvmpipe Mesa 22", "1.3.230", ""},
    {"Old Card", DeviceType::Discrete, "old 1", "1.1.0", "it lacks Vulkan 1.3"},
    {"UHD Graphics", DeviceType::Integrated, "ANV Mesa 22", "1.3.230", ""},
    {"GeForce RTX 4090", DeviceType::Discrete, "NVIDIA 550", "1.3.277", ""},
    {"GeForce RTX 4060", DeviceType::Discrete, "NVIDIA 550", "1.3.277", ""},
    {"Virtio Venus", DeviceType::Virtual, "venus", "1.3.0", ""}};

Error errorOf(const std::vector<DeviceInfo>& devices, std::string_view wanted) {
  try {
    static_cast<void>(chooseDevice(devices, wanted));
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing thrown for " << wanted;
  return {ErrorKind::Internal, ""};
}

TEST(DeviceChoice, AutoPrefersDiscreteThenIntegratedThenVirtualThenCpu) {
  std::vector<DeviceInfo> devices = kMachine;
  EXPECT_EQ(chooseDevice(devices, "auto"), 3u);  // the first of its kind that is usable
  devices[3].missing = devices[4].missing = "broken";
  EXPECT_EQ(chooseDevice(devices, "auto"), 2u);
  devices[2].missing = "broken";
  EXPECT_EQ(chooseDevice(devices, "auto"), 5u);
  devices[5].missing = "broken";
  EXPECT_EQ(chooseDevice(devices, "auto"), 0u);
}

TEST(DeviceChoice, UnderstandsKindsNumbersAndParts) {
  EXPECT_EQ(chooseDevice(kMachine, "cpu"), 0u);
  EXPECT_EQ(chooseDevice(kMachine, "GPU"), 3u);
  EXPECT_EQ(chooseDevice(kMachine, "5"), 5u);
  EXPECT_EQ(chooseDevice(kMachine, "rtx 4060"), 4u);
  EXPECT_EQ(chooseDevice(kMachine, "uhd"), 2u);
  EXPECT_EQ(chooseDevice(kMachine, "GEFORCE"), 3u);
}

TEST(DeviceChoice, GpuNeverMeansTheCpu) {
  const std::vector<DeviceInfo> devices{kMachine[0]};
  const Error error = errorOf(devices, "gpu");
  EXPECT_EQ(error.kind(), ErrorKind::Device);
  EXPECT_THAT(error.what(), HasSubstr("no usable Vulkan device is a GPU"));
  EXPECT_THAT(error.what(),
              HasSubstr("0: llvmpipe (LLVM 15) (CPU, llvmpipe Mesa 22, Vulkan 1.3.230): usable"));
  EXPECT_THAT(error.hint(), HasSubstr("auto"));
}

TEST(DeviceChoice, NamesEveryDeviceWithItsReason) {
  const Error unknown = errorOf(kMachine, "Radeon");
  EXPECT_EQ(unknown.kind(), ErrorKind::Device);
  EXPECT_THAT(unknown.what(), HasSubstr("there is no Vulkan device 'Radeon'"));
  EXPECT_THAT(unknown.what(),
              HasSubstr("1: Old Card (discrete GPU, old 1, Vulkan 1.1.0): not usable, it lacks Vulkan 1.3"));
  for (const DeviceInfo& device : kMachine) EXPECT_THAT(unknown.what(), HasSubstr(device.name));

  EXPECT_THAT(errorOf(kMachine, "6").what(), HasSubstr("there is no Vulkan device '6'"));
  EXPECT_THAT(errorOf(kMachine, "1").what(), HasSubstr("Vulkan device 1 (Old Card) is not usable: it lacks"));
  EXPECT_THAT(errorOf(kMachine, "old").what(), HasSubstr("device old (Old Card) is not usable: it lacks"));

  const std::vector<DeviceInfo> old{kMachine[1]};
  const Error none = errorOf(old, "auto");
  EXPECT_THAT(none.what(), HasSubstr("no Vulkan device is usable"));
  EXPECT_THAT(none.hint(), HasSubstr("mesa-vulkan-drivers"));
}

TEST(DeviceChoice, SaysWhatToInstallWhenThereIsNoDriver) {
  const test::ScopedVariable files("VK_DRIVER_FILES", nullptr);
  const test::ScopedVariable oldFiles("VK_ICD_FILENAMES", nullptr);
  const Error error = errorOf({}, "auto");
  EXPECT_EQ(error.kind(), ErrorKind::Device);
  EXPECT_THAT(error.what(), HasSubstr("no Vulkan device found"));
  EXPECT_THAT(error.hint(), HasSubstr("apt install mesa-vulkan-drivers"));
}

TEST(DeviceChoice, BlamesTheVariableThatHidesTheDrivers) {
  const test::ScopedVariable oldFiles("VK_ICD_FILENAMES", nullptr);
  {
    const test::ScopedVariable files("VK_DRIVER_FILES", "/nonexistent/icd.json");
    EXPECT_THAT(noDriverHint(),
                HasSubstr("VK_DRIVER_FILES names /nonexistent/icd.json, which does not exist"));
  }
  const std::string existing = std::filesystem::temp_directory_path().string();
  const test::ScopedVariable files("VK_DRIVER_FILES", existing.c_str());
  EXPECT_THAT(noDriverHint(), HasSubstr("VK_DRIVER_FILES=" + existing + " hides every other driver"));
  EXPECT_THAT(noDriverHint(), Not(HasSubstr("does not exist")));
}

}  // namespace
}  // namespace luxo::gpu
