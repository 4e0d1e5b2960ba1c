#include "lib/vulkan/device_choice.h"

#include "lib/base/error.h"
#include "lib/platform/printable.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <optional>

namespace pt::vulkan {

namespace {

using Kind = vk::PhysicalDeviceType;

constexpr bool is(int number, Kind kind) {
    return number == static_cast<int>(kind);
}
static_assert(is(PT_DEVICE_OTHER, Kind::eOther) && is(PT_DEVICE_INTEGRATED_GPU, Kind::eIntegratedGpu) &&
              is(PT_DEVICE_DISCRETE_GPU, Kind::eDiscreteGpu) && is(PT_DEVICE_VIRTUAL_GPU, Kind::eVirtualGpu) &&
              is(PT_DEVICE_CPU, Kind::eCpu));

template <std::size_t size>
void copy_text(char (&target)[size], const std::string &text) {
    const std::size_t length = std::min(text.size(), size - 1);
    std::memcpy(target, text.data(), length);
    target[length] = '\0';
}

std::string unsuitable_reason(const vk::raii::PhysicalDevice &device, std::uint32_t api_version) {
    if (api_version < VK_API_VERSION_1_2)
        return "Vulkan 1.2 is needed, it has " + std::to_string(VK_API_VERSION_MAJOR(api_version)) + "." +
               std::to_string(VK_API_VERSION_MINOR(api_version));
    const auto computes = [](const vk::QueueFamilyProperties &family) {
        return static_cast<bool>(family.queueFlags & vk::QueueFlagBits::eCompute);
    };
    if (!std::ranges::any_of(device.getQueueFamilyProperties(), computes))
        return "it has no queue for compute";
    return "";
}

std::uint64_t largest_device_heap(const vk::raii::PhysicalDevice &device) {
    const vk::PhysicalDeviceMemoryProperties memory = device.getMemoryProperties();
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
    return largest;
}

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string uuid_digits(const pt_device_info &device) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : device.uuid) {
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

bool is_uuid(const std::string &digits) {
    return digits.size() == 32 && digits.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool is_index(const std::string &text) {
    return !text.empty() && text.size() < 32 && text.find_first_not_of("0123456789") == std::string::npos;
}

std::string mismatch(const pt_device_info &device, const std::string &wanted) {
    if (wanted.empty())
        return "";
    if (wanted == "cpu")
        return device.kind == PT_DEVICE_CPU ? "" : "not a CPU";
    if (wanted == "gpu")
        return device.kind == PT_DEVICE_CPU || device.kind == PT_DEVICE_OTHER ? "not a GPU" : "";
    std::string digits = wanted;
    std::erase(digits, '-');
    if (is_uuid(digits))
        return uuid_digits(device) == digits ? "" : "another UUID";
    return lower_case(device.name).find(wanted) != std::string::npos ? "" : "the name does not contain it";
}

int rank(const pt_device_info &device) {
    constexpr std::array<std::uint32_t, 4> best_first = {PT_DEVICE_DISCRETE_GPU, PT_DEVICE_INTEGRATED_GPU,
                                                         PT_DEVICE_VIRTUAL_GPU, PT_DEVICE_CPU};
    return static_cast<int>(std::ranges::find(best_first, device.kind) - best_first.begin());
}

std::size_t indexed_device(std::span<const pt_device_info> devices, const std::string &wanted) {
    std::uint64_t index = UINT64_MAX;
    std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (index >= devices.size())
        refuse_argument("create", "device", wanted,
                        "must be an index below " + std::to_string(devices.size()) + ", the number of devices",
                        PT_ERROR_NO_DEVICE);
    const pt_device_info &device = devices[index];
    if (!device.suitable)
        throw Error(PT_ERROR_NO_DEVICE, "device " + wanted + " (" + device.name + ") does not fit: " + device.reason);
    return index;
}

} // namespace

pt_device_info describe(const vk::raii::PhysicalDevice &device) {
    const vk::PhysicalDeviceProperties basic = device.getProperties();
    pt_device_info info{};
    const auto kind = static_cast<std::uint32_t>(basic.deviceType);
    info.kind = kind <= std::uint32_t{PT_DEVICE_CPU} ? kind : std::uint32_t{PT_DEVICE_OTHER};
    copy_text(info.name, basic.deviceName);
    info.memory_bytes = largest_device_heap(device);
    const std::string reason = unsuitable_reason(device, basic.apiVersion);
    copy_text(info.reason, reason);
    info.suitable = reason.empty() ? 1 : 0;
    if (basic.apiVersion >= VK_API_VERSION_1_2) {
        const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceIDProperties,
                                                 vk::PhysicalDeviceDriverProperties>();
        const auto &uuid = chain.get<vk::PhysicalDeviceIDProperties>().deviceUUID;
        std::copy(uuid.begin(), uuid.end(), info.uuid);
        const auto &driver = chain.get<vk::PhysicalDeviceDriverProperties>();
        copy_text(info.driver, std::string(driver.driverName.data()) + ", " + driver.driverInfo.data());
    }
    return info;
}

std::size_t choose_device(std::span<const pt_device_info> devices, const std::string &wanted) {
    if (is_index(wanted))
        return indexed_device(devices, wanted);
    const std::string words = lower_case(wanted);
    std::size_t best = devices.size();
    std::string reasons;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const std::string against = devices[i].suitable ? mismatch(devices[i], words) : devices[i].reason;
        if (!against.empty())
            reasons += "\n  " + std::to_string(i) + ": " + devices[i].name + ": " + against;
        else if (best == devices.size() || rank(devices[i]) < rank(devices[best]))
            best = i;
    }
    if (best == devices.size())
        throw Error(PT_ERROR_NO_DEVICE,
                    (wanted.empty() ? "no device fits:" : "no device fits \"" + platform::printable(wanted) + "\":") +
                        reasons);
    return best;
}

namespace {

// Returns an empty list if an item is a name, because names may contain commas.
std::vector<std::string> listed(const std::string &wanted) {
    std::vector<std::string> items;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
        end = wanted.find(',', begin);
        const std::string text = wanted.substr(begin, end - begin);
        std::string digits = lower_case(text);
        std::erase(digits, '-');
        if (!is_index(text) && !is_uuid(digits))
            return {};
        items.push_back(text);
    }
    return items;
}

// Two drivers may list one GPU with the same UUID.
std::optional<std::size_t> same_device_among(std::span<const pt_device_info> devices,
                                             std::span<const std::size_t> chosen, std::size_t other) {
    const std::string uuid = uuid_digits(devices[other]);
    const bool known = uuid.find_first_not_of('0') != std::string::npos;
    const auto found = std::ranges::find_if(
        chosen, [&](std::size_t index) { return index == other || (known && uuid_digits(devices[index]) == uuid); });
    return found == chosen.end() ? std::nullopt : std::optional(*found);
}

std::vector<std::size_t> all_of_the_best_kind(std::span<const pt_device_info> devices) {
    const std::uint32_t kind = devices[choose_device(devices, "")].kind;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (devices[i].suitable && devices[i].kind == kind && !same_device_among(devices, chosen, i))
            chosen.push_back(i);
    return chosen;
}

} // namespace

std::vector<std::size_t> choose_devices(std::span<const pt_device_info> devices, const std::string &wanted) {
    if (lower_case(wanted) == "all")
        return all_of_the_best_kind(devices);
    std::vector<std::size_t> chosen;
    for (const std::string &item : listed(wanted)) {
        const std::size_t index = choose_device(devices, item);
        if (const std::optional<std::size_t> same = same_device_among(devices, chosen, index))
            refuse_argument("create", "device", '"' + wanted + '"',
                            "must not name a device twice: " + item + " is device " + std::to_string(*same) + " (" +
                                devices[*same].name + "), which is in the list already");
        chosen.push_back(index);
    }
    return chosen.empty() ? std::vector{choose_device(devices, wanted)} : chosen;
}

} // namespace pt::vulkan
