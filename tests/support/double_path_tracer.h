// What a pixel of diffuse surfaces shows, by the plainest of path tracers in double: no lamp is sampled, no sequence of
// points is used, and nothing is shared with the library. Used by tests of whole images.
#pragma once

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

class DoublePathTracer {
public:
    struct Estimate {
        double mean = 0.0;     // of the radiance's components
        double variance = 0.0; // of the mean
    };

    DoublePathTracer(const pt_scene &scene, const pt_camera &camera, std::uint32_t seed) :
        scene_(scene),
        camera_(camera),
        engine_(seed),
        position_(vector(camera.position)),
        forward_(glm::normalize(vector(camera.target) - position_)),
        right_(glm::normalize(glm::cross(forward_, vector(camera.up)))),
        up_(glm::cross(right_, forward_)) {}

    // Of a rectangle of pixels, at a number of places in each of them.
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
    };

    static glm::dvec3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

    static glm::dvec3 colour(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

    double share() { return std::generate_canonical<double, 53>(engine_); }

    double path(const pt_render &render, glm::dvec2 place) {
        const double time =
            camera_.shutter_open + share() * (camera_.shutter_close - camera_.shutter_open); // of its whole way
        const bool is_parallel = camera_.projection == PT_PROJECTION_ORTHOGRAPHIC;
        const double image_height = is_parallel ? camera_.vertical_extent : 2.0 * std::tan(0.5 * camera_.vertical_fov);
        const glm::dvec3 across = image_height / render.height *
                                  ((place.x - 0.5 * render.width) * right_ - (place.y - 0.5 * render.height) * up_);
        glm::dvec3 origin = is_parallel ? position_ + across : position_;
        glm::dvec3 direction = is_parallel ? forward_ : glm::normalize(forward_ + across);
        glm::dvec3 radiance(0.0);
        glm::dvec3 weight(1.0);
        for (std::uint32_t vertex = 0; vertex < render.max_path_length; ++vertex) {
            const Hit hit = first_hit(origin, direction, time, vertex == 0);
            if (std::isinf(hit.distance))
                break;
            radiance += weight * colour(scene_.materials[hit.material].emission);
            weight *= colour(scene_.materials[hit.material].diffuse);
            if (weight == glm::dvec3(0.0))
                break;
            origin += hit.distance * direction + 1e-7 * hit.normal;
            direction = cosine_direction(hit.normal);
        }
        return (radiance.r + radiance.g + radiance.b) / 3.0;
    }

    // A point on the unit sphere about the normal's end, as seen from the normal's foot.
    glm::dvec3 cosine_direction(const glm::dvec3 &normal) {
        const double z = 1.0 - 2.0 * share();
        const double angle = 2.0 * std::numbers::pi * share();
        const double radius = std::sqrt(1.0 - z * z);
        return glm::normalize(normal + glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), z));
    }

    bool is_hidden(std::uint32_t material) const {
        return scene_.material_flags && scene_.material_flags[material] == PT_MATERIAL_HIDDEN_FROM_CAMERA;
    }

    Hit first_hit(const glm::dvec3 &origin, const glm::dvec3 &direction, double time, bool is_of_camera) const {
        Hit nearest;
        for (std::uint32_t i = 0; i < scene_.sphere_count; ++i) {
            const pt_sphere &sphere = scene_.spheres[i];
            if (is_of_camera && is_hidden(sphere.material))
                continue;
            const glm::dvec3 to_centre = vector(sphere.center) + time * vector(sphere.motion) - origin;
            const double along = glm::dot(to_centre, direction);
            const glm::dvec3 across = to_centre - along * direction;
            const double square = sphere.radius * sphere.radius - glm::dot(across, across);
            if (square <= 0.0)
                continue;
            const double half_chord = std::sqrt(square);
            const bool enters = along - half_chord > 0.0;
            const double distance = enters ? along - half_chord : along + half_chord;
            if (distance <= 0.0 || distance >= nearest.distance)
                continue;
            const glm::dvec3 outward = (distance * direction - to_centre) / sphere.radius;
            nearest = {distance, enters ? outward : -outward, sphere.material};
        }
        for (std::uint32_t i = 0; i < scene_.plane_count; ++i) {
            const pt_plane &plane = scene_.planes[i];
            if (is_of_camera && is_hidden(plane.material))
                continue;
            const glm::dvec3 normal = vector(plane.normal);
            const double slope = glm::dot(normal, direction);
            const double distance = -(glm::dot(normal, origin) + plane.offset) / slope;
            if (distance > 0.0 && distance < nearest.distance)
                nearest = {distance, glm::normalize(slope > 0.0 ? -normal : normal), plane.material};
        }
        return nearest;
    }

    const pt_scene &scene_;
    pt_camera camera_;
    std::mt19937_64 engine_;
    glm::dvec3 position_, forward_, right_, up_;
};
