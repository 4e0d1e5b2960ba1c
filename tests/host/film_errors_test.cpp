// Tests of what is kept from look to look at a film: what a new look at all of it says.
#include "lib/film/film_errors.h"

#include "lib/film/film_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

namespace {

constexpr pt::TileGrid film_grid{45, 37}; // tiles and regions that are cut at the right and at the bottom
constexpr std::uint32_t samples_of_part = 16;

// A film of random sums.
pt::PixelSums random_film(std::uint32_t seed) {
    std::mt19937 random(seed);
    pt::PixelSums sums;
    sums.resize(std::size_t{film_grid.width} * film_grid.height);
    for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
        for (std::uint32_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane) {
            const bool is_top = plane % pt::gpu::FILM_SUM_WORDS == pt::gpu::FILM_SUM_WORDS - 1;
            for (std::uint32_t &word : sums.plane(part, plane))
                word = plane == pt::gpu::FILM_ACCEPTED   ? samples_of_part - seed % 2
                       : plane == pt::gpu::FILM_REJECTED ? seed % 2
                       : is_top                          ? 0
                                                         : static_cast<std::uint32_t>(random());
        }
    return sums;
}

pt::FilmErrors::ReadRows reader_of(const pt::PixelSums &film) {
    return [&film](std::uint32_t first_row, pt::PixelSums &rows) {
        rows.copy(film, std::size_t{first_row} * film_grid.width, rows.pixel_count(), 0);
    };
}

pt::TileSamples all_samples() {
    return pt::TileSamples(film_grid, pt::SampleSet(pt::SampleRange{0, 2 * samples_of_part}));
}

// What errors say of a film, and that it is what a first look says.
void expect_first_look(pt::FilmErrors &errors, const pt::TileSamples &samples, const pt::PixelSums &film) {
    pt::FilmErrors first;
    const std::span<const double> found = errors.tile_squares(samples, 1.0, reader_of(film));
    const std::span<const double> expected = first.tile_squares(samples, 1.0, reader_of(film));
    EXPECT_TRUE(std::ranges::equal(found, expected));
    EXPECT_GT(*std::ranges::max_element(expected), 0.0);
    const std::span<const pt::RegionErrors> regions = errors.regions(samples, 1.0, reader_of(film));
    const std::span<const pt::RegionErrors> expected_regions = first.regions(samples, 1.0, reader_of(film));
    ASSERT_EQ(regions.size(), 4U);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        EXPECT_EQ(regions[i].relative_square.sum, expected_regions[i].relative_square.sum) << i;
        EXPECT_EQ(regions[i].unseen, expected_regions[i].unseen) << i;
        EXPECT_EQ(regions[i].rejected, expected_regions[i].rejected) << i;
    }
}

TEST(FilmErrors, AreThoseOfAFirstLookWhereTilesHaveChanged) {
    pt::FilmErrors errors;
    pt::PixelSums film = random_film(2);
    pt::TileSamples samples = all_samples();
    expect_first_look(errors, samples, film);

    // Tiles 7 and 25 take the sums of another film, of which one sample of each pixel was left out.
    const pt::PixelSums other = random_film(3);
    for (const std::size_t tile : {7, 25}) {
        const pt::Rectangle pixels = film_grid.pixels(tile);
        for (std::size_t y = pixels.y; y < pixels.y + pixels.height; ++y)
            for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
                for (std::uint32_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane)
                    std::ranges::copy(other.plane(part, plane).subspan(y * film_grid.width + pixels.x, pixels.width),
                                      film.plane(part, plane).subspan(y * film_grid.width + pixels.x).begin());
        samples.set(tile, pt::SampleSet(pt::SampleRange{0, 2 * samples_of_part + 1}));
    }
    expect_first_look(errors, samples, film);
}

// Not told of the change, they go by what they have kept.
TEST(FilmErrors, KeepWhatTheyKnowOfTilesWithTheSameSamples) {
    pt::FilmErrors errors;
    const pt::PixelSums film = random_film(2);
    const std::span<const double> found = errors.tile_squares(all_samples(), 1.0, reader_of(film));
    const std::vector<double> before(found.begin(), found.end());
    const pt::PixelSums other = random_film(4);
    EXPECT_TRUE(std::ranges::equal(errors.tile_squares(all_samples(), 1.0, reader_of(other)), before));
    errors.forget();
    expect_first_look(errors, all_samples(), other);
}

TEST(FilmErrors, AreThoseOfAFirstLookAfterOneThatFailed) {
    const pt::PixelSums film = random_film(2);
    const pt::PixelSums other = random_film(4);
    for (const std::uint32_t failing_row : {0, 16}) {
        pt::FilmErrors errors;
        expect_first_look(errors, all_samples(), film);
        errors.forget();
        const auto read = [&](std::uint32_t first_row, pt::PixelSums &rows) {
            if (first_row >= failing_row)
                throw std::runtime_error("a device is lost");
            reader_of(other)(first_row, rows);
        };
        EXPECT_THROW(errors.tile_squares(all_samples(), 1.0, read), std::runtime_error);
        expect_first_look(errors, all_samples(), other);
    }
}

} // namespace
