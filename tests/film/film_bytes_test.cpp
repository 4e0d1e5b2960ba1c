#include "lib/film/film_bytes.h"

#include "lib/base/digest.h"
#include "tests/support/data_folder.h"
#include "tests/support/expected_error.h"
#include "tests/support/film_maker.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace {

using Bytes = std::vector<std::byte>;

// Another program wrote this film by FORMAT.md. The first of its two tiles has samples in both parts.
Bytes golden_film() {
    std::ifstream file(data_folder() + "/film/version-1.ptfilm", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

const pt::FilmHeader golden_header{film_maker::identity(7, 5),
                                   {{{0, 1, 3, 2},
                                     [] {
                                         pt::SampleSet samples({0, 5});
                                         samples.add(pt::SampleRange{20, 30});
                                         return samples;
                                     }()},
                                    {{3, 1, 2, 2}, pt::SampleSet({8, 10})}}};

// Part s has n samples. Pixel i rejects r = (i + s) mod 2 of them. The sum of channel c is (n - r) ((c + 1) 10^25 +
// 10^18 i + 977 s).
void set_part(pt::PixelSums &sums, std::uint32_t part, std::uint32_t samples, std::uint32_t s) {
    __extension__ using Wide = unsigned __int128;
    constexpr Wide ten_to_18 = 1'000'000'000'000'000'000U;
    for (std::uint32_t i = 0; i < sums.pixel_count(); ++i) {
        const std::uint32_t rejected = samples > 0 ? (i + s) % 2 : 0;
        const std::uint32_t accepted = samples - rejected;
        for (std::size_t c = 0; c < 3; ++c) {
            const Wide sum = accepted * ((c + 1) * ten_to_18 * 10'000'000U + i * ten_to_18 + s * 977U);
            for (std::size_t word = 0; word < 4; ++word)
                sums.plane(part, 4 * c + word)[i] = static_cast<std::uint32_t>(sum >> (32 * word));
        }
        sums.plane(part, pt::gpu::FILM_ACCEPTED)[i] = accepted;
        sums.plane(part, pt::gpu::FILM_REJECTED)[i] = rejected;
    }
}

std::vector<pt::PixelSums> golden_sums() {
    std::vector<pt::PixelSums> tiles(2);
    tiles[0].resize(6);
    set_part(tiles[0], pt::older_part, 5, 1);
    set_part(tiles[0], pt::newer_part, 10, 2);
    tiles[1].resize(4);
    set_part(tiles[1], pt::older_part, 2, 3);
    set_part(tiles[1], pt::newer_part, 0, 0);
    return tiles;
}

TEST(FilmBytes, Version1StaysReadable) {
    const Bytes bytes = golden_film();
    const pt::FilmReader film(bytes);
    EXPECT_TRUE(film.header() == golden_header) << pt::text_of(film.header());
    const std::vector<pt::PixelSums> expected = golden_sums();
    for (std::size_t tile = 0; tile < expected.size(); ++tile) {
        pt::PixelSums sums;
        sums.resize(expected[tile].pixel_count());
        film.read(tile, 0, sums);
        EXPECT_TRUE(sums == expected[tile]) << "tile " << tile;
    }
}

TEST(FilmBytes, EveryBitCounts) {
    const Bytes golden = golden_film();
    for (std::size_t bit = 0; bit < 8 * golden.size(); ++bit) {
        Bytes bytes = golden;
        bytes[bit / 8] ^= std::byte{1} << (bit % 8);
        ASSERT_EQ(error_of([&] { const pt::FilmReader film(bytes); }).code(), PT_ERROR_INCOMPATIBLE) << "bit " << bit;
    }
    const pt::FilmReader unharmed(golden);
}

Bytes sealed(const std::string &header, std::size_t sum_bytes) {
    const auto text = std::as_bytes(std::span(header));
    Bytes bytes(text.begin(), text.end());
    bytes.resize(text.size() + sum_bytes);
    const std::uint64_t checksum = pt::checksum(bytes);
    bytes.resize(bytes.size() + sizeof checksum);
    std::memcpy(&bytes[bytes.size() - sizeof checksum], &checksum, sizeof checksum);
    return bytes;
}

std::string with_planes(std::string header) {
    const std::string first = "pt film 1\n";
    return header.starts_with(first)
               ? header.insert(first.size(), "planes red 4 green 4 blue 4 accepted 1 rejected 1\n")
               : header;
}

TEST(FilmBytes, HeadersHaveOneForm) {
    constexpr std::size_t pixel_bytes = 56;
    const std::string range = ": must be a range of indices below 2^32 that begins after the end of the previous one";
    const struct {
        const char *header;
        std::string message;
    } cases[] = {
        {"", "film: these bytes are not a film"},
        {"pt film 1", "film: its header has no end"},
        {"pt film 2\n\n", "film: its version is not 1, which this library reads"},
        {"pt film 1\nseed \t1\n\n", "film: its header has bytes that are not printable ASCII"},
        {"pt film 1\ncoverage 1\ntile 0 0 1 1\nsamples 0 1\n\n", "film: its header is not in the prescribed form"},
        {"pt film 1\ntile 0 0 1\n\n", "film: tile is not four numbers"},
        {"pt film 1\ntile 0 0 1 -1\n\n", "film: tile is not four numbers"},
        {"pt film 1\ntile 0 0 1 0\n\n", "film: tile = 0 0 1 0: must have from 1 to 2^32 - 1 pixels"},
        {"pt film 1\ntile 0 0 65536 65536\n\n", "film: tile = 0 0 65536 65536: must have from 1 to 2^32 - 1 pixels"},
        {"pt film 1\nsamples 0 1\n\n", "film: samples are not two numbers after a tile"},
        {"pt film 1\ntile 0 0 1 1\nsamples 1 1\n\n", "film: samples = 1 1" + range},
        {"pt film 1\ntile 0 0 1 1\nsamples 0 4294967297\n\n", "film: samples = 0 4294967297" + range},
        {"pt film 1\ntile 0 0 1 1\nsamples 0 1\nsamples 1 2\n\n", "film: samples = 1 2" + range},
        {"pt film 1\ntile 0 0 1 1\nsamples 0 4294967296\n\n", "film: samples: a pixel holds at most 2^32 - 1"},
        {"pt film 1\ntile 0 0 1 1\n\n", "film: a tile has no samples"},
        {"pt film 1\ntile 18446744073709551615 0 2 1\nsamples 0 1\n\n",
         "film: tile = 18446744073709551615 0 2 1: must have from 1 to 2^32 - 1 pixels"},
        {"pt film 1\ntile 0 0 1 4294967295\nsamples 0 1\ntile 1 0 1 1\nsamples 0 1\n\n",
         "film: its tiles have more than 2^32 - 1 pixels"},
        {"pt film 1\nlamps 8 4 1\ntile 0 0 1 1\nsamples 0 1\n\n",
         "film: lamps are not two multiples of 8 and a number of samples"},
        {"pt film 1\nlamps 8 8 0\ntile 0 0 1 1\nsamples 0 1\n\n",
         "film: lamps are not two multiples of 8 and a number of samples"},
        {"pt film 1\nlamps 0 8 1\nlamps 8 0 1\ntile 0 0 1 1\nsamples 0 1\n\n",
         "film: its header is not in the prescribed form"},
        {"pt film 1\nlamps 8 0 1\nlamps 8 0 2\ntile 0 0 1 1\nsamples 0 1\n\n",
         "film: its header is not in the prescribed form"},
        {"pt film 1\ntile 0 0 1 01\nsamples 0 1\n\n", "film: its header is not in the prescribed form"},
        {"pt film 1\ntile 0 0 1 1\nsamples 0 1\nseed 1\n\n", "film: its header is not in the prescribed form"},
    };
    for (const auto &[header, message] : cases) {
        const Bytes bytes = sealed(with_planes(header), pixel_bytes);
        const pt::Error error = error_of([&] { const pt::FilmReader film(bytes); });
        EXPECT_EQ(error.code(), PT_ERROR_INCOMPATIBLE);
        EXPECT_EQ(error.what(), message) << header;
    }
    const std::string header = with_planes("pt film 1\nseed 1\ntile 0 0 1 1\nsamples 0 1\n\n");
    for (const std::size_t wrong : {pixel_bytes - 1, pixel_bytes + 1}) {
        const Bytes bytes = sealed(header, wrong);
        const pt::Error error = error_of([&] { const pt::FilmReader film(bytes); });
        EXPECT_TRUE(names(error, ": it is truncated, or other bytes follow")) << error.what();
    }
    const Bytes good = sealed(header, pixel_bytes);
    const pt::FilmReader film(good);
    pt::PixelSums sums;
    sums.resize(1);
    EXPECT_EQ(error_of([&] { film.read(0, 0, sums); }).code(), PT_ERROR_INCOMPATIBLE) << "a sample that is not there";
}

TEST(FilmBytes, HeadersHaveNoMoreLinesThanCanBeOfUse) {
    std::string facts = with_planes("pt film 1\n");
    for (int i = 0; i < 300'000; ++i)
        facts += "a \n";
    EXPECT_EQ(error_of([&] { pt::parsed_film_header(facts + '\n'); }).what(),
              std::string("film: its header has more than 100 lines with other names"));
}

} // namespace
