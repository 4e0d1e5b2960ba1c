// Too little device memory, as the device itself states: drivers may promise more.
#include "tests/faults/vulkan_calls.h"
#include "tests/support/context_calls.h"

#include <pt/film.h>
#include <pt/stats.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

constexpr uint32_t width = 24;
constexpr uint32_t height = 20;
constexpr uint64_t sums_bytes = uint64_t{112} * width * height;

// A context on a device with so much memory.
class Context {
public:
    explicit Context(uint64_t memory_bytes) {
        faults::limit_memory(memory_bytes);
        pt_create_info create{};
        create.struct_size = sizeof create;
        create.submit_milliseconds = 1;
        EXPECT_EQ(pt_create(&create, &context_), PT_OK) << pt_last_error(nullptr);
        const CourseworkScene coursework;
        const pt_scene scene = coursework.scene();
        const pt_camera camera = CourseworkScene::camera();
        EXPECT_EQ(pt_set_scene(context_, &scene), PT_OK) << message();
        EXPECT_EQ(pt_set_camera(context_, &camera), PT_OK) << message();
    }
    Context(const Context &) = delete;
    Context &operator=(const Context &) = delete;
    ~Context() {
        pt_destroy(context_);
        faults::limit_memory(UINT64_MAX);
    }

    std::string message() const { return pt_last_error(context_); }

    pt_result set_render(uint32_t first_sample, uint32_t max_path_length = 2) {
        pt_render render = render_of(width, height, max_path_length);
        render.first_sample = first_sample;
        return pt_set_render(context_, &render);
    }

    pt_result accumulate(uint32_t sample_count) {
        const pt_accumulate_info info{sizeof info, sample_count, nullptr, nullptr, 0, 0, 0, nullptr, 0, 0};
        return pt_accumulate(context_, &info);
    }

    // The sample with an index alone.
    void take(uint32_t index) {
        EXPECT_EQ(set_render(index), PT_OK) << message();
        EXPECT_EQ(accumulate(1), PT_OK) << message();
    }

    pt_result add(const std::vector<char> &film) { return pt_add_film(context_, film.data(), film.size()); }

    std::vector<char> film() { return film_of(context_); }

    uint64_t bytes_in_use() {
        pt_stats stats{};
        stats.struct_size = sizeof stats;
        EXPECT_EQ(pt_get_stats(context_, &stats), PT_OK) << message();
        return stats.device_bytes;
    }

private:
    pt_context *context_ = nullptr;
};

// The sums of the film are needed twice, for as long as it takes to add another.
TEST(DeviceMemoryTest, AFilmIsAddedWhereItsSumsFitInTwice) {
    Context roomy(UINT64_MAX);
    roomy.take(1);
    const std::vector<char> second = roomy.film();
    roomy.take(0);
    const std::vector<char> first = roomy.film();
    const uint64_t in_use = roomy.bytes_in_use();
    ASSERT_EQ(roomy.add(second), PT_OK) << roomy.message();
    const std::vector<char> both = roomy.film();

    Context full(in_use + sums_bytes - 1);
    full.take(0);
    ASSERT_EQ(full.add(second), PT_ERROR_OUT_OF_DEVICE_MEMORY);
    EXPECT_EQ(full.message(), "a sum of films takes " + std::to_string(sums_bytes) + " bytes beside the " +
                                  std::to_string(in_use) + " in use, and the device has " +
                                  std::to_string(in_use + sums_bytes - 1));
    EXPECT_EQ(full.bytes_in_use(), in_use);
    EXPECT_TRUE(full.film() == first) << "the film has changed";

    Context just_enough(in_use + sums_bytes);
    just_enough.take(0);
    ASSERT_EQ(just_enough.add(second), PT_OK) << just_enough.message();
    EXPECT_EQ(just_enough.bytes_in_use(), in_use);
    EXPECT_TRUE(just_enough.film() == both) << "another sum";
}

TEST(DeviceMemoryTest, AnImageIsRefusedWhereItDoesNotFit) {
    constexpr uint64_t film_bytes = sums_bytes;
    Context small(film_bytes - 1);
    EXPECT_EQ(small.set_render(0), PT_ERROR_UNSUPPORTED);
    EXPECT_EQ(small.message().rfind("render.width * rows = 24 * 20: the film takes " + std::to_string(film_bytes) +
                                        " bytes, and the device has " + std::to_string(film_bytes - 1) +
                                        ": render fewer",
                                    0),
              0U)
        << small.message();
    Context just_enough(film_bytes);
    EXPECT_EQ(just_enough.set_render(0), PT_OK) << just_enough.message();
}

} // namespace
