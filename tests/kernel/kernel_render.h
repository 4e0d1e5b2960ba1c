#pragma once

#include "lib/code/shader_source.h"
#include "lib/code/specialised_code.h"
#include "lib/film/pixel_sums.h"
#include "lib/scene/checked_scene.h"
#include "lib/view/camera_rules.h"
#include "lib/view/view.h"
#include "tests/film/film_words.h"
#include "tests/invariance/invariance_scene.h"
#include "tests/kernel/probe.h"
#include "tests/support/checked_scene_of.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

inline std::vector<std::uint32_t> with_scene_source(std::span<const std::uint32_t> constants, std::uint32_t source,
                                                    std::span<const glm::vec4> words) {
    std::vector<std::uint32_t> result(constants.begin(), constants.end());
    result[pt::gpu::ID_SCENE_SOURCE] = source;
    result[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
    if (source == pt::gpu::SCENE_IN_CONSTANTS)
        for (const glm::vec4 &word : words)
            for (int i = 0; i < 4; ++i)
                result.push_back(std::bit_cast<std::uint32_t>(word[i]));
    return result;
}

// If the scene is in constants, the buffer gets wrong words.
inline void set_scene_for(Probe &probe, std::uint32_t source, std::span<const glm::vec4> words) {
    if (source == pt::gpu::SCENE_IN_CONSTANTS)
        probe.set_scene(std::vector<glm::vec4>(words.size(), glm::vec4(-77.0F)));
    else
        probe.set_scene(words);
}

class KernelRender {
public:
    using FilmWords = std::vector<std::uint32_t>;
    using Constants = std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT>;

    static constexpr std::uint32_t width = 16;
    static constexpr std::uint32_t height = 12;
    static constexpr std::uint32_t most_samples = 16;
    static constexpr std::uint64_t seed = 7;

    KernelRender(const pt::Scene &scene, const pt::Camera &camera, std::uint32_t max_path_length = 4) :
        KernelRender(pt::view_of(pt::PreparedScene(scene), camera, settings(max_path_length))) {}

    explicit KernelRender(pt::View scene) : scene_(std::move(scene)), frame_(scene_.frame) {
        if (scene_.tree)
            tree_ = scene_.tree->words();
        frame_.strip_pixel_count = width * height;
        frame_.sample_count = frame_.share = most_samples;
    }

    void take(std::uint32_t samples) { frame_.sample_count = samples; }

    static pt::RenderSettings settings(std::uint32_t max_path_length) {
        return {width, height, max_path_length, seed, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_SOBOL, 0, height};
    }

    const pt::Features &features() const { return scene_.features; }
    const std::vector<glm::vec4> &words() const { return scene_.words; }
    Constants constants() const { return pt::specialization_constants(scene_.features); }

    FilmWords film(std::uint32_t source, const std::vector<glm::vec4> &words) const {
        return film_of_kernel(constants(), source, words);
    }

    FilmWords film_of_kernel(const Constants &constants, std::uint32_t source,
                             const std::vector<glm::vec4> &words) const {
        Probe probe = probe_of_kernel(constants, source, words);
        return film_by(probe);
    }

    FilmWords film_by_driver(std::uint32_t source) const {
        const auto values = with_scene_source(constants(), source, words());
        Probe probe(pt::embedded_code().pathtrace, sizeof frame_, values);
        set_scene_for(probe, source, words());
        return film_by(probe);
    }

    Probe probe_of_kernel(const Constants &constants, std::uint32_t source, const std::vector<glm::vec4> &words) const {
        const auto values = with_scene_source(constants, source, words);
        Probe probe(pt::specialised_code(pt::embedded_code().pathtrace, values), sizeof frame_, values);
        set_scene_for(probe, source, words);
        return probe;
    }

    Probe probe_of_tree(std::uint32_t walk_trips = 0) const {
        Constants of_scene = constants();
        of_scene[pt::gpu::ID_WALK_TRIPS] = walk_trips;
        return probe_of_kernel(of_scene, pt::gpu::SCENE_IN_STORAGE, words());
    }

    FilmWords film_by(Probe &probe) const {
        const std::size_t nodes = scene_.tree ? scene_.tree->node_words().size() : 0;
        probe.set_tree(std::span(tree_).first(nodes), std::span(tree_).subspan(nodes));
        std::vector<std::uint32_t> indices(most_samples);
        std::iota(indices.begin(), indices.end(), 0U);
        probe.set_points(pt::point_table(PT_SAMPLER_SOBOL, seed, indices, pt::point_layout(scene_.features)));
        constexpr std::uint32_t below = pt::gpu::TILE_SIZE * width;
        constexpr std::array<std::uint32_t, 4> tiles = {0, pt::gpu::TILE_SIZE, below, below + pt::gpu::TILE_SIZE};
        FilmWords film(std::size_t{pt::gpu::FILM_PARTS} * pt::gpu::FILM_WORDS * width * height);
        probe.run_over(std::as_bytes(std::span(tiles)), std::as_writable_bytes(std::span(film)),
                       std::as_bytes(std::span(&frame_, 1)), tiles.size() * pt::gpu::WORKGROUP_SIZE);
        return film;
    }

    std::vector<glm::uvec4> &tree() { return tree_; }

    std::vector<float> radiance(const FilmWords &film) const {
        const pt::PixelSums sums = sums_of(film, width * height);
        for (std::size_t pixel = 0; pixel < sums.pixel_count(); ++pixel)
            pt::require_samples(sums.samples_of(pixel), {frame_.sample_count, 0});
        return sums.values(PT_QUANTITY_RADIANCE, 1.0 / double{scene_.frame.film_scale});
    }

private:
    pt::View scene_;
    std::vector<glm::uvec4> tree_;
    pt::gpu::FrameConstants frame_;
};

inline KernelRender render_of_scene(const InvarianceScene &scene, std::uint32_t max_path_length = 4) {
    return {pt::owned_scene(checked_scene_of(scene.scene())), pt::validated_camera(scene.camera), max_path_length};
}
