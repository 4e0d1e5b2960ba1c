// Changes the scene of one context many times and measures memory: pt_soak [scenes] (default 1000). Leak checks miss
// memory that is freed with the context. The exit code is 1 if the heap grows too much after a quarter of the scenes.
// It may grow by less than malloc's smallest block of 32 bytes per scene, plus four pages for the driver's threads.
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <pt/pt.h>
#include <pt/stats.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <malloc.h>

namespace {

struct Memory {
    double heap;
    uint64_t device_bytes;
};

void require(bool holds, const char *what) {
    if (holds)
        return;
    std::fprintf(stderr, "pt_soak: %s failed\n", what);
    std::exit(2);
}

void require_ok(pt_result result, const pt_context *context) {
    require(result == PT_OK, pt_last_error(context));
}

const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {8, 4, 2}, 0, 0},
                                 {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0, 0}};

void set_scene(pt_context *context, int round) {
    const pt_sphere spheres[] = {{{3, 2, -8}, 1, {0, 0, 0}, 0, 0},
                                 {{-1, 1e-3 * (round % 100), -6}, 1, {0, 0, 0}, 1, 0}};
    const pt_scene scene = scene_of(materials, spheres, {});
    require_ok(pt_set_scene(context, &scene), context);
}

pt_context *create() {
    pt_context *context = nullptr;
    require_ok(pt_create(nullptr, &context), nullptr);
    set_scene(context, 0);
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.shutter_close = 1;
    camera.target[2] = -1;
    require_ok(pt_set_camera(context, &camera), context);
    const pt_render render = render_of(16, 8, 2);
    require_ok(pt_set_render(context, &render), context);
    return context;
}

Memory memory_after_rendering(pt_context *context) {
    pt_accumulate_info accumulate{};
    accumulate.struct_size = sizeof accumulate;
    accumulate.sample_count = 1;
    require_ok(pt_accumulate(context, &accumulate), context);
    std::vector<float> pixels(std::size_t{16} * 8 * 3);
    const pt_image image = image_target(pixels);
    require_ok(pt_readback(context, &image), context);
    pt_stats stats{};
    stats.struct_size = sizeof stats;
    require_ok(pt_get_stats(context, &stats), context);
    const struct mallinfo2 info = mallinfo2();
    return {static_cast<double>(info.uordblks + info.hblkhd), stats.device_bytes};
}

} // namespace

int main(int argument_count, char **arguments) {
    const int scenes = argument_count > 1 ? std::atoi(arguments[1]) : 1000;
    require(scenes >= 4, "reading the number of scenes, which must be at least 4,");
    const int warm = scenes / 4;
    pt_context *context = create();
    Memory first{};
    Memory last{};
    for (int done = 1; done <= scenes; ++done) {
        set_scene(context, done);
        last = memory_after_rendering(context);
        if (done == warm)
            first = last;
        if (done % std::max(scenes / 20, 1) == 0)
            std::printf("%10d %14.0f %14llu\n", done, last.heap, static_cast<unsigned long long>(last.device_bytes));
    }
    pt_destroy(context);
    require(last.device_bytes == first.device_bytes, "constant device memory");
    const double grown = (last.heap - first.heap) / (scenes - warm);
    const double allowed = 32.0 + 4.0 * 4096.0 / scenes;
    std::printf("grows by %.1f bytes a scene, %.1f are allowed\n", grown, allowed);
    return grown <= allowed ? 0 : 1;
}
