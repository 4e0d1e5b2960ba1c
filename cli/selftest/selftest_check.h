// One result of `pt selftest`: an error, and the bound that it must keep.
#pragma once

#include <string>

namespace cli {

struct SelftestCheck {
    std::string group; // "function", "scene", "invariance" or "directions"
    std::string name;
    double error; // infinite where nothing finite was measured
    double bound;
    std::string unit;
    std::string detail; // what was measured, for a report of the fault

    // Written so that an error that is not a number fails.
    bool passed() const { return error <= bound; }
};

} // namespace cli
