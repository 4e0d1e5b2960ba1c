#include "cli/selftest/selftest_run.h"

#include "cli/selftest/selftest_directions.h"
#include "cli/selftest/selftest_scene.h"

#include <pt/accuracy.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numeric>
#include <span>
#include <string>

namespace cli {
namespace {

std::vector<SelftestCheck> check_functions(const Context &context) {
    std::uint32_t count = 0;
    context.require(pt_get_accuracy(context.get(), nullptr, &count));
    std::vector<pt_function_accuracy> rows(count);
    context.require(pt_get_accuracy(context.get(), rows.data(), &count));
    rows.resize(count);
    std::vector<SelftestCheck> checks;
    for (const pt_function_accuracy &row : rows) {
        std::array<char, 48> place{};
        std::snprintf(place.data(), place.size(), "worst at %.9g", row.worst_input);
        checks.push_back({"function", row.name, row.worst_error, row.bound, "ulp", place.data()});
    }
    return checks;
}

void describe(const Context &context, const SelftestScene &scene) {
    const pt_scene description = scene.scene();
    context.require(pt_set_scene(context.get(), &description));
    context.require(pt_set_camera(context.get(), &scene.camera));
    context.require(pt_set_render(context.get(), &scene.render));
}

void accumulate(const Context &context, std::uint32_t sample_count) {
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = sample_count;
    context.require(pt_accumulate(context.get(), &info));
}

// One call for each count.
std::vector<float> render(const Context &context, const SelftestScene &scene,
                          const std::vector<std::uint32_t> &sample_counts) {
    describe(context, scene);
    for (const std::uint32_t sample_count : sample_counts)
        accumulate(context, sample_count);
    return context.read_image(scene.render);
}

double differing_values(std::span<const float> a, std::span<const float> b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(), [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y) ? 0.0 : 1.0;
    });
}

// The sum of the samples is exact, so that its bits do not depend on the calls in which they were taken.
SelftestCheck check_splits(const Context &context) {
    const SelftestScene scene = lamp_in_a_ball();
    const std::uint32_t third = scene.sample_count / 3;
    const std::vector<float> one_call = render(context, scene, {scene.sample_count});
    const std::vector<float> two_calls = render(context, scene, {third, scene.sample_count - third});
    const std::vector<float> many_calls = render(context, scene, std::vector<std::uint32_t>(scene.sample_count, 1));
    const double differing = differing_values(one_call, two_calls) + differing_values(one_call, many_calls);
    return {
        "invariance", "samples split over calls", differing, 0.0, "values", "that differ in \"" + scene.name + "\""};
}

// The library leaves out samples that are not finite, negative or too bright; these scenes have none.
std::vector<SelftestCheck> check_scenes(const Context &context) {
    std::vector<SelftestCheck> checks;
    double left_out = 0.0;
    for (const SelftestScene &scene : selftest_scenes()) {
        checks.push_back(scene.judge(render(context, scene, {scene.sample_count})));
        left_out += static_cast<double>(context.read_stats().rejected_samples);
    }
    checks.push_back({"scene", "samples left out", left_out, 0.0, "samples", "of all scenes"});
    return checks;
}

} // namespace

std::vector<SelftestCheck> run_selftest_checks(const Context &context) {
    std::vector<SelftestCheck> checks = check_functions(context);
    const std::vector<SelftestCheck> scenes = check_scenes(context);
    checks.insert(checks.end(), scenes.begin(), scenes.end());
    checks.push_back(check_splits(context));
    return checks;
}

std::vector<SelftestCheck> run_direction_checks(const Context &context) {
    std::vector<SelftestCheck> checks;
    for (const DirectionScene &directions : direction_scenes()) {
        const SelftestScene &scene = directions.scene;
        const std::vector<SelftestCheck> judged = directions.judge(render(context, scene, {scene.sample_count}));
        checks.insert(checks.end(), judged.begin(), judged.end());
    }
    return checks;
}

} // namespace cli
