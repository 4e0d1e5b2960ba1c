// Spheres that are given by columns: the rules, one broken array each and the whole message about it, and that they are
// the spheres that structs would give.
#include "lib/base/error.h"
#include "lib/scene/checked_scene.h"
#include "lib/scene/scene.h"
#include "lib/scene/scene_digest.h"
#include "lib/scene/sphere_source.h"
#include "lib/scene/srgb.h"
#include "tests/support/expected_error.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace sphere_arrays {

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

const std::vector<pt_material> three_materials = {{{0.5F, 0.25F, 1.0F}, {0.25F, 0.5F, 0}, {0, 0, 0}, 10},
                                                  {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 0},
                                                  {{0, 0, 0}, {0, 0, 0}, {2, 3, 4}, 0}};

// Four spheres in columns of floats, which a test spoils.
struct Particles {
    std::vector<float> center = {1, 2, 3, 4, 5, 6, -7, 8, 9, 10, 11, -0.0F};
    std::vector<float> radius = {1, 2, 0.1F, 4};
    std::vector<double> motion = {0, 0, 0, 0, 1, 0, 0.1, 0, 0, 0, 0, -1e-3};
    std::vector<std::uint32_t> material = {0, 2, 1, 0};
    std::vector<float> color = {1, 1, 1, 0.5F, 0.5F, 0.5F, 0.1F, 0.2F, 0.3F, 0, 1, 0.5F};
    std::vector<pt_material> materials = three_materials;
    std::uint32_t count = 4;
    std::function<void(pt_sphere_array &)> spoil = [](pt_sphere_array &) {};
    std::function<void(pt_scene &)> spoil_scene = [](pt_scene &) {};

    pt_sphere_array array() const {
        pt_sphere_array array{};
        array.struct_size = sizeof array;
        array.count = count;
        array.center = {center.data(), 12, PT_TYPE_FLOAT32};
        array.radius = {radius.data(), 4, PT_TYPE_FLOAT32};
        array.motion = {motion.data(), 24, PT_TYPE_FLOAT64};
        array.material = {material.data(), 4, PT_TYPE_UINT32};
        array.color = {color.data(), 12, PT_TYPE_FLOAT32};
        spoil(array);
        return array;
    }

    // By structs, and materials made by hand.
    std::vector<pt_sphere> spheres() const {
        std::vector<pt_sphere> spheres;
        for (std::size_t i = 0; i < count; ++i)
            spheres.push_back({{center[3 * i], center[3 * i + 1], center[3 * i + 2]},
                               radius[i],
                               {motion[3 * i], motion[3 * i + 1], motion[3 * i + 2]},
                               material[i],
                               0});
        return spheres;
    }

    pt::Scene validated() const {
        const std::array<pt_sphere_array, 1> arrays{array()};
        return validated(arrays);
    }

    pt::Scene validated(std::span<const pt_sphere_array> arrays) const {
        pt_scene scene = scene_of(materials, {}, {});
        scene.sphere_arrays = arrays.data();
        scene.sphere_array_count = static_cast<std::uint32_t>(arrays.size());
        spoil_scene(scene);
        return pt::validated_scene(scene);
    }

    // Result and message of the error, or "accepted".
    std::string outcome() const {
        try {
            validated();
        } catch (const pt::Error &error) {
            return (error.code() == PT_ERROR_INVALID_SCENE ? "" : std::string(pt::result_name(error.code())) + ": ") +
                   error.what();
        }
        return "accepted";
    }
};

// ---- What is refused ----------------------------------------------------------------------------------------------

struct ArrayCase {
    const char *name;
    void (*spoil)(Particles &particles);
    const char *message;
};

void PrintTo(const ArrayCase &test_case, std::ostream *out) {
    *out << test_case.name;
}

class BrokenArray : public testing::TestWithParam<ArrayCase> {};

TEST_P(BrokenArray, IsRefusedWithMessage) {
    Particles particles;
    ASSERT_EQ(particles.outcome(), "accepted");
    GetParam().spoil(particles);
    EXPECT_EQ(particles.outcome(), GetParam().message);
}

