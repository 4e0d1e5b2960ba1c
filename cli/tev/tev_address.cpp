#include "cli/tev/tev_address.h"

#include "cli/base/number.h"

#include <cstdint>

namespace cli {

std::optional<TevAddress> parse_tev_address(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos) {
        return std::nullopt;
    }
    std::string_view host = text.substr(0, colon);
    const std::string_view port = text.substr(colon + 1);
    const bool is_bracketed = host.starts_with('[') && host.ends_with(']');
    if (is_bracketed) {
        host = host.substr(1, host.size() - 2);
    }
    const auto number = parse_number<std::uint16_t>(port);
    if (host.empty() || !number || *number == 0 || (!is_bracketed && host.find(':') != std::string_view::npos)) {
        return std::nullopt;
    }
    return TevAddress{std::string(host), std::string(port)};
}

} // namespace cli
