#include "cli/selftest/selftest_report.h"

#include "cli/base/device_text.h"
#include "cli/base/json_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace cli {
namespace {

std::size_t failed_count(const SelftestReport &report) {
    return static_cast<std::size_t>(
        std::ranges::count_if(report.checks, [](const SelftestCheck &check) { return !check.passed(); }));
}

std::string header(const pt_device_info &device) {
    return "pt      " + version_text() + "\ndevice  " + device.name + "\ndriver  " + device.driver + "\nkind    " +
           kind_name(device.kind) + "\nmemory  " + memory_text(device.memory_bytes) + "\nUUID    " +
           uuid_text(device.uuid) + "\n";
}

std::string row(const std::string &verdict, const std::string &name, const std::string &error, const std::string &bound,
                const std::string &unit, const std::string &detail) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), "%-4s  %-32s  %9s  %9s  %-8s  ", verdict.c_str(), name.c_str(),
                  error.c_str(), bound.c_str(), unit.c_str());
    return text.data() + detail + "\n";
}

std::string short_number(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", number);
    return text.data();
}

std::string verdict(const SelftestReport &report) {
    const std::string count = std::to_string(report.checks.size()) + " checks";
    return report.passed() ? "passed: all " + count + "\n"
                           : "FAILED: " + std::to_string(failed_count(report)) + " of " + count + "\n";
}

} // namespace

bool SelftestReport::passed() const {
    return failed_count(*this) == 0;
}

std::string selftest_text(const SelftestReport &report) {
    std::string text = header(report.device) + "\n" + row("", "check", "error", "bound", "unit", "measured");
    for (const SelftestCheck &check : report.checks) {
        text += row(check.passed() ? "pass" : "FAIL", check.name, short_number(check.error), short_number(check.bound),
                    check.unit, check.detail);
    }
    return text + "\n" + verdict(report);
}

nlohmann::ordered_json selftest_json(const SelftestReport &report) {
    auto checks = nlohmann::ordered_json::array();
    for (const SelftestCheck &check : report.checks) {
        checks.push_back({{"group", check.group},
                          {"name", check.name},
                          {"passed", check.passed()},
                          {"error", number_or_null(check.error)},
                          {"bound", check.bound},
                          {"unit", check.unit},
                          {"measured", check.detail}});
    }
    return {{"version", version_text()},
            {"device",
             {{"name", report.device.name},
              {"driver", report.device.driver},
              {"kind", kind_name(report.device.kind)},
              {"memory_bytes", report.device.memory_bytes},
              {"uuid", uuid_text(report.device.uuid)}}},
            {"passed", report.passed()},
            {"checks", std::move(checks)}};
}

} // namespace cli
