#include "cli/base/progress.h"

#include "cli/base/text.h"
#include "lib/platform/terminal.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cli {
namespace {

constexpr std::chrono::milliseconds update_interval{100};
constexpr const char *line_eraser = "\r\x1b[K"; // ECMA-48: erase the line

std::string duration_text(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    return formatted("%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
}

} // namespace

ProgressStyle progress_style(const std::string &name, bool quiet, bool is_terminal) {
    if (quiet || name == "none")
        return ProgressStyle::none;
    if (name == "json")
        return ProgressStyle::json;
    return is_terminal ? ProgressStyle::line : ProgressStyle::none;
}

std::size_t terminal_columns() {
    constexpr std::size_t usual = 80;
    const std::size_t columns = platform::terminal_columns();
    return columns > 0 ? columns : usual;
}

Progress::Progress(std::ostream &output, ProgressStyle style, std::uint64_t pixel_count, std::uint64_t sample_count,
                   Clock::time_point start, std::function<std::size_t()> columns) :
    output_(output),
    column_count_(std::move(columns)),
    style_(style),
    pixel_count_(static_cast<double>(pixel_count)),
    sample_count_(sample_count),
    start_(start),
    next_update_(start) {}

void Progress::erase_line() {
    if (std::exchange(has_line_, false))
        output_ << line_eraser << std::flush;
}

void Progress::overwrite_line(const std::string &text) {
    output_ << line_eraser << text << std::flush;
    has_line_ = true;
}

void Progress::update_scene(double share, Clock::time_point now) {
    if (style_ != ProgressStyle::line || now < std::max(next_update_, start_ + update_interval))
        return;
    next_update_ = now + update_interval;
    overwrite_line(formatted("scene %3.0f %%", 100.0 * share));
}

void Progress::update_samples(double samples_of_part, Clock::time_point now) {
    const double share = samples_of_part / static_cast<double>(sample_count_);
    const double whole_share = part_begin_ + (part_end_ - part_begin_) * share;
    const double sample_count = whole_share * static_cast<double>(sample_count_);
    const double seconds = std::max(std::chrono::duration<double>(now - start_).count(), 1e-9);
    fraction_ = std::max({fraction_, whole_share, std::min(seconds / limit_seconds_, 1.0)});
    if (style_ == ProgressStyle::none || sample_count <= begun_ || (now < next_update_ && whole_share < 1.0))
        return;
    next_update_ = now + update_interval;
    if (style_ == ProgressStyle::json)
        print_json(sample_count, seconds);
    else
        print_line(sample_count, seconds);
}

double Progress::remaining_seconds(double samples, double seconds) const {
    const double left = seconds * (static_cast<double>(sample_count_) - samples) / (samples - begun_);
    return std::min(left, std::max(limit_seconds_ - seconds, 0.0));
}

std::string Progress::error_text() const {
    return std::isfinite(relative_error_) ? formatted("  error %.3g%%", 100.0 * relative_error_) : "";
}

void Progress::say(const std::string &message) {
    erase_line();
    print_message(message);
}

// On a narrow terminal drops the last parts, because a wrapped line cannot be erased.
void Progress::print_line(double samples, double seconds) {
    const std::array<std::string, 5> parts{
        formatted("%5.1f %%", 100.0 * fraction_),
        "  ETA " + duration_text(remaining_seconds(samples, seconds)),
        formatted("  %.0f/", std::floor(samples)) + formatted("%.0f spp", static_cast<double>(sample_count_)),
        error_text(),
        formatted("  %.1f Msamples/s", (samples - begun_) * pixel_count_ / seconds * 1e-6),
    };
    const std::size_t columns = column_count_();
    std::string line;
    for (const std::string &part : parts) {
        if (line.size() + part.size() >= columns) // some terminals wrap after the last column
            break;
        line += part;
    }
    overwrite_line(line);
}

void Progress::print_json(double samples, double seconds) {
    const nlohmann::ordered_json line{{"fraction", fraction_},
                                      {"samples_per_pixel", static_cast<std::uint64_t>(samples)},
                                      {"samples_per_pixel_total", sample_count_},
                                      {"samples_per_second", (samples - begun_) * pixel_count_ / seconds},
                                      {"seconds", seconds},
                                      {"eta_seconds", remaining_seconds(samples, seconds)}};
    output_ << line.dump() << std::endl;
}

} // namespace cli
