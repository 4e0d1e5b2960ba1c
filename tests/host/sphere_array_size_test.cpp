// How many spheres columns may have, and structs of columns that are shorter or longer than this library's.
#include "lib/base/error.h"
#include "lib/scene/checked_scene.h"
#include "lib/scene/scene.h"
#include "lib/scene/scene_digest.h"
#include "tests/host/particles.h"
#include "tests/support/expected_error.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace sphere_arrays {

namespace {

// As many as there can be, all in one place: only counted and checked here, since they would take 4 GiB.
TEST(SphereArrays, MayHaveTwoToTheTwentySixthSpheres) {
    Particles particles;
    particles.count = 1U << 26;
    particles.spoil = [](pt_sphere_array &array) {
        for (pt_column *column : {&array.center, &array.radius, &array.motion, &array.material, &array.color})
            column->stride_bytes = 0;
    };
    const pt_sphere_array array = particles.array();
    pt_scene scene = scene_of(three_materials, {}, {});
    scene.sphere_arrays = &array;
    scene.sphere_array_count = 1;
    const pt::CheckedScene checked = pt::checked_scene(scene);
    EXPECT_EQ(checked.spheres.size(), std::size_t{1} << 26);
    EXPECT_EQ(checked.spheres[(std::size_t{1} << 26) - 1].radius, 1.0);
}

TEST(SphereArrays, OfNoneNeedNoColumns) {
    Particles particles;
    particles.spoil = [](pt_sphere_array &array) {
        array = {sizeof array, 0, {nullptr, 12, PT_TYPE_FLOAT32}, {nullptr, 1, 77}, {}, {}, {}, {}, {}};
    };
    EXPECT_EQ(particles.outcome(), "accepted");
    EXPECT_TRUE(particles.validated().spheres.empty());
}

// Arrays of another header, with more or fewer bytes each, one after the other. What it has of this one's is given.
std::vector<unsigned char> resized(std::span<const pt_sphere_array> arrays, std::uint32_t size) {
    std::vector<unsigned char> bytes(arrays.size() * size);
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        pt_sphere_array array = arrays[i];
        array.struct_size = size;
        std::memcpy(bytes.data() + i * size, &array, std::min<std::size_t>(size, sizeof array));
    }
    return bytes;
}

pt::Scene validated_bytes(const std::vector<unsigned char> &bytes, std::uint32_t count) {
    pt_scene scene = scene_of(three_materials, {}, {});
    scene.sphere_arrays = reinterpret_cast<const pt_sphere_array *>(bytes.data());
    scene.sphere_array_count = count;
    return pt::validated_scene(scene);
}

TEST(SphereArrays, MayBeShorterOrLonger) {
    const Particles particles;
    const std::array<pt_sphere_array, 2> arrays{particles.array(), particles.array()};
    const pt::Scene whole = validated_bytes(resized(arrays, sizeof(pt_sphere_array)), 2);
    const pt::Scene longer = validated_bytes(resized(arrays, sizeof(pt_sphere_array) + 20), 2);
    EXPECT_EQ(pt::digest_of(longer), pt::digest_of(whole));
    const pt::Scene shorter = validated_bytes(resized(arrays, offsetof(pt_sphere_array, motion)), 2);
    ASSERT_EQ(shorter.spheres.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(shorter.spheres[i].center, whole.spheres[i].center);
        EXPECT_EQ(shorter.spheres[i].radius, whole.spheres[i].radius);
        EXPECT_EQ(shorter.spheres[i].motion, glm::dvec3(0));
        EXPECT_EQ(shorter.spheres[i].material, 0U);
    }
}

TEST(SphereArrays, OfOtherSizesAreRefused) {
    const Particles particles;
    const std::array<pt_sphere_array, 2> arrays{particles.array(), particles.array()};
    std::vector<unsigned char> longer = resized(arrays, sizeof(pt_sphere_array) + 8);
    longer.back() = 1;
    const pt::Error unknown = error_of([&] { validated_bytes(longer, 2); });
    EXPECT_EQ(unknown.code(), PT_ERROR_UNSUPPORTED);
    EXPECT_STREQ(unknown.what(), "sphere_arrays[1].struct_size = 128: byte 127 is set, but this library knows only the "
                                 "first 120 bytes of the struct");
    std::array<pt_sphere_array, 2> unlike = arrays;
    unlike[1].struct_size = 40;
    const pt::Error error = error_of([&] { particles.validated(unlike); });
    EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(error.what(), "sphere_arrays[1].struct_size = 40: must be that of sphere_arrays[0] (120)");
}

} // namespace

} // namespace sphere_arrays
