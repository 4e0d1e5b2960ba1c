// Shares no code with the library.
#pragma once

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

class DoublePathTracer {
public:
    struct Estimate {
        double mean = 0.0;
        double variance = 0.0;
    };

    DoublePathTracer(const pt_scene &scene, const pt_camera &camera, std::uint32_t seed) :
        scene_(scene),
        camera_(camera),
        engine_(seed),
        position_(vector(camera.position)),
        forward_(glm::normalize(vector(camera.target) - position_)),
        right_(glm::normalize(glm::cross(forward_, vector(camera.up)))),
        up_(glm::cross(right_, forward_)) {
        for (std::uint32_t i = 0; i < scene.sphere_count; ++i)
            if (color(scene.materials[scene.spheres[i].material].emission) != glm::dvec3(0.0))
                lamps_.push_back(i);
    }

    Estimate of_rectangle(const pt_render &render, glm::uvec2 first, glm::uvec2 size, std::uint32_t samples) {
        double sum = 0.0;
        double squares = 0.0;
        const double pixels = double{1} * size.x * size.y;
        for (std::uint32_t i = 0; i < size.x * size.y; ++i) {
            const glm::dvec2 pixel(first.x + i % size.x, first.y + i / size.x);
            double of_pixel = 0.0;
            double squares_of_pixel = 0.0;
            for (std::uint32_t sample = 0; sample < samples; ++sample) {
                const double value = path(render, pixel + glm::dvec2(share(), share()));
                of_pixel += value;
                squares_of_pixel += value * value;
            }
            const double mean = of_pixel / samples;
            sum += mean;
            squares += (squares_of_pixel / samples - mean * mean) / (samples - 1);
        }
        return {sum / pixels, squares / (pixels * pixels)};
    }

private:
    struct Hit {
        double distance = std::numeric_limits<double>::infinity();
        glm::dvec3 normal{0.0};
        std::uint32_t material = 0;
        std::uint32_t surface = 0;
    };

    // f = kd / pi + ks (n + 2) / (2 pi) max(0, cos)^n.
    struct Reflection {
        glm::dvec3 normal, mirror, diffuse, specular;
        double exponent;

        double lobe(const glm::dvec3 &to) const {
            return std::pow(std::max(glm::dot(mirror, to), 0.0), exponent) / (2.0 * std::numbers::pi);
        }
        double specular_share() const { return (specular.r + specular.g + specular.b) / sum(); }
        double sum() const { return diffuse.r + diffuse.g + diffuse.b + specular.r + specular.g + specular.b; }
        double density(const glm::dvec3 &to) const {
            const double cosine = glm::dot(normal, to) / std::numbers::pi;
            return (1.0 - specular_share()) * cosine + specular_share() * (exponent + 1.0) * lobe(to);
        }
        glm::dvec3 value_times_cosine(const glm::dvec3 &to) const {
            return (diffuse / std::numbers::pi + (exponent + 2.0) * lobe(to) * specular) * glm::dot(normal, to);
        }
    };

    static glm::dvec3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