std::string name_of(const testing::TestParamInfo<ArrayCase> &instance) {
    return instance.param.name;
}

// Spoils the array's struct.
#define SPOILT(change) [](Particles &p) { p.spoil = [](pt_sphere_array &a) { change; }; }

INSTANTIATE_TEST_SUITE_P(
    Columns, BrokenArray,
    testing::Values(
        ArrayCase{"CenterMissing", SPOILT(a.center = {}),
                  "sphere_arrays[0].center.data = NULL: must not be NULL, as count is 4"},
        ArrayCase{"RadiusMissing", SPOILT(a.radius.data = nullptr),
                  "sphere_arrays[0].radius.data = NULL: must not be NULL, as count is 4"},
        ArrayCase{"MotionLost", SPOILT(a.motion.data = nullptr),
                  "sphere_arrays[0].motion.data = NULL: must not be NULL where type or stride_bytes is set"},
        ArrayCase{"MaterialLost", SPOILT(a.material = (pt_column{nullptr, 0, PT_TYPE_UINT32})),
                  "sphere_arrays[0].material.data = NULL: must not be NULL where type or stride_bytes is set"},
        ArrayCase{"ColorLost", SPOILT(a.color = (pt_column{nullptr, 12, 0})),
                  "sphere_arrays[0].color.data = NULL: must not be NULL where type or stride_bytes is set"},
        ArrayCase{"CenterWithoutType", SPOILT(a.center.type = 0),
                  "sphere_arrays[0].center.type = 0: must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)"},
        ArrayCase{"CenterOfIndices", SPOILT(a.center.type = PT_TYPE_UINT32),
                  "sphere_arrays[0].center.type = 3: must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)"},
        ArrayCase{"RadiusOfColors", SPOILT(a.radius.type = PT_TYPE_SRGB8),
                  "sphere_arrays[0].radius.type = 4: must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)"},
        ArrayCase{"MotionOfUnknown", SPOILT(a.motion.type = 5),
                  "sphere_arrays[0].motion.type = 5: must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)"},
        ArrayCase{"MaterialOfFloats", SPOILT(a.material.type = PT_TYPE_FLOAT32),
                  "sphere_arrays[0].material.type = 1: must be PT_TYPE_UINT32 (3)"},
        ArrayCase{"ColorOfUnknown", SPOILT(a.color.type = 4294967295U),
                  "sphere_arrays[0].color.type = 4294967295: must be PT_TYPE_FLOAT32 (1), PT_TYPE_FLOAT64 (2) or "
                  "PT_TYPE_SRGB8 (4)"},
        ArrayCase{"CenterStrideOfANumber", SPOILT(a.center.stride_bytes = 4),
                  "sphere_arrays[0].center.stride_bytes = 4: must be 0 or at least the 12 bytes of one element"},
        ArrayCase{"MotionStrideOfFloats", SPOILT(a.motion.stride_bytes = 23),
                  "sphere_arrays[0].motion.stride_bytes = 23: must be 0 or at least the 24 bytes of one element"},
        ArrayCase{"RadiusStrideCut", SPOILT(a.radius.stride_bytes = 3),
                  "sphere_arrays[0].radius.stride_bytes = 3: must be 0 or at least the 4 bytes of one element"},
        ArrayCase{"MaterialStrideOfBytes", SPOILT(a.material.stride_bytes = 1),
                  "sphere_arrays[0].material.stride_bytes = 1: must be 0 or at least the 4 bytes of one element"},
        ArrayCase{"ColorStrideOfBytes", SPOILT(a.color = (pt_column{a.color.data, 2, PT_TYPE_SRGB8})),
                  "sphere_arrays[0].color.stride_bytes = 2: must be 0 or at least the 3 bytes of one element"},
        ArrayCase{"NegativeStride", SPOILT(a.center.stride_bytes = static_cast<std::uint32_t>(-12)),
                  "sphere_arrays[0].center.stride_bytes = 4294967284: must be < 2^31"},
        ArrayCase{"LargeStride", SPOILT(a.color.stride_bytes = 1U << 31),
                  "sphere_arrays[0].color.stride_bytes = 2147483648: must be < 2^31"},
        ArrayCase {
            "SeveralColumns", SPOILT(a.center = {}; a.material.type = 0; a.color.stride_bytes = 1),
                "sphere_arrays[0].center.data = NULL: must not be NULL, as count is 4\n"
                "sphere_arrays[0].material.type = 0: must be PT_TYPE_UINT32 (3)\n"
                "sphere_arrays[0].color.stride_bytes = 1: must be 0 or at least the 12 bytes of one element"
        },
        ArrayCase{"Size", SPOILT(a.struct_size = 3),
                  "PT_ERROR_INVALID_ARGUMENT: sphere_arrays[0].struct_size = 3: must be the size of the struct, which "
                  "holds this field"},
        ArrayCase{"AbsurdSize", SPOILT(a.struct_size = 65537),
                  "PT_ERROR_INVALID_ARGUMENT: sphere_arrays[0].struct_size = 65537: must be the size of the struct (<= "
                  "65536)"},
        ArrayCase{"OnlyCenters", SPOILT(a.struct_size = offsetof(pt_sphere_array, radius)),
                  "sphere_arrays[0].radius.data = NULL: must not be NULL, as count is 4"}),
    name_of);

