// Rules that end a rendering early.
#pragma once

#include <pt/stats.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace cli {

struct StoppingRules : pt_stopping {
    StoppingRules() : pt_stopping{} {}

    bool has_target() const { return target_error > 0.0; }
    bool has_any() const { return has_target() || time_limit > 0.0; }

    bool is_reached(const pt_error_estimate &error) const {
        return has_target() && error.relative_rmse_high <= target_error;
    }

    std::uint32_t usual_samples() const { return has_any() ? 65536 : 64; }
};

inline constexpr const char *stopping_options = "--error or --time";
inline constexpr const char *ended_by_time = "time";

// Forecasts the samples for a target error. `error` may be infinite. Independent errors fall as n^-1/2 and stratified
// ones faster, so the forecast falls with time. It is at least the count of the next check.
inline std::uint32_t forecast_sample_count(std::uint32_t sample_count, double error, double target_error,
                                           std::uint32_t most) {
    const double ratio = error / target_error;
    const double guess = sample_count * ratio * ratio;
    const double least = pt_next_check(sample_count) + 1.0;
    return static_cast<std::uint32_t>(std::min(std::max(std::ceil(guess), least), static_cast<double>(most)));
}

// Divides the time of a rendering among the pieces of its image.
class StoppingTest {
public:
    using Clock = std::chrono::steady_clock;

    StoppingTest(const StoppingRules &rules, Clock::time_point start) : rules_(rules), start_(start) {}

    const StoppingRules &rules() const { return rules_; }

    // `end` is the finished fraction of the image after the piece. A piece may use the time that earlier ones saved.
    void enter_piece(double end) {
        end_ = end;
        is_over_ = false;
    }

    pt_stopping rules_of_step() const {
        constexpr double least = 1e-9; // a late piece gets one sample
        const std::chrono::duration<double> passed = Clock::now() - start_;
        pt_stopping rules = rules_;
        if (rules.time_limit > 0.0)
            rules.time_limit = std::max(rules.time_limit * end_ - passed.count(), least);
        return rules;
    }

    void look(pt_result result) {
        is_over_ = result == PT_LIMIT_REACHED;
        if (is_over_)
            ended_by_ = ended_by_time;
    }

    bool is_over() const { return is_over_; }

    std::optional<std::string> ended_by() const { return ended_by_; }

private:
    StoppingRules rules_;
    Clock::time_point start_;
    double end_ = 1.0;
    bool is_over_ = false;
    std::optional<std::string> ended_by_;
};

} // namespace cli
