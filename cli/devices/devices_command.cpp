#include "cli/base/context.h"
#include "cli/base/devices.h"
#include "cli/base/json.h"
#include "cli/base/vector_width.h"
#include "cli/commands.h"
#include "cli/scene/scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace cli {
namespace {

using Row = std::array<std::string, 7>;

Row table_row(std::size_t index, const pt_device_info &device) {
    return {std::to_string(index),
            kind_name(device.kind),
            platform::printable(device.name),
            platform::printable(device.driver),
            memory_text(device.memory_bytes),
            uuid_text(device.uuid),
            device.suitable != 0 ? "yes" : std::string("no: ") + device.reason};
}

void print_table(const std::vector<pt_device_info> &devices) {
    std::vector<Row> rows{{"index", "kind", "name", "driver", "memory", "UUID", "suitable"}};
    for (const pt_device_info &device : devices)
        rows.push_back(table_row(rows.size() - 1, device));
    const auto width_of = [&](std::size_t column) {
        return std::ranges::max(rows, {}, [column](const Row &row) { return row[column].size(); })[column].size();
    };
    for (const Row &row : rows) {
        for (std::size_t column = 0; column + 1 < row.size(); ++column)
            std::cout << std::left << std::setw(static_cast<int>(width_of(column) + 2)) << row[column];
        std::cout << row.back() << '\n';
    }
}

void print_json(const std::vector<pt_device_info> &devices) {
    auto list = nlohmann::ordered_json::array();
    for (const pt_device_info &device : devices) {
        nlohmann::ordered_json each{{"index", list.size()}};
        each.update(device_json(device));
        each.update({{"suitable", device.suitable != 0}, {"reason", device.reason}});
        list.push_back(std::move(each));
    }
    std::cout << json_text(list);
}

struct DevicesOptions {
    bool as_json = false;
    std::string kernels;
    std::string device;
};

bool have_tree(const std::string &kernels) {
    if (kernels == "list" || kernels == "tree")
        return kernels == "tree";
    SceneFile scene = read_scene_file(kernels);
    load_columns(scene);
    return gets_tree(scene);
}

int print_vector_width(const DevicesOptions &options) {
    const Context context(create_info(options.device, ""), {have_tree(options.kernels), UINT64_MAX});
    for (const char *name : vector_width_variables)
        if (const char *value = std::getenv(name))
            std::cout << name << '=' << value << '\n';
    return static_cast<int>(ExitCode::done);
}

int run_devices(const DevicesOptions &options) {
    if (!options.kernels.empty())
        return print_vector_width(options);
    const VectorWidth width({}); // the name of llvmpipe contains the width
    const std::vector<pt_device_info> devices =
        elements_of<pt_device_info>([](auto *to, auto *count) { require(pt_get_devices(to, count)); });
    if (options.as_json)
        print_json(devices);
    else
        print_table(devices);
    const bool any_suitable = std::ranges::any_of(devices, [](const auto &device) { return device.suitable != 0; });
    return static_cast<int>(any_suitable ? ExitCode::done : ExitCode::no_device);
}

} // namespace

void add_devices_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "devices", "List the Vulkan devices", "", &run_devices);
    command.add_flag("--json", options.as_json, "Print JSON");
    add_text(
        command, "--vector-width", options.kernels, "SCENE|list|tree",
        "Print the environment variables for llvmpipe's best vector width, for a scene's kernel, or kernels without "
        "or with a tree. The width is measured the first time");
    add_device(command, options.device);
}

} // namespace cli
