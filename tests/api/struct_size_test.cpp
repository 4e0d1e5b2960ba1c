#include "tests/api/api_fixture.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"
#include "tests/support/sized.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace api {

namespace {

using Outcome = std::pair<pt_result, std::string>;

// Sizes change in steps of 8 bytes, so that no pointer is split.
template <typename T>
std::vector<uint32_t> older_sizes() {
    std::vector<uint32_t> sizes{sizeof(uint32_t)};
    for (uint32_t size = 8; size < sizeof(T); size += 8)
        sizes.push_back(size);
    return sizes;
}

template <typename T>
T with_tail(const T &value, uint32_t size, int byte) {
    T copy = value;
    std::memset(reinterpret_cast<unsigned char *>(&copy) + size, byte, sizeof(T) - size);
    return copy;
}

template <typename T, typename Call>
std::vector<uint32_t> misread_sizes(const T &value, const Call &call) {
    std::vector<uint32_t> misread;
    for (const uint32_t size : older_sizes<T>()) {
        T older = with_tail(value, size, 0xff);
        T zeros = with_tail(value, size, 0);
        older.struct_size = size;
        zeros.struct_size = sizeof(T);
        if (call(older) != call(zeros))
            misread.push_back(size);
    }
    return misread;
}

template <typename T>
struct Newer {
    T known;
    unsigned char tail[16];
};

template <typename T>
Newer<T> newer_than(const T &value) {
    Newer<T> newer{value, {}};
    newer.known.struct_size = sizeof newer;
    return newer;
}

template <typename T, typename Call>
void expect_absurd_sizes_refused(T value, const std::string &name, const Call &call) {
    for (const auto &[size, rule] : {std::pair{0U, ", which holds this field"}, {65537U, " (<= 65536)"}}) {
        value.struct_size = size;
        const Outcome refused{PT_ERROR_INVALID_ARGUMENT, name + ".struct_size = " + std::to_string(size) +
                                                             ": must be the size of the struct" + rule};
        EXPECT_EQ(call(value), refused);
    }
}

// The call must read older structs as far as they reach, accept newer structs with a zero tail, name each nonzero byte
// in a tail, and reject sizes that never existed.
template <typename T, typename Call>
void expect_sizes_heeded(const T &value, const std::string &name, const Call &call) {
    EXPECT_EQ(misread_sizes(value, call), std::vector<uint32_t>());
    EXPECT_EQ(call(newer_than(value).known), call(value));
    for (std::size_t i = 0; i < sizeof(Newer<T>::tail); ++i) {
        Newer<T> newer = newer_than(value);
        newer.tail[i] = 1;
        const Outcome outcome{PT_ERROR_UNSUPPORTED, name + ".struct_size = " + std::to_string(sizeof newer) +
                                                        ": byte " + std::to_string(sizeof(T) + i) +
                                                        " is set, but this library knows only the first " +
                                                        std::to_string(sizeof(T)) + " bytes of the struct"};
        EXPECT_EQ(call(newer.known), outcome);
    }
    expect_absurd_sizes_refused(value, name, call);
}

class StructSizeTest : public ApiTest {
protected:
    Outcome outcome(pt_result result) const { return {result, result < 0 ? message() : ""}; }
};

TEST(StructSize, AMisreadStructIsNoticed) {
    const auto reads_beyond = [](const pt_camera &camera) { return camera.focus; };
    const auto reads_size = [](const pt_camera &camera) { return camera.struct_size; };
    EXPECT_EQ(misread_sizes(valid_camera(), reads_beyond), older_sizes<pt_camera>());
    EXPECT_EQ(misread_sizes(valid_camera(), reads_size), older_sizes<pt_camera>());
}

TEST_F(StructSizeTest, Scene) {
    const auto call = [&](const pt_scene &scene) { return outcome(pt_set_scene(context(), &scene)); };
    const pt_plane plane{{0, 1, 0}, 20, 0, 0};
    pt_scene scene = valid_scene();
    scene.plane_count = 1;
    scene.planes = &plane;
    const float center[3] = {1, 2, 3};
    const float radius = 4;
    pt_sphere_array array = array_of(1, {center, 12, PT_TYPE_FLOAT32}, {&radius, 4, PT_TYPE_FLOAT32});
    scene.sphere_arrays = &array;
    scene.sphere_array_count = 1;
    EXPECT_EQ(call(scene).first, PT_OK) << message();
    expect_sizes_heeded(scene, "scene", call);
    const auto call_with = [&](const pt_sphere_array &another) {
        pt_scene changed = scene;
        changed.sphere_arrays = &another;
        return call(changed);
    };
    expect_sizes_heeded(array, "sphere_arrays[0]", call_with);
}

TEST_F(StructSizeTest, Camera) {
    const auto call = [&](const pt_camera &camera) { return outcome(pt_set_camera(context(), &camera)); };
    const pt_camera camera{sizeof(pt_camera), 0, {1, 2, 3}, {4, 5, 7}, {0, 0, 1}, 0.5, 0.25, 0.75, 0, 0.5, 3};
    EXPECT_EQ(call(camera).first, PT_OK) << message();
    expect_sizes_heeded(camera, "camera", call);
}

TEST_F(StructSizeTest, Render) {
    const auto call = [&](const pt_render &render) { return outcome(pt_set_render(context(), &render)); };
    pt_render render = valid_render();
    render.seed = 5;
    render.first_sample = 7;
    render.estimator = PT_ESTIMATOR_COSINE;
    render.sampler = PT_SAMPLER_HALTON;
    render.first_row = 2;
    render.row_count = 3;
    EXPECT_EQ(call(render).first, PT_OK) << message();
    expect_sizes_heeded(render, "render", call);
}

TEST_F(StructSizeTest, AccumulateInfo) {
    set_all();
    const auto call = [&](const pt_accumulate_info &info) { return outcome(pt_accumulate(context(), &info)); };
    const pt_progress_fn go_on = [](void *, double) -> int32_t { return 0; };
    const pt_accumulate_info info = accumulate_info(1, 1e-9, go_on);
    EXPECT_EQ(call(info).first, PT_OK) << message();
    expect_sizes_heeded(info, "accumulate", call);
}

TEST_F(StructSizeTest, Image) {
    set_all();
    accumulate(1);
    const auto call = [&](const pt_image &image) { return outcome(pt_readback(context(), &image)); };
    std::vector<float> pixels(width * height * 4);
    pt_image image = image_target(pixels, PT_QUANTITY_STANDARD_ERROR, width * 16);
    set_part(image, {1, 2, 3, 1});
    image.format = PT_FORMAT_RGBA32F;
    EXPECT_EQ(call(image).first, PT_OK) << message();
    expect_sizes_heeded(image, "image", call);
}

TEST(StructSize, CreateInfo) {
    const auto call = [](const pt_create_info &info) {
        pt_context *context = nullptr;
        const pt_result result = pt_create(&info, &context);
        pt_destroy(context);
        return Outcome{result, result < 0 ? pt_last_error(nullptr) : ""};
    };
    const pt_log_fn ignore = [](void *, int32_t, const char *) {};
    auto info = sized<pt_create_info>();
    info.device = "cpu,no such device";
    info.log = ignore;
    info.submit_milliseconds = 2000;
    expect_sizes_heeded(info, "create", call);
}

template <typename T, typename Call>
void expect_written_sizes_heeded(const T &whole, const std::string &name, const Call &call) {
    for (const uint32_t size : older_sizes<T>()) {
        T expected = with_tail(whole, size, 0x55);
        T older = with_tail(T{}, 0, 0x55);
        expected.struct_size = older.struct_size = size;
        EXPECT_EQ(call(&older), (Outcome{PT_OK, ""}));
        EXPECT_EQ(std::memcmp(&older, &expected, sizeof older), 0) << "of " << size << " bytes";
    }
    Newer<T> newer = newer_than(T{});
    std::memset(newer.tail, 0x55, sizeof newer.tail);
    EXPECT_EQ(call(&newer.known), (Outcome{PT_OK, ""}));
    EXPECT_EQ(newer.known.struct_size, sizeof newer);
    newer.known.struct_size = sizeof whole;
    EXPECT_EQ(std::memcmp(&newer.known, &whole, sizeof whole), 0);
    EXPECT_EQ(std::ranges::count(newer.tail, 0x55), std::ssize(newer.tail)) << "written behind the struct";
    expect_absurd_sizes_refused(whole, name, [&](T wrong) { return call(&wrong); });
}

TEST_F(StructSizeTest, StatsAndErrorEstimate) {
    set_all();
    accumulate(16);
    expect_written_sizes_heeded(stats(), "stats", [&](pt_stats *to) { return outcome(pt_get_stats(context(), to)); });
    expect_written_sizes_heeded(error(), "error",
                                [&](pt_error_estimate *to) { return outcome(pt_get_error_estimate(context(), to)); });
}

} // namespace

} // namespace api
