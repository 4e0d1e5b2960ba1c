#include "cli/picture/denoise.h"

#include "cli/base/context.h"

#include <pt/denoise.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cli {
namespace {

pt_error_estimate denoise(const std::string &library, const Rectangle &size, const std::array<const float *, 4> &images,
                          float *to) {
    auto info = sized<pt_denoise_info>();
    info.width = size.width;
    info.height = size.height;
    info.first = images[0];
    info.second = images[1];
    info.albedo = images[2];
    info.normal = images[3];
    info.denoised = to;
    info.library = library.c_str();
    auto error = sized<pt_error_estimate>();
    const pt_result result = pt_denoise(&info, &error);
    if (result < 0)
        throw Failure(result == PT_ERROR_UNSUPPORTED ? ExitCode::file : exit_code_of(result),
                      last_error(nullptr).in_words(&in_words_of_options));
    return error;
}

} // namespace

void require_denoiser(const std::string &library) {
    const std::array<float, 3> black{};
    std::array<float, 3> result{};
    denoise(library, {0, 0, 1, 1}, {black.data(), black.data(), black.data(), black.data()}, result.data());
}

RenderedImage denoised(const std::string &library, const RenderedImage &first, RenderedImage second,
                       std::span<const float> albedo, std::span<const float> normal) {
    std::vector<float> result(first.radiance.size());
    second.error =
        denoise(library, first.part, {first.radiance.data(), second.radiance.data(), albedo.data(), normal.data()},
                result.data());
    second.raw.resize(result.size());
    std::ranges::transform(first.radiance, second.radiance, second.raw.begin(),
                           [](float a, float b) { return (a + b) / 2; });
    second.radiance = std::move(result);
    second.stats.sample_count += first.stats.sample_count;
    second.stats.max_sample_count += first.stats.max_sample_count;
    second.stats.mean_sample_count += first.stats.mean_sample_count;
    second.stats.rejected_samples += first.stats.rejected_samples;
    return second;
}

} // namespace cli
