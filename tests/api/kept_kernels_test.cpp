#include "tests/api/api_fixture.h"
#include "tests/support/context_calls.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"

#include <pt/devices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace api {

namespace {

using Kept = std::vector<std::byte>;

struct Keeper {
    std::map<std::string, Kept> kept;
    std::vector<std::string> loads;
    std::vector<std::string> stores;
    std::vector<std::string> lines;

    static std::uint64_t load(void *user, const char *key, void *data, std::uint64_t size_bytes) {
        auto *const self = static_cast<Keeper *>(user);
        self->loads.emplace_back(key);
        const Kept &bytes = self->kept[key];
        if (bytes.size() <= size_bytes)
            std::copy(bytes.begin(), bytes.end(), static_cast<std::byte *>(data));
        return bytes.size();
    }

    static void store(void *user, const char *key, const void *data, std::uint64_t size_bytes) {
        auto *const self = static_cast<Keeper *>(user);
        self->stores.emplace_back(key);
        const auto *bytes = static_cast<const std::byte *>(data);
        self->kept[key].assign(bytes, bytes + size_bytes);
    }

    static void hear(void *user, std::int32_t level, const char *line) {
        auto *const self = static_cast<Keeper *>(user);
        self->lines.push_back(line);
        if (level <= PT_LOG_WARNING)
            ADD_FAILURE() << line;
    }

    std::size_t heard(const std::string &start) const {
        return static_cast<std::size_t>(
            std::ranges::count_if(lines, [&](const std::string &line) { return line.starts_with(start); }));
    }
};

class KeptKernelsApiTest : public ApiTest {
protected:
    Context keeping(Keeper &keeper, std::uint32_t flags = 0) {
        return create_context([&](pt_create_info &info) {
            info.flags |= flags;
            info.log = &Keeper::hear;
            info.log_user = &keeper;
            info.load_kernels = &Keeper::load;
            info.store_kernels = &Keeper::store;
            info.kernels_user = &keeper;
        });
    }

    std::vector<float> rendered(pt_context *context, std::uint32_t count) {
        const pt_accumulate_info info = accumulate_info(count);
        EXPECT_EQ(pt_accumulate(context, &info), PT_OK) << pt_last_error(context);
        std::vector<float> pixels(std::size_t{3} * width * height);
        const pt_image image = image_target(pixels);
        EXPECT_EQ(pt_readback(context, &image), PT_OK) << pt_last_error(context);
        return pixels;
    }

