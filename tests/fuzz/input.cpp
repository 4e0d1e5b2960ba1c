#include "tests/fuzz/input.h"

namespace fuzz {

namespace {

constexpr std::uint32_t most_surfaces_read = 12;
constexpr std::uint32_t most_copies = 128;

template <std::size_t Count>
void read_lengths(Numbers &numbers, double (&lengths)[Count]) {
    for (double &length : lengths)
        length = numbers.length();
}

pt_material material(Numbers &numbers) {
    pt_material material{};
    const bool emits = numbers.one_in(4);
    const bool shines = numbers.one_in(2);
    const bool gains = numbers.one_in(32);
    const auto reflectance = [&](float most) { return gains ? numbers.color() : std::min(numbers.color(), most); };
    for (std::size_t i = 0; i < 3; ++i) {
        material.emission[i] = emits ? numbers.color() : 0.0F;
        material.diffuse[i] = reflectance(1.0F);
        material.specular[i] = shines ? reflectance(1.0F - material.diffuse[i]) : 0.0F;
    }
    material.glossiness = shines ? numbers.glossiness() : 0.0F;
    return material;
}

pt_sphere sphere(Numbers &numbers, std::uint32_t material_count) {
    pt_sphere sphere{};
    read_lengths(numbers, sphere.center);
    sphere.radius = numbers.positive_length();
    if (numbers.one_in(8))
        read_lengths(numbers, sphere.motion);
    sphere.material = numbers.count(material_count);
    sphere.reserved = numbers.count(1);
    return sphere;
}

pt_plane plane(Numbers &numbers, std::uint32_t material_count) {
    pt_plane plane{};
    for (double &component : plane.normal)
        component = numbers.component();
    plane.offset = numbers.length();
    plane.material = numbers.count(material_count);
    plane.reserved = numbers.count(1);
    return plane;
}

void read_camera(Numbers &numbers, pt_camera &camera) {
    camera.target[2] = -1.0;
    if (numbers.one_in(2)) {
        read_lengths(numbers, camera.position);
        read_lengths(numbers, camera.target);
    }
    if (numbers.one_in(4))
        for (double &component : camera.up)
            component = numbers.component();
    if (numbers.one_in(4))
        camera.vertical_fov = 3.1415926535897927 * numbers.share();
    if (numbers.one_in(4)) {
        const double open = numbers.share();
        const double close = numbers.share();
        camera.shutter_open = std::min(open, close);
        camera.shutter_close = std::max(open, close);
    }
    camera.projection = numbers.count(PT_PROJECTION_ORTHOGRAPHIC + 1);
    if (camera.projection == PT_PROJECTION_ORTHOGRAPHIC)
        camera.vertical_extent = numbers.length();
    else if (numbers.one_in(4)) {
        camera.aperture = numbers.length();
        camera.focus = numbers.length();
    }
}

void read_render(Numbers &numbers, pt_render &render) {
    static constexpr std::uint32_t lengths[] = {0, 1, 2, 3, 6, 8, 12, 40, 1024};
    render.width = 1 + numbers.count(8);
    render.height = 1 + numbers.count(4);
    render.max_path_length = numbers.choice(lengths);
    render.estimator = numbers.count(PT_ESTIMATOR_MIS + 1);
    render.sampler = numbers.count(PT_SAMPLER_SOBOL + 1);
    render.seed = numbers.raw<std::uint64_t>();
    render.first_sample = numbers.one_in(8) ? numbers.raw<std::uint32_t>() : 0;
    render.first_row = numbers.count(render.height > 0 && render.height <= 4 ? render.height : 1);
    render.row_count = numbers.one_in(8) ? numbers.count(3) : 0;
    render.flags = numbers.count(PT_RENDER_COVERAGE + 1);
}

template <typename Surface>
void repeat(std::vector<Surface> &surfaces, std::uint32_t copies) {
    const std::size_t once = surfaces.size();
    surfaces.reserve(once * (copies + 1));
    for (std::size_t i = 0; i < once * copies; ++i)
        surfaces.push_back(surfaces[i]);
}

} // namespace

pt_scene Input::scene() const {
    const std::size_t first = spheres.size() - column_count;
    const std::span array(&columns, column_count > 0 ? 1 : 0);
    if (column_count > 0) {
        const pt_sphere &sphere = spheres[first];
        const auto column = [](const void *data, std::uint32_t type) {
            return pt_column{data, sizeof(pt_sphere), type};
        };
        columns =
            array_of(column_count, column(sphere.center, PT_TYPE_FLOAT64), column(&sphere.radius, PT_TYPE_FLOAT64));
        columns.motion = column(sphere.motion, PT_TYPE_FLOAT64);
        columns.material = column(&sphere.material, PT_TYPE_UINT32);
        if (has_colors)
            columns.color = column(sphere.center, PT_TYPE_SRGB8);
    }
    return scene_of(materials, std::span(spheres).first(first), planes, array);
}

Input decoded_input(Numbers numbers) {
    Input input;
    if (numbers.one_in(4))
        numbers.be_wild();
    const std::uint32_t material_count = 1 + numbers.below(4);
    const std::uint32_t sphere_count = numbers.below(most_surfaces_read);
    const std::uint32_t plane_count = numbers.below(most_surfaces_read / 2);
    input.sample_count = 1 + numbers.below(4);
    read_render(numbers, input.render);
    read_camera(numbers, input.camera);
    for (std::uint32_t i = 0; i < material_count; ++i)
        input.materials.push_back(material(numbers));
    for (std::uint32_t i = 0; i < sphere_count; ++i)
        input.spheres.push_back(sphere(numbers, material_count));
    for (std::uint32_t i = 0; i < plane_count; ++i)
        input.planes.push_back(plane(numbers, material_count));
    if (numbers.one_in(16)) {
        const std::uint32_t copies = numbers.below(most_copies);
        repeat(input.spheres, copies);
        repeat(input.planes, copies);
    }
    if (numbers.one_in(2)) {
        input.column_count = numbers.raw<std::uint16_t>() % static_cast<std::uint32_t>(input.spheres.size() + 1);
        input.has_colors = numbers.one_in(2);
    }
    return input;
}

} // namespace fuzz
