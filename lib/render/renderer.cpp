#include "lib/render/renderer.h"

#include "lib/base/error.h"
#include "lib/kernel/accuracy.h"
#include "lib/view/view.h"
#include "lib/vulkan/device_choice.h"

#include <algorithm>
#include <utility>

namespace pt {

namespace {

std::vector<pt_device_info> describe_all(const vulkan::Instance &instance) {
    std::vector<pt_device_info> devices;
    for (const vk::raii::PhysicalDevice &device : instance.physical_devices())
        devices.push_back(vulkan::describe(device));
    return devices;
}

} // namespace

std::vector<pt_device_info> list_devices() {
    return describe_all(vulkan::Instance(Log{}, false));
}

// Reads the code before it makes a device, because the code may have errors.
Renderer::Renderer(const CreateSettings &settings) :
    source_(settings.shader_directory),
    code_(source_.read()),
    instance_(settings.vulkan ? vulkan::Instance(settings.log, settings.vulkan->instance)
                              : vulkan::Instance(settings.log, settings.validation)),
    tree_from_(settings.tree_from) {
    if (settings.vulkan)
        use_device_of(*settings.vulkan, settings);
    else
        use_own_devices(settings);
}

void Renderer::use_own_devices(const CreateSettings &settings) {
    const std::vector<vk::raii::PhysicalDevice> devices = instance_.physical_devices();
    for (const std::size_t index : vulkan::choose_devices(describe_all(instance_), settings.device))
        for (std::uint32_t i = 0; i < settings.devices_of_each; ++i)
            add_device(devices[index], settings);
}

void Renderer::use_device_of(const vulkan::CallerVulkan &caller, const CreateSettings &settings) {
    add_device(validated_physical_device(instance_.handle(), caller), settings, &caller);
}

void Renderer::add_device(const vk::raii::PhysicalDevice &physical_device, const CreateSettings &settings,
                          const vulkan::CallerVulkan *caller) {
    vulkan::DevicePolicy policy =
        settings.like_gpus ? vulkan::gpu_like_policy() : vulkan::default_policy(vulkan::describe(physical_device));
    policy.scene_in_constants = policy.scene_in_constants && settings.scene_kernels;
    policy.adaptive_from = settings.adaptive_from.value_or(policy.adaptive_from);
    devices_.push_back(std::make_unique<RenderDevice>(instance_, physical_device, policy, code_,
                                                      settings.submit_milliseconds * 1e-3, caller));
    devices_.back()->keep_kernels(settings.kernel_store);
    log().info([&] {
        const pt_device_info &info = devices_.back()->device().info();
        return std::string("renders on ") + info.name + " (" + info.driver + ")";
    });
}

bool Renderer::is_alive() const {
    return std::ranges::none_of(devices_, [](const auto &device) { return device->device().lost(); });
}

void Renderer::require_alive() const {
    for (const auto &device : devices_)
        device->device().require_alive();
}

void Renderer::discard_samples() noexcept {
    for (const auto &device : devices_)
        device->discard_samples();
    round_ = {};
    samples_.clear();
    film_view_.forget_samples();
    samples_for_lamps_.clear();
    forget_error();
}

void Renderer::set_scene(CheckedScene scene, WorkProgress &progress) {
    require_alive();
    PreparedScene prepared(std::move(scene), tree_from_, scene_ ? &*scene_ : nullptr, progress);
    progress.finish();
    discard_samples();
    view_.reset();
    small_lamps_.reset();
    scene_ = std::move(prepared);
}

void Renderer::set_camera(const Camera &camera) {
    require_alive();
    discard_samples();
    view_.reset();
    small_lamps_.reset();
    camera_ = camera;
}

void Renderer::set_render(const RenderSettings &settings) {
    require_alive();
    TileSamples none({settings.width, settings.row_count});
    const bool same_size =
        settings_ && settings.width == settings_->width && settings.row_count == settings_->row_count;
    if (!same_size || settings.coverage != settings_->coverage) {
        std::vector<DeviceFilm> films;
        for (const auto &device : devices_)
            films.push_back(device->make_film(settings));
        film_view_.drop();
        for (std::size_t i = 0; i < films.size(); ++i)
            devices_[i]->set_film(std::move(films[i]));
    }
    discard_samples();
    view_.reset();
    if (!same_size || settings.height != settings_->height || settings.first_row != settings_->first_row)
        small_lamps_.reset();
    settings_ = settings;
    samples_ = std::move(none);
}

void Renderer::reload_shaders() {
    require_alive();
    if (source_.is_embedded())
        throw Error(PT_ERROR_INVALID_STATE, "no shader_dir: the kernels are those in the library");
    set_code(source_.read());
}

void Renderer::set_code(const KernelCode &code) {
    if (code == code_)
        return;
    const KernelsKept kept(devices_);
    std::vector<std::unique_ptr<TracePipelines>> pipelines;
    for (const auto &device : devices_)
        pipelines.push_back(device->make_pipelines(code));
    discard_samples();
    film_view_.drop();
    for (std::size_t i = 0; i < pipelines.size(); ++i)
        devices_[i]->set_pipelines(code, std::move(pipelines[i]));
    code_ = code;
}

void Renderer::require_settings() const {
    require_alive();
    if (!scene_)
        throw Error(PT_ERROR_INVALID_STATE, "no scene: call pt_set_scene first");
    if (!camera_)
        throw Error(PT_ERROR_INVALID_STATE, "no camera: call pt_set_camera first");
    if (!settings_)
        throw Error(PT_ERROR_INVALID_STATE, "no render settings: call pt_set_render first");
}

void Renderer::require_samples() const {
    if (samples_.empty())
        throw Error(PT_ERROR_INVALID_STATE, "no samples yet: call pt_accumulate or pt_add_film first");
}

const std::shared_ptr<const View> &Renderer::view() {
    if (!view_)
        view_ = std::make_shared<const View>(view_of(*scene_, *camera_, *settings_));
    return view_;
}

void Renderer::prepare() {
    require_settings();
    const KernelsKept kept(devices_);
    for (const auto &device : devices_)
        device->prepare_ahead(view(), *settings_);
    film_view_.prepare();
}

std::vector<pt_function_accuracy> Renderer::accuracy() {
    return measured_accuracy(devices_.front()->device(), code_.accuracy);
}

} // namespace pt