#undef SPOILT

INSTANTIATE_TEST_SUITE_P(
    Values, BrokenArray,
    testing::Values(
        ArrayCase{"CenterNan", [](Particles &p) { p.center[7] = not_a_number; },
                  "sphere_arrays[0].center[2] = (-7, nan, 9): must be finite"},
        ArrayCase{"CenterSmall", [](Particles &p) { p.center[3] = -1e-19F; },
                  "sphere_arrays[0].center[1] = (-1e-19, 5, 6): must be 0 or of a magnitude in [1e-18, 1e18]"},
        ArrayCase{"CenterLarge", [](Particles &p) { p.center[11] = 2e18F; },
                  "sphere_arrays[0].center[3] = (10, 11, 2e+18): must be 0 or of a magnitude in [1e-18, 1e18]"},
        ArrayCase{"RadiusZero", [](Particles &p) { p.radius[0] = 0; }, "sphere_arrays[0].radius[0] = 0: must be > 0"},
        ArrayCase{"RadiusNegative", [](Particles &p) { p.radius[3] = -0.1F; },
                  "sphere_arrays[0].radius[3] = -0.1: must be > 0"},
        ArrayCase{"RadiusSmall", [](Particles &p) { p.radius[3] = 1e-20F; },
                  "sphere_arrays[0].radius[3] = 1e-20: must lie in [1e-18, 1e18]"},
        ArrayCase{"RadiusNan", [](Particles &p) { p.radius[1] = not_a_number; },
                  "sphere_arrays[0].radius[1] = nan: must be finite"},
        ArrayCase{"MotionInfinite", [](Particles &p) { p.motion[6] = -std::numeric_limits<double>::infinity(); },
                  "sphere_arrays[0].motion[2] = (-inf, 0, 0): must be finite"},
        ArrayCase{"MotionSmall", [](Particles &p) { p.motion[2] = 1e-300; },
                  "sphere_arrays[0].motion[0] = (0, 0, 1e-300): must be 0 or of a magnitude in [1e-18, 1e18]"},
        ArrayCase{"MaterialOneTooFar", [](Particles &p) { p.material[2] = 3; },
                  "sphere_arrays[0].material[2] = 3: must be < material_count (3)"},
        ArrayCase{"MaterialFar", [](Particles &p) { p.material[0] = 4294967295U; },
                  "sphere_arrays[0].material[0] = 4294967295: must be < material_count (3)"},
        ArrayCase{"ColorAboveOne", [](Particles &p) { p.color[4] = std::nextafter(1.0F, 2.0F); },
                  "sphere_arrays[0].color[1] = (0.5, 1.0000001, 0.5): must lie in [0, 1]"},
        ArrayCase{"ColorNegative", [](Particles &p) { p.color[9] = -0.01F; },
                  "sphere_arrays[0].color[3] = (-0.01, 1, 0.5): must lie in [0, 1]"},
        ArrayCase{"ColorNan", [](Particles &p) { p.color[2] = not_a_number; },
                  "sphere_arrays[0].color[0] = (1, 1, nan): must be finite"},
        ArrayCase{"NoMaterials",
                  [](Particles &p) {
                      p.materials.clear();
                      p.spoil = [](pt_sphere_array &a) { a.material = {}; };
                  },
                  "sphere_arrays[0].material = 0: must be < material_count (0)"},
        ArrayCase{"OneForAllIsToldOnce",
                  [](Particles &p) {
                      p.radius = {-1};
                      p.spoil = [](pt_sphere_array &a) { a.radius.stride_bytes = 0; };
                  },
                  "sphere_arrays[0].radius[0] = -1: must be > 0"},
        ArrayCase{"InOrder",
                  [](Particles &p) {
                      p.radius[3] = p.radius[1] = -1;
                      p.color[0] = 2;
                      p.center[0] = not_a_number;
                      p.material[3] = 7;
                  },
                  "sphere_arrays[0].center[0] = (nan, 2, 3): must be finite\n"
                  "sphere_arrays[0].radius[1] = -1: must be > 0\n"
                  "sphere_arrays[0].radius[3] = -1: must be > 0\n"
                  "sphere_arrays[0].material[3] = 7: must be < material_count (3)\n"
                  "sphere_arrays[0].color[0] = (2, 1, 1): must lie in [0, 1]"}),
    name_of);

