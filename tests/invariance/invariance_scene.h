#pragma once

#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"

#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

struct InvarianceScene {
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera = CourseworkScene::camera();

    pt_scene scene() const { return scene_of(materials, spheres, planes); }

    // Coordinates are multiples of 1/2, and normals are axes.
    static InvarianceScene coursework() {
        const CourseworkScene source;
        InvarianceScene result{{source.materials.begin(), source.materials.end()},
                               {source.spheres.begin(), source.spheres.end()},
                               {source.planes.begin(), source.planes.end()}};
        result.spheres[3].motion[1] = 0.5;
        return result;
    }

    void brighten(float factor) {
        for (pt_material &material : materials)
            for (float &component : material.emission)
                component *= factor;
    }

    void scale(double factor) {
        for (pt_sphere &sphere : spheres) {
            sphere.radius *= factor;
            for (int i = 0; i < 3; ++i) {
                sphere.center[i] *= factor;
                sphere.motion[i] *= factor;
            }
        }
        for (pt_plane &plane : planes)
            plane.offset *= factor;
        for (int i = 0; i < 3; ++i) {
            camera.position[i] *= factor;
            camera.target[i] *= factor;
        }
    }

    void translate(const double (&by)[3]) {
        for (int i = 0; i < 3; ++i) {
            for (pt_sphere &sphere : spheres)
                sphere.center[i] += by[i];
            for (pt_plane &plane : planes)
                plane.offset -= plane.normal[i] * by[i];
            camera.position[i] += by[i];
            camera.target[i] += by[i];
        }
    }

    // `matrix` has orthonormal rows.
    void turn(const double (&matrix)[3][3]) {
        const auto turned = [&](double(&vector)[3]) {
            double result[3];
            for (int i = 0; i < 3; ++i)
                result[i] = matrix[i][0] * vector[0] + matrix[i][1] * vector[1] + matrix[i][2] * vector[2];
            std::copy_n(result, 3, vector);
        };
        for (pt_sphere &sphere : spheres) {
            turned(sphere.center);
            turned(sphere.motion);
        }
        for (pt_plane &plane : planes)
            turned(plane.normal);
        turned(camera.position);
        turned(camera.target);
        turned(camera.up);
    }

    void reverse_materials() {
        std::ranges::reverse(materials);
        const auto last = static_cast<uint32_t>(materials.size()) - 1;
        for (pt_sphere &sphere : spheres)
            sphere.material = last - sphere.material;
        for (pt_plane &plane : planes)
            plane.material = last - plane.material;
    }
};
