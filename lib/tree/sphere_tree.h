// The tree of spheres in the kernel's layout. All devices share it.
//
// The shape affects only speed.
#pragma once

#include "lib/base/digest.h"
#include "lib/base/work_progress.h"
#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/scene.h"
#include "lib/scene/sphere_source.h"
#include "lib/tree/grid.h"
#include "lib/tree/sphere_order.h"
#include "lib/tree/sphere_words.h"
#include "lib/tree/tree_choice.h"
#include "shaders/gpu_layout.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pt {

struct TreeMaterial {
    std::uint32_t index;
    bool emits;
};

class SphereTree {
public:
    // The tree must have at least one sphere. `materials` are the whole scene's.
    SphereTree(const SphereSource &spheres, const TreeChoice &choice, std::span<const TreeMaterial> materials,
               WorkProgress &progress);

    // Reuses another tree's shape. Each sphere keeps its slot. Returns nothing if a new tree would be much better,
    // other spheres are left out, or a tree has twins.
    static std::optional<SphereTree> with_shape_of(const SphereTree &other, const SphereSource &spheres,
                                                   const TreeChoice &choice, std::span<const TreeMaterial> materials,
                                                   WorkProgress &progress);

    const Grid &grid() const { return grid_; }

    const std::vector<glm::uvec4> &words() const { return words_; }
    std::span<const glm::uvec4> node_words() const { return std::span(words_).first(first_sphere_); }
    std::span<const glm::uvec4> sphere_words() const { return std::span(words_).subspan(first_sphere_); }

    gpu::TreeFrame frame(const Camera &camera) const;

    // Adds the grid and the words of all spheres in the scene's order.
    void add_to(Digest &digest) const;

    // Expected number of nodes that a ray through the tree visits: the sum of all nodes' surfaces divided by the root's
    // surface.
    double cost() const { return cost_; }

    std::uint32_t sphere_count() const { return sphere_count_; }
    std::uint32_t node_count() const { return node_count_; }
    std::uint32_t depth() const { return depth_; }
    bool moves() const { return moves_; }
    Kinds kinds() const { return kinds_; }
    bool has_opacities() const { return has_opacities_; }

    std::span<const std::uint32_t> spheres() const { return *spheres_; }
    std::uint32_t scene_sphere_count() const { return scene_sphere_count_; }
    bool has(pt_column pt_sphere_array::*look) const;

    const std::vector<std::uint32_t> &lamp_materials() const { return lamp_materials_; }

    Sphere lamp(std::uint32_t number) const;

    // Whether the camera is at any time inside a sphere. True if float32 cannot decide.
    bool may_hold(const Camera &camera) const;

    // Whether parallel rays may start on both sides of a sphere (moving_ball.h).
    bool divides_start(const Camera &camera) const;

    // Finds the sphere with the least of_sphere(). of_region() must be a lower bound for all spheres within a ball.
    struct Least {
        double number;
        std::uint32_t sphere; // scene index
        MovingBall surface;   // relative to the camera
    };
    Least least(const Camera &camera, const std::function<double(const MovingBall &)> &of_region,
                const std::function<double(const MovingBall &)> &of_sphere) const;

    // Finds the sphere that reaches farthest from the median center.
    struct Farthest {
        std::uint32_t sphere; // scene index
        MovingBall surface;
        double distance; // distance of its center from the median center
    };
    Farthest farthest() const;

    void visit(const Camera &camera, const std::function<bool(const MovingBall &)> &enters,
               const std::function<void(const MovingBall &, std::int16_t opacity)> &receive) const;

    PointBox bounds() const { return {grid_.point(box_.low), grid_.point(box_.high)}; }

    bool has_close_lamps() const { return close_lamps_; }

private:
    struct FoundLamp {
        std::uint32_t sphere;
        std::uint32_t place;
        std::uint32_t material;
    };

    SphereTree(const SphereSource &spheres, const TreeChoice &choice);

    void make_room(std::size_t node_count, WorkProgress &progress);
    std::span<glm::uvec4> words_of_node(std::size_t node);
    void write_spheres(const SphereSource &spheres, std::span<const TreeMaterial> materials, WorkProgress &progress);
    void write_lamps(std::vector<FoundLamp> lamps, std::span<const TreeMaterial> materials);
    void write_nodes(WorkProgress &progress);
    GridBox write_node(std::uint32_t node, WorkProgress &progress);
    bool has_alike(WorkProgress &progress) const;
    bool has_ways() const { return moves_ || kinds_.have_ways(); }
    SphereWords words_of(std::uint32_t place) const;
    std::uint32_t first_of(std::size_t look) const {
        return first_look_ + static_cast<std::uint32_t>(look) * quarter();
    }
    std::uint32_t quarter() const { return (sphere_count_ + 3) / 4; }
    MovingBall surface_of(std::uint32_t place) const { return words_of(place).surface(grid_); }
    MovingBall region_of(const GridBox &box, const Camera &camera) const;
    bool is_far(const Camera &camera) const;
    bool finds_close_lamps(WorkProgress &progress) const;
    template <typename Property>
    bool any_in(const GridBox &box, Property &&property) const;

    Grid grid_;
    bool moves_;
    Kinds kinds_;
    std::vector<LookColumn> looks_; // columns that some sphere has
    bool has_opacities_;
    std::uint32_t scene_sphere_count_;
    std::vector<std::uint32_t> left_out_; // scene indices
    std::uint32_t depth_ = 0;
    std::uint32_t sphere_count_ = 0;
    std::uint32_t node_count_ = 0;
    std::shared_ptr<const std::vector<std::uint32_t>> spheres_; // scene indices by slot; shared by trees of one shape
    double cost_ = 0.0;
    double cost_as_made_ = 0.0; // cost when the shape was built
    std::uint32_t first_sphere_ = 0;
    std::uint32_t first_motion_ = 0;
    std::uint32_t first_surface_ = 0;
    std::uint32_t first_look_ = 0;
    std::uint32_t first_lamp_ = 0;
    bool close_lamps_ = false;
    GridBox box_;
    std::vector<std::uint32_t> lamp_materials_;
    std::vector<glm::uvec4> words_;
};

} // namespace pt
