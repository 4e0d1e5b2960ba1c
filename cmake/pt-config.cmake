# find_package(pt): the target pt::pt. The library brings all it needs but the Vulkan loader, which it names itself.
include(${CMAKE_CURRENT_LIST_DIR}/pt-targets.cmake)
