#include "lib/vulkan/instance.h"

#include "lib/base/error.h"
#include "lib/base/log.h"
#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace {

using pt::vulkan::Instance;

class EnvironmentVariable {
public:
    EnvironmentVariable(const char *name, const char *value) : name_(name) {
        if (const char *before = std::getenv(name))
            before_ = before;
        setenv(name, value, 1);
    }
    ~EnvironmentVariable() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    EnvironmentVariable(const EnvironmentVariable &) = delete;
    EnvironmentVariable &operator=(const EnvironmentVariable &) = delete;

private:
    const char *name_;
    std::optional<std::string> before_;
};

TEST(VulkanInstanceTest, WithoutADriverThereIsNoDevice) {
    const EnvironmentVariable no_driver("VK_DRIVER_FILES", "/nonexistent/driver.json");
    const pt::Error error = error_of([] { (void)Instance(pt::Log{}, false).physical_devices(); });
    EXPECT_EQ(error.code(), PT_ERROR_NO_DEVICE);
    EXPECT_TRUE(names(error, "VK_DRIVER_FILES=/nonexistent/driver.json")) << error.what();
    EXPECT_TRUE(names(error, "ErrorIncompatibleDriver")) << error.what();
    EXPECT_TRUE(names(error, "mesa-vulkan-drivers")) << error.what();
}

TEST(VulkanInstanceTest, WithoutTheLayerValidationIsUnsupported) {
    const EnvironmentVariable no_layers("VK_LAYER_PATH", "/nonexistent");
    const pt::Error error = error_of([] { Instance(pt::Log{}, true); });
    EXPECT_EQ(error.code(), PT_ERROR_UNSUPPORTED);
    EXPECT_TRUE(names(error, "VK_LAYER_KHRONOS_validation")) << error.what();
}

} // namespace
