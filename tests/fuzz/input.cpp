#include "tests/fuzz/input.h"

#include "tests/fuzz/numbers.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace fuzz {

namespace {

constexpr std::uint32_t most_surfaces_read = 12;
constexpr std::uint32_t most_copies = 128;

template <std::size_t Count>
void read_lengths(Numbers &numbers, double (&lengths)[Count]) {
    for (double &length : lengths)
        length = numbers.length();
}

pt_material material(Numbers &numbers, ByteReader &bytes) {
    pt_material material{};
    const bool emits = bytes.one_in(4);
    const bool shines = bytes.one_in(2);
    const bool gains = bytes.one_in(32);
    const auto reflectance = [&](float most) { return gains ? numbers.color() : std::min(numbers.color(), most); };
    for (std::size_t i = 0; i < 3; ++i) {
        material.emission[i] = emits ? numbers.color() : 0.0F;
        material.diffuse[i] = reflectance(1.0F);
        material.specular[i] = shines ? reflectance(1.0F - material.diffuse[i]) : 0.0F;
    }
    material.glossiness = shines ? numbers.glossiness() : 0.0F;
    return material;
}

pt_sphere sphere(Numbers &numbers, ByteReader &bytes, std::uint32_t material_count) {
    pt_sphere sphere{};
    read_lengths(numbers, sphere.center);
    sphere.radius = numbers.positive_length();
    if (bytes.one_in(8))
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

void read_camera(Numbers &numbers, ByteReader &bytes, pt_camera &camera) {
    camera.struct_size = sizeof camera;
    camera.target[2] = -1.0;
    if (bytes.one_in(2)) {
        read_lengths(numbers, camera.position);
        read_lengths(numbers, camera.target);
    }
    if (bytes.one_in(4))
        for (double &component : camera.up)
            component = numbers.component();
    if (bytes.one_in(4))
        camera.vertical_fov = numbers.field_of_view();
    if (bytes.one_in(4)) {
        const double open = numbers.share();
        const double close = numbers.share();
        camera.shutter_open = std::min(open, close);
        camera.shutter_close = std::max(open, close);
    }
    camera.projection = numbers.count(PT_PROJECTION_ORTHOGRAPHIC + 1);
    if (camera.projection == PT_PROJECTION_ORTHOGRAPHIC)
        camera.vertical_extent = numbers.length();
    else if (bytes.one_in(4)) {
        camera.aperture = numbers.length();
        camera.focus = numbers.length();
    }
}

void read_render(Numbers &numbers, ByteReader &bytes, pt_render &render) {
    static constexpr std::uint32_t lengths[] = {0, 1, 2, 3, 6, 8, 12, 40, 1024};
    render.struct_size = sizeof render;
    render.width = 1 + numbers.count(8);
    render.height = 1 + numbers.count(4);
    render.max_path_length = bytes.choice(lengths);
    render.estimator = numbers.count(PT_ESTIMATOR_MIS + 1);
    render.sampler = numbers.count(PT_SAMPLER_SOBOL + 1);
    render.seed = bytes.raw<std::uint64_t>();
    render.first_sample = bytes.one_in(8) ? bytes.raw<std::uint32_t>() : 0;
    render.first_row = numbers.count(render.height > 0 && render.height <= 4 ? render.height : 1);
    render.row_count = bytes.one_in(8) ? numbers.count(3) : 0;
    render.flags = numbers.count(PT_RENDER_COVERAGE + 1);
}

void read_claims(ByteReader &bytes, Input &input) {
    input.claims.has_materials = !bytes.one_in(32);
    input.claims.has_spheres = !bytes.one_in(32);
    input.claims.has_planes = !bytes.one_in(32);
    if (bytes.one_in(32))
        input.claims.more_spheres = (1U << 30) | bytes.raw<std::uint32_t>();
    if (bytes.one_in(32))
        input.claims.fewer_materials = bytes.below(256);
    for (std::uint32_t &size : input.struct_sizes) {
        if (bytes.one_in(16))
            size = bytes.one_in(4) ? bytes.raw<std::uint32_t>() : bytes.below(256);
    }
    // Versions of pt_scene contain whole pointers, so their sizes are multiples of 8.
    std::uint32_t &scene_size = input.struct_sizes[0];
    if (scene_size < sizeof(pt_scene) && scene_size > offsetof(pt_scene, materials))
        scene_size &= ~7U;
    input.tail_byte = bytes.one_in(8) ? 1 : 0;
}

void read_columns(ByteReader &bytes, Input &input) {
    static constexpr std::uint32_t right_types[] = {PT_TYPE_FLOAT64, PT_TYPE_FLOAT64, PT_TYPE_FLOAT64, PT_TYPE_UINT32,
                                                    PT_TYPE_SRGB8};
    Input::Columns &columns = input.columns;
    columns.count = bytes.raw<std::uint16_t>() % static_cast<std::uint32_t>(input.spheres.size() + 1);
    columns.has_colors = bytes.one_in(2);
    if (bytes.one_in(4)) {
        columns.claimed = bytes.below(Input::Columns::none);
        columns.claim.data = bytes.one_in(8) ? nullptr : &input;
        columns.claim.stride_bytes =
            bytes.one_in(16) ? (1U << 31) | bytes.raw<std::uint32_t>() : bytes.below(sizeof(pt_sphere) + 1);
        columns.claim.type = bytes.one_in(4) ? bytes.raw<std::uint8_t>() : right_types[columns.claimed];
    }
    if (bytes.one_in(32))
        columns.more_spheres = (1U << 27) | bytes.raw<std::uint32_t>();
    if (bytes.one_in(16))
        columns.struct_size = bytes.one_in(4) ? bytes.raw<std::uint32_t>() : bytes.below(256);
    // No caller's array ends within a pointer.
    if (columns.struct_size < sizeof(pt_sphere_array) && columns.struct_size > offsetof(pt_sphere_array, center))
        columns.struct_size &= ~7U;
}

pt_sphere_array columns_of(const Input &input, std::size_t first, std::size_t count) {
    const Input::Columns &columns = input.columns;
    pt_sphere_array array{};
    array.struct_size = columns.struct_size;
    array.count = static_cast<std::uint32_t>(count) | columns.more_spheres;
    if (count == 0)
        return array;
    const auto column = [](const void *data, std::uint32_t type) { return pt_column{data, sizeof(pt_sphere), type}; };
    const pt_sphere &sphere = input.spheres[first];
    array.center = column(sphere.center, PT_TYPE_FLOAT64);
    array.radius = column(&sphere.radius, PT_TYPE_FLOAT64);
    array.motion = column(sphere.motion, PT_TYPE_FLOAT64);
    array.material = column(&sphere.material, PT_TYPE_UINT32);
    if (columns.has_colors)
        array.color = column(sphere.center, PT_TYPE_SRGB8);
    if (columns.claimed < Input::Columns::none) {
        pt_column *const all[] = {&array.center, &array.radius, &array.motion, &array.material, &array.color};
        pt_column &claimed = *all[columns.claimed];
        const void *data = columns.claimed == 4 ? sphere.center : claimed.data;
        claimed = columns.claim;
        claimed.data = columns.claim.data ? data : nullptr;
    }
    return array;
}

void write_arrays(const Input &input, std::span<const pt_sphere_array> arrays) {
    const std::size_t size = std::clamp<std::size_t>(input.columns.struct_size, sizeof(std::uint32_t), 65536);
    input.array_bytes.assign(arrays.size() * size, input.tail_byte);
    input.array_bytes.shrink_to_fit();
    for (std::size_t i = 0; i < arrays.size(); ++i)
        std::memcpy(input.array_bytes.data() + i * size, &arrays[i], std::min(sizeof(pt_sphere_array), size));
}

template <typename Surface>
void repeat(std::vector<Surface> &surfaces, std::uint32_t copies) {
    const std::size_t once = surfaces.size();
    surfaces.reserve(once * (copies + 1));
    for (std::size_t i = 0; i < once * copies; ++i) {
        surfaces.push_back(surfaces[i]);
    }
}

} // namespace

pt_scene Input::scene() const {
    const auto count = [](const auto &elements) { return static_cast<std::uint32_t>(elements.size()); };
    pt_scene scene{};
    scene.struct_size = sizeof scene;
    scene.material_count = count(materials) - std::min(count(materials), claims.fewer_materials);
    scene.sphere_count = (count(spheres) - columns.count) | claims.more_spheres;
    scene.plane_count = count(planes);
    scene.materials = claims.has_materials ? materials.data() : nullptr;
    scene.spheres = claims.has_spheres ? spheres.data() : nullptr;
    scene.planes = claims.has_planes ? planes.data() : nullptr;
    if (columns.count > 0) {
        const std::size_t first = spheres.size() - columns.count;
        const std::size_t half = columns.count / 2;
        const std::array arrays{columns_of(*this, first, half), columns_of(*this, first + half, columns.count - half)};
        write_arrays(*this, arrays);
        scene.sphere_arrays = reinterpret_cast<const pt_sphere_array *>(array_bytes.data());
        scene.sphere_array_count = count(arrays);
    }
    return scene;
}

Input decoded_input(ByteReader bytes) {
    Input input;
    const bool wild = bytes.one_in(4);
    Numbers numbers(bytes, wild);
    const std::uint32_t material_count = 1 + bytes.below(4);
    const std::uint32_t sphere_count = bytes.below(most_surfaces_read);
    const std::uint32_t plane_count = bytes.below(most_surfaces_read / 2);
    input.sample_count = 1 + bytes.below(4);
    read_render(numbers, bytes, input.render);
    read_camera(numbers, bytes, input.camera);
    for (std::uint32_t i = 0; i < material_count; ++i)
        input.materials.push_back(material(numbers, bytes));
    for (std::uint32_t i = 0; i < sphere_count; ++i)
        input.spheres.push_back(sphere(numbers, bytes, material_count));
    for (std::uint32_t i = 0; i < plane_count; ++i)
        input.planes.push_back(plane(numbers, material_count));
    if (wild)
        read_claims(bytes, input);
    if (bytes.one_in(16)) {
        const std::uint32_t copies = bytes.below(most_copies);
        repeat(input.spheres, copies);
        repeat(input.planes, copies);
    }
    if (bytes.one_in(2))
        read_columns(bytes, input);
    return input;
}

void change_one_number(Input &input, ByteReader &bytes) {
    Numbers numbers(bytes, false);
    const auto any = [&](auto &elements) -> auto & {
        return elements[bytes.raw<std::uint16_t>() % elements.size()];
    };
    const auto component = [&](auto &values) -> auto & {
        return values[bytes.below(3)];
    };
    const std::uint32_t kind = bytes.below(8);
    if (kind < 4 && !input.spheres.empty()) {
        pt_sphere &sphere = any(input.spheres);
        if (kind == 0)
            sphere.radius = numbers.positive_length();
        else if (kind == 1 && component(sphere.motion) != 0.0)
            component(sphere.motion) = numbers.length();
        else
            component(sphere.center) = numbers.length();
    } else if (kind < 6 && !input.planes.empty()) {
        pt_plane &plane = any(input.planes);
        (kind == 4 ? plane.offset : component(plane.normal)) = kind == 4 ? numbers.length() : numbers.component();
    } else if (kind == 6 && !input.materials.empty()) {
        pt_material &material = any(input.materials);
        if (component(material.emission) > 0.0F)
            component(material.emission) = numbers.color();
        else if (material.glossiness > 0.0F)
            material.glossiness = numbers.glossiness();
        else
            component(material.diffuse) = std::min(numbers.color(), 1.0F);
    } else {
        component(bytes.one_in(2) ? input.camera.target : input.camera.position) = numbers.length();
    }
}

void SizedStruct::copy(const void *value, std::size_t known_size, std::uint32_t size, std::uint8_t tail_byte) {
    // The library refuses more than 64 KiB without reading them.
    constexpr std::size_t largest = 65536;
    const std::size_t length = std::clamp<std::size_t>(size, sizeof(std::uint32_t), largest);
    bytes_ = std::make_unique<std::uint8_t[]>(length);
    std::fill_n(bytes_.get(), length, tail_byte);
    std::memcpy(bytes_.get(), value, std::min(known_size, length));
}

} // namespace fuzz
