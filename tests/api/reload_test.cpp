#include "lib/render/renderer.h"
#include "lib/scene/scene.h"
#include "lib/view/camera_rules.h"
#include "tests/api/api_fixture.h"
#include "tests/api/shader_folder.h"
#include "tests/support/context_calls.h"
#include "tests/support/shared_context.h"

#include "tests/support/checked_scene_of.h"
#include "tests/support/expected_error.h"

#include <pt/shaders.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace api {

namespace {

class ReloadTest : public ApiTest {
protected:
    void SetUp() override {
        own_ = create_context([&](pt_create_info &info) { info.shader_dir = folder_.c_str(); });
        ApiTest::SetUp();
        ASSERT_TRUE(own_);
        api::set_all(own_.get());
    }

    void TearDown() override {
        own_.reset();
        ApiTest::TearDown();
    }

    pt_context *own() const { return own_.get(); }
    std::string own_message() const { return pt_last_error(own()); }

    // `factor` multiplies the scene's radiance.
    static void expect_samples(pt_context *on, uint32_t count, float factor) {
        EXPECT_EQ(stats_of(on).sample_count, count);
        const std::vector<float> pixels = values_of(on, width * height);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            ASSERT_EQ(pixels[i], factor * radiance[i % 3]) << "value " << i;
    }

    // Powers of two scale sums without rounding.
    void double_the_radiance() const {
        shaders_.replace("pathtrace.comp", "* held.film_scale", "* (2.0 * held.film_scale)");
    }

    ShaderFolder shaders_;

private:
    std::string folder_ = shaders_.path();
    Context own_;
};

TEST_F(ReloadTest, AContextWithoutAFolderHasNothingToReload) {
    set_all();
    accumulate(2);
    expect_failure(pt_reload_shaders(context()), PT_ERROR_INVALID_STATE,
                   "no shader_dir: the kernels are those in the library");
    expect_image(2);
}

TEST_F(ReloadTest, OtherKernelsDiscardTheSamplesAndTheSameKeepThem) {
    accumulate_on(own(), 3);
    shaders_.replace("pathtrace.comp", "void main()", "// a remark\nvoid main()");
    ASSERT_EQ(pt_reload_shaders(own()), PT_OK) << own_message();
    expect_samples(own(), 3, 1);
    double_the_radiance();
    accumulate_on(own(), 2);
    expect_samples(own(), 5, 1);
    ASSERT_EQ(pt_reload_shaders(own()), PT_OK) << own_message();
    EXPECT_EQ(stats_of(own()).sample_count, 0U);
    accumulate_on(own(), 2);
    expect_samples(own(), 2, 2);
    api::set_all(own());
    accumulate_on(own(), 1);
    expect_samples(own(), 1, 2);
}

TEST_F(ReloadTest, AFailureKeepsKernelsAndSamples) {
    accumulate_on(own(), 3);
    double_the_radiance();
    const std::string place = shaders_.break_film();
    EXPECT_EQ(pt_reload_shaders(own()), PT_ERROR_SHADER);
    EXPECT_NE(own_message().find(place), std::string::npos) << own_message() << "\nmust contain\n" << place;
    expect_samples(own(), 3, 1);
    accumulate_on(own(), 2);
    expect_samples(own(), 5, 1);
    api::set_all(own());
    accumulate_on(own(), 1);
    expect_samples(own(), 1, 1);
}

TEST_F(ReloadTest, AllDevicesGetTheKernels) {
    const std::string folder = shaders_.path();
    const Context shared = create_context(
        [&](pt_create_info &info) {
            info.shader_dir = folder.c_str();
            info.submit_milliseconds = 1;
        },
        shared_by(2, false));
    api::set_all(shared.get());
    accumulate_on(shared.get(), 64);
    expect_samples(shared.get(), 64, 1);
    double_the_radiance();
    ASSERT_EQ(pt_reload_shaders(shared.get()), PT_OK);
    accumulate_on(shared.get(), 64);
    expect_samples(shared.get(), 64, 2);
}

// lavapipe 22.3.6 leaks memory when it refuses a kernel.
#ifdef __SANITIZE_ADDRESS__
using DriverMayLeak = __lsan::ScopedDisabler;
#else
struct DriverMayLeak {};
#endif

// Every driver refuses a renamed entry point. The validation layer is off, because it would report the error first.
TEST_F(ReloadTest, KernelsThatTheDriverRefusesAreNotTaken) {
    pt::CreateSettings settings;
    settings.device = std::getenv("PT_TEST_DEVICE") ? std::getenv("PT_TEST_DEVICE") : "";
    pt::Renderer renderer(settings);
    pt::WorkProgress nobody;
    renderer.set_scene(checked_scene_of(valid_scene()), nobody);
    renderer.set_camera(pt::validated_camera(valid_camera()));
    renderer.set_render(pt::validated_render(valid_render()));
    const auto take_a_sample = [&] {
        pt_accumulate_info one_sample{};
        one_sample.sample_count = 1;
        EXPECT_EQ(renderer.accumulate(one_sample), PT_OK);
    };
    take_a_sample();

    constexpr uint32_t main_word = 0x6e69616d; // "main", little-endian
    pt::KernelCode bad = pt::embedded_code();
    std::vector<std::vector<uint32_t>> words = *bad.words;
    const auto entry = std::ranges::find(words.front(), main_word);
    ASSERT_NE(entry, words.front().end());
    *entry = 0x6e69616e;
    bad.words = std::make_shared<const std::vector<std::vector<uint32_t>>>(words);
    bad.pathtrace = bad.words->front();
    const pt::Error error = error_of([&] {
        [[maybe_unused]] const DriverMayLeak allowance{};
        renderer.set_code(bad);
    });
    EXPECT_EQ(pt::result_name(error.code()), std::string("PT_ERROR_SHADER")) << error.what();
    EXPECT_EQ(renderer.stats().sample_count, 1U);
    take_a_sample();
    EXPECT_EQ(renderer.stats().sample_count, 2U);
}

} // namespace

} // namespace api
