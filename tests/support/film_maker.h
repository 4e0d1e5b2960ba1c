#pragma once

#include "lib/base/digest.h"
#include "lib/film/film_bytes.h"
#include "lib/film/sample_set.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace film_maker {

using Bytes = std::vector<std::byte>;
using Pixel = std::pair<std::uint32_t, std::uint32_t>;
using Samples = std::map<Pixel, std::set<std::uint32_t>>;

inline pt::FilmIdentity identity(std::uint32_t width, std::uint32_t height, bool has_coverage = false) {
    pt::FilmIdentity facts{{"scene", "00112233445566778899aabbccddeeff"},
                           {"camera", "ffeeddccbbaa99887766554433221100"},
                           {"width", std::to_string(width)},
                           {"height", std::to_string(height)},
                           {"max_path_length", "6"},
                           {"seed", "18446744073709551615"},
                           {"estimator", "5"},
                           {"sampler", "4"},
                           {"unit_exponent", "-3"},
                           {"estimator_version", "1"},
                           {"kernel", "0123456789abcdef0123456789abcdef"},
                           {"device", "a device, its driver 1.2"}};
    if (has_coverage)
        facts.insert(facts.begin() + 8, {"coverage", "1"});
    return facts;
}

inline pt::SampleSet set_of(const std::set<std::uint32_t> &indices) {
    pt::SampleSet samples;
    for (const std::uint32_t index : indices)
        samples.add(pt::SampleRange{index, std::uint64_t{index} + 1});
    return samples;
}

inline std::uint64_t mixed(std::uint64_t number) {
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9U;
    number = (number ^ (number >> 27)) * 0x94d049bb133111ebU;
    return number ^ (number >> 31);
}

inline bool is_rejected(const Pixel &pixel, std::uint32_t index) {
    return mixed(pixel.first * 7919U + pixel.second * 104729U + index) % 16 == 0;
}

// Two of 3 samples hit a surface.
inline bool is_covered(const Pixel &pixel, std::uint32_t index) {
    return mixed(pixel.first * 104729U + pixel.second * 7919U + index) % 3 != 0;
}

inline std::uint32_t covered_of(const Pixel &pixel, const std::set<std::uint32_t> &indices) {
    return static_cast<std::uint32_t>(
        std::ranges::count_if(indices, [&](std::uint32_t index) { return is_covered(pixel, index); }));
}

__extension__ using Wide = unsigned __int128;

// Values are in units of 2^-60, and below 2^24.
inline Wide value_of(const Pixel &pixel, std::uint32_t index, std::uint32_t channel) {
    const std::uint64_t key = ((std::uint64_t{pixel.first} << 20 | pixel.second) << 34) ^ (std::uint64_t{index} << 2);
    return Wide{mixed(key | channel)} << (mixed(key + 3) % 20);
}

inline void set_pixel(pt::PixelSums &sums, std::size_t at, const Pixel &pixel, const std::set<std::uint32_t> &indices,
                      std::uint64_t split) {
    Wide totals[2][3] = {};
    std::uint32_t counts[2][2] = {};
    for (const std::uint32_t index : indices) {
        const std::uint32_t part = index < split ? pt::older_part : pt::newer_part;
        const bool rejected = is_rejected(pixel, index);
        ++counts[part][rejected ? 1 : 0];
        for (std::uint32_t channel = 0; channel < 3 && !rejected; ++channel)
            totals[part][channel] += value_of(pixel, index, channel);
    }
    for (std::uint32_t part = 0; part < 2; ++part) {
        for (std::size_t word = 0; word < 12; ++word)
            sums.plane(part, word)[at] = static_cast<std::uint32_t>(totals[part][word / 4] >> (32 * (word % 4)));
        sums.plane(part, pt::gpu::FILM_ACCEPTED)[at] = counts[part][0];
        sums.plane(part, pt::gpu::FILM_REJECTED)[at] = counts[part][1];
    }
    if (sums.has_coverage())
        sums.plane(pt::gpu::FILM_COVERED)[at] = covered_of(pixel, indices);
}

inline Bytes film_of(const pt::FilmIdentity &identity, const std::vector<pt::Rectangle> &tiles, const Samples &samples,
                     const std::vector<pt::LampSquare> &lamps = {}) {
    pt::FilmHeader header{identity, {}, {}, lamps};
    for (const pt::Rectangle &tile : tiles)
        header.tiles.push_back({tile, set_of(samples.at({tile.y, tile.x}))});
    Bytes bytes(pt::FilmLayout(header).size_bytes());
    pt::FilmWriter writer(header, bytes);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const auto &[x, y, width, height] = tiles[i];
        pt::PixelSums sums;
        sums.resize(tiles[i].pixel_count(), pt::has_coverage(identity));
        const std::uint64_t split = pt::split_of(header.tiles[i].samples.hull());
        for (std::uint32_t row = 0; row < height; ++row)
            for (std::uint32_t column = 0; column < width; ++column)
                set_pixel(sums, std::size_t{row} * width + column, {y + row, x + column},
                          samples.at({y + row, x + column}), split);
        writer.write(i, 0, sums);
    }
    writer.end();
    return bytes;
}

inline std::vector<pt::Rectangle> tiles_of(const Samples &samples) {
    std::vector<pt::Rectangle> tiles;
    const auto at = [&](std::int64_t row, std::int64_t column) -> const std::set<std::uint32_t> * {
        const auto found = row < 0 || column < 0
                               ? samples.end()
                               : samples.find({static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column)});
        return found == samples.end() ? nullptr : &found->second;
    };
    const auto same = [&](std::int64_t row, std::int64_t column, const std::set<std::uint32_t> &set) {
        const std::set<std::uint32_t> *other = at(row, column);
        return other && *other == set;
    };
    for (const auto &[pixel, set] : samples) {
        const auto [row, column] = pixel;
        if (same(row, std::int64_t{column} - 1, set))
            continue;
        std::uint32_t end = column + 1;
        while (same(row, end, set))
            ++end;
        const pt::Rectangle run{column, row, end - column, 1};
        const auto above = std::find_if(tiles.begin(), tiles.end(), [&](const pt::Rectangle &tile) {
            return tile.x == run.x && tile.width == run.width && tile.y + tile.height == row &&
                   same(tile.y, tile.x, set);
        });
        if (above != tiles.end())
            ++above->height;
        else
            tiles.push_back(run);
    }
    return tiles;
}

} // namespace film_maker
