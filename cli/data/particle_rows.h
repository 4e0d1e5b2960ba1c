// What readers of all formats hand particles to: it says which columns of a file are needed, and keeps the rows that
// meet the conditions.
#pragma once

#include "cli/data/particle_condition.h"
#include "cli/data/particle_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace cli {

// Which columns of a file are the position.
struct PositionNames {
    std::array<std::string_view, 3> names;
    bool scaled = false; // shares of the box's edges
};

class ParticleRows {
public:
    static constexpr std::size_t largest_count = std::size_t{1} << 26; // of spheres, in pt.h
    static constexpr std::uint32_t unused = UINT32_MAX;
    static constexpr std::size_t most_columns = 65536; // of a file: their names take memory before a number is read

    // file: its name, for messages. Throws Failure for conditions that cannot be read.
    ParticleRows(std::string file, const ParticleQuery &query);

    // Where that value of the row that is being read stands, for messages.
    void set_place(std::function<std::string(std::uint32_t slot)> place) { place_ = std::move(place); }

    // A frame begins, of particles with these columns: what was kept of the one before is dropped. choices: the
    // position is in the first of which the file has all. Throws Failure if there is none, or a column is asked for
    // that is not there.
    void begin_frame(std::span<const std::string> columns, std::span<const PositionNames> choices,
                     const std::optional<SimulationBox> &box);

    // After begin_frame: so many rows may come, at most. Sizes in the heads of files are not to be trusted so far.
    void expect(std::uint64_t count);

    // For each column the place of its value in a row, or unused.
    std::span<const std::uint32_t> slots() const { return slots_; }
    std::size_t used_column_count() const { return used_column_count_; } // all that come later are unused
    std::size_t row_size() const { return names_.size(); }

    // The text of a value that goes to that place of the row. Throws Failure if it is not a finite number, nor a word
    // where the names of types may be.
    void set(double *row, std::uint32_t slot, std::string_view text);
    bool has_words(std::uint32_t slot) const { return has_words_[slot] != 0; }

    // Throws Failure unless all values of the row are finite.
    void require_finite(const double *row) const;

    // Keeps the row if all conditions hold for it. The row is overwritten where positions are shares of a box.
    void add(double *row);

    std::size_t kept_count() const { return particles_.positions.size() / 3; }

    // What was kept; only once.
    Particles finish();

    // "melt.dump:17: x = nan: must be finite".
    [[noreturn]] void refuse(std::uint32_t slot, const std::string &value, const std::string &rule) const;

private:
    struct BoundCondition {
        std::uint32_t slot;
        Comparison comparison;
        double number;
        std::size_t index; // of the condition in conditions_
    };

    std::uint32_t slot_of_column(std::size_t column);
    std::size_t find_column(std::span<const std::string> columns, std::string_view name) const;
    std::uint32_t slot_of(std::span<const std::string> columns, std::string_view name); // unused if it has none
    std::uint32_t require_slot(std::span<const std::string> columns, const std::string &name);
    void bind_position(std::span<const std::string> columns, std::span<const PositionNames> choices);
    void bind_columns(std::span<const std::string> columns);
    void bind_conditions(std::span<const std::string> columns);
    void check_words() const;
    double index_of(std::string_view word);
    void unscale(double *row) const;
    bool is_wanted(const double *row) const;
    void name_used_types();

    std::string file_;
    ParticleQuery query_;
    std::vector<ParticleCondition> conditions_;
    std::function<std::string(std::uint32_t slot)> place_;

    std::vector<std::uint32_t> slots_;
    std::size_t used_column_count_ = 0;
    std::vector<std::string> names_; // of the values of a row; the first three are the position
    std::array<std::uint32_t, 3> scaled_slots_{};
    bool is_scaled_ = false;
    std::vector<char> has_words_; // by slots
    bool is_first_row_ = true;
    std::vector<std::uint32_t> column_slots_; // of particles_.columns
    std::vector<BoundCondition> bound_;

    std::vector<std::string> words_;
    std::unordered_map<std::string, std::uint32_t> word_indices_;
    std::size_t last_word_ = 0;

    Particles particles_;
};

} // namespace cli
