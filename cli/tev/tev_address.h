// Where the image viewer tev listens.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cli {

struct TevAddress {
    std::string host = "127.0.0.1"; // tev's own defaults
    std::string port = "14158";
};

// "127.0.0.1:14158", "viewer.example:14158" or "[::1]:14158". Nothing unless there are a host and a port from 1 to
// 65535.
std::optional<TevAddress> parse_tev_address(std::string_view text);

inline std::string tev_address_text(const TevAddress &address) {
    const bool has_colon = address.host.find(':') != std::string::npos;
    return (has_colon ? "[" + address.host + "]" : address.host) + ":" + address.port;
}

} // namespace cli
