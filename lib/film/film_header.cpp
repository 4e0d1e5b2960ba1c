#include "lib/film/film_header.h"

#include "lib/base/error.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <tuple>
#include <utility>

namespace pt {

namespace {

constexpr std::string_view first_line_start = "pt film ";
constexpr std::string_view version = "1";
constexpr std::string_view planes_line = "planes red 4 green 4 blue 4 accepted 1 rejected 1";
static_assert(3 * gpu::FILM_SUM_WORDS == gpu::FILM_ACCEPTED && gpu::FILM_REJECTED + 1 == gpu::FILM_WORDS);
constexpr std::string_view covered_plane = " covered 1";
constexpr std::string_view tile_name = "tile";
constexpr std::string_view samples_name = "samples";
constexpr std::string_view round_name = "round";
constexpr std::string_view lamps_name = "lamps";

constexpr std::uint64_t max_round = 10'000;

// Limits the memory of the parser, which is many times the text's length.
constexpr std::size_t max_facts = 100;

[[noreturn]] void refuse(const std::string &message) {
    throw Error(PT_ERROR_INCOMPATIBLE, "film: " + message);
}

std::string_view take_line(std::string_view &text) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos)
        refuse("its header has no end");
    const std::string_view line = text.substr(0, end);
    if (!std::ranges::all_of(line, [](char letter) { return letter >= ' ' && letter <= '~'; }))
        refuse("its header has bytes that are not printable ASCII");
    text.remove_prefix(end + 1);
    return line;
}

template <std::size_t Count>
std::optional<std::array<std::uint64_t, Count>> numbers(std::string_view text) {
    std::array<std::uint64_t, Count> values{};
    const char *place = text.data();
    const char *const end = text.data() + text.size();
    for (std::size_t i = 0; i < Count; ++i) {
        if (i > 0 && (place == end || *place++ != ' '))
            return std::nullopt;
        const auto [next, error] = std::from_chars(place, end, values[i]);
        if (error != std::errc{})
            return std::nullopt;
        place = next;
    }
    return place == end ? std::optional(values) : std::nullopt;
}

void read_tile(std::string_view value, FilmHeader &header) {
    const auto sides = numbers<4>(value);
    if (!sides)
        refuse("tile is not four numbers");
    const auto [x, y, width, height] = *sides;
    const bool lies_within_an_image =
        x <= UINT32_MAX && y <= UINT32_MAX && width <= UINT32_MAX - x && height <= UINT32_MAX - y;
    if (!lies_within_an_image || width == 0 || height == 0 || width > UINT32_MAX / height)
        refuse("tile = " + std::string(value) + ": must have from 1 to 2^32 - 1 pixels");
    header.tiles.push_back({{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                             static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)},
                            {}});
}

void read_samples(std::string_view value, FilmHeader &header) {
    const auto ends = numbers<2>(value);
    if (!ends || header.tiles.empty())
        refuse("samples are not two numbers after a tile");
    const SampleRange range{(*ends)[0], (*ends)[1]};
    SampleSet &samples = header.tiles.back().samples;
    const bool follows = samples.empty() || samples.hull().end < range.first;
    if (range.first >= range.end || range.end > sample_index_end || !follows)
        refuse("samples = " + std::string(value) +
               ": must be a range of indices below 2^32 that begins after the end of the previous one");
    samples.add(range);
}

void read_round(std::string_view value, FilmHeader &header) {
    const bool negative = value.starts_with('-');
    const auto round = numbers<2>(value.substr(negative ? 1 : 0));
    if (!round || (*round)[0] > max_round || (*round)[1] > UINT32_MAX)
        refuse("round is not a number of at most " + std::to_string(max_round) + " and a number of samples");
    const auto number = static_cast<std::int32_t>((*round)[0]);
    header.round = {negative ? -number : number, (*round)[1]};
}

void read_lamps(std::string_view value, FilmHeader &header) {
    const auto lamps = numbers<3>(value);
    if (!lamps || std::ranges::any_of(*lamps, [](std::uint64_t number) { return number > UINT32_MAX; }) ||
        (*lamps)[0] % lamp_square != 0 || (*lamps)[1] % lamp_square != 0 || (*lamps)[2] == 0)
        refuse("lamps are not two multiples of " + std::to_string(lamp_square) + " and a number of samples");
    header.lamps.push_back({static_cast<std::uint32_t>((*lamps)[0]), static_cast<std::uint32_t>((*lamps)[1]),
                            static_cast<std::uint32_t>((*lamps)[2])});
}

