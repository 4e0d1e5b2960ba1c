#include "cli/data/particle_rows.h"

#include "cli/base/suggestion.h"
#include "cli/data/text_number.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

namespace cli {
namespace {

// By which formats call the types of particles. A file that has none of the name that is asked for may have another;
// and these alone may have words.
constexpr std::array<std::string_view, 8> type_columns{"type",    "element", "species", "symbol",
                                                       "symbols", "types",   "label",   "name"};

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equal_but_for_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

bool is_type(std::string_view name) {
    return std::any_of(type_columns.begin(), type_columns.end(),
                       [name](std::string_view each) { return equal_but_for_case(name, each); });
}

std::string number_text(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", number);
    return text.data();
}

} // namespace

ParticleRows::ParticleRows(std::string file, const ParticleQuery &query) : file_(std::move(file)), query_(query) {
    for (const std::string &text : query.where) {
        try {
            conditions_.push_back(parse_condition(text));
        } catch (const std::invalid_argument &error) {
            throw Failure(query.blame, error.what());
        }
    }
}

void ParticleRows::begin_frame(std::span<const std::string> columns, std::span<const PositionNames> choices,
                               const std::optional<SimulationBox> &box) {
    slots_.assign(columns.size(), unused);
    used_column_count_ = 0;
    names_ = {"x", "y", "z"};
    is_first_row_ = true;
    particles_.positions.clear();
    particles_.box = box;
    bind_position(columns, choices);
    bind_columns(columns);
    bind_conditions(columns);
    has_words_.assign(names_.size(), 0);
}

void ParticleRows::expect(std::uint64_t count) {
    if (bound_.empty()) { // else nobody knows how many are kept
        const auto expected = static_cast<std::size_t>(std::min<std::uint64_t>(count, largest_count));
        particles_.positions.reserve(3 * expected);
        for (ParticleColumn &column : particles_.columns) {
            column.values.reserve(expected);
        }
    }
}

std::uint32_t ParticleRows::slot_of_column(std::size_t column) {
    used_column_count_ = std::max(used_column_count_, column + 1);
    return slots_[column];
}

// The column of that name, or else the only one whose name differs in case alone; the number of columns if there is
// none.
std::size_t ParticleRows::find_column(std::span<const std::string> columns, std::string_view name) const {
    const auto exact = std::find(columns.begin(), columns.end(), name);
    if (exact != columns.end()) {
        if (std::find(exact + 1, columns.end(), name) != columns.end()) {
            throw Failure(ExitCode::scene, place_(0) + ": there are two columns " + quoted_text(name));
        }
        return static_cast<std::size_t>(exact - columns.begin());
    }
    const auto similar = [name](const std::string &each) { return equal_but_for_case(each, name); };
    const auto found = std::find_if(columns.begin(), columns.end(), similar);
    const bool is_alone = found == columns.end() || std::none_of(found + 1, columns.end(), similar);
    return is_alone ? static_cast<std::size_t>(found - columns.begin()) : columns.size();
}

void ParticleRows::bind_position(std::span<const std::string> columns, std::span<const PositionNames> choices) {
    for (const PositionNames &choice : choices) {
        std::array<std::size_t, 3> found{};
        std::transform(choice.names.begin(), choice.names.end(), found.begin(),
                       [&](std::string_view name) { return find_column(columns, name); });
        if (std::find(found.begin(), found.end(), columns.size()) != found.end()) {
            continue;
        }
        is_scaled_ = choice.scaled;
        for (std::size_t i = 0; i < 3; ++i) {
            std::uint32_t slot = static_cast<std::uint32_t>(i);
            if (is_scaled_) {
                slot = static_cast<std::uint32_t>(names_.size());
                names_.push_back(columns[found[i]]);
                scaled_slots_[i] = slot;
            }
            slots_[found[i]] = slot;
            slot_of_column(found[i]);
        }
        return;
    }
    std::string known;
    for (const PositionNames &choice : choices) {
        known.append(known.empty() ? "" : ", or ").append(choice.names[0]);
        known.append(", ").append(choice.names[1]).append(", ").append(choice.names[2]);
    }
    throw Failure(ExitCode::scene, place_(0) + ": there is no position: the columns must have " + known);
}

// x, y and z are always the position in the units of the file, also where the file has shares of the box.
std::uint32_t ParticleRows::slot_of(std::span<const std::string> columns, std::string_view name) {
    for (std::uint32_t i = 0; i < 3; ++i) {
        if (equal_but_for_case(name, names_[i])) {
            return i;
        }
    }
    std::size_t column = find_column(columns, name);
    for (std::size_t i = 0; column == columns.size() && is_type(name) && i < type_columns.size(); ++i) {
        column = find_column(columns, type_columns[i]);
    }
    if (column == columns.size()) {
        return unused;
    }
    if (slots_[column] == unused) {
        slots_[column] = static_cast<std::uint32_t>(names_.size());
        names_.push_back(columns[column]);
    }
    return slot_of_column(column);
}

std::uint32_t ParticleRows::require_slot(std::span<const std::string> columns, const std::string &name) {
    const std::uint32_t slot = slot_of(columns, name);
    if (slot == unused) {
        const std::vector<std::string_view> known(columns.begin(), columns.end());
        throw UnknownColumn(query_.blame, file_ + ": " + unknown_name("column", name, known), name);
    }
    return slot;
}

void ParticleRows::bind_columns(std::span<const std::string> columns) {
    particles_.columns.clear();
    column_slots_.clear();
    const auto bind = [this](const std::string &name, std::uint32_t slot) {
        const auto &bound = particles_.columns;
        const bool is_new =
            std::none_of(bound.begin(), bound.end(), [&name](const ParticleColumn &each) { return each.name == name; });
        if (is_new) {
            particles_.columns.push_back({name, {}, false});
            column_slots_.push_back(slot);
        }
    };
    for (const std::string &name : query_.columns) {
        bind(name, require_slot(columns, name));
    }
    for (const std::string &name : query_.if_present) {
        if (const std::uint32_t slot = slot_of(columns, name); slot != unused) {
            bind(name, slot);
        }
    }
}

void ParticleRows::bind_conditions(std::span<const std::string> columns) {
    bound_.clear();
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        const ParticleCondition &condition = conditions_[i];
        const double number = condition.word.empty() ? condition.number : index_of(condition.word);
        bound_.push_back({require_slot(columns, condition.column), condition.comparison, number, i});
    }
}

