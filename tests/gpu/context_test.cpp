// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include "base/error.h"
#include "gpu/debug.h"
#include "support/gpu_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace luxo::gpu {
namespace {

using ::testing::HasSubstr;

// What creating a context says when it fails.
Error errorOf(const ContextDesc& desc) {
  try {
    const Context context(desc);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing thrown";
  return {ErrorKind::Internal, ""};
}

using ContextTest = test::GpuTest;

TEST_F(ContextTest, StartsEmptyAndDescribesItself) {
  const Counters counters = context().counters();
  EXPECT_EQ(counters.objects, 0u);
  EXPECT_EQ(counters.memoryBytes, 0u);
  EXPECT_EQ(counters.submits, 0u);
  EXPECT_FALSE(context().deviceInfo().name.empty());
  EXPECT_THAT(context().deviceInfo().apiVersion, ::testing::StartsWith("1."));
  EXPECT_TRUE(context().deviceInfo().usable());
}

TEST_F(ContextTest, ListsTheDeviceItTook) {
  const std::vector<DeviceInfo> devices = listDevices();
  EXPECT_TRUE(std::ranges::any_of(devices, [&](const DeviceInfo& device) {
    return device.name == context().deviceInfo().name && device.driver == context().deviceInfo().driver;
  }));
}

/// NVIDIA's driver (580) could be loaded 26 times in a process.
TEST_F(ContextTest, OpensAgainAndAgain) {
  for (int i = 0; i < 40; ++i) EXPECT_NO_THROW(Context(ContextDesc{})) << i;
}

TEST_F(ContextTest, OffersSupportedSampleCounts) {
  EXPECT_EQ(context().supportedSamples(0), VK_SAMPLE_COUNT_1_BIT);
  EXPECT_EQ(context().supportedSamples(1), VK_SAMPLE_COUNT_1_BIT);
  EXPECT_EQ(context().supportedSamples(4), VK_SAMPLE_COUNT_4_BIT);  // every Vulkan device has 4
  EXPECT_EQ(context().supportedSamples(7), VK_SAMPLE_COUNT_4_BIT);
}

TEST_F(ContextTest, TakesTheDeviceTheEnvironmentNames) {
  const test::ScopedVariable variable("LUXO_DEVICE", "no such device");
  EXPECT_THAT(errorOf({}).what(), HasSubstr("there is no Vulkan device 'no such device'"));
  EXPECT_NO_THROW(Context({.device = "0"})) << "what the program asks for comes first";
}

TEST_F(ContextTest, SaysWhichDevicesThereAreWhenTheNameIsWrong) {
  const Error error = errorOf({.device = "Voodoo 3"});
  EXPECT_EQ(error.kind(), ErrorKind::Device);
  EXPECT_THAT(error.what(), HasSubstr("there is no Vulkan device 'Voodoo 3'; this machine has:"));
  EXPECT_THAT(error.what(), HasSubstr(context().deviceInfo().name));
}

TEST_F(ContextTest, RefusesADeviceThatCannotPresent) {
  const Error error =
      errorOf({.canPresent = [](VkInstance, VkPhysicalDevice, std::uint32_t) { return false; }});
  EXPECT_EQ(error.kind(), ErrorKind::Device);
  EXPECT_THAT(error.what(),
              HasSubstr("not usable, it has no graphics and compute queue that can show pictures"));
}

TEST_F(ContextTest, WorksWithoutValidation) {
  const Context plain;
  EXPECT_TRUE(plain.deviceInfo().usable());
}

TEST(Context, SaysThatTheDriverFileDoesNotExist) {
  const test::ScopedVariable files("VK_DRIVER_FILES", "/nonexistent");
  const test::ScopedVariable oldFiles("VK_ICD_FILENAMES", nullptr);
  EXPECT_TRUE(listDevices().empty());
  const Error error = errorOf({});
  EXPECT_EQ(error.kind(), ErrorKind::Device);
  EXPECT_THAT(error.what(), HasSubstr("no Vulkan device found"));
  EXPECT_THAT(error.hint(), HasSubstr("VK_DRIVER_FILES names /nonexistent, which does not exist"));
}

TEST(Context, SaysWhatToInstallWhenThereIsNoValidationLayer) {
  const test::ScopedVariable layers("VK_LAYER_PATH", "/nonexistent");
  const Error error = errorOf({.validation = true});
  EXPECT_EQ(error.kind(), ErrorKind::Device);
  EXPECT_THAT(error.what(), HasSubstr("the Vulkan validation layer is not installed"));
  EXPECT_THAT(error.hint(), HasSubstr("apt install vulkan-validationlayers"));
}

TEST_F(ContextTest, RefusesMoreMemoryThanTheDriverGives) {
  try {
    static_cast<void>(context().memory().allocate(
        {.requirements = {.size = std::uint64_t{1} << 60, .alignment = 1, .memoryTypeBits = ~0u}}));
    FAIL() << "an exbibyte";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Device) << "no retry would help";
    EXPECT_THAT(error.what(), HasSubstr("allocate 1099511627776 MiB"));
    EXPECT_THAT(error.what(), HasSubstr("this device gives at most"));
  }
  EXPECT_EQ(context().counters().deviceBytes, 0u);
}

// That no message came means little unless messages do come: plant one mistake of each kind.
class ValidationTest : public test::GpuTest {
 protected:
  std::uint64_t messagesOf(const std::function<void(Context&, const ValidationLog&)>& mistake) {
    const auto log = std::make_shared<ValidationLog>();
    {
      Context mistaken({.validation = true, .validationLog = log});
      EXPECT_EQ(log->count(), 0u);
      mistake(mistaken, *log);
    }
    return log->count();
  }
};

TEST_F(ValidationTest, ReportsWrongCalls) {
  EXPECT_GT(messagesOf([](Context& mistaken, const ValidationLog&) {
              const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                            .size = 16};  // no usage
              VkBuffer buffer = VK_NULL_HANDLE;
              vkCreateBuffer(mistaken.device(), &info, nullptr, &buffer);
              if (buffer != VK_NULL_HANDLE) vkDestroyBuffer(mistaken.device(), buffer, nullptr);
            }),
            0u);
}

TEST_F(ValidationTest, ReportsLeaksAfterTheContextIsGone) {
  EXPECT_GT(messagesOf([](Context& mistaken, const ValidationLog& log) {
              const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
              VkSemaphore leaked = VK_NULL_HANDLE;
              vkCreateSemaphore(mistaken.device(), &info, nullptr, &leaked);
              EXPECT_EQ(log.count(), 0u);
            }),
            0u);
}

TEST_F(ValidationTest, KeepsTheFirstTwentyTexts) {
  ValidationLog log;
  for (int i = 0; i < 30; ++i) log.add(std::to_string(i));
  EXPECT_EQ(log.count(), 30u);
  EXPECT_EQ(log.messages().size(), 20u);
  EXPECT_EQ(log.messages().back(), "19");
}

TEST_F(ValidationTest, NamesObjectsInItsMessages) {
  const auto log = std::make_shared<ValidationLog>();
  {
    Context mistaken({.validation = true, .validationLog = log});
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore leaked = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreateSemaphore(mistaken.device(), &info, nullptr, &leaked), VK_SUCCESS);
    setName(mistaken, leaked, "the leaked one");
  }
  ASSERT_FALSE(log->messages().empty());
  EXPECT_THAT(log->messages().front(), HasSubstr("the leaked one"));
}

}  // namespace
}  // namespace luxo::gpu
