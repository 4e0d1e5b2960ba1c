#include "cli/base/common_options.h"

#include <pt/pt.h>

#include <algorithm>
#include <array>

namespace cli {

std::string alternatives(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        text.append(text.empty() ? "" : "|").append(name);
    return text;
}

void refuse_option(const std::string &option, const std::string &rule, const std::string &text) {
    throw CLI::ValidationError(option, rule + ", is \"" + text + "\"");
}

double read_target_error(const std::string &option, const std::string &text) {
    const std::optional<double> share = parse_share(text);
    if (!share || *share <= 0.0)
        refuse_option(option, "must be a number above 0 like 0.005 or 0.5%", text);
    return *share;
}

CLI::Option *add_size(CLI::App &command, std::optional<ImageSize> &size) {
    const auto read = [&size](const std::string &text) {
        size = parse_size(text);
        if (!size)
            refuse_option("--size", "must be two whole numbers like 1920x1080", text);
    };
    return command.add_option_function<std::string>("--size", read, "Pixels (default: the scene's, else 512x512)")
        ->type_name("WxH");
}

CLI::Option *add_max_path_length(CLI::App &command, std::optional<std::uint32_t> &max_path_length) {
    return add_whole_number<std::uint32_t>(command, "--max-path-length", max_path_length, 1,
                                           "Surface vertices after the camera, 1 = emission only (default: the "
                                           "scene's, else " +
                                               std::to_string(PT_DEFAULT_MAX_PATH_LENGTH) + ")")
        ->type_name("L");
}

CLI::Option *add_seed(CLI::App &command, std::optional<std::uint64_t> &seed) {
    return add_whole_number<std::uint64_t>(command, "--seed", seed, 0, "Seed (default: the scene's, else 0)");
}

CLI::Option *add_device(CLI::App &command, std::string &device) {
    return command
        .add_option("--device", device,
                    "Index or UUID from `pt devices`, or several (0,1), or part of a name (default: the best one)")
        ->type_name("INDEX|UUID|NAME|gpu|cpu|all");
}

void add_reporting(CLI::App &command, std::string &progress, bool &quiet) {
    const std::string group = "Messages";
    static constexpr std::array<std::string_view, 3> styles{"auto", "json", "none"};
    command
        .add_option_function<std::string>(
            "--progress",
            [&progress](const std::string &text) {
                if (std::find(styles.begin(), styles.end(), text) == styles.end())
                    throw CLI::ValidationError("--progress", unknown_name("style", text, styles));
                progress = text;
            },
            "On stderr: auto (a line if it is a terminal; the default), json (an object a line), none")
        ->type_name(alternatives(styles))
        ->group(group);
    command.add_flag("-q,--quiet", quiet, "Print errors only")->group(group);
}

} // namespace cli