const void *const not_there = reinterpret_cast<const void *>(std::uintptr_t{64}); // reading it ends the process

INSTANTIATE_TEST_SUITE_P(
    Counts, BrokenArray,
    testing::Values(ArrayCase{"NoArrays",
                              [](Particles &p) { p.spoil_scene = [](pt_scene &s) { s.sphere_arrays = nullptr; }; },
                              "scene.sphere_arrays = NULL: must not be NULL, as sphere_array_count is 1"},
                    ArrayCase{"TooManyArrays",
                              [](Particles &p) {
                                  p.spoil_scene = [](pt_scene &s) {
                                      s.sphere_arrays = static_cast<const pt_sphere_array *>(not_there);
                                      s.sphere_array_count = 65537;
                                  };
                              },
                              "scene.sphere_array_count = 65537: must be <= 65536"},
                    ArrayCase{"Reserved", [](Particles &p) { p.spoil_scene = [](pt_scene &s) { s.reserved = 1; }; },
                              "scene.reserved = 1: must be 0"},
                    ArrayCase{"TooManySpheres", // which are not there, and so must not be read
                              [](Particles &p) {
                                  p.spoil = [](pt_sphere_array &a) {
                                      a.count = (1U << 26) + 1;
                                      a.center.data = a.radius.data = not_there;
                                  };
                              },
                              "scene.sphere_count + the counts of sphere_arrays = 67108865: must be <= 2^26"},
                    ArrayCase{"TooManyWithStructs",
                              [](Particles &p) {
                                  p.spoil_scene = [](pt_scene &s) {
                                      s.spheres = static_cast<const pt_sphere *>(not_there);
                                      s.sphere_count = (1U << 26) - 3;
                                  };
                              },
                              "scene.sphere_count + the counts of sphere_arrays = 67108865: must be <= 2^26"},
                    ArrayCase{"CountsThatWrapAround",
                              [](Particles &p) {
                                  p.spoil = [](pt_sphere_array &a) { a.count = 4294967295U; };
                                  p.spoil_scene = [](pt_scene &s) { s.sphere_count = 5; };
                              },
                              "scene.sphere_count + the counts of sphere_arrays = 4294967300: must be <= 2^26\n"
                              "scene.plane_count + all spheres = 4294967300: must be < 2^30"}),
    name_of);

