// Radii and colours that particles have by columns, types and elements.
#include "cli/data/element_data.h"
#include "cli/data/number_colours.h"
#include "cli/data/particle_colour.h"
#include "cli/data/particle_radius.h"
#include "cli/data/periodic_wrap.h"
#include "cli/data/typical_radius.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using cli::ColourSource;
using cli::ParticleColour;
using cli::ParticleColumn;
using cli::ParticleRadius;
using cli::Particles;
using cli::RadiusSource;
using Bytes = std::vector<std::uint8_t>;

// Particles in a row, so far apart.
Particles row_of(std::size_t count, double distance, std::vector<ParticleColumn> columns = {},
                 std::vector<std::string> words = {}) {
    Particles particles;
    for (std::size_t i = 0; i < count; ++i)
        particles.positions.insert(particles.positions.end(), {distance * static_cast<double>(i), 0.0, 0.0});
    particles.columns = std::move(columns);
    particles.type_names = std::move(words);
    return particles;
}

Particles water(double distance) {
    return row_of(3, distance, {{"element", {0, 1, 1}, true}}, {"O", "H"});
}

Particles numbered(std::vector<float> types) {
    const std::size_t count = types.size();
    return row_of(count, 1.0, {{"type", std::move(types), false}});
}

std::vector<float> shown_radii(const Particles &particles, const ParticleRadius &radius) {
    return cli::radii_of(particles, resolved(radius, particles));
}

Bytes shown_colours(const Particles &particles, const ParticleColour &colour) {
    return cli::colours_of(particles, resolved(colour, particles));
}

template <typename Work>
std::string refusal(Work work) {
    try {
        work();
    } catch (const std::invalid_argument &error) {
        return error.what();
    }
    return "";
}

ParticleColour by_column(const std::string &column) {
    ParticleColour colour;
    colour.source = ColourSource::map;
    colour.columns = {column};
    return colour;
}

ParticleColour by_type() {
    ParticleColour colour;
    colour.source = ColourSource::type;
    colour.columns = {"type"};
    return colour;
}

// Some entries of the three sources: a row that is shifted, or a digit that is wrong at the ends, shows.
TEST(ElementData, IsThatOfItsSources) {
    struct Entry {
        const char *symbol;
        float van_der_waals;
        float covalent;
        std::uint32_t colour;
    };
    for (const Entry &each :
         {Entry{"H", 1.20F, 0.31F, 0xffffff}, Entry{"C", 1.77F, 0.76F, 0x909090}, Entry{"N", 1.66F, 0.71F, 0x3050f8},
          Entry{"O", 1.50F, 0.66F, 0xff0d0d}, Entry{"Si", 2.19F, 1.11F, 0xf0c8a0}, Entry{"Fe", 2.44F, 1.32F, 0xe06633},
          Entry{"Au", 2.32F, 1.36F, 0xffd123}, Entry{"U", 2.71F, 1.96F, 0x008fff}}) {
        const cli::ElementData *element = cli::find_element(each.symbol);
        ASSERT_NE(element, nullptr) << each.symbol;
        EXPECT_EQ(element->van_der_waals_radius, each.van_der_waals) << each.symbol;
        EXPECT_EQ(element->covalent_radius, each.covalent) << each.symbol;
        EXPECT_EQ(element->colour, each.colour) << each.symbol;
    }
    for (const char *none : {"", "h", "Water", "X", "1"})
        EXPECT_EQ(cli::find_element(none), nullptr) << none;
}

TEST(ParticleRadius, ComesFromTheFirstThatThereIs) {
    Particles particles = water(1.0);
    EXPECT_EQ(shown_radii(particles, {}), (std::vector<float>{0.66F, 0.31F, 0.31F}));
    particles.columns.push_back({"radius", {3, 2, 1}, false});
    EXPECT_EQ(shown_radii(particles, {}), (std::vector<float>{3, 2, 1}));
    EXPECT_EQ(shown_radii(numbered({1, 2}), {}), (std::vector<float>{0.5F}));
    // In nanometres or metres, covalent radii in angstroms would be nonsense.
    EXPECT_EQ(shown_radii(water(0.1), {}), (std::vector<float>{0.05F}));
    EXPECT_EQ(shown_radii(water(100.0), {}), (std::vector<float>{50.0F}));
    // One type that is no element has no radius to go with the others.
    EXPECT_EQ(shown_radii(row_of(2, 1.0, {{"element", {0, 1}, true}}, {"O", "water"}), {}), (std::vector<float>{0.5F}));
}

TEST(ParticleRadius, IsScaled) {
    ParticleRadius radius{RadiusSource::van_der_waals, 0.5, {}, {}};
    EXPECT_EQ(shown_radii(water(1.0), radius), (std::vector<float>{0.75F, 0.6F, 0.6F}));
    EXPECT_EQ(shown_radii(numbered({1, 2}), {RadiusSource::column, 2.0, "type", {}}), (std::vector<float>{2, 4}));
    EXPECT_EQ(shown_radii(water(1.0), {RadiusSource::constant, 0.25, {}, {}}), (std::vector<float>{0.25F}));
}

