// A fixture for pt.h. Warnings of the library or of the validation layer are failures. PT_TEST_DEVICE sets
// pt_create_info.device. PT_TEST_NO_VALIDATION removes the layer, for leak checks.
#pragma once

#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"
#include "tests/support/sized.h"

#include <pt/devices.h>
#include <pt/pt.h>
#include <pt/stats.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

struct DestroyContext {
    void operator()(pt_context *context) const { pt_destroy(context); }
};
using Context = std::unique_ptr<pt_context, DestroyContext>;

inline pt_stats stats_of(pt_context *context) {
    auto stats = sized<pt_stats>();
    EXPECT_EQ(pt_get_stats(context, &stats), PT_OK) << pt_last_error(context);
    return stats;
}

inline pt_error_estimate error_of(pt_context *context) {
    auto error = sized<pt_error_estimate>();
    EXPECT_EQ(pt_get_error_estimate(context, &error), PT_OK) << pt_last_error(context);
    return error;
}

class ContextFixture : public testing::Test {
protected:
    void SetUp() override {
        context_ = create_fixtures_context();
        ASSERT_TRUE(context_);
    }

    virtual Context create_fixtures_context() { return create_context(); }

    void TearDown() override {
        context_.reset();
        for (const std::string &line : complaints_)
            ADD_FAILURE() << line;
    }

    pt_context *context() const { return context_.get(); }

    using Create = std::function<pt_result(const pt_create_info *, pt_context **)>;

    // The context must be destroyed before the test ends.
    Context create_context(
        const std::function<void(pt_create_info &)> &adjust = [](pt_create_info &) {},
        const Create &create = &pt_create) {
        auto info = sized<pt_create_info>();
        info.flags = std::getenv("PT_TEST_NO_VALIDATION") ? 0 : PT_CREATE_VALIDATION;
        info.device = std::getenv("PT_TEST_DEVICE");
        info.log = &ContextFixture::collect;
        info.log_user = &complaints_;
        adjust(info);
        pt_context *created = nullptr;
        EXPECT_EQ(create(&info, &created), PT_OK) << pt_last_error(nullptr);
        return Context(created);
    }

    void accumulate(std::uint32_t sample_count) {
        const pt_accumulate_info info = accumulate_info(sample_count);
        ASSERT_EQ(pt_accumulate(context(), &info), PT_OK) << pt_last_error(context());
    }

    void readback(std::vector<float> &image) {
        const pt_image target = image_target(image);
        ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
    }

    pt_stats stats() { return stats_of(context()); }
    pt_error_estimate error() { return error_of(context()); }

    static bool is_on_cpu(pt_context *on) {
        pt_device_info info{};
        EXPECT_EQ(pt_get_context_device(on, &info), PT_OK) << pt_last_error(on);
        return info.kind == PT_DEVICE_CPU;
    }

private:
    static void collect(void *user, int32_t level, const char *line) {
        if (level == PT_LOG_ERROR || level == PT_LOG_WARNING)
            static_cast<std::vector<std::string> *>(user)->push_back(line);
    }

    std::vector<std::string> complaints_;
    Context context_;
};
