#include "cli/scene/render_settings.h"

#include "cli/base/field_names.h"

#include <algorithm>

namespace cli {
namespace {

constexpr std::uint32_t default_sample_count = 64;

template <typename Value>
Value first_given(const std::optional<Value> &option, const std::optional<Value> &scene, Value otherwise) {
    return option.value_or(scene.value_or(otherwise));
}

// Indices of samples end at 2^32 - 1.
void limit_samples(RenderSettings &settings, bool is_upper_limit) {
    const std::uint64_t left = (std::uint64_t{1} << 32) - settings.render.first_sample;
    if (settings.sample_count <= left)
        return;
    if (!is_upper_limit) {
        throw Failure(ExitCode::usage, "--first-sample " + std::to_string(settings.render.first_sample) + ": " +
                                           std::to_string(settings.sample_count) +
                                           " samples from there on would pass the last index, 4294967295");
    }
    settings.sample_count = static_cast<std::uint32_t>(left);
}

// The library refuses a picture that is empty itself, which has no part.
ImageWindow chosen_window(const std::optional<Rectangle> &crop, const pt_render &render) {
    ImageWindow window = whole_window(render.width, render.height);
    if (!crop || render.width == 0 || render.height == 0)
        return window;
    const bool is_inside = crop->x < render.width && crop->width <= render.width - crop->x && crop->y < render.height &&
                           crop->height <= render.height - crop->y;
    if (!is_inside || crop->pixel_count() == 0) {
        throw Failure(ExitCode::usage, "--crop " + std::to_string(crop->x) + "," + std::to_string(crop->y) + "," +
                                           std::to_string(crop->width) + "," + std::to_string(crop->height) +
                                           ": must be a part of the picture, of " + window_text(window) +
                                           " pixels, with at least one");
    }
    window.part = *crop;
    return window;
}

} // namespace

bool RenderSettings::gives(std::string_view member) const {
    return std::find(scene_members.begin(), scene_members.end(), member) != scene_members.end();
}

// A rule about no setting is about the scene.
bool RenderSettings::is_from_scene(const BrokenRule &rule) const {
    const FieldName *name = find_field_name(rule);
    return name == nullptr || name->option.empty() || gives(rule.member);
}

bool RenderSettings::is_size_from_scene() const {
    return gives("width") || gives("height");
}

Failure RenderSettings::explain(const LibraryError &error, const SceneFile &scene) const {
    ExitCode code = ExitCode::scene;
    const std::string explained = error.in_words([&](const BrokenRule &rule) {
        const bool from_scene = is_from_scene(rule);
        code = from_scene && code == ExitCode::scene ? scene.blame(rule) : ExitCode::usage;
        return from_scene ? scene.explain(rule) : in_words_of_options(rule);
    });
    return {code, explained};
}

RenderSettings merge_settings(const RenderOptions &options, const SceneFile &scene) {
    RenderSettings settings{};
    pt_render &render = settings.render;
    render.struct_size = sizeof(pt_render);
    render.width = options.size ? options.size->width : scene.width.value_or(default_side);
    render.height = options.size ? options.size->height : scene.height.value_or(default_side);
    render.max_path_length = first_given(options.max_path_length, scene.max_path_length, PT_DEFAULT_MAX_PATH_LENGTH);
    render.seed = first_given(options.seed, scene.seed, std::uint64_t{0});
    render.first_sample = options.first_sample;
    render.sampler = first_given(options.sampler, scene.sampler, std::uint32_t{PT_SAMPLER_BEST});
    render.estimator = first_given(options.estimator, scene.estimator, std::uint32_t{PT_ESTIMATOR_BEST});
    settings.target_error = options.target_error.value_or(0.0);
    settings.sampling = options.sampling.value_or(PT_SAMPLING_BEST);
    const bool stops_otherwise = options.target_error || options.time_limit;
    settings.sample_count = first_given(options.sample_count, scene.sample_count,
                                        stops_otherwise ? default_most_samples : default_sample_count);
    limit_samples(settings, stops_otherwise);
    settings.window = chosen_window(options.crop, render);
    settings.exposure = first_given(options.display.exposure, scene.exposure, Exposure{});
    settings.tone_curve = first_given(options.display.tone_curve, scene.tone_curve, ToneCurve::none);
    settings.gamma = options.display.gamma ? options.display.gamma : scene.gamma;
    if (!options.size && (scene.width || scene.height))
        settings.scene_members.insert(settings.scene_members.end(), {"width", "height"});
    if (!options.max_path_length && scene.max_path_length)
        settings.scene_members.emplace_back("max_path_length");
    if (!options.sample_count && scene.sample_count)
        settings.scene_members.emplace_back("sample_count");
    return settings;
}

} // namespace cli
