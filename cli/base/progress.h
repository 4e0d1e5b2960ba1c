// Shows the progress of a rendering: a line on a terminal, JSON lines for programs, or nothing.
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

// Width of the terminal on stderr; 80 if it does not say.
std::size_t terminal_columns();

class Progress {
public:
    using Clock = std::chrono::steady_clock;

    // From now on pixel_count times sample_count samples are to be taken. columns: the present width of the terminal.
    Progress(std::ostream &output, ProgressStyle style, std::uint64_t pixel_count, std::uint64_t sample_count,
             Clock::time_point start, std::function<std::size_t()> columns = &terminal_columns);
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;
    ~Progress() { erase_line(); } // leaves the terminal's line empty for what is printed next

    // From now on the samples belong to one part of the work, the share [begin, end] of the whole.
    void enter_part(double begin, double end) {
        part_begin_ = begin;
        part_end_ = end;
    }

    // Shows which share of the scene has been taken over, before there are samples: as a line on a terminal, if it
    // takes longer than a tenth of a second.
    void update_scene(double share, Clock::time_point now);

    // The samples that are done. Prints at most ten times a second, and at the end. The share that is shown never
    // falls, even if expect() raises the total.
    void update_samples(double samples_of_part, Clock::time_point now);

    // From now on this many samples a pixel are to be taken in all.
    void expect(std::uint64_t sample_count) { sample_count_ = sample_count; }

    // This many samples a pixel existed at the start.
    void begin_at(std::uint64_t sample_count) { begun_ = static_cast<double>(sample_count); }

    // The work ends after this time since the start, if it has not ended by itself.
    void limit_time(double seconds) { limit_seconds_ = seconds; }

    // The relative error to be shown from now on; infinite: it is not known.
    void show_error(double relative_error) { relative_error_ = relative_error; }

    // Whether show_error() is of any use.
    bool shows_error() const { return style_ == ProgressStyle::line; }

    // A message between the lines of progress.
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
    double fraction_ = 0.0; // of the whole, the largest told
    double begun_ = 0.0;    // samples a pixel that were there at the start
    double limit_seconds_ = std::numeric_limits<double>::infinity();
    double relative_error_ = std::numeric_limits<double>::infinity();
    Clock::time_point start_;
    Clock::time_point next_update_;
    bool has_line_ = false; // whether there is something to be erased
};

// name: "auto", "json" or "none". Only auto depends on the terminal.
ProgressStyle progress_style(const std::string &name, bool quiet, bool is_terminal);

} // namespace cli