TEST(SphereArrays, AreNamedByTheirIndex) {
    Particles particles;
    std::array<pt_sphere_array, 3> arrays{};
    arrays.fill(particles.array());
    const float bad = -1;
    arrays[1].radius = {&bad, 0, PT_TYPE_FLOAT32};
    arrays[2].center.type = 9;
    const pt::Error error = error_of([&] { particles.validated(arrays); });
    EXPECT_STREQ(error.what(), "sphere_arrays[1].radius[0] = -1: must be > 0\n"
                               "sphere_arrays[2].center.type = 9: must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)");
    const pt::BrokenRule &rule = error.broken_rules()->first()[0];
    EXPECT_EQ(rule.subject, "sphere_arrays");
    EXPECT_EQ(rule.index, 1);
    EXPECT_EQ(rule.member, "radius");
    EXPECT_EQ(rule.component, 0);
}

// Two columns of a million wrong values: eight are told of, and the others only counted.
TEST(SphereArrays, CountMostOfManyViolations) {
    Particles particles;
    particles.count = 1000000;
    particles.center.assign(3000000, not_a_number);
    particles.radius.assign(1000000, -1);
    particles.radius.back() = 1;
    particles.spoil = [](pt_sphere_array &array) { array.motion = array.material = array.color = {}; };
    const pt::Error error = error_of([&] { particles.validated(); });
    EXPECT_EQ(error.broken_rules()->count(), 1999999U);
    EXPECT_EQ(error.broken_rules()->first().size(), 8U);
    EXPECT_EQ(error.broken_rules()->first()[7].text(), "sphere_arrays[0].center[7] = (nan, nan, nan): must be finite");
    EXPECT_TRUE(std::string(error.what()).ends_with("\n... and 1999991 more")) << error.what();
}

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
        array = {sizeof array, 0, {nullptr, 12, PT_TYPE_FLOAT32}, {nullptr, 1, 77}, {}, {}, {}};
    };
    EXPECT_EQ(particles.outcome(), "accepted");
    EXPECT_TRUE(particles.validated().spheres.empty());
}

// ---- How arrays grow ----------------------------------------------------------------------------------------------

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
    EXPECT_STREQ(unknown.what(), "sphere_arrays[1].struct_size = 96: byte 95 is set, but this library knows only the "
                                 "first 88 bytes of the struct");
    std::array<pt_sphere_array, 2> unlike = arrays;
    unlike[1].struct_size = 40;
    const pt::Error error = error_of([&] { particles.validated(unlike); });
    EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(error.what(), "sphere_arrays[1].struct_size = 40: must be that of sphere_arrays[0] (88)");
}

// ---- What is read -------------------------------------------------------------------------------------------------

void expect_equal(const pt::Sphere &a, const pt::Sphere &b) {
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.motion, b.motion);
    EXPECT_EQ(a.material, b.material);
}

// A column in memory of its own that ends with its last element, at a distance from each other and at any address.
class ColumnCopy {
public:
    template <typename Number>
    ColumnCopy(const std::vector<Number> &numbers, std::uint32_t components, std::uint32_t type, std::uint32_t stride,
               std::size_t offset) {
        const std::size_t size = components * sizeof(Number);
        const std::size_t count = stride == 0 ? 1 : numbers.size() / components;
        const std::size_t end = offset + (count - 1) * stride + size;
        bytes_ = std::make_unique<unsigned char[]>(end);
        std::memset(bytes_.get(), 0xff, end);
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(bytes_.get() + offset + i * stride, numbers.data() + i * components, size);
        column_ = {bytes_.get() + offset, stride, type};
    }

    const pt_column &column() const { return column_; }

private:
    std::unique_ptr<unsigned char[]> bytes_;
    pt_column column_;
};

template <typename To, typename From>
std::vector<To> converted(const std::vector<From> &from) {
    return {from.begin(), from.end()};
}

