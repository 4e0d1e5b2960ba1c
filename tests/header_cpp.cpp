// pt.h as C++, and its binary interface: sizes, offsets and numbers that programs were compiled with must never change.
// A struct that is passed by pointer may grow at its tail: then its size changes here, and nothing else.
#include <pt/pt.h>

#include <cstddef>
#include <type_traits>

namespace {

static_assert(sizeof(void *) == 8, "the numbers below are those of machines with 64-bit pointers");

// Every member begins where the one before ends: no padding.
#define PT_EXPECT_MEMBER(type, member, offset, size)                                                                   \
    static_assert(offsetof(type, member) == offset && sizeof(type::member) == size)
#define PT_EXPECT_STRUCT(type, size)                                                                                   \
    static_assert(sizeof(type) == size && std::is_trivial_v<type> && std::is_standard_layout_v<type>)

PT_EXPECT_STRUCT(pt_device_info, 800);
PT_EXPECT_MEMBER(pt_device_info, kind, 0, 4);
PT_EXPECT_MEMBER(pt_device_info, suitable, 4, 4);
PT_EXPECT_MEMBER(pt_device_info, memory_bytes, 8, 8);
PT_EXPECT_MEMBER(pt_device_info, uuid, 16, 16);
PT_EXPECT_MEMBER(pt_device_info, name, 32, 256);
PT_EXPECT_MEMBER(pt_device_info, driver, 288, 256);
PT_EXPECT_MEMBER(pt_device_info, reason, 544, 256);

PT_EXPECT_STRUCT(pt_material, 40);
PT_EXPECT_MEMBER(pt_material, diffuse, 0, 12);
PT_EXPECT_MEMBER(pt_material, specular, 12, 12);
PT_EXPECT_MEMBER(pt_material, emission, 24, 12);
PT_EXPECT_MEMBER(pt_material, glossiness, 36, 4);

PT_EXPECT_STRUCT(pt_sphere, 64);
PT_EXPECT_MEMBER(pt_sphere, center, 0, 24);
PT_EXPECT_MEMBER(pt_sphere, radius, 24, 8);
PT_EXPECT_MEMBER(pt_sphere, motion, 32, 24);
PT_EXPECT_MEMBER(pt_sphere, material, 56, 4);
PT_EXPECT_MEMBER(pt_sphere, reserved, 60, 4);

PT_EXPECT_STRUCT(pt_plane, 40);
PT_EXPECT_MEMBER(pt_plane, normal, 0, 24);
PT_EXPECT_MEMBER(pt_plane, offset, 24, 8);
PT_EXPECT_MEMBER(pt_plane, material, 32, 4);
PT_EXPECT_MEMBER(pt_plane, reserved, 36, 4);

PT_EXPECT_STRUCT(pt_scene, 40);
PT_EXPECT_MEMBER(pt_scene, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_scene, material_count, 4, 4);
PT_EXPECT_MEMBER(pt_scene, sphere_count, 8, 4);
PT_EXPECT_MEMBER(pt_scene, plane_count, 12, 4);
PT_EXPECT_MEMBER(pt_scene, materials, 16, 8);
PT_EXPECT_MEMBER(pt_scene, spheres, 24, 8);
PT_EXPECT_MEMBER(pt_scene, planes, 32, 8);

PT_EXPECT_STRUCT(pt_camera, 104);
PT_EXPECT_MEMBER(pt_camera, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_camera, reserved, 4, 4);
PT_EXPECT_MEMBER(pt_camera, position, 8, 24);
PT_EXPECT_MEMBER(pt_camera, target, 32, 24);
PT_EXPECT_MEMBER(pt_camera, up, 56, 24);
PT_EXPECT_MEMBER(pt_camera, vertical_fov, 80, 8);
PT_EXPECT_MEMBER(pt_camera, shutter_open, 88, 8);
PT_EXPECT_MEMBER(pt_camera, shutter_close, 96, 8);

PT_EXPECT_STRUCT(pt_render, 48);
PT_EXPECT_MEMBER(pt_render, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_render, width, 4, 4);
PT_EXPECT_MEMBER(pt_render, height, 8, 4);
PT_EXPECT_MEMBER(pt_render, max_path_length, 12, 4);
PT_EXPECT_MEMBER(pt_render, seed, 16, 8);
PT_EXPECT_MEMBER(pt_render, first_sample, 24, 4);
PT_EXPECT_MEMBER(pt_render, estimator, 28, 4);
PT_EXPECT_MEMBER(pt_render, sampler, 32, 4);
PT_EXPECT_MEMBER(pt_render, reserved, 36, 4);
PT_EXPECT_MEMBER(pt_render, first_row, 40, 4);
PT_EXPECT_MEMBER(pt_render, row_count, 44, 4);

PT_EXPECT_STRUCT(pt_accumulate_info, 32);
PT_EXPECT_MEMBER(pt_accumulate_info, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_accumulate_info, sample_count, 4, 4);
PT_EXPECT_MEMBER(pt_accumulate_info, progress, 8, 8);
PT_EXPECT_MEMBER(pt_accumulate_info, progress_user, 16, 8);
PT_EXPECT_MEMBER(pt_accumulate_info, target_error, 24, 8);

PT_EXPECT_STRUCT(pt_image, 32);
PT_EXPECT_MEMBER(pt_image, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_image, quantity, 4, 4);
PT_EXPECT_MEMBER(pt_image, data, 8, 8);
PT_EXPECT_MEMBER(pt_image, size_bytes, 16, 8);
PT_EXPECT_MEMBER(pt_image, row_bytes, 24, 8);

PT_EXPECT_STRUCT(pt_stats, 96);
PT_EXPECT_MEMBER(pt_stats, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_stats, sample_count, 4, 4);
PT_EXPECT_MEMBER(pt_stats, rejected_samples, 8, 8);
PT_EXPECT_MEMBER(pt_stats, device_bytes, 16, 8);
PT_EXPECT_MEMBER(pt_stats, submit_count, 24, 8);
PT_EXPECT_MEMBER(pt_stats, device_seconds, 32, 8);
PT_EXPECT_MEMBER(pt_stats, features, 40, 4);
PT_EXPECT_MEMBER(pt_stats, device_count, 44, 4);
PT_EXPECT_MEMBER(pt_stats, rmse, 48, 8);
PT_EXPECT_MEMBER(pt_stats, rmse_low, 56, 8);
PT_EXPECT_MEMBER(pt_stats, rmse_high, 64, 8);
PT_EXPECT_MEMBER(pt_stats, relative_rmse, 72, 8);
PT_EXPECT_MEMBER(pt_stats, relative_rmse_low, 80, 8);
PT_EXPECT_MEMBER(pt_stats, relative_rmse_high, 88, 8);

PT_EXPECT_STRUCT(pt_function_accuracy, 64);
PT_EXPECT_MEMBER(pt_function_accuracy, name, 0, 40);
PT_EXPECT_MEMBER(pt_function_accuracy, worst_error, 40, 8);
PT_EXPECT_MEMBER(pt_function_accuracy, bound, 48, 8);
PT_EXPECT_MEMBER(pt_function_accuracy, worst_input, 56, 8);

PT_EXPECT_STRUCT(pt_create_info, 48);
PT_EXPECT_MEMBER(pt_create_info, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_create_info, flags, 4, 4);
PT_EXPECT_MEMBER(pt_create_info, device, 8, 8);
PT_EXPECT_MEMBER(pt_create_info, log, 16, 8);
PT_EXPECT_MEMBER(pt_create_info, log_user, 24, 8);
PT_EXPECT_MEMBER(pt_create_info, submit_milliseconds, 32, 4);
PT_EXPECT_MEMBER(pt_create_info, reserved, 36, 4);
PT_EXPECT_MEMBER(pt_create_info, vulkan, 40, 8);

PT_EXPECT_STRUCT(pt_vulkan, 64);
PT_EXPECT_MEMBER(pt_vulkan, struct_size, 0, 4);
PT_EXPECT_MEMBER(pt_vulkan, queue_family, 4, 4);
PT_EXPECT_MEMBER(pt_vulkan, instance, 8, 8);
PT_EXPECT_MEMBER(pt_vulkan, physical_device, 16, 8);
PT_EXPECT_MEMBER(pt_vulkan, device, 24, 8);
PT_EXPECT_MEMBER(pt_vulkan, queue, 32, 8);
PT_EXPECT_MEMBER(pt_vulkan, lock_queue, 40, 8);
PT_EXPECT_MEMBER(pt_vulkan, unlock_queue, 48, 8);
PT_EXPECT_MEMBER(pt_vulkan, queue_user, 56, 8);

static_assert(std::is_same_v<pt_result, int32_t>);
static_assert(PT_OK == 0 && PT_CANCELLED == 1 && PT_TARGET_REACHED == 2);
static_assert(PT_ERROR_INVALID_ARGUMENT == -1 && PT_ERROR_INVALID_SCENE == -2 && PT_ERROR_INVALID_STATE == -3);
static_assert(PT_ERROR_UNSUPPORTED == -4 && PT_ERROR_NO_DEVICE == -5 && PT_ERROR_OUT_OF_HOST_MEMORY == -6);
static_assert(PT_ERROR_OUT_OF_DEVICE_MEMORY == -7 && PT_ERROR_DEVICE_LOST == -8 && PT_ERROR_SHADER == -9);
static_assert(PT_ERROR_INTERNAL == -10);
static_assert(PT_DEVICE_OTHER == 0 && PT_DEVICE_INTEGRATED_GPU == 1 && PT_DEVICE_DISCRETE_GPU == 2);
static_assert(PT_DEVICE_VIRTUAL_GPU == 3 && PT_DEVICE_CPU == 4);
static_assert(PT_ESTIMATOR_BEST == 0 && PT_ESTIMATOR_UNIFORM == 1 && PT_ESTIMATOR_MIS == 5);
static_assert(PT_FEATURE_LAMPS == 1 && PT_FEATURE_GLOSS == 2 && PT_FEATURE_MOTION == 4 && PT_FEATURE_LARGE == 8);
static_assert(PT_QUANTITY_RADIANCE == 0 && PT_QUANTITY_STANDARD_ERROR == 1);
static_assert(PT_LOG_ERROR == 1 && PT_LOG_WARNING == 2 && PT_LOG_INFO == 3);
static_assert(PT_CREATE_VALIDATION == 1);

// The functions have C linkage and these types.
static_assert(std::is_same_v<decltype(&pt_version), uint32_t (*)()>);
static_assert(std::is_same_v<decltype(&pt_result_name), const char *(*)(pt_result)>);
static_assert(std::is_same_v<decltype(&pt_get_devices), pt_result (*)(pt_device_info *, uint32_t *)>);
static_assert(std::is_same_v<decltype(&pt_create), pt_result (*)(const pt_create_info *, pt_context **)>);
static_assert(std::is_same_v<decltype(&pt_last_error), const char *(*)(const pt_context *)>);
static_assert(std::is_same_v<decltype(&pt_destroy), void (*)(pt_context *)>);
static_assert(std::is_same_v<decltype(&pt_get_context_device), pt_result (*)(pt_context *, pt_device_info *)>);
static_assert(std::is_same_v<decltype(&pt_set_scene), pt_result (*)(pt_context *, const pt_scene *)>);
static_assert(std::is_same_v<decltype(&pt_set_camera), pt_result (*)(pt_context *, const pt_camera *)>);
static_assert(std::is_same_v<decltype(&pt_set_render), pt_result (*)(pt_context *, const pt_render *)>);
static_assert(std::is_same_v<decltype(&pt_accumulate), pt_result (*)(pt_context *, const pt_accumulate_info *)>);
static_assert(std::is_same_v<decltype(&pt_readback), pt_result (*)(pt_context *, const pt_image *)>);
static_assert(std::is_same_v<decltype(&pt_get_stats), pt_result (*)(pt_context *, pt_stats *)>);
static_assert(
    std::is_same_v<decltype(&pt_get_accuracy), pt_result (*)(pt_context *, pt_function_accuracy *, uint32_t *)>);

} // namespace
