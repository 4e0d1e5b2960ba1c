#include "tests/faults/allocations.h"
#include "tests/faults/vulkan_calls.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <pt/film.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace faults;

using FilmBytes = std::vector<char>;

constexpr uint32_t uneven_width = 40;
constexpr uint32_t uneven_height = 24;

// Leaves out the validation layer, because its calls and memory would count.
Context context_of(uint32_t device_count) {
    auto info = sized<pt_create_info>();
    info.submit_milliseconds = 20;
    pt_context *context = nullptr;
    EXPECT_EQ(create_shared(device_count, info, &context), PT_OK) << pt_last_error(nullptr);
    return Context(context);
}

void begin_picture(pt_context *context) {
    set_coursework(context, render_of(uneven_width, uneven_height, 2));
}

pt_result take_to_target(pt_context *context) {
    const InLibrary in_library;
    auto info = sized<pt_accumulate_info>();
    info.sample_count = 1U << 20;
    info.stopping.target_error = 0.03;
    return pt_accumulate(context, &info);
}

std::size_t place_after(std::size_t place) {
    return place + 1 + place / 8;
}

class UnevenTargetTest : public testing::Test {
protected:
    void SetUp() override {
        const Context undisturbed = context_of(1);
        begin_picture(undisturbed.get());
        ASSERT_EQ(take_to_target(undisturbed.get()), PT_TARGET_REACHED) << pt_last_error(undisturbed.get());
        const pt_stats stats = stats_of(undisturbed.get());
        ASSERT_LT(stats.sample_count, stats.max_sample_count) << "all tiles have the same";
        expected_ = film_of(undisturbed.get());
        context_ = context_of(2);
    }

    void TearDown() override {
        context_.reset();
        heal_devices();
        forget_objects();
    }

    void expect_bytes_after(pt_result disturbed) {
        if (disturbed == PT_ERROR_DEVICE_LOST) {
            context_.reset();
            heal_devices();
            context_ = context_of(2);
            return;
        }
        if (disturbed < PT_OK) {
            EXPECT_STRNE(pt_last_error(context()), "");
            EXPECT_EQ(take_to_target(context()), PT_TARGET_REACHED) << pt_last_error(context());
        }
        EXPECT_TRUE(film_of(context()) == expected_) << "after " << pt_result_name(disturbed);
    }

    pt_context *context() const { return context_.get(); }

private:
    FilmBytes expected_;
    Context context_;
};

// Only the two memory errors of Vulkan calls are injected. Other errors lose the device and its film.
TEST_F(UnevenTargetTest, AnyAllocationOrVulkanCallMayFail) {
    for (const int kind : {0, 1, 2}) {
        std::size_t failures = 0;
        bool reached = true;
        for (std::size_t place = 1; reached && !HasFatalFailure(); place = place_after(place)) {
            SCOPED_TRACE("place " + std::to_string(place) + ", kind " + std::to_string(kind));
            begin_picture(context());
            fail_allocation(kind == 0 ? place : 0, false);
            fail_call(kind == 0 ? 0 : place, kind == 2 ? 1 : 0);
            const pt_result result = take_to_target(context());
            reached = kind == 0 ? allocation_failed() : !call_fault().function.empty();
            if (kind == 0 && allocation_threw()) {
                EXPECT_EQ(result, PT_ERROR_OUT_OF_HOST_MEMORY);
            }
            failures += result < PT_OK && result != PT_ERROR_DEVICE_LOST ? 1 : 0;
            fail_allocation(0, false);
            fail_call(0, 0);
            expect_bytes_after(result);
        }
        EXPECT_GT(failures, 10U) << kind;
    }
}

} // namespace
