// What may end a rendering before it has all samples, and the test of it between steps. A further rule is a field here,
// its test in StoppingTest, and its option in render_options.cpp.
#pragma once

#include <pt/stats.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace cli {

struct StoppingRules {
    double target_error = 0.0;        // relative; 0: none. The library tests it, within its steps
    std::optional<double> time_limit; // seconds for each frame

    bool has_target() const { return target_error > 0.0; }
    bool has_any() const { return has_target() || time_limit; }

    // Of a pixel, unless the scene or an option says it.
    std::uint32_t usual_samples() const { return has_any() ? 65536 : 64; }

    // By which factor the samples may grow after so many seconds, if others take as long.
    double growth_left(double seconds) const {
        return time_limit.value_or(std::numeric_limits<double>::infinity()) / seconds;
    }
};

inline constexpr const char *stopping_options = "--error or --time";
inline constexpr const char *ended_by_time = "time";

// A guess how many samples a target error takes in all, if `sample_count` samples have the error `error`, which may be
// infinite. The error of independent samples falls with the root of their number; stratified samples need fewer, so the
// guess falls as they come. It is more than the samples at the next look, so that progress does not show 100% before
// the target is reached.
inline std::uint32_t forecast_sample_count(std::uint32_t sample_count, double error, double target_error,
                                           std::uint32_t most) {
    const double ratio = error / target_error;
    const double guess = sample_count * ratio * ratio;
    const double least = pt_next_check(sample_count) + 1.0;
    return static_cast<std::uint32_t>(std::min(std::max(std::ceil(guess), least), static_cast<double>(most)));
}

// Asked between the steps of a rendering, which takes the pieces of an image one after the other.
class StoppingTest {
public:
    using Clock = std::chrono::steady_clock;

    StoppingTest(const StoppingRules &rules, Clock::time_point start) : rules_(rules), start_(start) {}

    const StoppingRules &rules() const { return rules_; }

    // The next piece ends at this share of the image. Each gets its share of the time, plus what earlier pieces have
    // not used.
    void enter_piece(double end) {
        if (rules_.time_limit)
            end_ = start_ +
                   std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*rules_.time_limit * end));
        is_over_ = false;
    }

    // Whether a step is to end as soon as it has a whole sample.
    bool is_due() const { return Clock::now() >= end_; }

    // After a step that has left the piece with a sample at the least, but not with all.
    void look(Clock::time_point now) {
        is_over_ = now >= end_;
        if (is_over_)
            ended_by_ = ended_by_time;
    }

    // Whether the piece gets no more samples.
    bool is_over() const { return is_over_; }

    // The rule by which some piece has fewer samples; nothing if none has.
    std::optional<std::string> ended_by() const { return ended_by_; }

private:
    StoppingRules rules_;
    Clock::time_point start_;
    Clock::time_point end_ = Clock::time_point::max(); // of the piece
    bool is_over_ = false;
    std::optional<std::string> ended_by_;
};

} // namespace cli
