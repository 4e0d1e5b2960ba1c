#include "cli/base/devices.h"
#include "cli/base/exit_code.h"
#include "cli/base/file.h"
#include "cli/base/json.h"
#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "cli/scene/scene.h"
#include "cli/selftest/selftest.h"

#include <nlohmann/json.hpp>
#include <pt/accuracy.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>

namespace cli {
namespace {

struct SelftestOptions {
    std::string device;
    std::string json;
    std::string shader_dir;
    bool directions = false;
};

std::size_t failed_count(const SelftestReport &report) {
    return static_cast<std::size_t>(
        std::ranges::count_if(report.checks, [](const SelftestCheck &check) { return !check.passed(); }));
}

std::string header(const pt_device_info &device) {
    return "pt      " + version_text() + "\ndevice  " + device.name + "\ndriver  " + device.driver + "\nkind    " +
           kind_name(device.kind) + "\nmemory  " + memory_text(device.memory_bytes) + "\nUUID    " +
           uuid_text(device.uuid) + "\n";
}

std::string row(const char *verdict, const std::string &name, const std::string &error, const std::string &bound,
                const std::string &unit, const std::string &detail) {
    return formatted("%-4s  %-32s  %9s  %9s  %-8s  ", verdict, name.c_str(), error.c_str(), bound.c_str(),
                     unit.c_str()) +
           detail + "\n";
}

std::string verdict(const SelftestReport &report) {
    const std::string count = std::to_string(report.checks.size()) + " checks";
    return report.passed() ? "passed: all " + count + "\n"
                           : "FAILED: " + std::to_string(failed_count(report)) + " of " + count + "\n";
}

std::vector<SelftestCheck> check_functions(const Context &context) {
    const auto rows = elements_of<pt_function_accuracy>(
        [&](auto *to, auto *count) { context.require(pt_get_accuracy(context.get(), to, count)); });
    std::vector<SelftestCheck> checks;
    checks.reserve(rows.size());
    for (const pt_function_accuracy &row : rows) {
        checks.push_back(
            {"function", row.name, row.worst_error, row.bound, "ulp", formatted("worst at %.9g", row.worst_input)});
    }
    return checks;
}

double differing_values(std::span<const float> a, std::span<const float> b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(), [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y) ? 0.0 : 1.0;
    });
}

// Sums are exact, so the same samples in several calls must have the same bits.
SelftestCheck check_splits(const Context &context) {
    const SelftestScene ball = lamp_in_a_ball();
    const std::uint32_t count = ball.scene.sample_count.value();
    const std::vector<float> one_call = render_radiance(context, ball.scene, {count});
    const std::vector<float> two_calls = render_radiance(context, ball.scene, {count / 3, count - count / 3});
    const std::vector<float> many_calls = render_radiance(context, ball.scene, std::vector<std::uint32_t>(count, 1));
    const double differing = differing_values(one_call, two_calls) + differing_values(one_call, many_calls);
    return {"invariance", "samples split over calls", differing, 0.0, "values", "that differ in \"" + ball.name + "\""};
}

std::vector<SelftestCheck> check_scenes(const Context &context, const std::vector<SelftestScene> &scenes,
                                        const std::string &group) {
    std::vector<SelftestCheck> checks;
    double left_out = 0.0;
    for (const SelftestScene &scene : scenes) {
        checks.push_back(scene.judge(render_radiance(context, scene.scene, {scene.scene.sample_count.value()})));
        checks.back().group = group;
        left_out += static_cast<double>(context.stats().rejected_samples);
    }
    checks.push_back({group, "samples left out", left_out, 0.0, "samples", "of all scenes"});
    return checks;
}

std::vector<SelftestScene> with_weights(std::vector<SelftestScene> scenes) {
    std::ranges::move(weight_scenes(), std::back_inserter(scenes));
    return scenes;
}

std::vector<SelftestCheck> run_selftest_checks(const Context &context) {
    std::vector<SelftestCheck> checks = check_functions(context);
    const std::vector<SelftestCheck> scenes = check_scenes(context, with_weights(selftest_scenes()), "scene");
    checks.insert(checks.end(), scenes.begin(), scenes.end());
    checks.push_back(check_splits(context));
    return checks;
}

int run_selftest(const SelftestOptions &options) {
    check_report_file(options.json);
    const Context context(create_info(options.device, options.shader_dir));
    SelftestReport report{};
    context.require(pt_get_context_device(context.get(), &report.device));
    report.checks = options.directions ? check_scenes(context, with_weights(direction_scenes()), "directions")
                                       : run_selftest_checks(context);

    print_for_people(selftest_text(report), options.json == standard_stream);
    write_report_file(options.json, json_text(selftest_json(report)));
    return static_cast<int>(report.passed() ? ExitCode::done : ExitCode::internal);
}

constexpr const char *selftest_help =
    "Compares the kernel's functions with double precision, small scenes with closed forms, and images\n"
    "whose samples were split over calls bit by bit. Every correct device keeps the bounds: those of\n"
    "functions follow from the precision that Vulkan promises, those of scenes from float32 and noise. A\n"
    "correct device fails about once in a million runs. Paste the output into a report of a fault.\n";

} // namespace

void add_selftest_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "selftest", "Check a device against exact answers, in some seconds", selftest_help,
                    &run_selftest);
    add_device(command, options.device);
    add_text(command, "--json", options.json, "JSON",
             "Write the report as JSON; - is standard output, the text then goes to stderr");
    command.add_flag("--directions", options.directions,
                     "Check only the directions that kernels sample, and the weights of lamps");
    add_shader_dir(command, options.shader_dir);
}

std::vector<float> render_radiance(const Context &context, const SceneFile &scene,
                                   const std::vector<std::uint32_t> &sample_counts) {
    describe_scene(context, scene, [](double) { return true; });
    context.require(pt_set_render(context.get(), &scene.render));
    for (const std::uint32_t sample_count : sample_counts) {
        auto info = sized<pt_accumulate_info>();
        info.sample_count = sample_count;
        context.require(pt_accumulate(context.get(), &info));
    }
    const pt_render &image = scene.render;
    std::vector<float> radiance(std::size_t{3} * image.width * image.height);
    context.read(0, image.width, image.height, PT_QUANTITY_RADIANCE, radiance.data());
    return radiance;
}

bool SelftestReport::passed() const {
    return failed_count(*this) == 0;
}

std::string selftest_text(const SelftestReport &report) {
    std::string text = header(report.device) + "\n" + row("", "check", "error", "bound", "unit", "measured");
    for (const SelftestCheck &check : report.checks) {
        text += row(check.passed() ? "pass" : "FAIL", check.name, formatted("%.3g", check.error),
                    formatted("%.3g", check.bound), check.unit, check.detail);
    }
    return text + "\n" + verdict(report);
}

nlohmann::ordered_json selftest_json(const SelftestReport &report) {
    auto checks = nlohmann::ordered_json::array();
    for (const SelftestCheck &check : report.checks) {
        checks.push_back({{"group", check.group},
                          {"name", check.name},
                          {"passed", check.passed()},
                          {"error", number_or_null(check.error)},
                          {"bound", check.bound},
                          {"unit", check.unit},
                          {"measured", check.detail}});
    }
    return {{"version", version_text()},
            {"device", device_json(report.device)},
            {"passed", report.passed()},
            {"checks", std::move(checks)}};
}

} // namespace cli