// Whether a column has words is known from the first row on.
void ParticleRows::check_words() const {
    for (const BoundCondition &bound : bound_) {
        const ParticleCondition &condition = conditions_[bound.index];
        const bool has_words = has_words_[bound.slot] != 0;
        if (has_words == condition.word.empty()) {
            throw Failure(query_.blame, file_ + ": \"" + condition.text + "\": the column " + names_[bound.slot] +
                                            " has " + (has_words ? "words" : "numbers"));
        }
    }
}

double ParticleRows::index_of(std::string_view word) {
    constexpr std::size_t most_words = 65536;
    if (last_word_ < words_.size() && words_[last_word_] == word) {
        return static_cast<double>(last_word_);
    }
    const auto [entry, is_new] =
        word_indices_.try_emplace(std::string(word), static_cast<std::uint32_t>(words_.size()));
    if (is_new) {
        words_.push_back(entry->first);
        if (words_.size() > most_words) {
            throw Failure(ExitCode::scene, place_(0) + ": there are more than " + std::to_string(most_words) +
                                               " names of types: this is another kind of column");
        }
    }
    last_word_ = entry->second;
    return static_cast<double>(last_word_);
}

void ParticleRows::set(double *row, std::uint32_t slot, std::string_view text) {
    if (has_words_[slot] != 0) {
        row[slot] = index_of(text);
        return;
    }
    const char *rule = parse_real(text, row[slot]);
    if (rule == nullptr) {
        return;
    }
    double ignored = 0.0;
    const bool is_word = !text.empty() && is_first_row_ && slot >= 3 && is_type(names_[slot]) &&
                         parse_real(text, ignored) != nullptr &&
                         (lower(text.front()) >= 'a' && lower(text.front()) <= 'z');
    if (!is_word) {
        refuse(slot, quoted_text(text), rule);
    }
    has_words_[slot] = 1;
    row[slot] = index_of(text);
}

void ParticleRows::require_finite(const double *row) const {
    for (std::uint32_t slot = 0; slot < names_.size(); ++slot) {
        if (!std::isfinite(row[slot]) && !(is_scaled_ && slot < 3)) {
            refuse(slot, number_text(row[slot]), "must be finite");
        }
    }
}

void ParticleRows::unscale(double *row) const {
    const SimulationBox &box = *particles_.box;
    for (std::size_t i = 0; i < 3; ++i) {
        row[i] = box.origin[i];
        for (std::size_t edge = 0; edge < 3; ++edge) {
            row[i] += row[scaled_slots_[edge]] * box.edges[edge][i];
        }
        if (!std::isfinite(row[i])) {
            refuse(static_cast<std::uint32_t>(i), number_text(row[i]), "must be finite");
        }
    }
}

bool ParticleRows::is_wanted(const double *row) const {
    return std::all_of(bound_.begin(), bound_.end(), [row](const BoundCondition &condition) {
        return holds(condition.comparison, row[condition.slot], condition.number);
    });
}

void ParticleRows::add(double *row) {
    if (std::exchange(is_first_row_, false)) {
        check_words();
    }
    if (is_scaled_) {
        unscale(row);
    }
    if (!is_wanted(row)) {
        return;
    }
    if (kept_count() == largest_count) {
        throw Failure(ExitCode::scene, place_(0) + ": there are more than " + std::to_string(largest_count) +
                                           " particles: choose fewer by conditions");
    }
    particles_.positions.insert(particles_.positions.end(), row, row + 3);
    for (std::size_t i = 0; i < column_slots_.size(); ++i) {
        const double value = row[column_slots_[i]];
        if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
            refuse(column_slots_[i], number_text(value), "must fit a 32-bit floating point number");
        }
        particles_.columns[i].values.push_back(static_cast<float>(value));
    }
}

// Words may be those of a condition alone, or of particles that were not kept: numbers them anew, as they appear.
void ParticleRows::name_used_types() {
    constexpr float unknown = -1.0F;
    std::vector<float> numbers(words_.size(), unknown);
    for (std::size_t i = 0; i < column_slots_.size(); ++i) {
        if (has_words_[column_slots_[i]] == 0) {
            continue;
        }
        particles_.columns[i].has_words = true;
        for (float &value : particles_.columns[i].values) {
            float &number = numbers[static_cast<std::size_t>(value)];
            if (number == unknown) {
                number = static_cast<float>(particles_.type_names.size());
                particles_.type_names.push_back(words_[static_cast<std::size_t>(value)]);
            }
            value = number;
        }
    }
}

Particles ParticleRows::finish() {
    name_used_types();
    return std::move(particles_);
}

void ParticleRows::refuse(std::uint32_t slot, const std::string &value, const std::string &rule) const {
    throw Failure(ExitCode::scene, place_(slot) + ": " + names_[slot] + " = " + value + ": " + rule);
}

} // namespace cli
