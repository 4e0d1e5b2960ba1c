// Vulkan-Hpp with this project's settings: RAII handles, exceptions, designated initialisers, the linked loader.
// Included by lib/vulkan/ and, through its headers, by what builds on it.
#pragma once

#define VULKAN_HPP_NO_CONSTRUCTORS
#define VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL 0
#include <vulkan/vulkan_raii.hpp>
