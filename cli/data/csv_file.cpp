#include "cli/data/csv_file.h"

#include "cli/base/exit_code.h"
#include "cli/data/text_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace cli {
namespace {

constexpr std::array<PositionNames, 1> csv_positions{{{{"x", "y", "z"}}}};

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
        text.remove_prefix(1);
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) {
        text.remove_suffix(1);
    }
    return text;
}

// The fields of one line after the other.
class CsvFields {
public:
    CsvFields(const DataStream &stream, char separator) : stream_(stream), separator_(separator) {}

    void begin(std::string_view line) {
        rest_ = line;
        has_more_ = true;
    }
    bool has_more() const { return has_more_; }

    // Without blanks around it; valid until the next one is taken.
    std::string_view take() {
        const std::size_t first = separator_ == '\t' ? 0 : std::min(rest_.find_first_not_of(' '), rest_.size());
        if (first < rest_.size() && rest_[first] == '"') {
            rest_.remove_prefix(first + 1);
            return take_quoted();
        }
        const std::size_t end = rest_.find(separator_);
        const std::string_view field = without_blanks(rest_.substr(0, end));
        pass(end);
        return field;
    }

private:
    void pass(std::size_t end) {
        has_more_ = end != std::string_view::npos;
        rest_.remove_prefix(has_more_ ? end + 1 : rest_.size());
    }

    // What is within quotes, of which two stand for one.
    std::string_view take_quoted() {
        unquoted_.clear();
        for (;;) {
            const std::size_t quote = rest_.find('"');
            if (quote == std::string_view::npos) {
                throw Failure(ExitCode::scene,
                              stream_.line_place() + ": a quoted field must end in the line that it begins in");
            }
            unquoted_ += rest_.substr(0, quote);
            rest_.remove_prefix(quote + 1);
            if (!rest_.starts_with('"')) {
                break;
            }
            unquoted_ += '"';
            rest_.remove_prefix(1);
        }
        const std::size_t end = rest_.find(separator_);
        if (!without_blanks(rest_.substr(0, end)).empty()) {
            throw Failure(ExitCode::scene, stream_.line_place() + ": " + quoted_text(rest_.substr(0, end)) +
                                               " follows a quoted field without a separator");
        }
        pass(end);
        return unquoted_;
    }

    const DataStream &stream_;
    char separator_;
    std::string_view rest_;
    bool has_more_ = false;
    std::string unquoted_;
};

class CsvReader {
public:
    CsvReader(DataStream &stream, char separator, ParticleRows &rows) :
        stream_(stream),
        separator_(separator),
        fields_(stream, separator),
        rows_(rows) {}

    void read(std::string_view head) {
        rows_.set_place([this](std::uint32_t) { return stream_.line_place(); });
        read_head(head);
        row_.resize(rows_.row_size());
        slots_ = rows_.slots();
        for (std::string_view line; stream_.next_line(line);) {
            if (!without_blanks(line).empty()) {
                read_line(line);
                rows_.add(row_.data());
            }
        }
    }

private:
    void read_head(std::string_view head) {
        std::vector<std::string> names;
        fields_.begin(head);
        do {
            names.emplace_back(fields_.take());
        } while (fields_.has_more());
        rows_.begin_frame(names, csv_positions, std::nullopt);
    }

    void read_line(std::string_view line) {
        if (line.find('"') != std::string_view::npos) {
            read_quoted_line(line);
            return;
        }
        const char *next = line.data();
        const char *last = line.data() + line.size();
        std::size_t column = 0;
        for (;; ++column) {
            const bool is_used = column < slots_.size() && slots_[column] != ParticleRows::unused;
            next = is_used ? read_field(next, last, slots_[column]) : std::find(next, last, separator_);
            if (next == last) {
                break;
            }
            ++next;
        }
        require_columns(column + 1);
    }

    // Most fields are plain numbers, and are read without looking for their end first. Returns where the separator is.
    const char *read_field(const char *first, const char *last, std::uint32_t slot) {
        double number = 0.0;
        const auto [end, error] = std::from_chars(first, last, number);
        if (error == std::errc{} && (end == last || *end == separator_) && std::isfinite(number) &&
            !rows_.has_words(slot)) {
            row_[slot] = number;
            return end;
        }
        const char *field_end = std::find(first, last, separator_);
        rows_.set(row_.data(), slot, without_blanks({first, static_cast<std::size_t>(field_end - first)}));
        return field_end;
    }

    void read_quoted_line(std::string_view line) {
        fields_.begin(line);
        std::size_t column = 0;
        for (; fields_.has_more(); ++column) {
            const std::string_view field = fields_.take();
            if (column < slots_.size() && slots_[column] != ParticleRows::unused) {
                rows_.set(row_.data(), slots_[column], field);
            }
        }
        require_columns(column);
    }

    void require_columns(std::size_t count) const {
        if (count != slots_.size()) {
            throw Failure(ExitCode::scene, stream_.line_place() + ": has " + std::to_string(count) +
                                               " fields, must have " + std::to_string(slots_.size()) +
                                               " like the first line");
        }
    }

    DataStream &stream_;
    char separator_;
    CsvFields fields_;
    ParticleRows &rows_;
    std::span<const std::uint32_t> slots_;
    std::vector<double> row_;
};

std::string read_head_line(DataStream &stream) {
    std::string_view line;
    if (!stream.next_line(line)) {
        throw Failure(ExitCode::scene, stream.name() + ": is empty: must begin with the names of columns");
    }
    return std::string(line);
}

} // namespace

void read_csv(DataStream &stream, ParticleRows &rows) {
    const std::string head = read_head_line(stream);
    const bool has_semicolons = head.find(',') == std::string::npos && head.find(';') != std::string::npos;
    CsvReader(stream, has_semicolons ? ';' : ',', rows).read(head);
}

void read_tsv(DataStream &stream, ParticleRows &rows) {
    const std::string head = read_head_line(stream);
    CsvReader(stream, '\t', rows).read(head);
}

} // namespace cli
