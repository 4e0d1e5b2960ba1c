#pragma once

#include <nlohmann/json_fwd.hpp>
#include <pt/devices.h>

#include <cstdint>
#include <string>

namespace cli {

std::string kind_name(std::uint32_t kind);

nlohmann::ordered_json device_json(const pt_device_info &device);

std::string memory_text(std::uint64_t bytes);

std::string version_text();

std::string uuid_text(const std::uint8_t (&uuid)[16]);

} // namespace cli
