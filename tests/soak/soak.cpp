// Makes and destroys contexts, and changes scenes in one, as often as is wanted, and looks at the process's memory:
//   pt_soak [contexts [scenes]]        40 and 1000 if not said
// A leak of the smallest piece that malloc gives, 32 bytes with its header, in each round is to be found: so much the
// heap may grow, and by four pages in all for what the driver's threads keep, as they happen to run. A control, which
// makes and destroys a Vulkan instance and device and nothing else, shows what the driver itself leaks (Mesa 22.3.6:
// 144 bytes): contexts may grow by that besides. Growth is taken from the end of the first quarter, when caches are
// filled. Exit code 1: memory grew more.
#include <pt/pt.h>
#include <pt/stats.h>

#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include <malloc.h>
#include <unistd.h>

namespace {

struct Memory {
    double heap;         // bytes that malloc has given and not got back
    double resident;     // bytes of the process in memory
    double device_bytes; // pt_stats.device_bytes
};

Memory memory(uint64_t device_bytes) {
    const struct mallinfo2 info = mallinfo2();
    unsigned long total = 0;
    unsigned long resident = 0;
    if (std::FILE *file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%lu %lu", &total, &resident) != 2)
            resident = 0;
        std::fclose(file);
    }
    return {static_cast<double>(info.uordblks + info.hblkhd),
            static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)),
            static_cast<double>(device_bytes)};
}

void require(bool holds, const char *what) {
    if (holds)
        return;
    std::fprintf(stderr, "pt_soak: %s failed\n", what);
    std::exit(2);
}

void require_ok(pt_result result, const pt_context *context) {
    require(result == PT_OK, pt_last_error(context));
}

// Growth of the heap in bytes a round, from the first quarter to the end.
double growth(const char *title, int rounds, const std::function<uint64_t(int)> &round) {
    const int step = std::max(rounds / 20, 1); // from row to row of the table
    std::printf("%s\n%10s %14s %14s %14s %12s\n", title, "rounds", "heap bytes", "resident", "on device", "s / round");
    int warm = 0;
    Memory first{};
    Memory last{};
    auto begin = std::chrono::steady_clock::now();
    for (int done = 1; done <= rounds; ++done) {
        last = memory(round(done));
        if (done % step != 0)
            continue;
        const auto now = std::chrono::steady_clock::now();
        std::printf("%10d %14.0f %14.0f %14.0f %12.6f\n", done, last.heap, last.resident, last.device_bytes,
                    std::chrono::duration<double>(now - begin).count() / step);
        std::fflush(stdout);
        begin = now;
        if (warm == 0 && done >= rounds / 4) {
            warm = done;
            first = last;
        }
    }
    require(last.device_bytes == first.device_bytes, "constant device memory");
    const double grown = (last.heap - first.heap) / std::max(rounds - warm, 1);
    std::printf("grows by %.1f bytes a round, resident memory by %.1f\n\n", grown,
                (last.resident - first.resident) / std::max(rounds - warm, 1));
    return grown;
}

// What the loader and the driver keep of each instance and device.
uint64_t make_and_destroy_vulkan_device(int /*round*/) {
    const VkApplicationInfo application{
        VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "soak", 0, nullptr, 0, VK_API_VERSION_1_2};
    VkInstanceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    create.pApplicationInfo = &application;
    VkInstance instance = VK_NULL_HANDLE;
    require(vkCreateInstance(&create, nullptr, &instance) == VK_SUCCESS, "vkCreateInstance");
    uint32_t count = 1;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    require(vkEnumeratePhysicalDevices(instance, &count, &physical_device) >= VK_SUCCESS, "vkEnumeratePhysicalDevices");
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo create_device{};
    create_device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    create_device.queueCreateInfoCount = 1;
    create_device.pQueueCreateInfos = &queue;
    VkDevice device = VK_NULL_HANDLE;
    require(vkCreateDevice(physical_device, &create_device, nullptr, &device) == VK_SUCCESS, "vkCreateDevice");
    vkDestroyDevice(device, nullptr);
    vkDestroyInstance(instance, nullptr);
    return 0;
}

const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {8, 4, 2}, 0, 0},
                                 {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0, 0}};

void set_scene(pt_context *context, int round) {
    const pt_sphere spheres[] = {{{3, 2, -8}, 1, {0, 0, 0}, 0, 0},
                                 {{-1, 1e-3 * (round % 100), -6}, 1, {0, 0, 0}, 1, 0}};
    pt_scene scene{};
    scene.struct_size = sizeof scene;
    scene.material_count = 2;
    scene.sphere_count = 2;
    scene.materials = materials;
    scene.spheres = spheres;
    require_ok(pt_set_scene(context, &scene), context);
}

pt_context *create(int round) {
    pt_context *context = nullptr;
    require_ok(pt_create(nullptr, &context), nullptr);
    set_scene(context, round);
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.shutter_close = 1;
    camera.target[2] = -1;
    require_ok(pt_set_camera(context, &camera), context);
    pt_render render{};
    render.struct_size = sizeof render;
    render.width = 16;
    render.height = 8;
    render.max_path_length = 2;
    require_ok(pt_set_render(context, &render), context);
    return context;
}

// Returns pt_stats.device_bytes.
uint64_t render(pt_context *context) {
    pt_accumulate_info accumulate{};
    accumulate.struct_size = sizeof accumulate;
    accumulate.sample_count = 1;
    require_ok(pt_accumulate(context, &accumulate), context);
    std::vector<float> pixels(std::size_t{16} * 8 * 3);
    pt_image image{};
    image.struct_size = sizeof image;
    image.data = pixels.data();
    image.size_bytes = pixels.size() * sizeof(float);
    require_ok(pt_readback(context, &image), context);
    pt_stats stats{};
    stats.struct_size = sizeof stats;
    require_ok(pt_get_stats(context, &stats), context);
    return stats.device_bytes;
}

} // namespace

int main(int argument_count, char **arguments) {
    const int contexts = argument_count > 1 ? std::atoi(arguments[1]) : 40;
    const int scenes = argument_count > 2 ? std::atoi(arguments[2]) : 1000;
    require(contexts >= 4 && scenes >= 4, "reading the numbers of contexts and scenes, which must be at least 4,");

    constexpr int warm_up = 60; // after which the loader and the driver keep the same each time
    for (int round = 0; round < warm_up; ++round)
        make_and_destroy_vulkan_device(round);
    const double control = growth("control: Vulkan instance and device", contexts, make_and_destroy_vulkan_device);
    // The same scene each time, so that the driver's cache of shaders stays as it is.
    const double of_contexts = growth("contexts", contexts, [](int) {
        pt_context *context = create(0);
        const uint64_t device_bytes = render(context);
        pt_destroy(context);
        return device_bytes;
    });
    pt_context *context = create(0);
    const double of_scenes = growth("scenes", scenes, [&](int round) {
        set_scene(context, round);
        return render(context);
    });
    pt_destroy(context);

    const auto allowed = [](int rounds) { return 32.0 + 4.0 * 4096.0 / rounds; };
    const bool flat = of_contexts <= std::max(control, 0.0) + allowed(contexts) && of_scenes <= allowed(scenes);
    std::printf("%s: %.1f bytes a context beside the control's and %.1f a scene are allowed\n",
                flat ? "flat" : "NOT FLAT", allowed(contexts), allowed(scenes));
    return flat ? 0 : 1;
}
