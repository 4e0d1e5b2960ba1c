#include "cli/data/lammps_dump.h"

#include "cli/base/exit_code.h"
#include "cli/data/text_number.h"
#include "cli/data/text_rows.h"

#include <algorithm>
#include <array>
#include <span>

namespace cli {
namespace {

constexpr std::string_view item_mark = "ITEM: ";

// Wrapped into the box or not, and as shares of its edges or not.
constexpr std::array<PositionNames, 4> lammps_positions{
    {{{"x", "y", "z"}, false}, {{"xu", "yu", "zu"}, false}, {{"xs", "ys", "zs"}, true}, {{"xsu", "ysu", "zsu"}, true}}};

// Of lines "lo hi" with, if tilted, a third number each: xy, xz and yz. What lo and hi bound then is the tilted box,
// not its edges (docs.lammps.org/Howto_triclinic.html):
//   xlo_bound = xlo + min(0, xy, xz, xy + xz),   xhi_bound = xhi + max(0, xy, xz, xy + xz),
//   ylo_bound = ylo + min(0, yz),                yhi_bound = yhi + max(0, yz).
SimulationBox restricted_box(const std::vector<std::vector<double>> &lines, bool tilted) {
    const double xy = tilted ? lines[0][2] : 0.0;
    const double xz = tilted ? lines[1][2] : 0.0;
    const double yz = tilted ? lines[2][2] : 0.0;
    const auto [x_low, x_high] = std::minmax({0.0, xy, xz, xy + xz});
    const auto [y_low, y_high] = std::minmax({0.0, yz});
    SimulationBox box;
    box.origin = {lines[0][0] - x_low, lines[1][0] - y_low, lines[2][0]};
    box.edges[0] = {lines[0][1] - x_high - box.origin[0], 0.0, 0.0};
    box.edges[1] = {xy, lines[1][1] - y_high - box.origin[1], 0.0};
    box.edges[2] = {xz, yz, lines[2][1] - box.origin[2]};
    return box;
}

// Of lines with an edge and a component of the origin each.
SimulationBox general_box(const std::vector<std::vector<double>> &lines) {
    SimulationBox box;
    for (std::size_t i = 0; i < 3; ++i) {
        std::copy_n(lines[i].begin(), 3, box.edges[i].begin());
        box.origin[i] = lines[i][3];
    }
    return box;
}

} // namespace

void LammpsDump::refuse(const std::string &what) const {
    throw Failure(ExitCode::scene, stream().line_place() + ": " + what);
}

std::string_view LammpsDump::require_line() {
    std::string_view line;
    if (!stream().next_line(line) || !stream().was_line_ended()) {
        refuse("the file ends within the head of a frame: it was cut short");
    }
    return line;
}

std::vector<std::vector<double>> LammpsDump::read_box_lines(std::size_t count) {
    std::vector<std::vector<double>> lines;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string_view line = require_line();
        lines.push_back(read_line_numbers(stream(), line));
        if (lines.back().size() != count) {
            refuse(quoted_text(line) + ": the box has " + std::to_string(count) + " numbers in a line");
        }
    }
    return lines;
}

// "pp pp ff", after "xy xz yz" if the box is tilted, or "abc origin pp pp ff" if its edges are free.
void LammpsDump::read_box(std::string_view flags) {
    const std::vector<std::string> words = split_at_blanks(flags);
    const auto begins_with = [&words](std::initializer_list<std::string_view> names) {
        return words.size() >= names.size() && std::equal(names.begin(), names.end(), words.begin());
    };
    const bool tilted = begins_with({"xy", "xz", "yz"});
    const bool general = begins_with({"abc", "origin"});
    const std::span<const std::string> boundaries = std::span(words).subspan(tilted ? 3 : general ? 2 : 0);
    if (!boundaries.empty() && boundaries.size() != 3) {
        refuse("BOX BOUNDS " + quoted_text(flags) +
               ": must have a boundary for each of three directions, like pp pp ff");
    }
    box_ = general ? general_box(read_box_lines(4)) : restricted_box(read_box_lines(tilted ? 3 : 2), tilted);
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
        box_->periodic[i] = boundaries[i] == "pp";
    }
}

void LammpsDump::read_item(std::string_view item) {
    constexpr std::string_view box = "BOX BOUNDS";
    constexpr std::string_view atoms = "ATOMS";
    if (item == "NUMBER OF ATOMS") {
        count_ = read_line_count(stream(), require_line(), "the number of atoms");
    } else if (item.starts_with(box)) {
        read_box(item.substr(box.size()));
    } else if (item.starts_with(atoms)) {
        columns_ = split_at_blanks(item.substr(atoms.size()));
        has_columns_ = true;
    } else if (item == "TIMESTEP" || item == "UNITS" || item == "TIME") {
        require_line();
    } else {
        refuse("ITEM: " + quoted_text(item) + ": is none of a dump of atoms");
    }
}

bool LammpsDump::next() {
    count_.reset();
    box_.reset();
    has_columns_ = false;
    std::string_view line;
    while (!has_columns_) {
        const bool is_first = !count_ && !box_;
        if (!stream().next_line(line)) {
            if (!is_first) {
                refuse("the file ends within the head of a frame: it was cut short");
            }
            return false;
        }
        if (is_first && line.find_first_not_of(" \t") == std::string_view::npos) {
            continue; // at the end of a file
        }
        if (!line.starts_with(item_mark)) {
            refuse(quoted_text(line) + ": must begin with ITEM:");
        }
        if (!stream().was_line_ended()) {
            refuse("the file ends within the head of a frame: it was cut short");
        }
        const std::string item(line.substr(item_mark.size())); // the next line takes the place of this one
        read_item(item);
    }
    if (!count_) {
        refuse("ITEM: ATOMS comes before ITEM: NUMBER OF ATOMS");
    }
    return true;
}

void LammpsDump::skip() {
    skip_rows(stream(), *count_);
}

void LammpsDump::read(ParticleRows &rows) {
    rows.set_place([this](std::uint32_t) { return stream().line_place(); });
    if (columns_.empty()) {
        refuse("ITEM: ATOMS: there are no names of columns");
    }
    const bool has_box = box_.has_value();
    rows.begin_frame(columns_, std::span(lammps_positions).first(has_box ? 4 : 2), box_);
    read_rows(stream(), {*count_, columns_.size(), false, true}, rows);
}

} // namespace cli
