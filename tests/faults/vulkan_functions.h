// Vulkan functions with their effects on objects and their errors (Vulkan 1.3.239, "Return Codes").
#pragma once

// X(name without vk, effect on objects, possible errors...)
#define FAULTS_VULKAN_FUNCTIONS(X)                                                                                     \
    X(EnumerateInstanceVersion, None, VK_ERROR_OUT_OF_HOST_MEMORY)                                                     \
    X(EnumerateInstanceExtensionProperties, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)          \
    X(EnumerateInstanceLayerProperties, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)              \
    X(CreateInstance, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,                             \
      VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_LAYER_NOT_PRESENT, VK_ERROR_EXTENSION_NOT_PRESENT,                      \
      VK_ERROR_INCOMPATIBLE_DRIVER)                                                                                    \
    X(DestroyInstance, Destroys)                                                                                       \
    X(EnumeratePhysicalDevices, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,                      \
      VK_ERROR_INITIALIZATION_FAILED)                                                                                  \
    X(GetPhysicalDeviceProperties, None)                                                                               \
    X(GetPhysicalDeviceProperties2, None)                                                                              \
    X(GetPhysicalDeviceMemoryProperties, None)                                                                         \
    X(GetPhysicalDeviceQueueFamilyProperties, None)                                                                    \
    X(EnumerateDeviceExtensionProperties, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)            \
    X(CreateDevice, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,                               \
      VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_EXTENSION_NOT_PRESENT, VK_ERROR_FEATURE_NOT_PRESENT,                    \
      VK_ERROR_TOO_MANY_OBJECTS, VK_ERROR_DEVICE_LOST)                                                                 \
    X(DestroyDevice, Destroys)                                                                                         \
    X(GetDeviceQueue, None)                                                                                            \
    X(CreateCommandPool, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                          \
    X(DestroyCommandPool, Destroys)                                                                                    \
    X(AllocateCommandBuffers, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                        \
    X(FreeCommandBuffers, None)                                                                                        \
    X(ResetCommandBuffer, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                            \
    X(BeginCommandBuffer, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                            \
    X(EndCommandBuffer, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                              \
    X(CreateFence, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                                \
    X(DestroyFence, Destroys)                                                                                          \
    X(ResetFences, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                                   \
    X(GetFenceStatus, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_DEVICE_LOST)          \
    X(WaitForFences, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_DEVICE_LOST,           \
      VK_TIMEOUT)                                                                                                      \
    X(QueueSubmit, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_DEVICE_LOST, VK_TIMEOUT) \
    X(CreatePipelineCache, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                        \
    X(GetPipelineCacheData, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                          \
    X(DestroyPipelineCache, Destroys)                                                                                  \
    X(CreateBuffer, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                               \
    X(DestroyBuffer, Destroys)                                                                                         \
    X(CreateBufferView, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                           \
    X(DestroyBufferView, Destroys)                                                                                     \
    X(GetBufferMemoryRequirements, None)                                                                               \
    X(AllocateMemory, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_TOO_MANY_OBJECTS)  \
    X(FreeMemory, Destroys)                                                                                            \
    X(BindBufferMemory, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                              \
    X(MapMemory, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_MEMORY_MAP_FAILED)         \
    X(CreateDescriptorSetLayout, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                  \
    X(DestroyDescriptorSetLayout, Destroys)                                                                            \
    X(CreateDescriptorPool, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,                       \
      VK_ERROR_FRAGMENTATION)                                                                                          \
    X(DestroyDescriptorPool, Destroys)                                                                                 \
    X(AllocateDescriptorSets, None, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,                        \
      VK_ERROR_FRAGMENTED_POOL, VK_ERROR_OUT_OF_POOL_MEMORY)                                                           \
    X(UpdateDescriptorSets, None)                                                                                      \
    X(CreatePipelineLayout, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY)                       \
    X(DestroyPipelineLayout, Destroys)                                                                                 \
    X(CreateShaderModule, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,                         \
      VK_ERROR_INVALID_SHADER_NV)                                                                                      \
    X(DestroyShaderModule, Destroys)                                                                                   \
    X(CreateComputePipelines, Creates, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,                     \
      VK_ERROR_INVALID_SHADER_NV)                                                                                      \
    X(DestroyPipeline, Destroys)                                                                                       \
    X(CmdBindPipeline, None)                                                                                           \
    X(CmdBindDescriptorSets, None)                                                                                     \
    X(CmdPushConstants, None)                                                                                          \
    X(CmdDispatch, None)                                                                                               \
    X(CmdPipelineBarrier, None)                                                                                        \
    X(CmdCopyBuffer, None)                                                                                             \
    X(CmdFillBuffer, None)                                                                                             \
    X(CmdUpdateBuffer, None)