TEST(SphereArrays, AreTheSpheresOfStructs) {
    const Particles particles;
    const std::vector<pt_sphere> spheres = particles.spheres();
    const pt::Scene expected = pt::validated_scene(scene_of(three_materials, spheres, {}));
    for (const std::uint32_t gap : {0U, 1U, 4U, 1000U})
        for (const std::size_t offset : {0U, 1U, 3U, 7U}) {
            SCOPED_TRACE(testing::Message() << "gap " << gap << ", offset " << offset);
            const ColumnCopy center(particles.center, 3, PT_TYPE_FLOAT32, 12 + gap, offset);
            const ColumnCopy center64(converted<double>(particles.center), 3, PT_TYPE_FLOAT64, 24 + gap, offset);
            const ColumnCopy radius(particles.radius, 1, PT_TYPE_FLOAT32, 4 + gap, offset);
            const ColumnCopy radius64(converted<double>(particles.radius), 1, PT_TYPE_FLOAT64, 8 + gap, offset);
            const ColumnCopy motion(particles.motion, 3, PT_TYPE_FLOAT64, 24 + gap, offset);
            const ColumnCopy material(particles.material, 1, PT_TYPE_UINT32, 4 + gap, offset);
            for (const bool doubles : {false, true}) {
                Particles read;
                read.spoil = [&](pt_sphere_array &array) {
                    array.center = (doubles ? center64 : center).column();
                    array.radius = (doubles ? radius64 : radius).column();
                    array.motion = motion.column();
                    array.material = material.column();
                    array.color = {};
                };
                const pt::Scene found = read.validated();
                EXPECT_EQ(found.materials.size(), 3U);
                ASSERT_EQ(found.spheres.size(), 4U);
                for (std::size_t i = 0; i < 4; ++i)
                    expect_equal(found.spheres[i], expected.spheres[i]);
                EXPECT_EQ(pt::digest_of(found), pt::digest_of(expected));
            }
        }
}

TEST(SphereArrays, HaveOneValueForAllOrDefaults) {
    const ColumnCopy radius(std::vector<double>{0.3}, 1, PT_TYPE_FLOAT64, 0, 1);
    const ColumnCopy material(std::vector<std::uint32_t>{2}, 1, PT_TYPE_UINT32, 0, 2);
    const ColumnCopy motion(std::vector<float>{1, 2, 3}, 3, PT_TYPE_FLOAT32, 0, 3);
    Particles particles;
    particles.spoil = [&](pt_sphere_array &array) {
        array.radius = radius.column();
        array.material = material.column();
        array.motion = motion.column();
        array.color = {};
    };
    for (const pt::Sphere &sphere : particles.validated().spheres) {
        EXPECT_EQ(sphere.radius, 0.3);
        EXPECT_EQ(sphere.material, 2U);
        EXPECT_EQ(sphere.motion, glm::dvec3(1, 2, 3));
    }
    particles.spoil = [&](pt_sphere_array &array) { array.motion = array.material = array.color = {}; };
    for (const pt::Sphere &sphere : particles.validated().spheres) {
        EXPECT_EQ(sphere.material, 0U);
        EXPECT_EQ(sphere.motion, glm::dvec3(0));
    }
}

