// Decides when work ends before all samples are taken.
#pragma once

#include "lib/base/rules.h"
#include "lib/film/error_estimate.h"

#include <chrono>

namespace pt {

// The time begins with the object.
struct Stopping {
    pt_stopping rules;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

    void check(Violations &violations) const {
        const Subject subject(violations, "stopping");
        subject.check("target_error", rules.target_error, not_negative_rule);
        subject.check("time_limit", rules.time_limit, not_negative_rule);
    }

    bool has_target() const { return rules.target_error > 0.0; }
    bool has_any() const { return has_target() || rules.time_limit > 0.0; }

    bool is_reached(const ErrorEstimate &error) const { return is_near(error.relative_rmse.high, 1.0); }

    bool is_near(double error, double factor) const { return has_target() && error <= factor * rules.target_error; }

    double excess(double error) const { return error / rules.target_error; }

    // The fraction of the time that has passed, 0 without a limit.
    double spent() const {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        return rules.time_limit > 0.0 ? passed.count() / rules.time_limit : 0.0;
    }
};

} // namespace pt