void require_counts(const std::vector<FilmTile> &tiles) {
    std::uint64_t pixels = 0;
    for (const FilmTile &tile : tiles) {
        pixels += tile.pixels.pixel_count();
        if (pixels > UINT32_MAX)
            refuse("its tiles have more than 2^32 - 1 pixels");
        if (tile.samples.empty())
            refuse("a tile has no samples");
        if (tile.samples.count() > UINT32_MAX)
            refuse("samples: a pixel holds at most 2^32 - 1");
    }
}

} // namespace

bool has_coverage(const FilmIdentity &identity) {
    return std::ranges::find(identity, FilmFact{"coverage", "1"}) != identity.end();
}

std::vector<LampSquare> united(std::vector<LampSquare> lamps) {
    const auto place = [](const LampSquare &square) { return std::pair(square.y, square.x); };
    std::ranges::sort(lamps, [&](const LampSquare &a, const LampSquare &b) {
        return std::tuple(place(a), b.samples) < std::tuple(place(b), a.samples);
    });
    const auto is_same = [&](const LampSquare &a, const LampSquare &b) { return place(a) == place(b); };
    lamps.erase(std::unique(lamps.begin(), lamps.end(), is_same), lamps.end());
    return lamps;
}

std::string text_of(const FilmHeader &header) {
    std::string text = std::string(first_line_start).append(version) + '\n';
    text.append(planes_line).append(has_coverage(header.identity) ? covered_plane : "") += '\n';
    for (const FilmFact &fact : header.identity)
        text += fact.name + ' ' + fact.value + '\n';
    if (header.round.number != AdaptiveRound::none)
        text += std::string(round_name) + ' ' + std::to_string(header.round.number) + ' ' +
                std::to_string(header.round.floor) + '\n';
    for (const LampSquare &lamps : header.lamps)
        text += std::string(lamps_name) + ' ' + std::to_string(lamps.x) + ' ' + std::to_string(lamps.y) + ' ' +
                std::to_string(lamps.samples) + '\n';
    for (const FilmTile &tile : header.tiles) {
        text.append(tile_name);
        for (const std::uint32_t side : {tile.pixels.x, tile.pixels.y, tile.pixels.width, tile.pixels.height})
            text += ' ' + std::to_string(side);
        text += '\n';
        for (const SampleRange &range : tile.samples.ranges())
            text +=
                std::string(samples_name) + ' ' + std::to_string(range.first) + ' ' + std::to_string(range.end) + '\n';
    }
    return text + '\n';
}

FilmHeader parsed_film_header(std::string_view text) {
    std::string_view rest = text;
    if (!text.starts_with(first_line_start))
        refuse("these bytes are not a film");
    const std::string_view first = take_line(rest);
    if (first.substr(first_line_start.size()) != version)
        refuse("its version is not " + std::string(version) + ", which this library reads");
    if (const std::string_view planes = take_line(rest);
        planes != planes_line && planes != std::string(planes_line).append(covered_plane))
        refuse("its planes are not \"" + std::string(planes_line) + "\", with or without \"" +
               std::string(covered_plane.substr(1)) + "\", which this library reads");
    FilmHeader header;
    for (std::string_view line = take_line(rest); !line.empty(); line = take_line(rest)) {
        const std::size_t blank = std::min(line.find(' '), line.size());
        const std::string_view name = line.substr(0, blank);
        const std::string_view value = line.substr(std::min(blank + 1, line.size()));
        if (name == tile_name)
            read_tile(value, header);
        else if (name == samples_name)
            read_samples(value, header);
        else if (name == round_name)
            read_round(value, header);
        else if (name == lamps_name)
            read_lamps(value, header);
        else if (header.identity.size() < max_facts)
            header.identity.push_back({std::string(name), std::string(value)});
        else
            refuse("its header has more than " + std::to_string(max_facts) + " lines with other names");
    }
    require_counts(header.tiles);
    if (header.lamps != united(header.lamps) || text_of(header) != text)
        refuse("its header is not in the prescribed form");
    return header;
}

} // namespace pt
