// Medians and maxima about the pixels of tiles of any size, by sorting.
#include "lib/film/neighbourhoods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace neighbourhoods {

namespace {

// Beyond a plane's edges is what must not be looked at.
struct Plane {
    std::size_t width;
    std::size_t height;
    std::vector<float> values;

    Plane(std::size_t wide, std::size_t high, std::mt19937 &random) :
        width(wide),
        height(high),
        values(pt::tile_size * pt::tile_size, std::numeric_limits<float>::infinity()) {
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x)
                values[y * pt::tile_size + x] = random() % 3 == 0 ? 0.0F : static_cast<float>(random() % 50);
        if (random() % 4 == 0)
            values[(height - 1) * pt::tile_size] = std::numeric_limits<float>::infinity();
    }

    pt::TilePlane view() const { return {width, height, values.data()}; }

    // Ascending.
    std::vector<float> about(std::size_t x, std::size_t y) const {
        std::vector<float> found;
        for (std::size_t row = std::max<std::size_t>(y, 1) - 1; row < std::min(y + 2, height); ++row)
            for (std::size_t column = std::max<std::size_t>(x, 1) - 1; column < std::min(x + 2, width); ++column)
                found.push_back(values[row * pt::tile_size + column]);
        std::ranges::sort(found);
        return found;
    }
};

TEST(Neighbourhoods, AreThoseThatSortingFinds) {
    std::mt19937 random(5);
    for (const std::size_t width : {1, 2, 3, 7, 8})
        for (const std::size_t height : {1, 2, 3, 7, 8}) {
            const Plane plane(width, height, random);
            const pt::Neighbourhoods found = pt::find_neighbourhoods(plane.view());
            for (std::size_t y = 0; y < height; ++y)
                for (std::size_t x = 0; x < width; ++x) {
                    const std::vector<float> about = plane.about(x, y);
                    const float median = about.size() == 1 ? 0.0F : about[(about.size() - 1) / 2];
                    const std::string place = std::to_string(x) + " " + std::to_string(y) + " of " +
                                              std::to_string(width) + " x " + std::to_string(height);
                    EXPECT_EQ(found.median[y * pt::tile_size + x], median) << place;
                    EXPECT_EQ(found.largest[y * pt::tile_size + x], about.back()) << place;
                }
        }
}

} // namespace

} // namespace neighbourhoods
