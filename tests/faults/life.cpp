#include "tests/faults/life.h"

#include "tests/faults/allocations.h"
#include "tests/faults/vulkan_calls.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <pt/accuracy.h>
#include <pt/async.h>
#include <pt/film.h>
#include <pt/map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace faults {

namespace {

constexpr uint32_t width = 24;
constexpr uint32_t height = 20;
constexpr uint32_t film_end = 18;
constexpr uint32_t other_film_end = 12;
const std::string uneven_step = "pt_accumulate, to a target";

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

// No target needs 2^20 samples, so the film does not depend on earlier calls or failures.
pt_result accumulate_to_target(pt_context *context) {
    const pt_accumulate_info info = accumulate_info(1U << 20, 0.1, &go_on);
    return pt_accumulate(context, &info);
}

pt_result create(const Setting &setting, pt_context **context) {
    auto info = sized<pt_create_info>();
    info.submit_milliseconds = setting.submit_milliseconds;
    info.load_kernels = [](void *, const char *, void *, uint64_t) -> uint64_t { return 0; };
    info.store_kernels = [](void *, const char *, const void *, uint64_t) {};
    return create_shared(setting.device_count, info, context, false, 0);
}

template <typename Function>
pt_result run(const Function &function) {
    const InLibrary in_library;
    return function();
}

// A long error message enlarges the thread's message buffer once, so that later messages do not allocate.
void keep_a_long_message() {
    const std::string no_device(1000, '?');
    auto create = sized<pt_create_info>();
    create.device = no_device.c_str();
    pt_context *context = nullptr;
    EXPECT_EQ(pt_create(&create, &context), PT_ERROR_NO_DEVICE);
}

} // namespace

std::size_t call_number(const std::string &step, std::size_t number) {
    return step == uneven_step ? number + number * number * number / 16 : number;
}

Life::Life(const Setting &setting, const Expected &expected, const Injection &injection, std::size_t number,
           Steps &left, Steps &met) :
    setting_(setting),
    expected_(expected),
    injection_(injection),
    number_(number),
    left_(left),
    met_(met) {
    pose_as_gpu(setting.gpu);
}

Life::~Life() {
    pose_as_gpu(false);
}

void Life::live() {
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
    call("pt_create", [&] { return create(setting_, &context_); });
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

    accumulate_to("pt_accumulate", 2);
    read("pt_readback, radiance", PT_QUANTITY_RADIANCE);
    read("pt_readback, standard error", PT_QUANTITY_STANDARD_ERROR);
    map_image();
    read("pt_readback, objects", PT_QUANTITY_OBJECT);
    read("pt_readback, coverage", PT_QUANTITY_COVERAGE);
    accumulate_to("", film_end);
    look("pt_get_error_estimate", [&] {
        auto error = sized<pt_error_estimate>();
        return pt_get_error_estimate(context_, &error);
    });
    look("pt_get_accuracy", [&] {
        std::array<pt_function_accuracy, 16> rows{};
        uint32_t row_count = rows.size();
        return pt_get_accuracy(context_, rows.data(), &row_count);
    });
    save_film();

    call("pt_set_scene, again", set_scene);
    accumulate_to("", 1);
    call("pt_add_film",
         [&] { return pt_add_film(context_, expected_.other_film.data(), expected_.other_film.size()); });
    EXPECT_EQ(samples(), other_film_end);
    expect_image("pt_add_film");
    call("pt_set_camera, again", set_camera);
    accumulate_to("pt_start and pt_poll", 3, &start_and_poll);
    the_render.row_count = height / 2;
    call("pt_set_render, smaller", set_render);
    rows_ = height / 2;
    accumulate_to("pt_accumulate, again", 1);
    accumulate_unevenly();
    destroy();
}

void Life::look(const std::string &step, const Function &function) {
    if (left_.contains(step))
        call(step, function);
}

void Life::call(const std::string &step, const Function &function, const std::function<void()> &after_failure) {
    if (left_.empty())
        throw End();
    if (left_.erase(step) > 0) {
        const uint32_t before = samples();
        injection_.arm(step, number_);
        const pt_result result = run(function);
        const bool is_met = injection_.disarm(step, result, pt_last_error(context_));
        if (is_met)
            met_.insert(step);
        lost_ = result == PT_ERROR_DEVICE_LOST && context_;
        if (lost_)
            throw End();
        if (result >= 0)
            return;
        EXPECT_TRUE(is_met) << step << ": " << pt_last_error(context_);
        if (after_failure) {
            after_failure();
        } else {
            EXPECT_EQ(samples(), before) << step;
            expect_image(step);
        }
    }
    EXPECT_GE(run(function), PT_OK) << step << ": " << pt_last_error(context_);
}

