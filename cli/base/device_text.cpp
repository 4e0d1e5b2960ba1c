#include "cli/base/device_text.h"

#include <pt/devices.h>
#include <pt/pt.h>

#include <array>
#include <cstddef>
#include <cstdio>

namespace cli {

std::string kind_name(std::uint32_t kind) {
    switch (kind) {
    case PT_DEVICE_INTEGRATED_GPU:
        return "integrated GPU";
    case PT_DEVICE_DISCRETE_GPU:
        return "discrete GPU";
    case PT_DEVICE_VIRTUAL_GPU:
        return "virtual GPU";
    case PT_DEVICE_CPU:
        return "CPU";
    default:
        return "other";
    }
}

std::string memory_text(std::uint64_t bytes) {
    static constexpr std::array<const char *, 6> larger_units{"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    constexpr double rounds_to_1024 = 1023.95; // with one decimal
    if (bytes < 1024)
        return std::to_string(bytes) + " B";
    double count = static_cast<double>(bytes) / 1024.0;
    std::size_t unit = 0;
    while (count >= rounds_to_1024) {
        count /= 1024.0;
        ++unit;
    }
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f %s", count, larger_units[unit]);
    return text.data();
}

std::string uuid_text(const std::uint8_t (&uuid)[16]) {
    std::string text;
    for (std::size_t i = 0; i < 16; ++i) {
        std::array<char, 3> digits{};
        std::snprintf(digits.data(), digits.size(), "%02x", uuid[i]);
        if (i == 4 || i == 6 || i == 8 || i == 10)
            text += '-';
        text += digits.data();
    }
    return text;
}

} // namespace cli
