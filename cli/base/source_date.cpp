#include "cli/base/source_date.h"

#include "cli/base/exit_code.h"
#include "cli/base/number.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace cli {

std::string source_date() {
    constexpr std::uint64_t last_second = 253'402'300'799; // of the year 9999: later years have no such form
    const char *variable = std::getenv("SOURCE_DATE_EPOCH");
    if (variable == nullptr)
        return "";
    const auto seconds = parse_number<std::uint64_t>(variable);
    if (!seconds || *seconds > last_second) {
        throw Failure(ExitCode::usage, "SOURCE_DATE_EPOCH: must be a whole number of seconds from 0 to " +
                                           std::to_string(last_second) + ", is \"" + variable + "\"");
    }
    const auto time = static_cast<std::time_t>(*seconds);
    std::tm utc{};
    gmtime_r(&time, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y:%m:%d %H:%M:%S", &utc);
    return text.data();
}

} // namespace cli