// A call that fails keeps its complete samples. If memory is short, several devices may keep no samples.
void Life::accumulate_to(const std::string &step, uint32_t goal, Accumulate accumulate) {
    const uint32_t before = samples();
    pt_accumulate_info info = accumulate_info(goal - before, 0.0, &go_on);
    call(
        step, [&] { return info.sample_count == 0 ? PT_OK : accumulate(context_, &info); },
        [&] {
            const uint32_t after = samples();
            EXPECT_LE(after, goal) << step;
            const bool all_gone = setting_.device_count > 1 && after == 0;
            EXPECT_TRUE(after >= before || all_gone) << step;
            expect_image(step);
            info.sample_count = goal - after;
        });
    EXPECT_EQ(samples(), goal) << step;
    expect_image(step);
}

void Life::accumulate_unevenly() {
    if (!left_.contains(uneven_step))
        return;
    call(
        uneven_step, [&] { return std::min<pt_result>(accumulate_to_target(context_), PT_OK); }, [] {});
    EXPECT_TRUE(film_of(context_) == expected_.uneven_film) << "another film";
}

void Life::read(const std::string &step, uint32_t quantity) {
    if (!left_.contains(step))
        return;
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

void Life::map_image() {
    auto source = sized<pt_image>();
    void *data = nullptr;
    uint64_t size_bytes = 0;
    look("pt_map_image", [&] { return pt_map_image(context_, &source, &data, &size_bytes); });
    if (!data)
        return;
    const auto *const pixels = static_cast<const float *>(data);
    EXPECT_EQ(Image(pixels, pixels + size_bytes / sizeof(float)), expected_.images.at(samples()));
}

void Life::save_film() {
    const std::string step = "pt_save_film";
    Film film(expected_.film.size());
    uint64_t size = film.size();
    if (!left_.contains(step))
        return;
    call(
        step, [&] { return pt_save_film(context_, film.data(), &size); }, [&] { EXPECT_EQ(size, film.size()); });
    EXPECT_TRUE(film == expected_.film) << "other bytes";
}

void Life::destroy() {
    const std::string step = "pt_destroy";
    const bool injects = left_.erase(step) > 0;
    if (injects)
        injection_.arm(step, number_);
    run([&] {
        pt_destroy(context_);
        return PT_OK;
    });
    context_ = nullptr;
    if (injects && injection_.disarm(step, PT_OK, ""))
        met_.insert(step);
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

uint32_t Life::samples() {
    return context_ ? stats_of(context_).sample_count : 0;
}

void Life::expect_image(const std::string &step) {
    const uint32_t sample_count = samples();
    if (sample_count == 0)
        return;
    const Image image = values_of(context_, std::size_t{width} * rows_);
    EXPECT_TRUE(std::ranges::equal(image, std::span(expected_.images.at(sample_count)).first(image.size())))
        << step << ": another image";
}

Expected undisturbed() {
    const Scene scene;
    pt_render the_render = render();
    pt_context *created = nullptr;
    EXPECT_EQ(create({.gpu = false, .device_count = 1, .submit_milliseconds = 50}, &created), PT_OK)
        << pt_last_error(nullptr);
    const Context owner(created);
    set_picture(created, scene.scene(), camera(), the_render);
    Expected expected;
    for (uint32_t count = 1; count <= film_end; ++count) {
        accumulate_on(created, 1);
        expected.images[count] = values_of(created, std::size_t{width} * height);
    }
    expected.film = film_of(created);
    the_render.first_sample = 1;
    EXPECT_EQ(pt_set_render(created, &the_render), PT_OK) << pt_last_error(created);
    accumulate_on(created, other_film_end - 1);
    expected.other_film = film_of(created);
    the_render.first_sample = 0;
    the_render.row_count = height / 2;
    EXPECT_EQ(pt_set_render(created, &the_render), PT_OK) << pt_last_error(created);
    EXPECT_EQ(accumulate_to_target(created), PT_TARGET_REACHED) << pt_last_error(created);
    EXPECT_LT(stats_of(created).sample_count, stats_of(created).max_sample_count) << "all tiles have the same";
    expected.uneven_film = film_of(created);
    return expected;
}

void sweep(const Setting &setting, const Expected &expected, const Injection &injection) {
    keep_a_long_message();
    Steps wanted = {"pt_get_devices, count",
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
                    "pt_get_error_estimate",
                    "pt_get_accuracy",
                    "pt_save_film",
                    "pt_set_scene, again",
                    "pt_add_film",
                    "pt_set_camera, again",
                    "pt_start and pt_poll",
                    "pt_set_render, smaller",
                    "pt_accumulate, again",
                    uneven_step,
                    "pt_destroy"};
    for (std::size_t number = 1; !wanted.empty() && !testing::Test::HasFatalFailure(); ++number) {
        SCOPED_TRACE("place " + std::to_string(number));
        Steps left = std::exchange(wanted, {});
        while (!left.empty()) {
            const long allocations_before = live_allocations();
            Life(setting, expected, injection, number, left, wanted).live();
            heal_devices();
            for (const auto &[maker, count] : live_objects())
                ADD_FAILURE() << count << " objects of " << maker << " are left";
            EXPECT_EQ(live_allocations(), allocations_before);
            forget_objects();
        }
    }
}

} // namespace faults
