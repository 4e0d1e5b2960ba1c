#include "cli/base/devices.h"

#include "cli/base/text.h"
#include "lib/scene_file/names.h"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace cli {

std::string kind_name(std::uint32_t kind) {
    static constexpr pt::ValueNames names({{"other", PT_DEVICE_OTHER},
                                           {"integrated GPU", PT_DEVICE_INTEGRATED_GPU},
                                           {"discrete GPU", PT_DEVICE_DISCRETE_GPU},
                                           {"virtual GPU", PT_DEVICE_VIRTUAL_GPU},
                                           {"CPU", PT_DEVICE_CPU}});
    return std::string(names.name(kind));
}

nlohmann::ordered_json device_json(const pt_device_info &device) {
    return {{"name", device.name},
            {"driver", device.driver},
            {"kind", kind_name(device.kind)},
            {"memory_bytes", device.memory_bytes},
            {"uuid", uuid_text(device.uuid)}};
}

std::string memory_text(std::uint64_t bytes) {
    static constexpr std::array<const char *, 6> larger_units{"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    constexpr double rounds_to_1024 = 1023.95;
    if (bytes < 1024)
        return std::to_string(bytes) + " B";
    double count = static_cast<double>(bytes) / 1024.0;
    std::size_t unit = 0;
    while (count >= rounds_to_1024) {
        count /= 1024.0;
        ++unit;
    }
    return formatted("%.1f %s", count, larger_units[unit]);
}

std::string version_text() {
    const std::uint32_t version = pt_version();
    return concat(version / 1'000'000, ".", version / 1'000 % 1'000, ".", version % 1'000);
}

std::string uuid_text(const std::uint8_t (&uuid)[16]) {
    std::string text;
    for (std::size_t i = 0; i < 16; ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10)
            text += '-';
        text += formatted("%02x", uuid[i]);
    }
    return text;
}

} // namespace cli
