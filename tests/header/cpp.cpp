// Numbers and types of the binary interface must never change.
#include <pt/accuracy.h>
#include <pt/async.h>
#include <pt/compare.h>
#include <pt/denoise.h>
#include <pt/devices.h>
#include <pt/display.h>
#include <pt/errors.h>
#include <pt/film.h>
#include <pt/map.h>
#include <pt/pt.h>
#include <pt/shaders.h>
#include <pt/stats.h>
#include <pt/vulkan.h>

#include <type_traits>

namespace {

template <typename... Struct>
constexpr bool are_plain = (... && (std::is_trivial_v<Struct> && std::is_standard_layout_v<Struct>));
static_assert(are_plain<pt_device_info, pt_material, pt_sphere, pt_plane, pt_scene, pt_camera, pt_render>);
static_assert(are_plain<pt_accumulate_info, pt_image, pt_stats, pt_error_estimate, pt_function_accuracy, pt_vulkan,
                        pt_create_info>);
static_assert(are_plain<pt_broken_rule, pt_buffer_image, pt_column, pt_denoise_info, pt_sphere_array>);
static_assert(are_plain<pt_display_info>);
static_assert(are_plain<pt_compare_info, pt_compared_image, pt_compared_region, pt_comparison>);

static_assert(std::is_same_v<pt_result, int32_t>);
static_assert(PT_OK == 0 && PT_CANCELLED == 1 && PT_TARGET_REACHED == 2 && PT_PENDING == 3);
static_assert(PT_ERROR_INVALID_ARGUMENT == -1 && PT_ERROR_INVALID_SCENE == -2 && PT_ERROR_INVALID_STATE == -3);
static_assert(PT_ERROR_UNSUPPORTED == -4 && PT_ERROR_NO_DEVICE == -5 && PT_ERROR_OUT_OF_HOST_MEMORY == -6);
static_assert(PT_ERROR_OUT_OF_DEVICE_MEMORY == -7 && PT_ERROR_DEVICE_LOST == -8 && PT_ERROR_SHADER == -9);
static_assert(PT_ERROR_INTERNAL == -10 && PT_ERROR_INCOMPATIBLE == -11 && PT_ERROR_FILE == -12);
static_assert(PT_DEVICE_OTHER == 0 && PT_DEVICE_INTEGRATED_GPU == 1 && PT_DEVICE_DISCRETE_GPU == 2);
static_assert(PT_DEVICE_VIRTUAL_GPU == 3 && PT_DEVICE_CPU == 4);
static_assert(PT_ESTIMATOR_BEST == 0 && PT_ESTIMATOR_UNIFORM == 1 && PT_ESTIMATOR_MIS == 5);
static_assert(PT_FEATURE_LAMPS == 1 && PT_FEATURE_GLOSS == 2 && PT_FEATURE_MOTION == 4 && PT_FEATURE_LARGE == 8);
static_assert(PT_QUANTITY_RADIANCE == 0 && PT_QUANTITY_STANDARD_ERROR == 1 && PT_QUANTITY_SAMPLE_COUNT == 2);
static_assert(PT_QUANTITY_DEPTH == 3 && PT_QUANTITY_NORMAL == 4 && PT_QUANTITY_ALBEDO == 5 && PT_QUANTITY_OBJECT == 6);
static_assert(PT_QUANTITY_COVERAGE == 7);
static_assert(PT_FORMAT_RGB32F == 0 && PT_FORMAT_RGBA32F == 1 && PT_FORMAT_RGBA16F == 2 && PT_FORMAT_R32UI == 3);
static_assert(PT_NO_OBJECT == UINT32_MAX);
static_assert(PT_TYPE_FLOAT32 == 1 && PT_TYPE_FLOAT64 == 2 && PT_TYPE_UINT32 == 3 && PT_TYPE_SRGB8 == 4);
static_assert(PT_LOG_ERROR == 1 && PT_LOG_WARNING == 2 && PT_LOG_INFO == 3);
static_assert(PT_CREATE_VALIDATION == 1);
static_assert(PT_CURVE_NONE == 0 && PT_CURVE_REINHARD == 1 && PT_CURVE_ACES == 2 && PT_CURVE_AGX == 3);
static_assert(PT_CURVE_NEUTRAL == 4);
static_assert(PT_LIGHT_EQUAL_BITS == 1 && PT_LIGHT_SAME == 2 && PT_LIGHT_DIFFERENT == 3 && PT_LIGHT_UNDECIDED == 4);

static_assert(std::is_same_v<decltype(&pt_version), uint32_t (*)()>);
static_assert(std::is_same_v<decltype(&pt_result_name), const char *(*)(pt_result)>);
static_assert(std::is_same_v<decltype(&pt_next_check), uint32_t (*)(uint32_t)>);
static_assert(std::is_same_v<decltype(&pt_next_round), uint32_t (*)(uint32_t)>);
static_assert(std::is_same_v<decltype(&pt_get_devices), pt_result (*)(pt_device_info *, uint32_t *)>);
static_assert(std::is_same_v<decltype(&pt_create), pt_result (*)(const pt_create_info *, pt_context **)>);
static_assert(std::is_same_v<decltype(&pt_last_error), const char *(*)(const pt_context *)>);
static_assert(std::is_same_v<decltype(&pt_destroy), void (*)(pt_context *)>);
static_assert(std::is_same_v<decltype(&pt_get_context_device), pt_result (*)(pt_context *, pt_device_info *)>);
static_assert(std::is_same_v<decltype(&pt_set_scene), pt_result (*)(pt_context *, const pt_scene *)>);
static_assert(std::is_same_v<decltype(&pt_set_camera), pt_result (*)(pt_context *, const pt_camera *)>);
static_assert(std::is_same_v<decltype(&pt_set_render), pt_result (*)(pt_context *, const pt_render *)>);
static_assert(std::is_same_v<decltype(&pt_reload_shaders), pt_result (*)(pt_context *)>);
static_assert(std::is_same_v<decltype(&pt_accumulate), pt_result (*)(pt_context *, const pt_accumulate_info *)>);
static_assert(std::is_same_v<decltype(&pt_start), pt_result (*)(pt_context *, const pt_accumulate_info *)>);
static_assert(std::is_same_v<decltype(&pt_poll), pt_result (*)(pt_context *, uint64_t, double *)>);
static_assert(std::is_same_v<decltype(&pt_cancel), pt_result (*)(pt_context *)>);
static_assert(std::is_same_v<decltype(&pt_readback), pt_result (*)(pt_context *, const pt_image *)>);
static_assert(
    std::is_same_v<decltype(&pt_map_image), pt_result (*)(pt_context *, const pt_image *, void **, uint64_t *)>);
static_assert(std::is_same_v<decltype(&pt_readback_to_buffer), pt_result (*)(pt_context *, const pt_buffer_image *)>);
static_assert(std::is_same_v<decltype(&pt_get_stats), pt_result (*)(pt_context *, pt_stats *)>);
static_assert(std::is_same_v<decltype(&pt_get_error_estimate), pt_result (*)(pt_context *, pt_error_estimate *)>);
static_assert(std::is_same_v<decltype(&pt_compare), pt_result (*)(const pt_compare_info *, pt_comparison *,
                                                                  pt_compared_region *, uint32_t *)>);
static_assert(std::is_same_v<decltype(&pt_denoise), pt_result (*)(const pt_denoise_info *, pt_error_estimate *)>);
static_assert(
    std::is_same_v<decltype(&pt_get_accuracy), pt_result (*)(pt_context *, pt_function_accuracy *, uint32_t *)>);
static_assert(
    std::is_same_v<decltype(&pt_get_broken_rule), uint64_t (*)(const pt_context *, uint32_t, pt_broken_rule *)>);
static_assert(std::is_same_v<decltype(&pt_get_warning), pt_result (*)(pt_context *, pt_broken_rule *)>);

} // namespace
