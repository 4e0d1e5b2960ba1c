#include "tests/faults/vulkan_calls.h"

#include "tests/faults/allocations.h"
#include "tests/faults/kept_objects.h"
#include "tests/faults/vulkan_functions.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <vector>

extern "C" std::chrono::steady_clock::time_point __wrap__ZNSt6chrono3_V212steady_clock3nowEv();
extern "C" PFN_vkVoidFunction __real_vkGetInstanceProcAddr(VkInstance instance, const char *name);
extern "C" PFN_vkVoidFunction __wrap_vkGetInstanceProcAddr(VkInstance instance, const char *name);

namespace faults {

namespace {

enum class Effect { None, Creates, Destroys };

enum class Call {
#define FAULTS_NAME(id, ...) id,
    FAULTS_VULKAN_FUNCTIONS(FAULTS_NAME)
};

struct Function {
    const char *name;
    Effect effect;
    std::vector<VkResult> errors;
};

const Function &function(Call call) {
    static const std::vector<Function> functions = {
#define FAULTS_FUNCTION(id, effect, ...) {"vk" #id, Effect::effect, {__VA_ARGS__}},
        FAULTS_VULKAN_FUNCTIONS(FAULTS_FUNCTION)};
    return functions[static_cast<std::size_t>(call)];
}

constexpr Effect effects[] = {
#define FAULTS_EFFECT(id, effect, ...) Effect::effect,
    FAULTS_VULKAN_FUNCTIONS(FAULTS_EFFECT)};

std::chrono::steady_clock::time_point present;
std::size_t call_count = 0;
std::size_t failing_number = 0;
std::size_t failing_error = 0;
CallFault fault;
bool posing = false;
std::uint64_t largest_heap = UINT64_MAX;
std::set<const void *> lost; // devices and queues
std::set<VkFence> hanging;
std::map<VkQueue, VkDevice> devices_of_queues;
std::multimap<const void *, Call> live; // objects by handle, with their makers
PFN_vkDeviceWaitIdle wait_idle = nullptr;
PFN_vkGetDeviceProcAddr get_device_function = nullptr;

template <typename... A>
VkDevice device_of(const std::tuple<A...> &arguments) {
    const auto first = std::get<0>(arguments);
    if constexpr (std::is_same_v<decltype(first), const VkQueue>)
        return devices_of_queues[first];
    else if constexpr (std::is_same_v<decltype(first), const VkDevice>)
        return first;
    else
        return VK_NULL_HANDLE;
}

std::optional<VkResult> result_by_plan(Call call) {
    const std::vector<VkResult> &errors = function(call).errors;
    if (errors.empty() || ++call_count != failing_number)
        return std::nullopt;
    const bool may_hang = posing || errors.back() != VK_TIMEOUT; // A wait for a CPU has no time limit.
    const std::size_t error_count = errors.size() - (may_hang ? 0 : 1);
    fault = {function(call).name, errors[failing_error % error_count], error_count};
    return fault.result;
}

constexpr std::chrono::milliseconds submission_time{1};
constexpr std::chrono::milliseconds look_time{100};
constexpr std::chrono::microseconds polling_time{300};

template <Call call, typename... A>
std::optional<VkResult> result_by_state(const std::tuple<A...> &arguments) {
    constexpr bool is_wait = call == Call::WaitForFences || call == Call::GetFenceStatus;
    if constexpr (is_wait || call == Call::QueueSubmit)
        if (lost.contains(device_of(arguments)))
            return VK_ERROR_DEVICE_LOST;
    if constexpr (call == Call::WaitForFences)
        if (hanging.contains(*std::get<2>(arguments))) {
            pass_time(look_time);
            return VK_TIMEOUT;
        }
    if constexpr (call == Call::GetFenceStatus)
        if (hanging.contains(std::get<1>(arguments))) {
            pass_time(look_time);
            return VK_NOT_READY;
        }
    return std::nullopt;
}

void note_end(const void *handle) {
    if (!handle)
        return;
    const auto object = live.find(handle);
    if (object == live.end()) {
        std::fputs("an object is destroyed twice\n", stderr);
        std::abort();
    }
    live.erase(object);
}

template <Call call, typename... A>
void note_effect(const std::tuple<A...> &arguments) {
    constexpr Effect effect = effects[static_cast<std::size_t>(call)];
    if constexpr (effect == Effect::Creates)
        live.emplace(*std::get<sizeof...(A) - 1>(arguments), call);
    if constexpr (effect == Effect::Destroys)
        note_end(std::get<sizeof...(A) - 2>(arguments));
    if constexpr (call == Call::WaitForFences)
        pass_time(submission_time);
    if constexpr (call == Call::GetFenceStatus)
        pass_time(polling_time); // The library waits after one poll.
    if constexpr (call == Call::GetDeviceQueue)
        devices_of_queues[*std::get<3>(arguments)] = std::get<0>(arguments);
    if constexpr (call == Call::GetPhysicalDeviceProperties)
        if (posing)
            std::get<1>(arguments)->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    if constexpr (call == Call::GetPhysicalDeviceProperties2)
        if (posing)
            std::get<1>(arguments)->properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    if constexpr (call == Call::GetPhysicalDeviceMemoryProperties)
        for (VkMemoryHeap &heap : std::get<1>(arguments)->memoryHeaps)
            heap.size = std::min<VkDeviceSize>(heap.size, largest_heap);
}

template <Call call, typename Real, typename... A>
auto made(Real real, A... values) {
    [[maybe_unused]] const std::tuple<A...> arguments(values...);
    if constexpr (call == Call::CreateInstance) {
        return kept_instance(real, std::get<0>(arguments), std::get<2>(arguments));
    } else if constexpr (call == Call::CreateDevice) {
        return kept_device(real, std::get<0>(arguments), std::get<1>(arguments), std::get<3>(arguments));
    } else if constexpr (call == Call::CreateComputePipelines) {
        return kept_pipeline(real, std::get<0>(arguments), std::get<3>(arguments), std::get<5>(arguments));
    } else if constexpr (call == Call::DestroyDevice) {
        put_back(std::get<0>(arguments));
    } else if constexpr (call == Call::CreateShaderModule) {
        const VkResult result = real(values...);
        note_code(*std::get<3>(arguments), std::get<1>(arguments));
        return result;
    } else if constexpr (call != Call::DestroyInstance && call != Call::DestroyPipeline) {
        return real(values...);
    }
}

template <Call call, typename Pointer>
struct Hook;

template <Call call, typename Result, typename... A>
struct Hook<call, Result(VKAPI_PTR *)(A...)> {
    static inline Result(VKAPI_PTR *real)(A...) = nullptr;

