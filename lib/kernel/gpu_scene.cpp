// Turns a validated scene and camera into bytes for the kernel; see gpu_scene.h.
#include "lib/kernel/gpu_scene.h"

#include "lib/base/mixed.h"
#include "lib/scene/curved_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pt {

namespace {

float mean(const glm::vec3 &colour) {
    return (colour.r + colour.g + colour.b) / 3.0F;
}

// Surfaces in the kernel's order: lamps, skies, other spheres, planes with curvature, planes; otherwise as in the scene.
struct KernelOrder {
    std::vector<Sphere> spheres;
    std::vector<CurvedPlane> planes;
    std::vector<std::uint32_t> materials; // of all these
};

KernelOrder kernel_order(const Scene &scene, const Camera &camera) {
    KernelOrder order;
    std::vector<std::uint32_t> plane_materials;
    for (const Sphere &sphere : scene.spheres) {
        if (const auto plane = curved_plane(sphere, scene.materials[sphere.material], camera)) {
            order.planes.push_back(*plane);
            plane_materials.push_back(sphere.material);
        } else {
            order.spheres.push_back(sphere);
        }
    }
    std::ranges::stable_sort(order.spheres, {}, [&](const Sphere &sphere) {
        return sphere_role(sphere, scene.materials[sphere.material], camera);
    });
    for (const Plane &plane : scene.planes) {
        order.planes.push_back(curved_plane(plane, camera));
        plane_materials.push_back(plane.material);
    }
    for (const Sphere &sphere : order.spheres)
        order.materials.push_back(sphere.material);
    order.materials.insert(order.materials.end(), plane_materials.begin(), plane_materials.end());
    return order;
}

// The lobes are chosen by what they can reflect, but the diffuse one with twice the weight: it gathers from the whole
// hemisphere, so its samples vary more. (Measured on the coursework scene with six vertices: a tenth less error than
// with equal weights.) Neither is ever left to chance.
float specular_probability(const Material &material) {
    const float specular = mean(material.specular);
    const float diffuse = 2.0F * mean(material.diffuse);
    if (specular == 0.0F || diffuse == 0.0F)
        return specular > 0.0F ? 1.0F : 0.0F;
    return std::clamp(specular / (specular + diffuse), 1e-3F, 1.0F - 1e-3F);
}

// Writes the words of the surface with a kernel index.
class Writer {
public:
    Writer(std::vector<glm::vec4> &words, const Features &features) : words_(words), features_(features) {}

    void material(std::uint32_t surface, const Material &material) {
        const std::uint64_t count = features_.surface_count();
        // 0 may be given as -0, which the film would take for a negative number: adding 0 makes it +0.
        words_[count + surface] = glm::vec4(material.emission + 0.0F, mean(material.emission));
        // The constants of the two parts of f are in the words, for the kernel to spare them.
        const double lobe = (material.glossiness + 2.0) / (2.0 * std::numbers::pi);
        const glm::dvec3 diffuse = glm::dvec3(material.diffuse) / std::numbers::pi;
        words_[2 * count + surface] = glm::vec4(glm::vec3(diffuse), specular_probability(material));
        if (features_.gloss)
            words_[3 * count + surface] =
                glm::vec4(glm::vec3(glm::dvec3(material.specular) * lobe), material.glossiness);
    }

    void sphere(std::uint32_t surface, const Sphere &sphere, const Camera &camera) {
        const glm::dvec3 opening = sphere.center + camera.shutter_open * sphere.motion - camera.position;
        const glm::dvec3 way = (camera.shutter_close - camera.shutter_open) * sphere.motion;
        words_[surface] = glm::vec4(glm::vec3(opening), static_cast<float>(sphere.radius));
        if (features_.motion)
            words_[motion_words() + surface] = glm::vec4(glm::vec3(way), 0.0F);
    }

    void plane(std::uint32_t surface, const CurvedPlane &plane) {
        words_[surface] = glm::vec4(glm::vec3(plane.normal), static_cast<float>(plane.offset));
        if (features_.curvature)
            words_[curvature_words() + surface - features_.sphere_count] =
                glm::vec4(static_cast<float>(plane.curvature), glm::vec3(plane.way));
    }

private:
    std::uint64_t motion_words() const { return (features_.gloss ? 4 : 3) * std::uint64_t{features_.surface_count()}; }
    std::uint64_t curvature_words() const { return motion_words() + (features_.motion ? features_.sphere_count : 0); }

    std::vector<glm::vec4> &words_;
    const Features &features_;
};

} // namespace

std::vector<glm::vec4> gpu_scene(const Scene &scene, const Camera &camera, const Features &features) {
    std::vector<glm::vec4> words(scene_word_count(features));
    Writer writer(words, features);
    const KernelOrder order = kernel_order(scene, camera);
    std::uint32_t surface = 0;
    for (const Sphere &sphere : order.spheres)
        writer.sphere(surface++, sphere, camera);
    for (const CurvedPlane &plane : order.planes)
        writer.plane(surface++, plane);
    for (surface = 0; surface < features.surface_count(); ++surface)
        writer.material(surface, scene.materials[order.materials[surface]]);
    return words;
}

double film_unit(const Scene &scene) {
    float brightest = 0.0F;
    const auto include = [&](std::uint32_t material) {
        const glm::vec3 &emission = scene.materials[material].emission;
        brightest = std::max({brightest, emission.r, emission.g, emission.b});
    };
    for (const Sphere &sphere : scene.spheres)
        include(sphere.material);
    for (const Plane &plane : scene.planes)
        include(plane.material);
    if (brightest == 0.0F)
        return 1.0;
    int exponent = 0; // brightest = fraction * 2^exponent with fraction in [1/2, 1)
    std::frexp(brightest, &exponent);
    // The kernel multiplies by 1 / unit, which must be a normal float32.
    return std::ldexp(1.0, std::clamp(exponent - 8, -120, 120));
}

gpu::FrameConstants frame_constants(const Camera &camera, const RenderSettings &render, double film_unit) {
    const std::uint64_t seed = mixed(render.seed);
    gpu::FrameConstants constants{};
    constants.camera_right = camera.right;
    constants.camera_up = camera.up;
    constants.camera_forward = camera.forward * (render.height / (2.0 * camera.tan_half_fov));
    constants.start_scale = static_cast<float>(camera.start_distance * (2.0 * camera.tan_half_fov / render.height));
    constants.film_scale = static_cast<float>(1.0 / film_unit);
    constants.width = render.width;
    constants.height = render.height;
    constants.seed = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
    return constants;
}

} // namespace pt
