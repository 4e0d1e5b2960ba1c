// A program of somebody else, in C++: inside a ball that shines, every pixel has the ball's radiance, exactly. It has
// a namespace pt of its own, with names that the library uses inside. Exit status 0 if all is as it should be; an
// argument takes the place of the red that is expected, so that the check can be seen to fail.
#include <pt/pt.h>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace pt {

// Of the same signature as a function inside the library.
const char *result_name(pt_result) {
    return "a name of the program's";
}

// Of the same name as a class inside the library.
class Error : public std::runtime_error {
public:
    Error(pt_result code, const std::string &message);
    pt_result code;
};

Error::Error(pt_result failure, const std::string &message) :
    std::runtime_error(std::string(pt_result_name(failure)) + ": " + message),
    code(failure) {}

} // namespace pt

namespace {

void check(pt_result result, const pt_context *context) {
    if (result < 0)
        throw pt::Error(result, pt_last_error(context));
}

using Context = std::unique_ptr<pt_context, decltype(&pt_destroy)>;

Context create() {
    pt_context *context = nullptr;
    check(pt_create(nullptr, &context), nullptr);
    return Context(context, &pt_destroy);
}

std::vector<float> render(pt_context *context) {
    const pt_material material = {{0, 0, 0}, {0, 0, 0}, {2, 1, 0.5F}, 0, 0};
    const pt_sphere ball = {{0, 0, 0}, 3, {0, 0, 0}, 0, 0};
    pt_scene scene{};
    scene.struct_size = sizeof scene;
    scene.material_count = 1;
    scene.materials = &material;
    scene.sphere_count = 1;
    scene.spheres = &ball;
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.target[2] = -1;
    pt_render settings{};
    settings.struct_size = sizeof settings;
    settings.width = 8;
    settings.height = 4;
    pt_accumulate_info samples{};
    samples.struct_size = sizeof samples;
    samples.sample_count = 3;
    std::vector<float> pixels(std::size_t{3} * settings.width * settings.height);
    pt_image image{};
    image.struct_size = sizeof image;
    image.data = pixels.data();
    image.size_bytes = pixels.size() * sizeof(float);

    check(pt_set_scene(context, &scene), context);
    check(pt_set_camera(context, &camera), context);
    check(pt_set_render(context, &settings), context);
    check(pt_accumulate(context, &samples), context);
    check(pt_readback(context, &image), context);
    return pixels;
}

// The library's own exceptions and names are not mixed up with those of the program.
void check_own_names(pt_context *context) {
    if (pt_set_camera(context, nullptr) != PT_ERROR_INVALID_ARGUMENT)
        throw std::runtime_error("a camera that is NULL was not refused as it should be");
    if (pt_result_name(PT_OK) != std::string("PT_OK") || pt::result_name(PT_OK) == std::string("PT_OK"))
        throw std::runtime_error("the program's function and the library's are mixed up");
}

} // namespace

int main(int argument_count, char **arguments) {
    try {
        const float expected[] = {argument_count > 1 ? std::stof(arguments[1]) : 2, 1, 0.5F};
        const Context context = create();
        const std::vector<float> pixels = render(context.get());
        check_own_names(context.get());
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            if (pixels[i] != expected[i % 3]) {
                std::cerr << "value " << i << " is " << pixels[i] << ", not " << expected[i % 3] << '\n';
                return 1;
            }
        }
        return 0;
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
}
