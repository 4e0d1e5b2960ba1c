#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

namespace cli {

enum class ProgressStyle { none, line, json };

std::size_t terminal_columns();

class Progress {
public:
    using Clock = std::chrono::steady_clock;

    Progress(std::ostream &output, ProgressStyle style, std::uint64_t pixel_count, std::uint64_t sample_count,
             Clock::time_point start, std::function<std::size_t()> columns = &terminal_columns);
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;
    ~Progress() { erase_line(); }

    // `begin` and `end` are fractions of the whole work.
    void enter_part(double begin, double end) {
        part_begin_ = begin;
        part_end_ = end;
    }

    // Prints nothing during the first tenth of a second.
    void update_scene(double share, Clock::time_point now);

    // Prints at most ten times a second, and at the end. The percentage never falls.
    void update_samples(double samples_of_part, Clock::time_point now);

    void expect(std::uint64_t sample_count) { sample_count_ = sample_count; }

    void begin_at(std::uint64_t sample_count) { begun_ = static_cast<double>(sample_count); }

    void limit_time(double seconds) { limit_seconds_ = seconds; }

    void show_error(double relative_error) { relative_error_ = relative_error; }

    bool shows_error() const { return style_ == ProgressStyle::line; }

    void say(const std::string &message);

private:
    double remaining_seconds(double samples, double seconds) const;
    std::string error_text() const;
    void erase_line();
    void overwrite_line(const std::string &text);
    void print_line(double samples, double seconds);
    void print_json(double samples, double seconds);

    std::ostream &output_;
    std::function<std::size_t()> column_count_;
    ProgressStyle style_;
    double pixel_count_;
    std::uint64_t sample_count_;
    double part_begin_ = 0.0;
    double part_end_ = 1.0;
    double fraction_ = 0.0;
    double begun_ = 0.0;
    double limit_seconds_ = std::numeric_limits<double>::infinity();
    double relative_error_ = std::numeric_limits<double>::infinity();
    Clock::time_point start_;
    Clock::time_point next_update_;
    bool has_line_ = false;
};

ProgressStyle progress_style(const std::string &name, bool quiet, bool is_terminal);

} // namespace cli
