#include "tests/faults/vulkan_calls.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"

#include <pt/film.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

constexpr uint32_t width = 24;
constexpr uint32_t height = 20;
constexpr uint64_t sums_bytes = uint64_t{112} * width * height;

class DeviceMemoryTest : public testing::Test {
protected:
    void TearDown() override { faults::limit_memory(UINT64_MAX); }

    static Context context_with(uint64_t memory_bytes) {
        faults::limit_memory(memory_bytes);
        pt_context *context = nullptr;
        EXPECT_EQ(pt_create(nullptr, &context), PT_OK) << pt_last_error(nullptr);
        return Context(context);
    }

    static void take(const Context &context, uint32_t index) {
        pt_render render = render_of(width, height, 2);
        render.first_sample = index;
        set_coursework(context.get(), render);
        accumulate_on(context.get(), 1);
    }

    static pt_result add(const Context &context, const std::vector<char> &film) {
        return pt_add_film(context.get(), film.data(), film.size());
    }

    static uint64_t bytes_in_use(const Context &context) { return stats_of(context.get()).device_bytes; }
};

TEST_F(DeviceMemoryTest, AFilmIsAddedWhereItsSumsFitInTwice) {
    const Context roomy = context_with(UINT64_MAX);
    take(roomy, 1);
    const std::vector<char> second = film_of(roomy.get());
    take(roomy, 0);
    const std::vector<char> first = film_of(roomy.get());
    const uint64_t in_use = bytes_in_use(roomy);
    ASSERT_EQ(add(roomy, second), PT_OK) << pt_last_error(roomy.get());
    const std::vector<char> both = film_of(roomy.get());

    const Context full = context_with(in_use + sums_bytes - 1);
    take(full, 0);
    ASSERT_EQ(add(full, second), PT_ERROR_OUT_OF_DEVICE_MEMORY);
    EXPECT_EQ(pt_last_error(full.get()), "a sum of films takes " + std::to_string(sums_bytes) + " bytes beside the " +
                                             std::to_string(in_use) + " in use, and the device has " +
                                             std::to_string(in_use + sums_bytes - 1));
    EXPECT_EQ(bytes_in_use(full), in_use);
    EXPECT_TRUE(film_of(full.get()) == first) << "the film has changed";

    const Context just_enough = context_with(in_use + sums_bytes);
    take(just_enough, 0);
    ASSERT_EQ(add(just_enough, second), PT_OK) << pt_last_error(just_enough.get());
    EXPECT_EQ(bytes_in_use(just_enough), in_use);
    EXPECT_TRUE(film_of(just_enough.get()) == both) << "another sum";
}

TEST_F(DeviceMemoryTest, AnImageIsRefusedWhereItDoesNotFit) {
    const pt_render render = render_of(width, height, 2);
    const Context small = context_with(sums_bytes - 1);
    EXPECT_EQ(pt_set_render(small.get(), &render), PT_ERROR_UNSUPPORTED);
    const std::string message = pt_last_error(small.get());
    EXPECT_TRUE(message.starts_with("render.width * rows = 24 * 20: the film takes " + std::to_string(sums_bytes) +
                                    " bytes, and the device has " + std::to_string(sums_bytes - 1) + ": render fewer"))
        << message;
    const Context just_enough = context_with(sums_bytes);
    EXPECT_EQ(pt_set_render(just_enough.get(), &render), PT_OK) << pt_last_error(just_enough.get());
}

} // namespace
