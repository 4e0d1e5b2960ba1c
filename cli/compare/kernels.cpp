#include "cli/compare/kernels.h"

#include "cli/scene/scene.h"
#include "lib/scene_file/sphere_columns.h"

#include <algorithm>

namespace cli {
namespace {

constexpr std::uint32_t first_look = 16; // samples per pixel of the first comparison
constexpr std::uint32_t usual_samples = 65536;

// Equal bits of fewer samples prove little, because rare branches may not have run.
constexpr std::uint32_t least_equal = 256;

class Rendering {
public:
    Rendering(const Context &context, const SceneFile &scene) :
        context_(context),
        settings_(scene.render),
        window_(whole_window(settings_.width, settings_.height)),
        radiance_(3 * window_.part.pixel_count()) {
        describe_scene(context_, scene, [](double) { return true; });
        context_.require(pt_set_render(context_.get(), &settings_));
    }

    void render_up_to(std::uint32_t samples) {
        auto info = sized<pt_accumulate_info>();
        info.sample_count = samples - samples_;
        context_.require(pt_accumulate(context_.get(), &info));
        samples_ = samples;
        context_.read(0, window_.part.width, window_.part.height, PT_QUANTITY_RADIANCE, radiance_.data());
    }

    TestedImage image() const {
        return {window_, radiance_, samples_, samples_, settings_.sampler, settings_.estimator};
    }

private:
    const Context &context_;
    pt_render settings_;
    ImageWindow window_;
    std::vector<float> radiance_;
    std::uint32_t samples_ = 0;
};

} // namespace

LightVerdict compare_kernels(const KernelTask &task, const TellLook &told) {
    SceneFile scene = read_scene_file(task.scene, task.overrides);
    load_columns(scene);
    const Context edited(create_info(task.device, task.shader_dir));
    const Context built_in(create_info(task.device, ""));
    const bool gives_count = scene.gives({{"render", 0, false}, {"spp", 0, false}});
    const std::uint32_t most = gives_count ? scene.sample_count.value() : usual_samples;
    return compare_kernels(edited, built_in, scene, most, task.rule, told);
}

LightVerdict compare_kernels(const Context &edited_context, const Context &built_in_context, const SceneFile &scene,
                             std::uint32_t most, const LightRule &rule, const TellLook &told) {
    Rendering edited(edited_context, scene);
    Rendering built_in(built_in_context, scene);
    for (std::uint32_t look = 1, samples = std::min(first_look, most);; ++look, samples = std::min(2 * samples, most)) {
        edited.render_up_to(samples);
        built_in.render_up_to(samples);
        LightVerdict verdict = test_light(edited.image(), built_in.image(), rule, look);
        told(samples, verdict);
        const bool is_early = verdict.comparison.light == PT_LIGHT_EQUAL_BITS && samples < least_equal;
        if ((verdict.is_decided() && !is_early) || samples == most)
            return verdict;
    }
}

} // namespace cli