TEST(ParticleRadius, HasTables) {
    const ParticleRadius by_number{RadiusSource::types, 2.0, {}, {{"1", 0.5}, {"2", 0.75}}};
    EXPECT_EQ(shown_radii(numbered({2, 1, 2}), by_number), (std::vector<float>{1.5F, 1, 1.5F}));
    EXPECT_EQ(refusal([&] {
                  shown_radii(numbered({1, 3}), by_number);
              }),
              "the type 3 is none of those with a radius, 1 and 2");
    const ParticleRadius by_word{RadiusSource::types, 1.0, {}, {{"H", 0.5}, {"O", 1.0}}};
    EXPECT_EQ(shown_radii(water(1.0), by_word), (std::vector<float>{1, 0.5F, 0.5F}));
    EXPECT_EQ(
        refusal([] {
            shown_radii(row_of(1, 1.0, {{"element", {0}, true}}, {"Po"}), {RadiusSource::van_der_waals, 1.0, {}, {}});
        }),
        "the type Po: must be an element whose radius is known");
}

// A lattice whose spacing is known, in one, two and three dimensions.
TEST(TypicalRadius, IsHalfOfTheSpacing) {
    for (int dimensions = 0; dimensions <= 3; ++dimensions) {
        std::vector<double> positions;
        for (int x = 0; x < (dimensions > 0 ? 9 : 1); ++x)
            for (int y = 0; y < (dimensions > 1 ? 9 : 1); ++y)
                for (int z = 0; z < (dimensions > 2 ? 9 : 1); ++z)
                    positions.insert(positions.end(), {1e6 + 0.75 * x, 0.75 * y, -0.75 * z});
        EXPECT_EQ(cli::typical_radius(positions), dimensions == 0 ? 1.0 : 0.375) << dimensions;
    }
    EXPECT_EQ(cli::typical_radius(std::vector<double>{1, 2, 3, 1, 2, 3}), 1.0); // no two are apart
}

// The median of the distances to the n-th neighbour, of all pairs.
double median_distance(const std::vector<double> &positions, std::size_t n) {
    const std::size_t count = positions.size() / 3;
    std::vector<double> nth;
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<double> distances;
        for (std::size_t j = 0; j < count; ++j)
            distances.push_back(std::hypot(positions[3 * i] - positions[3 * j],
                                           positions[3 * i + 1] - positions[3 * j + 1],
                                           positions[3 * i + 2] - positions[3 * j + 2]));
        std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(n), distances.end());
        nth.push_back(distances[n]); // the first is 0, of itself
    }
    std::nth_element(nth.begin(), nth.begin() + static_cast<std::ptrdiff_t>(count / 2), nth.end());
    return nth[count / 2];
}

TEST(TypicalRadius, IsTheMedianOfAll) {
    std::mt19937 random(20261123);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<double> lattice;
    std::vector<double> cloud;
    std::vector<double> surface;
    for (int i = 0; i < 1000; ++i) {
        lattice.insert(lattice.end(), {i % 10 + 0.2 * share(random), i / 10 % 10 + 0.2 * share(random),
                                       i / 100 + 0.2 * share(random)});
        cloud.insert(cloud.end(), {3.0 * share(random), share(random), 0.2 * share(random)});
        surface.insert(surface.end(), {share(random), 2.5, 2.0 * share(random)});
    }
    EXPECT_NEAR(cli::typical_radius(lattice), 0.5 * median_distance(lattice, 1), 1e-15);
    EXPECT_NEAR(cli::typical_radius(cloud), 0.5 * median_distance(cloud, 4), 1e-15);
    EXPECT_NEAR(cli::typical_radius(surface), 0.5 * median_distance(surface, 4), 1e-15);
}

TEST(ParticleColour, OfElementsIsJmols) {
    EXPECT_EQ(shown_colours(water(1.0), {}), (Bytes{255, 13, 13, 255, 255, 255, 255, 255, 255}));
    // "type" is what the file has as such, also where that is numbers beside the elements.
    Particles both = water(1.0);
    both.columns.push_back({"type", {1, 2, 2}, false});
    EXPECT_EQ(shown_colours(both, {})[1], 13);
    EXPECT_EQ(shown_colours(both, by_type()), (Bytes{0, 114, 178, 230, 159, 0, 230, 159, 0}));
}

// The same type has the same colour whatever other types are shown: 8 has the first again, and 0 the last.
TEST(ParticleColour, OfTypesFollowsTheirNumbers) {
    EXPECT_EQ(shown_colours(numbered({1, 2, 7, 8, 0}), by_type()),
              (Bytes{0, 114, 178, 230, 159, 0, 240, 228, 66, 0, 114, 178, 240, 228, 66}));
    EXPECT_EQ(shown_colours(numbered({2}), by_type()), (Bytes{230, 159, 0}));
    const auto words = row_of(2, 1.0, {{"element", {1, 0}, true}}, {"water", "ice"});
    EXPECT_EQ(shown_colours(words, {}), (Bytes{230, 159, 0, 0, 114, 178}));
    const auto named = type_colours(words, resolved(ParticleColour{}, words));
    ASSERT_EQ(named.size(), 2U);
    EXPECT_EQ(named[0].name, "water");
    EXPECT_EQ(named[1].colour, (cli::DisplayColour{230, 159, 0}));
}

