// Two contexts in two threads, each of which renders the view of one eye. Both images are written side by side to
// two_contexts.ppm. Contexts are independent. Here they use the same device, but each could use another one
// (pt_create_info.device). Exit status 0 if the file was written.
#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <future>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr uint32_t width = 96;
constexpr uint32_t height = 96;

struct DestroyContext {
    void operator()(pt_context *context) const { pt_destroy(context); }
};
using Context = std::unique_ptr<pt_context, DestroyContext>;

// Results > 0 are remarks. If pt_create failed, context is NULL.
void check(pt_result result, const Context &context) {
    if (result < 0)
        throw std::runtime_error(std::string(pt_result_name(result)) + ": " + pt_last_error(context.get()));
}

Context create_context() {
    pt_context *context = nullptr;
    check(pt_create(nullptr, &context), nullptr);
    return Context(context);
}

// Returns R, G, B of each pixel, row by row, as seen from an eye at this x.
std::vector<float> render(double eye) {
    const pt_material materials[] = {
        {{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
        {{0.4F, 0.1F, 0.1F}, {0.4F, 0.4F, 0.4F}, {0, 0, 0}, 100, 0},
        {{0, 0, 0}, {0, 0, 0}, {40, 40, 36}, 0, 0},
    };
    const pt_sphere spheres[] = {{{0, 1, 0}, 1, {0, 0, 0}, 1, 0}, {{2, 4, 2}, 1, {0, 0, 0}, 2, 0}};
    const pt_plane floor{{0, 1, 0}, 0, 0, 0};
    pt_scene scene{};
    scene.struct_size = sizeof scene;
    scene.material_count = 3;
    scene.sphere_count = 2;
    scene.plane_count = 1;
    scene.materials = materials;
    scene.spheres = spheres;
    scene.planes = &floor;
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.position[0] = eye;
    camera.position[1] = 1.5;
    camera.position[2] = 5;
    camera.target[1] = 1;
    pt_render settings{};
    settings.struct_size = sizeof settings;
    settings.width = width;
    settings.height = height;
    const pt_accumulate_info samples{sizeof samples, 64, nullptr, nullptr, 0, 0, nullptr, 0, 0, {}};
    std::vector<float> pixels(std::size_t{3} * width * height);
    pt_image image{};
    image.struct_size = sizeof image;
    image.data = pixels.data();
    image.size_bytes = pixels.size() * sizeof(float);

    const Context context = create_context();
    check(pt_set_scene(context.get(), &scene), context);
    check(pt_set_camera(context.get(), &camera), context);
    check(pt_set_render(context.get(), &settings), context);
    check(pt_accumulate(context.get(), &samples), context);
    check(pt_readback(context.get(), &image), context);
    return pixels;
}

void write_side_by_side(const std::string &path, const std::vector<float> &left, const std::vector<float> &right) {
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << 2 * width << ' ' << height << "\n255\n";
    for (uint32_t row = 0; row < height; ++row)
        for (const std::vector<float> *eye : {&left, &right})
            for (uint32_t i = 0; i < 3 * width; ++i)
                file.put(static_cast<char>(255 * std::pow(std::min((*eye)[3 * width * row + i], 1.0F), 1 / 2.2F)));
    file.close();
    if (!file)
        throw std::runtime_error(path + " was not written");
}

} // namespace

int main() {
    try {
        std::future<std::vector<float>> left = std::async(std::launch::async, render, -0.1);
        std::future<std::vector<float>> right = std::async(std::launch::async, render, 0.1);
        const std::vector<float> left_image = left.get(); // get() rethrows the thread's exception
        write_side_by_side("two_contexts.ppm", left_image, right.get());
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
