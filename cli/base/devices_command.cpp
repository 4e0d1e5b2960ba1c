#include "cli/base/devices_command.h"

#include "cli/base/device_text.h"
#include "cli/base/exit_code.h"
#include "cli/base/json_text.h"
#include "cli/base/vector_width.h"

#include <pt/devices.h>
#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace cli {
namespace {

std::vector<pt_device_info> list_devices() {
    std::uint32_t count = 0;
    std::vector<pt_device_info> devices;
    pt_result result = pt_get_devices(nullptr, &count);
    if (result >= 0) {
        devices.resize(count);
        result = pt_get_devices(devices.data(), &count);
        devices.resize(count);
    }
    if (result < 0)
        throw Failure(exit_code_of(result), pt_last_error(nullptr));
    return devices;
}

constexpr std::size_t column_count = 7;
using Row = std::array<std::string, column_count>;

Row table_row(std::size_t index, const pt_device_info &device) {
    return {std::to_string(index),
            kind_name(device.kind),
            device.name,
            device.driver,
            memory_text(device.memory_bytes),
            uuid_text(device.uuid),
            device.suitable != 0 ? "yes" : std::string("no: ") + device.reason};
}

void print_table(const std::vector<pt_device_info> &devices) {
    std::vector<Row> rows{{"index", "kind", "name", "driver", "memory", "UUID", "suitable"}};
    for (const pt_device_info &device : devices)
        rows.push_back(table_row(rows.size() - 1, device));
    std::array<std::size_t, column_count> widths{};
    for (const Row &row : rows)
        for (std::size_t column = 0; column < column_count; ++column)
            widths[column] = std::max(widths[column], row[column].size());
    for (const Row &row : rows) {
        for (std::size_t column = 0; column + 1 < column_count; ++column)
            std::cout << std::left << std::setw(static_cast<int>(widths[column] + 2)) << row[column];
        std::cout << row.back() << '\n';
    }
}

void print_json(const std::vector<pt_device_info> &devices) {
    auto list = nlohmann::ordered_json::array();
    for (const pt_device_info &device : devices) {
        list.push_back({{"index", list.size()},
                        {"kind", kind_name(device.kind)},
                        {"name", device.name},
                        {"driver", device.driver},
                        {"memory_bytes", device.memory_bytes},
                        {"uuid", uuid_text(device.uuid)},
                        {"suitable", device.suitable != 0},
                        {"reason", device.reason}});
    }
    std::cout << json_text(list);
}

} // namespace

int run_devices(bool as_json) {
    choose_vector_width(); // it is part of llvmpipe's name
    const std::vector<pt_device_info> devices = list_devices();
    if (as_json)
        print_json(devices);
    else
        print_table(devices);
    const bool any_suitable =
        std::any_of(devices.begin(), devices.end(), [](const pt_device_info &device) { return device.suitable != 0; });
    return static_cast<int>(any_suitable ? ExitCode::done : ExitCode::no_device);
}

} // namespace cli
