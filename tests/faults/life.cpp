#include "tests/faults/life.h"

#include "tests/faults/allocations.h"
#include "tests/faults/vulkan_calls.h"
#include "tests/support/context_calls.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <pt/async.h>
#include <pt/film.h>
#include <pt/map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace faults {

namespace {

constexpr uint32_t width = 24;
constexpr uint32_t height = 20;
constexpr uint32_t other_film_end = 12;

// Paths are so long that a millisecond is too short for all pixels.
struct Scene {
    std::array<pt_material, 3> materials = {{{{0, 0, 0}, {0, 0, 0}, {8, 4, 2}, 0, 0},
                                             {{0.2F, 0.5F, 0.8F}, {0.8F, 0.8F, 0.8F}, {0, 0, 0}, 40, 0},
                                             {{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0}}};
    std::array<pt_sphere, 2> spheres = {{{{3, 2, -8}, 1, {0, 0, 0}, 0, 0}, {{-1, 0, -6}, 1, {1, 0, 0}, 1, 0}}};
    std::array<pt_plane, 1> planes = {{{{0, 1, 0}, 1, 2, 0}}};

    pt_scene scene() const { return scene_of(materials, spheres, planes); }
};

pt_camera camera() {
    return camera_at({0, 0, 0}, {0, 0, -1});
}

pt_render render() {
    pt_render render = render_of(width, height, 24);
    render.seed = 7;
    render.flags = PT_RENDER_COVERAGE;
    return render;
}

int32_t go_on(void *, double) {
    return 0;
}

// A failure also ends the work. Otherwise later calls would be refused.
pt_result start_and_poll(pt_context *context, const pt_accumulate_info *info) {
    pt_accumulate_info to_start = *info;
    to_start.progress = nullptr;
    pt_result result = pt_start(context, &to_start);
    for (uint64_t nanoseconds = 0; result == PT_PENDING; nanoseconds = UINT64_MAX)
        result = pt_poll(context, nanoseconds, nullptr);
    return result;
}

uint64_t no_kernels(void *, const char *, void *, uint64_t) {
    return 0;
}

void forget_kernels(void *, const char *, const void *, uint64_t) {}

} // namespace

Life::Life(const Setting &setting, const ExpectedImages &expected, const Steps &injected) :
    setting_(setting),
    expected_(expected),
    left_(injected) {
    pose_as_gpu(setting.gpu);
}

Life::~Life() {
    pose_as_gpu(false);
}

Steps Life::all_steps() {
    return {"pt_get_devices, count",
            "pt_get_devices",
            "pt_create",
            "pt_get_context_device",
            "pt_set_scene",
            "pt_set_camera",
            "pt_set_render",
            "pt_prepare",
            "pt_accumulate",
            "pt_readback, radiance",
            "pt_readback, standard error",
            "pt_map_image",
            "pt_readback, objects",
            "pt_readback, coverage",
            "pt_accumulate, to a target",
            "pt_get_error_estimate",
            "pt_get_accuracy",
            "pt_save_film",
            "pt_set_scene, again",
            "pt_add_film",
            "pt_set_camera, again",
            "pt_start and pt_poll",
            "pt_set_render, smaller",
            "pt_accumulate, again",
            "pt_destroy"};
}

void Life::live(Injection &injection) {
    injection_ = &injection;
    try {
        tell();
    } catch (const End &) {
        if (lost_)
            expect_lost();
        destroy();
    }
}

void Life::tell() {
    std::vector<pt_device_info> devices(16);
    auto count = static_cast<uint32_t>(devices.size());
    look("pt_get_devices, count", [&] { return pt_get_devices(nullptr, &count); });
    look("pt_get_devices", [&] { return pt_get_devices(devices.data(), &count); });

    auto create = sized<pt_create_info>();
    create.submit_milliseconds = setting_.submit_milliseconds;
    create.load_kernels = &no_kernels;
    create.store_kernels = &forget_kernels;
    call("pt_create", [&] {
        return setting_.device_count == 1 ? pt_create(&create, &context_)
                                          : create_shared(setting_.device_count, create, &context_);
    });
    look("pt_get_context_device", [&] { return pt_get_context_device(context_, devices.data()); });

    const Scene scene;
    const pt_scene the_scene = scene.scene();
    const pt_camera the_camera = camera();
    pt_render the_render = render();
    const auto set_scene = [&] { return pt_set_scene(context_, &the_scene); };
    const auto set_camera = [&] { return pt_set_camera(context_, &the_camera); };
    const auto set_render = [&] { return pt_set_render(context_, &the_render); };
    call("pt_set_scene", set_scene);
    call("pt_set_camera", set_camera);
    call("pt_set_render", set_render);
    rows_ = height;

    look("pt_prepare", [&] { return pt_prepare(context_); });

    accumulate_to("pt_accumulate", 2, 0.0);
    readback("pt_readback, radiance", PT_QUANTITY_RADIANCE);
    readback("pt_readback, standard error", PT_QUANTITY_STANDARD_ERROR);
    map_image("pt_map_image");
    read_of_scene("pt_readback, objects", PT_QUANTITY_OBJECT);
    read_of_scene("pt_readback, coverage", PT_QUANTITY_COVERAGE);
    accumulate_to("", 16, 0.0);
    accumulate_to("pt_accumulate, to a target", 18, 1e-6);
    look("pt_get_error_estimate", [&] {
        auto error = sized<pt_error_estimate>();
        return pt_get_error_estimate(context_, &error);
    });
    look("pt_get_accuracy", [&] {
        std::array<pt_function_accuracy, 16> rows{};
        uint32_t row_count = rows.size();
        return pt_get_accuracy(context_, rows.data(), &row_count);
    });

    save_film("pt_save_film");

    call("pt_set_scene, again", set_scene);
    accumulate_to("", 1, 0.0);
    add_film("pt_add_film");
    call("pt_set_camera, again", set_camera);
    accumulate_to("pt_start and pt_poll", 3, 0.0, &start_and_poll);
    the_render.row_count = height / 2;
    call("pt_set_render, smaller", set_render);
    rows_ = height / 2;
    accumulate_to("pt_accumulate, again", 1, 0.0);
    destroy();
}

pt_result Life::run(const Function &function) {
    const InLibrary in_library;
    return function();
}

void Life::look(const std::string &step, const Function &function) {
    if (left_.contains(step))
        call(step, function);
}

void Life::call(const std::string &step, const Function &function) {
    const State before = state();
    call(step, function, [&] {
        const State after = state();
        EXPECT_EQ(after.sample_count, before.sample_count) << step;
        EXPECT_EQ(after.rejected_samples, before.rejected_samples) << step;
        expect_image(step, after.sample_count);
    });
}

void Life::call(const std::string &step, const Function &function, const std::function<void()> &after_failure) {
    if (left_.empty())
        throw End();
    if (left_.erase(step) > 0) {
        attempted_.insert(step);
        injection_->arm();
        const pt_result result = run(function);
        if (injection_->disarm(step, result, pt_last_error(context_)))
            met_.insert(step);
        lost_ = result == PT_ERROR_DEVICE_LOST && context_;
        if (lost_)
            throw End();
        if (result >= 0)
            return;
        EXPECT_TRUE(met_.contains(step)) << step << ": " << pt_last_error(context_);
        after_failure();
    }
    EXPECT_GE(run(function), PT_OK) << step << ": " << pt_last_error(context_);
}

// A call that fails keeps its complete samples. If memory is short, several devices may keep no samples.
void Life::accumulate_to(const std::string &step, uint32_t sample_count, double target_error, Accumulate accumulate) {
    auto info = sized<pt_accumulate_info>();
    info.sample_count = sample_count - state().sample_count;
    info.progress = &go_on;
    info.stopping.target_error = target_error;
    info.sampling = PT_SAMPLING_UNIFORM;
    const uint32_t before = state().sample_count;
    call(
        step, [&] { return info.sample_count == 0 ? PT_OK : accumulate(context_, &info); },
        [&] {
            const State after = state();
            EXPECT_LE(after.sample_count, sample_count) << step;
            const bool all_gone = setting_.device_count > 1 && after.sample_count == 0;
            EXPECT_TRUE(after.sample_count >= before || all_gone) << step;
            expect_image(step, after.sample_count);
            info.sample_count = sample_count - after.sample_count;
        });
    EXPECT_EQ(state().sample_count, sample_count) << step;
    expect_image(step, sample_count);
}

void Life::readback(const std::string &step, uint32_t quantity) {
    Image image(std::size_t{width} * rows_ * 3);
    const pt_image target = image_target(image, quantity);
    call(step, [&] { return pt_readback(context_, &target); });
    const auto &images = quantity == PT_QUANTITY_RADIANCE ? expected_.radiance : expected_.standard_error;
    EXPECT_EQ(image, images.at(state().sample_count)) << step;
}

void Life::map_image(const std::string &step) {
    auto source = sized<pt_image>();
    void *data = nullptr;
    uint64_t size_bytes = 0;
    look(step, [&] { return pt_map_image(context_, &source, &data, &size_bytes); });
    if (!data)
        return;
    const auto *const pixels = static_cast<const float *>(data);
    EXPECT_EQ(Image(pixels, pixels + size_bytes / sizeof(float)), expected_.radiance.at(state().sample_count)) << step;
}

void Life::read_of_scene(const std::string &step, uint32_t quantity) {
    constexpr uint32_t unwritten = PT_NO_OBJECT - 1;
    const bool is_whole = quantity == PT_QUANTITY_OBJECT;
    std::vector<uint32_t> words(std::size_t{width} * rows_ * (is_whole ? 1 : 3), unwritten);
    auto target = sized<pt_image>();
    target.quantity = quantity;
    target.format = is_whole ? PT_FORMAT_R32UI : PT_FORMAT_RGB32F;
    target.data = words.data();
    target.size_bytes = words.size() * sizeof(uint32_t);
    const auto read = [&] { return pt_readback(context_, &target); };
    call(step, read);
    EXPECT_EQ(std::ranges::count(words, unwritten), 0) << step;
    const std::vector<uint32_t> first = words;
    EXPECT_EQ(run(read), PT_OK) << step;
    EXPECT_EQ(words, first) << step;
}

void Life::save_film(const std::string &step) {
    if (!left_.contains(step))
        return;
    Film film(expected_.film.size());
    uint64_t size = film.size();
    call(
        step, [&] { return pt_save_film(context_, film.data(), &size); },
        [&] { EXPECT_EQ(size, film.size()) << step; });
    EXPECT_TRUE(film == expected_.film) << step << ": other bytes";
}

void Life::add_film(const std::string &step) {
    call(step, [&] { return pt_add_film(context_, expected_.other_film.data(), expected_.other_film.size()); });
    EXPECT_EQ(state().sample_count, other_film_end) << step;
    expect_image(step, other_film_end);
}

void Life::destroy() {
    const bool injects = left_.erase("pt_destroy") > 0;
    if (injects)
        injection_->arm();
    run([&]() -> pt_result {
        pt_destroy(context_);
        return PT_OK;
    });
    context_ = nullptr;
    if (!injects)
        return;
    attempted_.insert("pt_destroy");
    if (injection_->disarm("pt_destroy", PT_OK, ""))
        met_.insert("pt_destroy");
}

void Life::expect_lost() {
    const std::string message = pt_last_error(context_);
    const pt_camera the_camera = camera();
    const pt_accumulate_info info = accumulate_info(1);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(pt_set_camera(context_, &the_camera), PT_ERROR_DEVICE_LOST);
        EXPECT_EQ(pt_last_error(context_), message);
        EXPECT_EQ(pt_accumulate(context_, &info), PT_ERROR_DEVICE_LOST);
        EXPECT_EQ(pt_last_error(context_), message);
    }
}

