#include "lib/scene_file/names.h"

#include <gtest/gtest.h>

#include <array>

namespace {

constexpr std::array<std::string_view, 4> known{"center", "radius", "material", "motion"};

TEST(Suggestion, FindsCommonMisspellings) {
    EXPECT_EQ(pt::nearest_name("raduis", known), "radius");
    EXPECT_EQ(pt::nearest_name("centre", known), "center");
    EXPECT_EQ(pt::nearest_name("materials", known), "material");
    EXPECT_EQ(pt::nearest_name("moton", known), "motion");
    EXPECT_EQ(pt::nearest_name("Radius", known), "radius");
    EXPECT_EQ(pt::nearest_name("rabius", known), "radius");
}

TEST(Suggestion, PrefersTheNearest) {
    constexpr std::array<std::string_view, 3> names{"side wall", "side walls", "side well"};
    EXPECT_EQ(pt::nearest_name("side wals", names), "side wall");
    EXPECT_EQ(pt::nearest_name("side wallss", names), "side walls");
}

TEST(Suggestion, IsSilentAboutStrangers) {
    EXPECT_EQ(pt::nearest_name("emission", known), "");
    EXPECT_EQ(pt::nearest_name("x", known), "");
    EXPECT_EQ(pt::nearest_name("", known), "");
    EXPECT_EQ(pt::nearest_name("radius", {}), "");
}

} // namespace
