// The results of a finished selftest, as text and as JSON: what a report of a fault needs.
#pragma once

#include "cli/selftest/selftest_check.h"

#include <pt/devices.h>
#include <pt/pt.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace cli {

struct SelftestReport {
    pt_device_info device;
    std::vector<SelftestCheck> checks;

    bool passed() const;
};

// The device, a line for every check, and the verdict.
std::string selftest_text(const SelftestReport &report);

nlohmann::ordered_json selftest_json(const SelftestReport &report);

} // namespace cli