    static glm::dvec3 color(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

    double share() { return std::generate_canonical<double, 53>(engine_); }

    double path(const pt_render &render, glm::dvec2 place) {
        const double time = camera_.shutter_open + share() * (camera_.shutter_close - camera_.shutter_open);
        const bool is_parallel = camera_.projection == PT_PROJECTION_ORTHOGRAPHIC;
        const double image_height = is_parallel ? camera_.vertical_extent : 2.0 * std::tan(0.5 * camera_.vertical_fov);
        const glm::dvec3 across = image_height / render.height *
                                  ((place.x - 0.5 * render.width) * right_ - (place.y - 0.5 * render.height) * up_);
        glm::dvec3 origin = is_parallel ? position_ + across : position_;
        glm::dvec3 direction = is_parallel ? forward_ : glm::normalize(forward_ + across);
        if (camera_.aperture > 0.0) {
            const double focus = camera_.focus > 0.0 ? camera_.focus : glm::length(vector(camera_.target) - position_);
            const glm::dvec3 sharp = position_ + focus * (forward_ + across);
            const double off_axis = 0.5 * camera_.aperture * std::sqrt(share());
            const double angle = 2.0 * std::numbers::pi * share();
            origin += off_axis * (std::cos(angle) * right_ + std::sin(angle) * up_);
            direction = glm::normalize(sharp - origin);
        }
        glm::dvec3 radiance(0.0);
        glm::dvec3 weight(1.0);
        double density = 0.0;
        for (std::uint32_t vertex = 0; vertex < render.max_path_length; ++vertex) {
            const Hit hit = first_hit(origin, direction, time, vertex == 0);
            if (std::isinf(hit.distance))
                break;
            const pt_material &material = scene_.materials[hit.material];
            const double by_lamp = vertex == 0 ? 0.0 : lamp_density(hit.surface, origin, time);
            radiance += weight * color(material.emission) * (by_lamp > 0.0 ? density / (density + by_lamp) : 1.0);
            origin += hit.distance * direction + 1e-7 * hit.normal;
            const Reflection reflection{hit.normal, glm::reflect(direction, hit.normal), color(material.diffuse),
                                        color(material.specular), material.glossiness};
            if (reflection.sum() == 0.0 || vertex + 1 == render.max_path_length)
                break;
            radiance += weight * light_of_a_lamp(origin, reflection, time);
            const bool mirrors = share() < reflection.specular_share();
            direction = mirrors ? lobe_direction(reflection) : cosine_direction(hit.normal);
            if (glm::dot(direction, hit.normal) <= 0.0)
                break;
            density = reflection.density(direction);
            weight *= reflection.value_times_cosine(direction) / density;
        }
        return (radiance.r + radiance.g + radiance.b) / 3.0;
    }

    glm::dvec3 center_at(const pt_sphere &sphere, double time) const {
        return vector(sphere.center) + time * vector(sphere.motion);
    }

    // Returns 1 - cos(half angle) of the sphere's cone. Inside the lamp the value is 0, because the lamp is not
    // sampled.
    double cap(const pt_sphere &sphere, const glm::dvec3 &from, double time) const {
        const glm::dvec3 to = center_at(sphere, time) - from;
        const double squared_sine = sphere.radius * sphere.radius / glm::dot(to, to);
        return squared_sine < 1.0 ? squared_sine / (1.0 + std::sqrt(1.0 - squared_sine)) : 0.0;
    }

    double lamp_density(std::uint32_t surface, const glm::dvec3 &from, double time) const {
        if (surface >= scene_.sphere_count)
            return 0.0;
        const double height = cap(scene_.spheres[surface], from, time);
        return height > 0.0 ? 1.0 / (2.0 * std::numbers::pi * height * static_cast<double>(lamps_.size())) : 0.0;
    }

    glm::dvec3 light_of_a_lamp(const glm::dvec3 &from, const Reflection &reflection, double time) {
        if (lamps_.empty())
            return glm::dvec3(0.0);
        const std::uint32_t index = lamps_[engine_() % lamps_.size()];
        const pt_sphere &lamp = scene_.spheres[index];
        const double height = cap(lamp, from, time);
        if (height == 0.0)
            return glm::dvec3(0.0);
        const glm::dvec3 to = around(glm::normalize(center_at(lamp, time) - from), share() * height);
        if (glm::dot(to, reflection.normal) <= 0.0 || first_hit(from, to, time, false).surface != index)
            return glm::dvec3(0.0);
        const double density = lamp_density(index, from, time) + reflection.density(to);
        return color(scene_.materials[lamp.material].emission) * reflection.value_times_cosine(to) / density;
    }

    glm::dvec3 around(const glm::dvec3 &axis, double height) {
        const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 x = glm::normalize(glm::cross(axis, other));
        const double angle = 2.0 * std::numbers::pi * share();
        const double sine = std::sqrt(height * (2.0 - height));
        return (1.0 - height) * axis + sine * (std::cos(angle) * x + std::sin(angle) * glm::cross(axis, x));
    }

    glm::dvec3 lobe_direction(const Reflection &reflection) {
        return around(reflection.mirror, -std::expm1(std::log(1.0 - share()) / (reflection.exponent + 1.0)));
    }

    glm::dvec3 cosine_direction(const glm::dvec3 &normal) { return around(normal, 1.0 - std::sqrt(1.0 - share())); }

    bool is_hidden(std::uint32_t material) const {
        return scene_.materials[material].flags == PT_MATERIAL_HIDDEN_FROM_CAMERA;
    }

    Hit first_hit(const glm::dvec3 &origin, const glm::dvec3 &direction, double time, bool is_of_camera) {
        Hit nearest;
        for (std::uint32_t i = 0; i < scene_.sphere_count; ++i) {
            const pt_sphere &sphere = scene_.spheres[i];
            if (is_of_camera && is_hidden(sphere.material))
                continue;
            const glm::dvec3 to_center = center_at(sphere, time) - origin;
            const double along = glm::dot(to_center, direction);
            const glm::dvec3 across = to_center - along * direction;
            const double square = sphere.radius * sphere.radius - glm::dot(across, across);
            if (square <= 0.0)
                continue;
            const double half_chord = std::sqrt(square);
            const bool enters = along - half_chord > 0.0;
            const double distance = enters ? along - half_chord : along + half_chord;
            if (distance <= 0.0 || distance >= nearest.distance)
                continue;
            const glm::dvec3 outward = (distance * direction - to_center) / sphere.radius;
            nearest = {distance, enters ? outward : -outward, sphere.material, i};
        }
        for (std::uint32_t i = 0; i < scene_.sphere_array_count; ++i)
            for (std::uint32_t row = 0; row < scene_.sphere_arrays[i].count; ++row)
                if (meets(scene_.sphere_arrays[i].opacity, row))
                    meet_capsule(nearest, origin, direction, scene_.sphere_arrays[i], row);
        for (std::uint32_t i = 0; i < scene_.plane_count; ++i) {
            const pt_plane &plane = scene_.planes[i];
            if (is_of_camera && is_hidden(plane.material))
                continue;
            const glm::dvec3 normal = vector(plane.normal);
            const double slope = glm::dot(normal, direction);
            const double distance = -(glm::dot(normal, origin) + plane.offset) / slope;
            if (distance > 0.0 && distance < nearest.distance)
                nearest = {distance, glm::normalize(slope > 0.0 ? -normal : normal), plane.material,
                           scene_.sphere_count + i};
        }
        return nearest;
    }

    template <typename Element>
    static const Element *at(const pt_column &column, std::uint32_t row) {
        return reinterpret_cast<const Element *>(static_cast<const unsigned char *>(column.data) +
                                                 std::size_t{row} * column.stride_bytes);
    }

    bool meets(const pt_column &opacity, std::uint32_t row) {
        return opacity.data == nullptr || share() < *at<float>(opacity, row);
    }

    // A ray enters the capsule at the smallest distance to its side or balls, and leaves at the largest.
    static void meet_capsule(Hit &nearest, const glm::dvec3 &origin, const glm::dvec3 &direction,
                             const pt_sphere_array &array, std::uint32_t row) {
        const double *const a = at<double>(array.center, row);
        const double *const b = at<double>(array.end, row);
        const double radius = *at<double>(array.radius, row);
        const glm::dvec3 first(a[0], a[1], a[2]);
        const glm::dvec3 last(b[0], b[1], b[2]);
        const double length = glm::length(last - first);
        double enters = std::numeric_limits<double>::infinity();
        double leaves = -enters;
        for (const glm::dvec3 &end : {first, last}) {
            const double along = glm::dot(end - origin, direction);
            const glm::dvec3 across = end - origin - along * direction;
            if (const double square = radius * radius - glm::dot(across, across); square > 0.0) {
                enters = std::min(enters, along - std::sqrt(square));
                leaves = std::max(leaves, along + std::sqrt(square));
            }
        }
        const glm::dvec3 axis = (last - first) / length;
        const glm::dvec3 slope = direction - glm::dot(direction, axis) * axis;
        const glm::dvec3 from = origin - first - glm::dot(origin - first, axis) * axis;
        const double quadratic = glm::dot(slope, slope);
        const double half_linear = glm::dot(slope, from);
        const double discriminant = half_linear * half_linear - quadratic * (glm::dot(from, from) - radius * radius);
        if (length > 0.0 && quadratic > 0.0 && discriminant > 0.0)
            for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)}) {
                const double distance = (root - half_linear) / quadratic;
                const double height = glm::dot(origin + distance * direction - first, axis);
                if (height < 0.0 || height > length)
                    continue;
                enters = std::min(enters, distance);
                leaves = std::max(leaves, distance);
            }
        const double distance = enters > 0.0 ? enters : leaves;
        if (!(distance > 0.0 && distance < nearest.distance))
            return;
        const glm::dvec3 point = origin + distance * direction;
        const double height = length > 0.0 ? std::clamp(glm::dot(point - first, axis), 0.0, length) : 0.0;
        const glm::dvec3 outward = (point - first - (length > 0.0 ? height * axis : glm::dvec3(0.0))) / radius;
        nearest = {distance, enters > 0.0 ? outward : -outward, *at<std::uint32_t>(array.material, row),
                   std::numeric_limits<std::uint32_t>::max()};
    }

    const pt_scene &scene_;
    pt_camera camera_;
    std::mt19937_64 engine_;
    std::vector<std::uint32_t> lamps_;
    glm::dvec3 position_, forward_, right_, up_;
};