// Structs and arrays of all sizes in one scene, empty ones among them, read in every way.
TEST(SphereSource, ReadsInOrderAcrossArrays) {
    std::vector<float> center(3 * 2000);
    std::vector<float> color(3 * 2000);
    for (std::size_t i = 0; i < center.size(); ++i) {
        center[i] = static_cast<float>(i + 1);
        color[i] = static_cast<float>(i) / static_cast<float>(center.size());
    }
    const float radius = 0.5F;
    std::vector<pt_sphere_array> arrays;
    std::size_t first = 0;
    for (const std::uint32_t count : {0U, 1U, 300U, 0U, 0U, 700U, 2U, 0U}) {
        pt_sphere_array array{};
        array.struct_size = sizeof array;
        array.count = count;
        array.center = {&center[3 * first], 12, PT_TYPE_FLOAT32};
        array.radius = {&radius, 0, PT_TYPE_FLOAT32};
        if (count != 300)
            array.color = {&color[3 * first], 12, PT_TYPE_FLOAT32};
        arrays.push_back(array);
        first += count;
    }
    const std::vector<pt_sphere> structs(5, pt_sphere{{9, 9, 9}, 3, {1, 0, 0}, 1, 0});
    const pt::SphereSource source(structs, arrays);
    ASSERT_EQ(source.size(), 5 + first);
    EXPECT_TRUE(source.has_colors());
    std::size_t next = 0;
    source.for_each([&](std::size_t index, const pt::Sphere &sphere, const glm::vec3 &own_color) {
        ASSERT_EQ(index, next++);
        expect_equal(sphere, source[index]);
        EXPECT_EQ(own_color, source.color(index));
        if (index < 5) {
            expect_equal(sphere, {{9, 9, 9}, 3, {1, 0, 0}, 1});
            EXPECT_EQ(own_color, glm::vec3(1));
            return;
        }
        const float *at = &center[3 * (index - 5)];
        expect_equal(sphere, {{at[0], at[1], at[2]}, 0.5, {0, 0, 0}, 0});
        const float *shade = &color[3 * (index - 5)];
        const bool is_colored = index < 6 || index >= 306;
        EXPECT_EQ(own_color, is_colored ? glm::vec3(shade[0], shade[1], shade[2]) : glm::vec3(1)) << index;
    });
    EXPECT_EQ(next, source.size());
    const std::vector<std::uint32_t> starts(source.array_starts().begin(), source.array_starts().end());
    EXPECT_EQ(starts, (std::vector<std::uint32_t>{5, 5, 6, 306, 306, 306, 1006, 1008}));
}

TEST(SphereSource, MayBeEmpty) {
    const pt::SphereSource source({}, {});
    EXPECT_EQ(source.size(), 0U);
    EXPECT_FALSE(source.has_colors());
    EXPECT_TRUE(source.array_starts().empty());
    source.for_each([](std::size_t, const pt::Sphere &, const glm::vec3 &) { FAIL(); });
}

TEST(Scene, KnowsWhereTheCallerHasASphere) {
    pt::Scene scene;
    scene.array_starts = {2, 2, 5};
    const auto place = [&](std::size_t index) {
        const pt::SpherePlace found = pt::place_of_sphere(scene, index);
        return std::string(found.subject) + ' ' + std::to_string(found.index) + ' ' + std::to_string(found.component);
    };
    EXPECT_EQ(place(0), "spheres 0 -1");
    EXPECT_EQ(place(1), "spheres 1 -1");
    EXPECT_EQ(place(2), "sphere_arrays 1 0");
    EXPECT_EQ(place(4), "sphere_arrays 1 2");
    EXPECT_EQ(place(5), "sphere_arrays 2 0");
    EXPECT_EQ(place(9), "sphere_arrays 2 4");
}

// ---- Colours ------------------------------------------------------------------------------------------------------

