#include "cli/data/text_rows.h"

#include "cli/base/exit_code.h"
#include "cli/base/number.h"
#include "cli/data/text_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace cli {
namespace {

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

const char *skip_blanks(const char *first, const char *last) {
    while (first != last && is_blank(*first)) {
        ++first;
    }
    return first;
}

const char *find_blank(const char *first, const char *last) {
    while (first != last && !is_blank(*first)) {
        ++first;
    }
    return first;
}

[[noreturn]] void refuse_end(const DataStream &stream, std::uint64_t count, std::uint64_t expected) {
    throw Failure(ExitCode::scene, stream.line_place() + ": the file ends after " + std::to_string(count) + " of " +
                                       std::to_string(expected) + " particles: it was cut short");
}

class RowReader {
public:
    RowReader(const DataStream &stream, const TextTable &table, ParticleRows &rows) :
        stream_(stream),
        table_(table),
        rows_(rows),
        slots_(rows.slots()),
        used_(rows.used_column_count()),
        row_(rows.row_size()) {}

    void read(std::string_view line) {
        const char *next = line.data();
        const char *last = line.data() + line.size();
        for (std::size_t column = 0; column < used_; ++column) {
            next = skip_blanks(next, last);
            if (next == last) {
                refuse_columns(line);
            }
            next = slots_[column] == ParticleRows::unused ? find_blank(next, last)
                                                          : read_value(next, last, slots_[column]);
        }
        if (!table_.may_have_more) {
            require_no_more(next, last, line);
        }
        rows_.add(row_.data());
    }

private:
    // Most values are plain numbers, and are read without looking for their end first.
    const char *read_value(const char *first, const char *last, std::uint32_t slot) {
        double number = 0.0;
        const auto [end, error] = std::from_chars(first, last, number);
        if (error == std::errc{} && (end == last || is_blank(*end)) && std::isfinite(number) &&
            !rows_.has_words(slot)) {
            row_[slot] = number;
            return end;
        }
        const char *field_end = find_blank(first, last);
        rows_.set(row_.data(), slot, {first, static_cast<std::size_t>(field_end - first)});
        return field_end;
    }

    void require_no_more(const char *next, const char *last, std::string_view line) const {
        std::size_t count = used_;
        for (next = skip_blanks(next, last); next != last; next = skip_blanks(next, last)) {
            next = find_blank(next, last);
            ++count;
        }
        if (count != table_.column_count) {
            refuse_columns(line);
        }
    }

    [[noreturn]] void refuse_columns(std::string_view line) const {
        throw Failure(ExitCode::scene, stream_.line_place() + ": " + quoted_text(line) + " has " +
                                           std::to_string(split_at_blanks(line).size()) + " values, must have " +
                                           std::to_string(table_.column_count) +
                                           (table_.may_have_more ? " or more" : ""));
    }

    const DataStream &stream_;
    const TextTable &table_;
    ParticleRows &rows_;
    std::span<const std::uint32_t> slots_;
    std::size_t used_;
    std::vector<double> row_;
};

} // namespace

std::vector<std::string> split_at_blanks(std::string_view line) {
    std::vector<std::string> fields;
    const char *last = line.data() + line.size();
    for (const char *next = skip_blanks(line.data(), last); next != last; next = skip_blanks(next, last)) {
        const char *end = find_blank(next, last);
        fields.emplace_back(next, end);
        next = end;
    }
    return fields;
}

std::vector<double> read_line_numbers(const DataStream &stream, std::string_view line) {
    std::vector<double> numbers;
    for (const std::string &field : split_at_blanks(line)) {
        numbers.push_back(0.0);
        if (const char *rule = parse_real(field, numbers.back())) {
            throw Failure(ExitCode::scene, stream.line_place() + ": " + quoted_text(field) + " " + rule);
        }
    }
    return numbers;
}

std::uint64_t read_line_count(const DataStream &stream, std::string_view line, const std::string &what) {
    const std::vector<std::string> fields = split_at_blanks(line);
    const auto count = fields.size() == 1 ? parse_number<std::uint64_t>(fields[0]) : std::nullopt;
    if (!count) {
        throw Failure(ExitCode::scene, stream.line_place() + ": " + what + " = " + quoted_text(line) +
                                           ": must be a whole number from 0");
    }
    return *count;
}

void read_rows(DataStream &stream, const TextTable &table, ParticleRows &rows) {
    if (const auto size = stream.size_left()) {
        const std::uint64_t least_size = 2 * table.column_count; // of a row: a digit and a blank, or the line's end
        rows.expect(std::min(table.row_count, *size / least_size + 1));
    }
    RowReader reader(stream, table, rows);
    std::string_view line;
    for (std::uint64_t row = 0; row < table.row_count; ++row) {
        if (!stream.next_line(line) || (table.must_end && !stream.was_line_ended())) {
            refuse_end(stream, row, table.row_count);
        }
        reader.read(line);
    }
}

void skip_rows(DataStream &stream, std::uint64_t row_count) {
    const std::uint64_t count = stream.skip_lines(row_count);
    if (count < row_count) {
        refuse_end(stream, count, row_count);
    }
}

} // namespace cli
