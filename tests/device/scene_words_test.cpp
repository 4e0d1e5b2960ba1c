// The words of the scene arrive where the kernel reads them, wherever the scene is.
#include "scene_words.spv.h"
#include "shaders/gpu_layout.h"
#include "surface_words.spv.h"
#include "tests/device/probe.h"
#include "tests/device/scene_constants.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace {

namespace gpu = pt::gpu;

using Words = std::vector<glm::vec4>;

// Numbers that are all different and not 0.
Words numbered(std::uint32_t count) {
    Words words;
    for (std::uint32_t i = 0; i < count; ++i)
        words.push_back(glm::vec4(1, 2, 3, 4) + 4.0F * static_cast<float>(i));
    return words;
}

class SceneWords : public testing::TestWithParam<std::uint32_t> {
protected:
    static Probe probe_of(std::span<const std::uint32_t> spirv, std::uint32_t push_bytes,
                          std::span<const std::uint32_t> constants, const Words &words) {
        Probe probe(spirv, push_bytes, with_scene_source(constants, GetParam(), words));
        set_scene_for(probe, GetParam(), words);
        return probe;
    }
};

INSTANTIATE_TEST_SUITE_P(, SceneWords,
                         testing::Values(gpu::SCENE_IN_STORAGE, gpu::SCENE_IN_UNIFORM, gpu::SCENE_IN_CONSTANTS),
                         [](const auto &test) { return name_of_source(test.param); });

std::uint32_t longest_scene(std::uint32_t source) {
    constexpr std::uint32_t longer_than_uniform = 1500;
    constexpr std::uint32_t words[] = {longer_than_uniform, gpu::UNIFORM_SCENE_WORDS, gpu::CONSTANT_SCENE_WORDS};
    return words[source];
}

TEST_P(SceneWords, AreReadByIndexAndAmongOthers) {
    constexpr std::array<std::uint32_t, gpu::CONSTANT_COUNT> constants{};
    struct Read {
        glm::vec4 word, among;
    };
    const Words words = numbered(longest_scene(GetParam()));
    Probe probe = probe_of(scene_words_spirv(), 2 * sizeof(std::uint32_t), constants, words);
    for (const std::uint32_t first : {0U, 5U}) {
        const std::array push = {static_cast<std::uint32_t>(words.size()), first};
        const auto reads = probe.run<Read>({}, words.size(), push, push[0]);
        for (std::uint32_t i = 0; i < words.size(); ++i) {
            EXPECT_EQ(reads[i].word, words[i]) << i;
            EXPECT_EQ(reads[i].among, words[std::max(i, first)]) << i << " from " << first;
        }
    }
}

// What surface_words.comp reads of a surface, and what it should.
struct SurfaceRead {
    glm::vec4 emission, lamp_emission, diffuse, specular, sphere, sphere_among, gradient_height, gradient_height_among,
        curvatures;

    bool operator==(const SurfaceRead &) const = default;
};

constexpr std::uint32_t lamps = 2;
constexpr std::uint32_t skies = 1;
constexpr std::uint32_t spheres = 4;
constexpr std::uint32_t planes = 2;
constexpr std::uint32_t surfaces = spheres + planes;
constexpr glm::vec4 point{1, 2, 3, 0};

struct Variant {
    bool gloss, motion, curvature, planes_emit;

    bool may_emit(std::uint32_t surface) const {
        return surface < lamps + skies || (planes_emit && surface >= spheres);
    }
};

// In the table that the storage buffer has, and the material of each surface there.
constexpr std::uint32_t materials = 3;
constexpr std::array<std::uint32_t, surfaces> material_of = {1, 0, 2, 2, 1, 0};

// The first word of each block, by the layout that gpu_layout.h describes.
struct Blocks {
    bool has_table;
    std::uint32_t emission, motion, curvature, index, diffuse, specular, reflection_step, end;

    Blocks(const Variant &variant, std::uint32_t source) : has_table(source == gpu::SCENE_IN_STORAGE) {
        const std::uint32_t gloss = variant.gloss ? 1 : 0;
        emission = surfaces;
        motion = has_table ? emission + lamps + skies + (variant.planes_emit ? planes : 0) : (3 + gloss) * surfaces;
        curvature = motion + (variant.motion ? spheres : 0);
        index = curvature + (variant.curvature ? planes : 0);
        diffuse = has_table ? index + 2 : 2 * surfaces; // indices of four surfaces, and of two
        specular = has_table ? diffuse + 1 : 3 * surfaces;
        reflection_step = has_table ? 1 + gloss : 1;
        end = has_table ? diffuse + reflection_step * materials : index;
    }

    std::uint32_t emission_of(std::uint32_t surface) const {
        return emission + (has_table && surface >= spheres ? surface - spheres + lamps + skies : surface);
    }

    float &index_of(Words &words, std::uint32_t surface) const {
        return words[index + surface / 4][static_cast<int>(surface % 4)];
    }
};

