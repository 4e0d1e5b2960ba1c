// What is shown of a device and of the library as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <pt/devices.h>

#include <cstdint>
#include <string>

namespace cli {

// kind: PT_DEVICE_*.
std::string kind_name(std::uint32_t kind);

// Name, driver, kind, memory and UUID.
nlohmann::ordered_json device_json(const pt_device_info &device);

// "7.7 GiB", "480 B": in the largest unit in which the number is at least one.
std::string memory_text(std::uint64_t bytes);

// The version of the library, which is also that of the program: "0.3.0".
std::string version_text();

// 32 hexadecimal digits in the usual groups.
std::string uuid_text(const std::uint8_t (&uuid)[16]);

} // namespace cli