TEST(ParticleColour, HasTables) {
    ParticleColour colour = by_type();
    colour.types = {{"1", {1, 2, 3}}, {"2", {4, 5, 6}}, {"9", {}}};
    EXPECT_EQ(shown_colours(numbered({2, 1}), colour), (Bytes{4, 5, 6, 1, 2, 3}));
    EXPECT_EQ(refusal([&] {
                  shown_colours(numbered({1, 4}), colour);
              }),
              "the type 4 is none of those with a colour, 1, 2 and 9");
}

TEST(ParticleColour, GoesFromTheLeastToTheLargest) {
    const Particles particles = row_of(3, 1.0, {{"vx", {-2, 4, 1}, false}});
    const auto known = resolved(by_column("vx"), particles);
    EXPECT_EQ(*known.range, (std::array<double, 2>{-2, 4}));
    const auto middle = cli::map_colour("viridis", 0.5);
    EXPECT_EQ(cli::colours_of(particles, known),
              (Bytes{0x44, 0x01, 0x54, 0xfd, 0xe7, 0x25, middle[0], middle[1], middle[2]}));
    ParticleColour given = by_column("vx");
    given.range = {1, 2};
    given.map = "magma";
    EXPECT_EQ(shown_colours(particles, given), (Bytes{0, 0, 4, 0xfc, 0xfd, 0xbf, 0, 0, 4})); // clamped at both ends
    // All alike: the middle.
    EXPECT_EQ(shown_colours(row_of(1, 1.0, {{"vx", {7}, false}}), by_column("vx")),
              (Bytes{middle[0], middle[1], middle[2]}));
    // A column of words has the colours of types.
    ParticleColour words = by_column("element");
    words.range = std::nullopt;
    EXPECT_EQ(shown_colours(water(1.0), words)[0], 255);
}

TEST(ParticleColour, TakesRedGreenAndBlue) {
    Particles particles = row_of(1, 1.0, {{"red", {1}, false}, {"green", {0.5F}, false}, {"blue", {0}, false}});
    EXPECT_EQ(shown_colours(particles, {}), (Bytes{255, 128, 0}));
    particles.columns[0].values = {51};
    EXPECT_EQ(shown_colours(particles, {}), (Bytes{51, 1, 0})); // of 255, as one is above 1
    EXPECT_TRUE(shown_colours(row_of(1, 1.0), {}).empty());     // grey for all
    EXPECT_EQ(resolved(ParticleColour{}, row_of(1, 1.0)).source, ColourSource::constant);
}

// The ends of the maps as their authors publish them, and every map grows brighter.
TEST(NumberColours, AreThePublishedMaps) {
    EXPECT_EQ(cli::map_colour("viridis", -1.0), (cli::DisplayColour{0x44, 0x01, 0x54}));
    EXPECT_EQ(cli::map_colour("viridis", 2.0), (cli::DisplayColour{0xfd, 0xe7, 0x25}));
    EXPECT_EQ(cli::map_colour("magma", 1.0), (cli::DisplayColour{0xfc, 0xfd, 0xbf}));
    EXPECT_EQ(cli::map_colour("cividis", 0.0), (cli::DisplayColour{0x00, 0x22, 0x4e}));
    EXPECT_EQ(cli::map_colour("cividis", 1.0), (cli::DisplayColour{0xfe, 0xe8, 0x38}));
    for (const std::string_view name : cli::colour_map_names) {
        double before = -1.0;
        for (int i = 0; i <= 16; ++i) {
            const auto [r, g, b] = cli::map_colour(name, i / 16.0);
            const double brightness = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            EXPECT_GT(brightness, before) << name << " at " << i;
            before = brightness;
        }
    }
}

// A tilted box, with periods along two of its edges.
TEST(PeriodicWrap, MovesByWholeEdges) {
    Particles particles;
    particles.box = cli::SimulationBox{{1, 1, 1}, {{{2, 0, 0}, {1, 2, 0}, {0, 0, 4}}}, {true, true, false}};
    const std::vector<double> inside{1.5, 1.5, 2, 2.5, 2.75, 4.5};
    particles.positions = inside;
    wrap_into_box(particles, "a");
    EXPECT_EQ(particles.positions, inside); // to the bit
    particles.positions = {1.5 + 2.0 * 3 - 1.0, 1.5 - 2.0, 2 + 40};
    wrap_into_box(particles, "a");
    EXPECT_EQ(particles.positions, (std::vector<double>{1.5, 1.5, 42}));
    particles.box->edges[2] = particles.box->edges[0];
    EXPECT_THROW(wrap_into_box(particles, "a"), cli::Failure);
}

} // namespace