Life::State Life::state() {
    if (!context_)
        return {};
    auto stats = sized<pt_stats>();
    EXPECT_EQ(pt_get_stats(context_, &stats), PT_OK) << pt_last_error(context_);
    return {stats.sample_count, stats.rejected_samples};
}

void Life::expect_image(const std::string &step, uint32_t sample_count) {
    if (!context_ || sample_count == 0)
        return;
    Image image(std::size_t{width} * rows_ * 3);
    const pt_image target = image_target(image);
    ASSERT_EQ(pt_readback(context_, &target), PT_OK) << step << ": " << pt_last_error(context_);
    const Image &whole = expected_.radiance.at(sample_count);
    EXPECT_TRUE(std::equal(image.begin(), image.end(), whole.begin())) << step << ": another image";
}

ExpectedImages undisturbed_images() {
    const Scene scene;
    const pt_scene the_scene = scene.scene();
    const pt_camera the_camera = camera();
    pt_render the_render = render();
    pt_context *context = nullptr;
    EXPECT_EQ(pt_create(nullptr, &context), PT_OK) << pt_last_error(nullptr);
    set_picture(context, the_scene, the_camera, the_render);
    ExpectedImages images;
    for (uint32_t count = 1; count <= 18; ++count) {
        const pt_accumulate_info info = accumulate_info(1);
        EXPECT_EQ(pt_accumulate(context, &info), PT_OK) << pt_last_error(context);
        for (const uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR}) {
            Image image(std::size_t{width} * height * 3);
            const pt_image target = image_target(image, quantity);
            EXPECT_EQ(pt_readback(context, &target), PT_OK) << pt_last_error(context);
            (quantity == PT_QUANTITY_RADIANCE ? images.radiance : images.standard_error)[count] = image;
        }
    }
    images.film = film_of(context);
    the_render.first_sample = 1;
    const pt_accumulate_info others = accumulate_info(other_film_end - 1);
    EXPECT_EQ(pt_set_render(context, &the_render), PT_OK) << pt_last_error(context);
    EXPECT_EQ(pt_accumulate(context, &others), PT_OK) << pt_last_error(context);
    images.other_film = film_of(context);
    pt_destroy(context);
    return images;
}

} // namespace faults
