#include "cli/picture/denoise.h"

#include "cli/base/context.h"

#include <pt/denoise.h>

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

namespace cli {
namespace {

struct Rounds {
    const RenderHalves &render;
    Halves halves{};
    pt_denoise_info info = sized<pt_denoise_info>();
    pt_error_estimate error = sized<pt_error_estimate>();
    std::exception_ptr failure{};

    bool add(std::uint32_t sample_count) {
        if (!render(sample_count, error, halves))
            return false;
        info.first = halves.first.radiance.data();
        info.second = halves.second.radiance.data();
        info.albedo = halves.albedo.data();
        info.normal = halves.normal.data();
        return true;
    }
};

std::int32_t add_round(void *user, std::uint32_t sample_count) {
    auto &rounds = *static_cast<Rounds *>(user);
    try {
        return rounds.add(sample_count) ? 0 : 1;
    } catch (...) {
        rounds.failure = std::current_exception();
        return 1;
    }
}

} // namespace

void require_denoiser(const std::string &library) {
    const std::vector<float> black(3);
    const RenderedImage image{.part = {0, 0, 1, 1}, .radiance = black};
    denoised(library, {image, image, black, black});
}

RenderedImage denoised(const std::string &library, Halves halves) {
    const Rectangle part = halves.first.part;
    auto rounds = sized<pt_rounds_info>();
    rounds.sample_count = 1;
    const auto render = [&](std::uint32_t, const pt_error_estimate &, Halves &rendered) {
        rendered = std::move(halves);
        return true;
    };
    return denoised_rounds(library, part, rounds, render).image;
}

Denoised denoised_rounds(const std::string &library, const Rectangle &part, pt_rounds_info rounds,
                         const RenderHalves &render) {
    Rounds state{render};
    std::vector<float> result(3 * part.pixel_count());
    state.info.width = part.width;
    state.info.height = part.height;
    state.info.denoised = result.data();
    state.info.library = library.c_str();
    rounds.render = &add_round;
    rounds.render_user = &state;
    const pt_result ended = pt_denoise_rounds(&rounds, &state.info, &state.error);
    if (state.failure)
        std::rethrow_exception(state.failure);
    if (ended < 0)
        throw Failure(ended == PT_ERROR_UNSUPPORTED ? ExitCode::file : exit_code_of(ended),
                      last_error(nullptr).in_words(&in_words_of_options));
    const RenderedImage &first = state.halves.first;
    RenderedImage &second = state.halves.second;
    second.error = state.error;
    second.raw.resize(first.radiance.size());
    std::ranges::transform(first.radiance, second.radiance, second.raw.begin(),
                           [](float a, float b) { return (a + b) / 2; });
    second.radiance = std::move(result);
    second.stats.sample_count += first.stats.sample_count;
    second.stats.max_sample_count += first.stats.max_sample_count;
    second.stats.mean_sample_count += first.stats.mean_sample_count;
    second.stats.rejected_samples += first.stats.rejected_samples;
    return {std::move(second), ended};
}

} // namespace cli
