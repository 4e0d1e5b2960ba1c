# The library's tests, by rooms: api/ (the calls of pt.h), film/ (sums, their error, and images), geometry/ (scenes, cameras,
# trees and first hits), light/ (samples of lamps, and radiance), kernel/ (its code and data), vulkan/ (devices and the memory
# of devices), accuracy/ (functions of the kernel against long double). Each room has tests without a device, in
# pt_host_tests, and with one, in pt_device_tests: two programs, because each links the library.
pt_add_tests(
  host
  api/render_settings_test.cpp
  api/scene_digest_test.cpp
  film/adaptive_rule_test.cpp
  film/comparison_test.cpp
  film/display_test.cpp
  film/error_estimate_test.cpp
  film/film_bytes_test.cpp
  film/film_calls_test.cpp
  film/film_test.cpp
  film/image_test.cpp
  film/pixel_sums_test.cpp
  film/tile_errors_test.cpp
  film/tile_samples_test.cpp
  geometry/camera_test.cpp
  geometry/displacement_test.cpp
  geometry/hidden_surfaces_test.cpp
  geometry/kept_shape_test.cpp
  geometry/outlying_test.cpp
  geometry/ray_start_test.cpp
  geometry/scene_test.cpp
  geometry/sphere_array_rules_test.cpp
  geometry/sphere_array_test.cpp
  geometry/sphere_order_test.cpp
  geometry/sphere_tree_test.cpp
  geometry/twins_test.cpp
  kernel/scene_blocks_test.cpp
  kernel/scene_features_test.cpp
  kernel/schedule_test.cpp
  kernel/specialised_code_test.cpp
  light/lamp_words_test.cpp
  light/point_sequence_test.cpp
  light/small_lamps_test.cpp
  vulkan/device_choice_test.cpp
)
target_precompile_headers(pt_host_tests PRIVATE ${PROJECT_SOURCE_DIR}/lib/vulkan/api.h <gtest/gtest.h>)
# Not with sanitizers: trees of a hundred thousand spheres, and statistics over thousands of films. Other tests run the same
# code on less.
if(PT_SANITIZE)
  set(large
      AdaptivePlan.CallsThatEndAnywhere*
      Comparison.EqualLight*
      Comparison.TheSmallestChange*
      PixelSums.ValuesAreTheNearestFloats
      SphereOrder.GivesEach*
      TreeCuts.OfMany*
  )
  list(JOIN large ":" large)
  set_tests_properties(host PROPERTIES ENVIRONMENT "GTEST_FILTER=-${large}")
endif()
set_tests_properties(host PROPERTIES LABELS quick)

pt_add_tests(
  device
  api/arguments_test.cpp
  api/context_test.cpp
  api/errors_test.cpp
  api/in_use_test.cpp
  api/kept_kernels_test.cpp
  api/polling_test.cpp
  api/set_scene_test.cpp
  api/struct_size_test.cpp
  film/adaptive_test.cpp
  film/coverage_test.cpp
  film/estimate_on_device_test.cpp
  film/film_on_device_test.cpp
  film/readback_test.cpp
  film/readback_to_buffer_test.cpp
  film/resolve_test.cpp
  film/saved_film_test.cpp
  film/split_into_calls_test.cpp
  film/split_over_devices_test.cpp
  geometry/first_hit_test.cpp
  kernel/probe.cpp
  kernel/trace_pipelines_test.cpp
  vulkan/borrowed_device_test.cpp
  vulkan/device_test.cpp
  vulkan/own_vulkan_test.cpp
)
set(kernels film_sums recurrence)
# What the kernel computes. Not with sanitizers: these spend their minutes in the kernel and the driver, not in this code.
if(NOT PT_SANITIZE)
  target_sources(
    pt_device_tests
    PRIVATE accuracy/camera_test.cpp
            accuracy/comparison.cpp
            accuracy/evaluation.cpp
            accuracy/integer_test.cpp
            accuracy/intersect_test.cpp
            accuracy/lights_test.cpp
            accuracy/maths_test.cpp
            accuracy/phong_test.cpp
            accuracy/sampling_test.cpp
            accuracy/vertex_test.cpp
            film/unknown_error_test.cpp
            geometry/capsule_test.cpp
            geometry/first_hit_random_test.cpp
            geometry/hidden_from_camera_test.cpp
            geometry/intersection_test.cpp
            geometry/motion_and_lens_test.cpp
            geometry/tree_test.cpp
            kernel/scene_source_test.cpp
            light/lamp_choice_test.cpp
            light/opacity_test.cpp
            light/random_light_test.cpp
            light/sampler_test.cpp
            light/spot_test.cpp
  )
  list(
    APPEND
    kernels
    accuracy_skips
    camera_items
    distance_items
    integer_items
    intersection
    lamp_items
    lamps
    phong_items
    sample_numbers
    sampling_items
    spots
    vertex_items
  )
