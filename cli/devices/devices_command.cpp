#include "cli/base/context.h"
#include "cli/base/devices.h"
#include "cli/base/environment.h"
#include "cli/base/json.h"
#include "cli/commands.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace cli {
namespace {

using Row = std::array<std::string, 7>;

std::vector<pt_device_info> list_devices() {
    std::uint32_t count = 0;
    std::vector<pt_device_info> devices;
    pt_result result = pt_get_devices(nullptr, &count);
    if (result >= 0) {
        devices.resize(count);
        result = pt_get_devices(devices.data(), &count);
        devices.resize(count);
    }
    require(result);
    return devices;
}

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

int run_devices(bool as_json) {
    choose_vector_width(); // the name of llvmpipe contains the width
    const std::vector<pt_device_info> devices = list_devices();
    if (as_json)
        print_json(devices);
    else
        print_table(devices);
    const bool any_suitable = std::ranges::any_of(devices, [](const auto &device) { return device.suitable != 0; });
    return static_cast<int>(any_suitable ? ExitCode::done : ExitCode::no_device);
}

} // namespace

void add_devices_command(CLI::App &program, Run &chosen) {
    const auto as_json = std::make_shared<bool>(false);
    add_command(program, chosen, "devices", "List the Vulkan devices", "", [as_json] {
        return run_devices(*as_json);
    }).add_flag("--json", *as_json, "Print JSON");
}

} // namespace cli
