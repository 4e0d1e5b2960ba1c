// Numbers by the scene's order of spheres that are met in another.
#include "lib/tree/scene_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace scene_numbers {

namespace {

TEST(SceneNumbers, AreThoseOfTheOrderInTheScene) {
    std::mt19937 engine(7);
    for (const std::uint32_t spheres : {1U, 63U, 64U, 65U, 1000U})
        for (const std::uint32_t one_in : {1U, 2U, 70U}) {
            std::vector<std::uint32_t> some;
            for (std::uint32_t sphere = 0; sphere < spheres; ++sphere)
                if (engine() % one_in == 0 || sphere + 1 == spheres)
                    some.push_back(sphere);
            std::vector<std::uint32_t> met = some;
            std::ranges::shuffle(met, engine);
            pt::SceneNumbers numbers(spheres);
            for (const std::uint32_t sphere : met)
                numbers.add(sphere);
            numbers.count();
            for (std::uint32_t number = 0; number < some.size(); ++number)
                EXPECT_EQ(numbers.number_of(some[number]), number) << spheres << ", one in " << one_in;
        }
}

} // namespace

} // namespace scene_numbers