    static VKAPI_ATTR Result VKAPI_CALL run(A... values) {
        const InLibrary out_of_library(false);
        const std::tuple<A...> arguments(values...);
        if constexpr (std::is_same_v<Result, VkResult>) {
            const std::optional<VkResult> planned = result_by_plan(call);
            if (planned == VK_TIMEOUT && call == Call::WaitForFences) {
                pass_time(std::chrono::hours{1});
                return VK_TIMEOUT;
            }
            if (planned == VK_TIMEOUT) {
                if constexpr (call == Call::QueueSubmit)
                    hanging.insert(std::get<3>(arguments));
            } else if (planned) {
                if (planned == VK_ERROR_DEVICE_LOST && device_of(arguments)) {
                    wait_idle(device_of(arguments)); // ends the lost device's work
                    lost.insert(device_of(arguments));
                }
                return *planned;
            }
            if (const std::optional<VkResult> result = result_by_state<call>(arguments))
                return *result;
            const VkResult result = made<call>(real, values...);
            if (result == VK_SUCCESS)
                note_effect<call>(arguments);
            if (planned == VK_TIMEOUT) // The CPU's driver crashes if resources in use are freed.
                wait_idle(device_of(arguments));
            return result;
        } else {
            if constexpr (effects[static_cast<std::size_t>(call)] != Effect::None)
                note_effect<call>(arguments);
            made<call>(real, values...);
            if constexpr (effects[static_cast<std::size_t>(call)] == Effect::None)
                note_effect<call>(arguments);
        }
    }
};

struct Entry {
    PFN_vkVoidFunction hook;
    PFN_vkVoidFunction *real;
};

const std::unordered_map<std::string_view, Entry> &entries() {
    static const std::unordered_map<std::string_view, Entry> entries = [] {
        std::unordered_map<std::string_view, Entry> result;
#define FAULTS_ENTRY(id, ...)                                                                                          \
    using Hook##id = Hook<Call::id, PFN_vk##id>;                                                                       \
    result["vk" #id] = {reinterpret_cast<PFN_vkVoidFunction>(&Hook##id::run),                                          \
                        reinterpret_cast<PFN_vkVoidFunction *>(&Hook##id::real)};
        FAULTS_VULKAN_FUNCTIONS(FAULTS_ENTRY)
        return result;
    }();
    return entries;
}

// A function without a hook would stay untested.
[[noreturn]] void unknown_function() {
    std::fputs("the library called a Vulkan function that tests/faults/vulkan_functions.h does not list\n", stderr);
    std::abort();
}

PFN_vkVoidFunction hooked(const char *name, PFN_vkVoidFunction real) {
    if (!real)
        return nullptr;
    const auto entry = entries().find(name);
    if (entry == entries().end())
        return reinterpret_cast<PFN_vkVoidFunction>(&unknown_function);
    *entry->second.real = real;
    return entry->second.hook;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char *name) {
    const InLibrary out_of_library(false);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
    const PFN_vkVoidFunction real = get_device_function(device, name);
    if (std::strcmp(name, "vkDeviceWaitIdle") == 0)
        wait_idle = reinterpret_cast<PFN_vkDeviceWaitIdle>(real);
    return hooked(name, real);
}

} // namespace

void fail_call(std::size_t number, std::size_t error_index) {
    call_count = 0;
    failing_number = number;
    failing_error = error_index;
    fault = {};
}

CallFault call_fault() {
    return fault;
}

void heal_devices() {
    lost.clear();
    hanging.clear();
}

void pass_time(std::chrono::nanoseconds duration) {
    present += duration;
}

void pose_as_gpu(bool pose) {
    posing = pose;
}

void limit_memory(std::uint64_t bytes) {
    largest_heap = bytes;
}

std::map<std::string, long> live_objects() {
    std::map<std::string, long> counts;
    for (const auto &[handle, maker] : live)
        ++counts[function(maker).name];
    return counts;
}

void forget_objects() {
    live.clear();
    put_all_back();
}

} // namespace faults

std::chrono::steady_clock::time_point __wrap__ZNSt6chrono3_V212steady_clock3nowEv() {
    return faults::present;
}

PFN_vkVoidFunction __wrap_vkGetInstanceProcAddr(VkInstance instance, const char *name) {
    using namespace faults;
    const InLibrary out_of_library(false);
    const PFN_vkVoidFunction real = __real_vkGetInstanceProcAddr(instance, name);
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(&__wrap_vkGetInstanceProcAddr);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        get_device_function = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
    }
    return hooked(name, real);
}