TEST(SphereArrays, ColorsMultiplyTheDiffuse) {
    const Particles particles;
    const pt::Scene scene = particles.validated();
    // The first sphere has its material's own colour, and that of the second reflects nothing, whatever its colour.
    ASSERT_EQ(scene.materials.size(), 5U);
    EXPECT_EQ(scene.spheres[0].material, 0U);
    EXPECT_EQ(scene.spheres[1].material, 2U);
    const pt::Material &third = scene.materials[scene.spheres[2].material];
    EXPECT_EQ(third.diffuse, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(third.glossiness, 0.0F);
    const pt::Material &fourth = scene.materials[scene.spheres[3].material];
    EXPECT_EQ(fourth.diffuse, glm::vec3(0, 0.25F, 0.5F));
    EXPECT_EQ(fourth.specular, glm::vec3(0.25F, 0.5F, 0));
    EXPECT_EQ(fourth.emission, glm::vec3(0));
    EXPECT_EQ(fourth.glossiness, 10.0F);

    std::vector<pt_material> by_hand = three_materials;
    by_hand.insert(by_hand.begin(), {{0, 0.25F, 0.5F}, {0.25F, 0.5F, 0}, {0, 0, 0}, 10});
    by_hand.push_back({{0.1F, 0.2F, 0.3F}, {0, 0, 0}, {0, 0, 0}, 0});
    std::vector<pt_sphere> spheres = particles.spheres();
    spheres[0].material = 1;
    spheres[1].material = 3;
    spheres[2].material = 4;
    spheres[3].material = 0;
    EXPECT_EQ(pt::digest_of(scene), pt::digest_of(pt::validated_scene(scene_of(by_hand, spheres, {}))));
    spheres[2].material = 2;
    EXPECT_NE(pt::digest_of(scene), pt::digest_of(pt::validated_scene(scene_of(by_hand, spheres, {}))));
}

TEST(SphereArrays, EqualColorsShareAMaterial) {
    constexpr std::uint32_t count = 60000;
    std::vector<std::uint8_t> bytes;
    std::vector<pt_material> by_hand{{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 0},
                                     {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 5}};
    std::mt19937 random(1);
    Particles particles;
    particles.materials = by_hand;
    particles.material.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        for (int component = 0; component < 3; ++component)
            bytes.push_back(static_cast<std::uint8_t>(random() % 12 + 244));
        particles.material.push_back(random() % 2);
    }
    particles.count = count;
    particles.spoil = [&](pt_sphere_array &array) {
        array.center.stride_bytes = array.radius.stride_bytes = 0;
        array.motion = {};
        array.color = {bytes.data(), 3, PT_TYPE_SRGB8};
    };
    const pt::Scene scene = particles.validated();
    // 12^3 colours of two materials, of which white is there already; all of them turn up.
    EXPECT_EQ(scene.materials.size(), 2 * 12 * 12 * 12U);
    for (std::uint32_t i = 0; i < count; ++i) {
        const pt::Material &material = scene.materials[scene.spheres[i].material];
        const pt_material &base = by_hand[particles.material[i]];
        ASSERT_EQ(material.glossiness, base.glossiness);
        for (int component = 0; component < 3; ++component)
            ASSERT_EQ(material.diffuse[component],
                      base.diffuse[component] * pt::linear_from_srgb(bytes[3 * i + static_cast<unsigned>(component)]));
    }
}

TEST(SphereArrays, ColorsMayBeOfAnyType) {
    const std::vector<double> shares{0, 1, 0.1, 0.7, 0.2, 0.9, -0.0, 1, 1, 0.25, 0.5, 0.75};
    const ColumnCopy doubles(shares, 3, PT_TYPE_FLOAT64, 25, 1);
    const ColumnCopy floats(converted<float>(shares), 3, PT_TYPE_FLOAT32, 13, 3);
    const ColumnCopy bytes(std::vector<std::uint8_t>{0, 255, 10, 11, 128, 200, 1, 2, 3, 254, 40, 50}, 3, PT_TYPE_SRGB8,
                           5, 1);
    Particles particles;
    const auto color = [&](const ColumnCopy &copy, std::size_t index) {
        pt_sphere_array array = particles.array();
        array.color = copy.column();
        return pt::SphereSource({}, {&array, 1}).color(index);
    };
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(color(doubles, i), color(floats, i)) << i;
    EXPECT_EQ(color(floats, 3), glm::vec3(0.25F, 0.5F, 0.75F));
    EXPECT_EQ(color(bytes, 0), glm::vec3(0, 1, pt::linear_from_srgb(10)));
    EXPECT_EQ(color(bytes, 3),
              glm::vec3(pt::linear_from_srgb(254), pt::linear_from_srgb(40), pt::linear_from_srgb(50)));
    particles.spoil = [&](pt_sphere_array &array) { array.color = doubles.column(); };
    EXPECT_EQ(particles.outcome(), "accepted");
}

// IEC 61966-2-1, whose power is correct to a few roundings of doubles: one of float is 2^29 times as large.
TEST(Srgb, IsDecodedAsTheStandardSays) {
    for (int byte = 0; byte < 256; ++byte) {
        const double encoded = byte / 255.0;
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        EXPECT_EQ(pt::linear_from_srgb(static_cast<std::uint8_t>(byte)), static_cast<float>(linear)) << byte;
    }
    EXPECT_EQ(pt::linear_from_srgb(0), 0.0F);
    EXPECT_EQ(pt::linear_from_srgb(255), 1.0F);
}

} // namespace

} // namespace sphere_arrays