// The numbers are whole ones and halves, so that all sums are exact.
std::vector<SurfaceRead> expected(const Variant &variant, const Blocks &blocks, Words words) {
    const glm::vec4 *motion = &words[blocks.motion];
    const glm::vec4 *curvature = motion + (variant.motion ? spheres : 0);
    std::vector<SurfaceRead> reads(surfaces);
    for (std::uint32_t i = 0; i < surfaces; ++i) {
        SurfaceRead &read = reads[i];
        read.emission = variant.may_emit(i) ? words[blocks.emission_of(i)] : glm::vec4(0);
        read.lamp_emission = i < lamps ? read.emission : glm::vec4(0);
        const std::uint32_t index =
            blocks.has_table ? std::bit_cast<std::uint32_t>(blocks.index_of(words, i)) - gpu::MATERIAL_INDEX_BITS : i;
        read.diffuse = words[blocks.diffuse + blocks.reflection_step * index];
        read.specular = variant.gloss ? words[blocks.specular + blocks.reflection_step * index] : glm::vec4(0);
        if (i < spheres) {
            read.sphere = words[i] + (variant.motion ? 0.5F * glm::vec4(glm::vec3(motion[i]), 0) : glm::vec4(0));
            read.sphere_among = read.sphere;
        } else {
            const glm::vec3 normal(words[i]);
            const float offset = words[i].w;
            const float bend = variant.curvature ? curvature[i - spheres].x : 0.0F;
            const glm::vec3 from_nearest = glm::vec3(point) + offset * normal;
            const float height =
                glm::dot(normal, glm::vec3(point)) + offset + 0.5F * bend * glm::dot(from_nearest, from_nearest);
            read.gradient_height = glm::vec4(normal + bend * from_nearest, height);
            read.gradient_height_among = read.gradient_height;
            read.curvatures = {bend, bend, 0, 0};
        }
    }
    return reads;
}

// With small numbers for the planes, lest the squares of their distances be rounded.
Words surface_words_of(const Variant &variant, const Blocks &blocks) {
    Words words = numbered(blocks.end);
    for (std::uint32_t i = 0; i < planes; ++i) {
        words[spheres + i] = {i + 1, 2, -1, i};
        if (variant.curvature)
            words[blocks.curvature + i] = {0.5 * (i + 1), 0, 0, 0};
    }
    if (blocks.has_table)
        for (std::uint32_t i = 0; i < surfaces; ++i)
            blocks.index_of(words, i) = std::bit_cast<float>(gpu::MATERIAL_INDEX_BITS + material_of[i]);
    return words;
}

TEST_P(SceneWords, OfEverySurfaceAreWhereItsBlocksSay) {
    for (const Variant &variant : {Variant{false, false, false, false}, Variant{true, true, true, false},
                                   Variant{false, true, true, true}, Variant{true, false, false, true}}) {
        std::array<std::uint32_t, gpu::CONSTANT_COUNT> constants{};
        constants[gpu::ID_SPHERE_COUNT] = spheres;
        constants[gpu::ID_PLANE_COUNT] = planes;
        constants[gpu::ID_LAMP_COUNT] = lamps;
        constants[gpu::ID_SKY_COUNT] = skies;
        constants[gpu::ID_GLOSS] = variant.gloss;
        constants[gpu::ID_MOTION] = variant.motion;
        constants[gpu::ID_CURVATURE] = variant.curvature;
        constants[gpu::ID_PLANES_EMIT] = variant.planes_emit;
        const Blocks blocks(variant, GetParam());
        Words words = surface_words_of(variant, blocks);
        Probe probe = probe_of(surface_words_spirv(), sizeof point, constants, words);
        const auto reads = probe.run<SurfaceRead>({}, surfaces, point, 1);
        EXPECT_EQ(reads, expected(variant, blocks, words))
            << "gloss " << variant.gloss << ", motion " << variant.motion << ", curvature " << variant.curvature
            << ", emitting planes " << variant.planes_emit;

        // Negative control: each word matters, but for what would be the emission of surfaces that do not emit, ...
        const auto is_index = [&](std::uint32_t i) {
            return blocks.has_table && i >= blocks.index && i < blocks.diffuse;
        };
        const auto is_no_emission = [&](std::uint32_t i) {
            const std::uint32_t surface = i - blocks.emission;
            return !blocks.has_table && surface < surfaces && !variant.may_emit(surface);
        };
        for (std::uint32_t i = 0; i < words.size(); ++i) {
            if (is_index(i) || is_no_emission(i))
                continue;
            words[i].x += 0.5F;
            EXPECT_NE(reads, expected(variant, blocks, words)) << i;
            words[i].x -= 0.5F;
        }
        // ... and so does each index.
        for (std::uint32_t i = 0; blocks.has_table && i < surfaces; ++i) {
            float &index = blocks.index_of(words, i);
            const float right =
                std::exchange(index, std::bit_cast<float>(gpu::MATERIAL_INDEX_BITS + (material_of[i] + 1) % materials));
            EXPECT_NE(reads, expected(variant, blocks, words)) << i;
            index = right;
        }
    }
}

} // namespace