endif()
target_precompile_headers(pt_device_tests REUSE_FROM pt_host_tests)
foreach(kernel IN LISTS kernels)
  pt_embed_shader(pt_device_tests ${CMAKE_CURRENT_SOURCE_DIR}/kernel/probe/${kernel}.comp)
endforeach()
if(TARGET pt-glsl)
  target_sources(pt_device_tests PRIVATE api/reload_test.cpp kernel/shader_source_test.cpp)
  target_compile_definitions(pt_device_tests PRIVATE PT_TEST_SHADER_DIR="${PROJECT_SOURCE_DIR}/shaders")
  # A program that has the library's objects in itself finds the module by name. By RPATH, not RUNPATH, which does not count
  # where AddressSanitizer stands between the program and dlopen.
  set_target_properties(pt_device_tests PROPERTIES BUILD_RPATH $<TARGET_FILE_DIR:pt-glsl>)
  target_link_options(pt_device_tests PRIVATE -Wl,--disable-new-dtags)
  add_dependencies(pt_device_tests pt-glsl)
endif()
# What is quick, and all else in two halves, which are among the first.
set(quick "ApiTest.*:SplitIntoCalls.*:Film.*:Resolve.*")
# Not with sanitizers: what takes a second or more, most of it in the kernel and in the compilers of drivers and of GLSL, and
# reaches nothing of the library that others do not.
if(PT_SANITIZE)
  set(slow
      AdaptiveTest.EachTile*
      AdaptiveTest.SplitsAndResumes*
      ApiTest.TheCallersRoundingMode*
      EstimateTest.*ThatOfTheHost
      FirstHit.Is*
      PollingTest.AnyPattern*
      PollingTest.ATarget*
      ReadbackTest.Rectangles*
      ReloadTest.AContext*
      ReloadTest.AllDevices*
      ReloadTest.OtherKernels*
      Resolve.BitsAre*
      Resolve.LostSamples*
      SavedFilm.PartsAddUp*
      SplitIntoCalls.NoSampleIsLost*
      SplitOverDevices.SeveralDevices*
  )
  list(JOIN slow ":" slow)
  set(but "-${slow}")
  set(rest "${quick}:${slow}")
else()
  set(rest "${quick}")
endif()
add_test(
  NAME device.quick COMMAND ${pt_leak_checked} $<TARGET_FILE:pt_device_tests> "--gtest_filter=${quick}${but}"
)
set_tests_properties(device.quick PROPERTIES LABELS quick)
add_test(NAME device.second_half COMMAND ${pt_leak_checked} $<TARGET_FILE:pt_device_tests>)
set(rest "GTEST_FILTER=-${rest};GTEST_TOTAL_SHARDS=2")
set_tests_properties(device PROPERTIES ENVIRONMENT "${rest};GTEST_SHARD_INDEX=0" COST 70)
set_tests_properties(device.second_half PROPERTIES ENVIRONMENT "${rest};GTEST_SHARD_INDEX=1" COST 70)
