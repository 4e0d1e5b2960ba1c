// A tree over spheres as the kernel reads it, for scenes of so many that testing each would take too long. It does not
// depend on where the camera is. Made by PreparedScene, shared by the kernels of all devices.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/scene.h"
#include "lib/scene/sphere_source.h"
#include "lib/tree/grid.h"
#include "lib/tree/sphere_order.h"
#include "shaders/gpu_layout.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

// What the tree has to know of a material.
struct TreeMaterial {
    std::uint32_t index; // in the table of those in use
    bool emits;
};

// In the scene's coordinates.
struct PointBox {
    glm::dvec3 low;
    glm::dvec3 high;
};

class SphereTree {
public:
    // Over the spheres but those left out, by their indices in ascending order: at least one. materials: those of the
    // scene, by index. progress is called now and then with the share that is done; what it throws ends the work.
    SphereTree(const SphereSource &spheres, std::span<const std::uint32_t> left_out,
               std::span<const TreeMaterial> materials, const std::function<void(double)> &progress);

    const Grid &grid() const { return grid_; }

    // The tree buffer of gpu_layout.h, all of it, and its parts.
    const std::vector<glm::uvec4> &words() const { return words_; }
    std::span<const glm::uvec4> node_words() const { return std::span(words_).first(first_sphere_); }
    std::span<const glm::uvec4> sphere_words() const { return std::span(words_).subspan(first_sphere_); }

    // The tree as a camera sees it.
    gpu::TreeFrame frame(const Camera &camera) const;

    // Spheres in it, without twins, and nodes, of which so many are on the way to the deepest.
    std::uint32_t sphere_count() const { return sphere_count_; }
    std::uint32_t node_count() const { return node_count_; }
    std::uint32_t depth() const { return depth_; }
    bool moves() const { return moves_; }
    bool has_colors() const { return has_colors_; }

    // Materials of the lamps by number, which is their order in the scene.
    const std::vector<std::uint32_t> &lamp_materials() const { return lamp_materials_; }

    // The sphere that a lamp is, as the kernel has it.
    Sphere lamp(std::uint32_t number) const;

    // Whether a camera is in a sphere at any time, or so near to it that float32 cannot tell.
    bool may_hold(const Camera &camera) const;

    // Of all spheres at any time.
    PointBox bounds() const { return {grid_.point(box_.low), grid_.point(box_.high)}; }

    // Whether some lamp and another sphere nearly coincide (twins.h).
    bool has_close_lamps() const { return close_lamps_; }

private:
    struct Extent;

    SphereTree(const Extent &extent, const SphereSource &spheres, std::span<const std::uint32_t> left_out,
               std::span<const TreeMaterial> materials, const std::function<void(double)> &progress);

    void write_spheres(const SphereSource &spheres, std::span<const TreeMaterial> materials, const TreeShape &shape);
    void write_nodes(const TreeShape &shape);
    MovingBall ball_at(std::uint32_t place) const;
    GridBox box_of_place(std::uint32_t place) const;
    bool is_far(const Camera &camera) const;
    bool finds_close_lamps() const;
    template <typename Property>
    bool any_in(const GridBox &box, Property &&property) const;

    Grid grid_;
    bool moves_;
    bool has_colors_;
    std::uint32_t depth_ = 0;
    std::uint32_t sphere_count_ = 0;
    std::uint32_t node_count_ = 0;
    std::uint32_t first_sphere_ = 0; // words of the buffer, each the end of the block before
    std::uint32_t first_motion_ = 0;
    std::uint32_t first_surface_ = 0;
    std::uint32_t first_color_ = 0;
    std::uint32_t first_lamp_ = 0;
    bool close_lamps_ = false;
    GridBox box_;
    std::vector<std::uint32_t> lamp_materials_;
    std::vector<glm::uvec4> words_;
};

} // namespace pt