    static void set_coursework(pt_context *context) { ::set_coursework(context, render_of(width, height, 3)); }
};

constexpr const char *built = "built a kernel for";

TEST_F(KeptKernelsApiTest, AfterPrepareNothingIsBuiltAndSamplesStay) {
    Keeper keeper;
    const Context prepared = keeping(keeper);
    pt_device_info device{};
    ASSERT_EQ(pt_get_context_device(prepared.get(), &device), PT_OK);
    EXPECT_EQ(keeper.heard(std::string("renders on ") + device.name + " (" + device.driver + ")"), 1U);
    ASSERT_NO_FATAL_FAILURE(set_coursework(prepared.get()));
    EXPECT_EQ(keeper.lines.size(), 1U);
    ASSERT_EQ(pt_prepare(prepared.get()), PT_OK) << pt_last_error(prepared.get());
    EXPECT_EQ(keeper.heard(built), 1U);
    const std::vector<float> image = rendered(prepared.get(), 5);
    EXPECT_EQ(keeper.heard(built), 1U);
    ASSERT_EQ(pt_prepare(prepared.get()), PT_OK) << pt_last_error(prepared.get());
    EXPECT_EQ(stats_of(prepared.get()).sample_count, 5U);
    const std::vector<float> whole = rendered(prepared.get(), 4);

    ASSERT_NO_FATAL_FAILURE(set_coursework(context()));
    EXPECT_EQ(rendered(context(), 5), image);
    EXPECT_EQ(rendered(context(), 4), whole);
}

TEST_F(KeptKernelsApiTest, KernelsOfScenesCanBeDeclined) {
    Keeper keeper;
    const Context declining = keeping(keeper, PT_CREATE_NO_SCENE_KERNELS);
    ASSERT_NO_FATAL_FAILURE(set_coursework(declining.get()));
    const std::vector<float> image = rendered(declining.get(), 5);
    pt_camera camera = CourseworkScene::camera();
    camera.position[0] += 0.01;
    ASSERT_EQ(pt_set_camera(declining.get(), &camera), PT_OK);
    rendered(declining.get(), 1);
    ASSERT_EQ(pt_prepare(declining.get()), PT_OK);
    EXPECT_EQ(keeper.heard(built), 1U);
    EXPECT_EQ(keeper.heard("built a kernel for all scenes of this kind"), 1U);
    ASSERT_NO_FATAL_FAILURE(set_coursework(context()));
    EXPECT_EQ(rendered(context(), 5), image) << "the same bits";
}

TEST_F(KeptKernelsApiTest, AreKeptUnderOneKeyAndGivenBack) {
    Keeper keeper;
    {
        const Context first = keeping(keeper);
        EXPECT_EQ(keeper.loads.size(), 1U) << "in pt_create";
        EXPECT_EQ(keeper.stores.size(), 0U);
        ASSERT_NO_FATAL_FAILURE(set_coursework(first.get()));
        ASSERT_EQ(pt_prepare(first.get()), PT_OK);
        EXPECT_EQ(keeper.stores.size(), 1U) << "at the end of the call that built them";
        rendered(first.get(), 3);
        EXPECT_EQ(keeper.stores.size(), 1U) << "there is nothing new";
    }
    ASSERT_EQ(keeper.stores, keeper.loads) << "the same key";
    const std::string key = keeper.loads[0];
    EXPECT_EQ(key.size(), 32U);
    EXPECT_EQ(key.find_first_not_of("0123456789abcdef"), std::string::npos) << key;

    Keeper again;
    again.kept = keeper.kept;
    const Context second = keeping(again);
    EXPECT_EQ(again.loads, (std::vector<std::string>{key, key})) << "the size, and the bytes";
    EXPECT_EQ(again.heard("the kept kernels"), 0U) << "they are whole";
    ASSERT_NO_FATAL_FAILURE(set_coursework(second.get()));
    ASSERT_NO_FATAL_FAILURE(set_coursework(context()));
    EXPECT_EQ(rendered(second.get(), 3), rendered(context(), 3));
    pt_device_info device{};
    ASSERT_EQ(pt_get_context_device(second.get(), &device), PT_OK);
    if (device.kind == PT_DEVICE_CPU) {
        EXPECT_EQ(again.stores.size(), 0U) << "what is kept already";
    }
}

TEST_F(KeptKernelsApiTest, DamagedAndForeignOnesAreLeftAlone) {
    Keeper keeper;
    {
        const Context first = keeping(keeper);
        ASSERT_NO_FATAL_FAILURE(api::set_all(first.get()));
        rendered(first.get(), 1);
    }
    ASSERT_GE(keeper.stores.size(), 1U);
    Kept &bytes = keeper.kept.begin()->second;
    const Kept whole = bytes;
    const auto expect_damaged = [&](bool is_damaged) {
        Keeper loading;
        loading.kept = keeper.kept;
        const Context context = keeping(loading);
        EXPECT_EQ(loading.heard("the kept kernels are damaged or foreign, and are built again"), is_damaged ? 1U : 0U);
        bytes = whole;
    };
    expect_damaged(false);
    for (const std::size_t place : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
        SCOPED_TRACE("place " + std::to_string(place));
        bytes[place] ^= std::byte{1};
        expect_damaged(true);
        bytes.resize(std::max<std::size_t>(place, 1));
        expect_damaged(true);
    }
}

TEST_F(KeptKernelsApiTest, LoadMaySayAnything) {
    for (const std::uint64_t claimed : {UINT64_MAX, std::uint64_t{1} << 40, std::uint64_t{100}}) {
        std::uint64_t size = claimed;
        const Context context = create_context([&](pt_create_info &info) {
            info.load_kernels = [](void *user, const char *, void *, std::uint64_t) {
                return (*static_cast<std::uint64_t *>(user))--;
            };
            info.kernels_user = &size;
        });
        EXPECT_TRUE(context) << claimed;
    }
}

} // namespace

} // namespace api
