// Builds and writes the tree; see sphere_tree.h.
#include "lib/tree/sphere_tree.h"

#include "lib/tree/equal_words.h"
#include "lib/tree/tree_node.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>

namespace pt {

namespace {

constexpr std::uint32_t nowhere = ~std::uint32_t{0}; // a place that there is not

// A shape is kept while the cost of the tree is within this factor of what it was when the shape was made; below, too, as
// something else than places has changed then. On lavapipe, with 10^3 to 10^6 spheres that went astray: at 1.04 rays take 2%
// longer, at 1.12 7%, at 1.25 an eighth to a seventh, at 1.5 a quarter, at 2.7 twice and at 6.4 four times as long. A new
// tree takes two or three times as long as one whose shape is kept.
constexpr double most_growth = 1.25;

// Of what is left of the work when a stage begins, as measured with a million spheres.
constexpr double share_of_extent = 0.06;
constexpr double share_of_items = 0.1;
constexpr double share_of_shape = 0.75;
constexpr double share_of_spheres = 0.5;
constexpr double share_of_nodes = 0.9;
constexpr double share_of_alike = 0.5;
constexpr double share_of_close_lamps = 0.5;

// Of the spheres that are in the tree: calls use(index, sphere, color) for each, in order.
template <typename Use>
void for_each_of(const SphereSource &spheres, std::span<const std::uint32_t> left_out, WorkProgress &progress,
                 Use &&use) {
    spheres.for_each(progress, [&](std::size_t index, const Sphere &sphere, const glm::vec3 &color) {
        if (!left_out.empty() && left_out.front() == index)
            left_out = left_out.subspan(1);
        else
            use(static_cast<std::uint32_t>(index), sphere, color);
    });
}

} // namespace

// What spheres take up at any time, and how many of them emit.
struct SphereTree::Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    double largest_radius = 0.0;
    bool moves = false;
    std::uint32_t lamp_count = 0;

    void add(const Sphere &sphere) {
        const glm::dvec3 end = sphere.center + sphere.motion;
        low = glm::min(low, glm::min(sphere.center, end) - sphere.radius);
        high = glm::max(high, glm::max(sphere.center, end) + sphere.radius);
        largest_radius = std::max(largest_radius, sphere.radius);
        moves = moves || sphere.motion != glm::dvec3(0.0);
    }

    // With a step more than needed on either side, for rounding to places. Of balls that are all but points where they are
    // the box may be nothing but rounding.
    Grid grid() const {
        const glm::dvec3 half = 0.5 * high - 0.5 * low;
        return {0.5 * low + 0.5 * high, std::max({half.x, half.y, half.z, largest_radius}) * (1.0 + 0x1p-28)};
    }

    static Extent of(const SphereSource &spheres, std::span<const std::uint32_t> left_out,
                     std::span<const TreeMaterial> materials, WorkProgress &progress) {
        progress.enter(share_of_extent, static_cast<double>(spheres.size()));
        Extent extent;
        for_each_of(spheres, left_out, progress, [&](std::uint32_t, const Sphere &sphere, const glm::vec3 &) {
            extent.add(sphere);
            extent.lamp_count += materials[sphere.material].emits ? 1 : 0;
        });
        return extent;
    }
};

namespace {

glm::uvec4 sphere_word(const Sphere &sphere, const Grid &grid) {
    return {grid.place(sphere.center), std::bit_cast<std::uint32_t>(static_cast<float>(sphere.radius))};
}

glm::uvec4 motion_word(const Sphere &sphere) {
    const glm::vec3 way = glm::vec3(sphere.motion) + 0.0F; // -0 is made +0, for twins
    return {std::bit_cast<std::uint32_t>(way.x), std::bit_cast<std::uint32_t>(way.y),
            std::bit_cast<std::uint32_t>(way.z), 0};
}

glm::ivec3 centre_of(const glm::uvec4 &word) {
    return {std::bit_cast<int>(word.x), std::bit_cast<int>(word.y), std::bit_cast<int>(word.z)};
}

glm::dvec3 way_of(const glm::uvec4 &word) {
    return {std::bit_cast<float>(word.x), std::bit_cast<float>(word.y), std::bit_cast<float>(word.z)};
}

// What the kernel has of a sphere.
std::array<std::uint32_t, 7> words_of(const Sphere &sphere, const Grid &grid) {
    const glm::uvec4 place = sphere_word(sphere, grid);
    const glm::uvec4 motion = motion_word(sphere);
    return {place.x, place.y, place.z, place.w, motion.x, motion.y, motion.z};
}

// Of the sphere as the kernel has it, so that twins have equal ones.
std::array<float, 4> ball_of(const Sphere &sphere, const Grid &grid) {
    const glm::uvec4 word = sphere_word(sphere, grid);
    const glm::dvec3 half_way = 0.5 * way_of(motion_word(sphere));
    const glm::vec3 centre(glm::dvec3(centre_of(word)) + half_way / grid.step);
    const double radius = double{std::bit_cast<float>(word.w)} + glm::length(half_way);
    return {centre.x, centre.y, centre.z, static_cast<float>(radius / grid.step)};
}

std::vector<TreeItem> items_of(const SphereSource &spheres, std::span<const std::uint32_t> left_out, const Grid &grid,
                               WorkProgress &progress) {
    std::vector<TreeItem> items;
    items.reserve(spheres.size() - left_out.size());
    for_each_of(spheres, left_out, progress, [&](std::uint32_t index, const Sphere &sphere, const glm::vec3 &) {
        items.push_back({ball_of(sphere, grid), index});
    });
    return items;
}

// Ten bits for the root of each component, which keep dark colours apart as well as bright ones.
std::uint32_t color_word(const glm::vec3 &color) {
    const glm::uvec3 steps(glm::sqrt(glm::clamp(color, 0.0F, 1.0F)) * float{gpu::TREE_COLOR_STEPS} + 0.5F);
    return steps.r | steps.g << 10 | steps.b << 20;
}

} // namespace

SphereTree::SphereTree(const SphereSource &spheres, std::span<const std::uint32_t> left_out,
                       std::span<const TreeMaterial> materials, WorkProgress &progress) :
    SphereTree(Extent::of(spheres, left_out, materials, progress), spheres, left_out) {
    const auto order = [&](std::uint32_t a, std::uint32_t b) {
        return words_of(spheres[a], grid_) <=> words_of(spheres[b], grid_);
    };
    progress.enter(share_of_items, static_cast<double>(spheres.size()));
    std::vector<TreeItem> items = items_of(spheres, left_out, grid_, progress);
    progress.enter(share_of_shape, shape_work(items.size()));
    {
        TreeShape shape = tree_shape(std::move(items), order, progress);
        depth_ = shape.depth;
        spheres_ = std::make_shared<const std::vector<std::uint32_t>>(std::move(shape.spheres));
        make_room(shape.nodes.size(), progress);
        for (std::size_t node = 0; node < shape.nodes.size(); ++node)
            std::ranges::copy(pt::words_of(shape.nodes[node]), words_of_node(node).begin());
    }
    write_spheres(spheres, materials, progress);
    write_nodes(progress);
    cost_as_made_ = cost_;
    close_lamps_ = finds_close_lamps(progress);
}

std::optional<SphereTree> SphereTree::with_shape_of(const SphereTree &other, const SphereSource &spheres,
                                                    std::span<const std::uint32_t> left_out,
                                                    std::span<const TreeMaterial> materials, WorkProgress &progress) {
    const bool are_the_same =
        other.scene_sphere_count_ == spheres.size() && std::ranges::equal(other.left_out_, left_out);
    if (!are_the_same || other.sphere_count_ + left_out.size() != spheres.size())
        return std::nullopt;
    SphereTree tree(Extent::of(spheres, left_out, materials, progress), spheres, left_out);
    tree.depth_ = other.depth_;
    tree.spheres_ = other.spheres_;
    tree.cost_as_made_ = other.cost_as_made_;
    tree.make_room(other.node_count(), progress);
    std::ranges::copy(std::span(other.words_).first(other.first_sphere_), tree.words_.begin());
    tree.write_spheres(spheres, materials, progress);
    tree.write_nodes(progress);
    const double growth = tree.cost_ / tree.cost_as_made_;
    if (growth > most_growth || growth * most_growth < 1.0 || tree.has_alike(progress))
        return std::nullopt;
    tree.close_lamps_ = tree.finds_close_lamps(progress);
    return tree;
}

SphereTree::SphereTree(const Extent &extent, const SphereSource &spheres, std::span<const std::uint32_t> left_out) :
    grid_(extent.grid()),
    moves_(extent.moves),
    has_colors_(spheres.has_colors()),
    scene_sphere_count_(static_cast<std::uint32_t>(spheres.size())),
    left_out_(left_out.begin(), left_out.end()) {
    lamp_materials_.reserve(extent.lamp_count);
}

// For all blocks. That of the lamps is empty, and will not be moved as it grows.
void SphereTree::make_room(std::size_t node_count, WorkProgress &progress) {
    sphere_count_ = static_cast<std::uint32_t>(spheres_->size());
    const std::uint32_t quarter = (sphere_count_ + 3) / 4;
    node_count_ = static_cast<std::uint32_t>(node_count);
    first_sphere_ =
        (node_count_ * gpu::TREE_NODE_WORDS + gpu::TREE_ALIGNMENT - 1) / gpu::TREE_ALIGNMENT * gpu::TREE_ALIGNMENT;
    first_motion_ = first_sphere_ + sphere_count_;
    first_surface_ = first_motion_ + (moves_ ? sphere_count_ : 0);
    first_color_ = first_surface_ + quarter;
    first_lamp_ = first_color_ + (has_colors_ ? quarter : 0);
    words_.reserve(first_lamp_ + lamp_materials_.capacity());
    // Not at once: memory that is touched for the first time takes long.
    constexpr std::size_t some = std::size_t{1} << 20;
    while (words_.size() < first_lamp_) {
        words_.resize(std::min<std::size_t>(words_.size() + some, first_lamp_));
        progress.add(0.0, some);
    }
}

std::span<glm::uvec4> SphereTree::words_of_node(std::size_t node) {
    return std::span(words_).subspan(node * gpu::TREE_NODE_WORDS, gpu::TREE_NODE_WORDS);
}

// All blocks but the nodes'. The caller's spheres are read in their order, which is faster than any other.
void SphereTree::write_spheres(const SphereSource &spheres, std::span<const TreeMaterial> materials,
                               WorkProgress &progress) {
    const std::vector<std::uint32_t> places = places_of_spheres();
    progress.add(0.0, places.size());
    // Places are anywhere in memory: it is asked for early, which spares an eighth of the call.
    const auto fetch = [&](std::uint32_t place) {
        if (place == nowhere)
            return;
        for (const std::uint32_t word : {first_sphere_ + place, first_surface_ + place / 4, first_color_ + place / 4})
            __builtin_prefetch(&words_[std::min(word, first_lamp_ - 1)], 1);
    };
    progress.enter(share_of_spheres, static_cast<double>(spheres.size()));
    spheres.for_each(progress, [&](std::size_t index, const Sphere &sphere, const glm::vec3 &color) {
        fetch(places[std::min(index + 16, places.size() - 1)]);
        const std::uint32_t place = places[index];
        if (place == nowhere)
            return;
        const auto component = static_cast<int>(place % 4);
        const TreeMaterial &material = materials[sphere.material];
        words_[first_sphere_ + place] = sphere_word(sphere, grid_);
        if (moves_)
            words_[first_motion_ + place] = motion_word(sphere);
        if (has_colors_)
            words_[first_color_ + place / 4][component] = color_word(color);
        words_[first_surface_ + place / 4][component] = material.index;
        if (material.emits) {
            const auto number = static_cast<std::uint32_t>(lamp_materials_.size());
            words_[first_surface_ + place / 4][component] = gpu::TREE_LAMP_BIT + number;
            words_.emplace_back(place, material.index, 0, 0);
            lamp_materials_.push_back(sphere.material);
        }
    });
}

// By links that are there already. Boxes come from what is below them, which the order of nodes puts behind them.
void SphereTree::write_nodes(WorkProgress &progress) {
    std::vector<GridBox> boxes(node_count());
    progress.enter(share_of_nodes, static_cast<double>(node_count()));
    double surfaces = 0.0;
    for (std::uint32_t node = node_count(); node-- > 0;) {
        const TreeLinks links = TreeNodeView(words_of_node(node)).links();
        TreeNode written(links);
        for (std::uint32_t child = 0; child < links.child_count; ++child)
            written.set_box(child, child < links.inner_count
                                       ? boxes[links.first_child + child]
                                       : box_of_place(links.first_place + child - links.inner_count));
        boxes[node] = written.box();
        surfaces += boxes[node].surface();
        std::ranges::copy(written.words(), words_of_node(node).begin());
        progress.add(1);
    }
    box_ = boxes.front();
    cost_ = surfaces / box_.surface();
}

// Whether two spheres are equal in all that is held but their motion.
bool SphereTree::has_alike(WorkProgress &progress) const {
    progress.enter(share_of_alike, static_cast<double>(sphere_count_));
    return has_equal_words(std::span(words_).subspan(first_sphere_, sphere_count_), progress);
}

// By the spheres' indices in the scene; nowhere: of what is left out, and of twins.
std::vector<std::uint32_t> SphereTree::places_of_spheres() const {
    std::vector<std::uint32_t> places(scene_sphere_count_, nowhere);
    for (std::uint32_t place = 0; place < sphere_count_; ++place)
        places[(*spheres_)[place]] = place;
    return places;
}

std::vector<std::uint32_t> SphereTree::places_in_scene_order() const {
    std::vector<std::uint32_t> places = places_of_spheres();
    std::erase(places, nowhere);
    return places;
}

SphereTree::HeldSphere SphereTree::held(std::uint32_t place) const {
    const auto component = static_cast<int>(place % 4);
    const glm::uvec4 &word = words_[first_sphere_ + place];
    const glm::uvec4 way = moves_ ? words_[first_motion_ + place] : glm::uvec4(0);
    const std::uint32_t surface = words_[first_surface_ + place / 4][component];
    const bool is_lamp = (surface & gpu::TREE_LAMP_BIT) != 0;
    return {{word.x, word.y, word.z, word.w, way.x, way.y, way.z},
            is_lamp ? words_[first_lamp_ + (surface & ~gpu::TREE_LAMP_BIT)].y : surface,
            has_colors_ ? words_[first_color_ + place / 4][component] : color_word(glm::vec3(1.0F))};
}

// A sphere as the kernel has it, from time 0 to 1.
MovingBall SphereTree::ball_at(std::uint32_t place) const {
    const glm::uvec4 &word = words_[first_sphere_ + place];
    return {grid_.point(centre_of(word)), moves_ ? way_of(words_[first_motion_ + place]) : glm::dvec3(0.0),
            std::bit_cast<float>(word.w)};
}

bool SphereTree::is_far(const Camera &camera) const {
    const glm::dvec3 steps = glm::abs(camera.position - grid_.middle) / grid_.step;
    return !(std::max({steps.x, steps.y, steps.z}) <= 2.0 * Grid::reach);
}

// Of the sphere as the kernel has it, at any time: what rounding adds there is the kernel's margin.
GridBox SphereTree::box_of_place(std::uint32_t place) const {
    const glm::uvec4 &word = words_[first_sphere_ + place];
    const auto radius = static_cast<int>(std::ceil(double{std::bit_cast<float>(word.w)} / grid_.step));
    const glm::ivec3 centre = centre_of(word);
    GridBox box{centre - radius, centre + radius};
    if (moves_) {
        const glm::dvec3 way = way_of(words_[first_motion_ + place]) / grid_.step;
        box.low += glm::ivec3(glm::floor(glm::min(way, 0.0)));
        box.high += glm::ivec3(glm::ceil(glm::max(way, 0.0)));
    }
    return box;
}

// Whether a property holds of some place whose box, or what rounding has made of it, meets a box.
template <typename Property>
bool SphereTree::any_in(const GridBox &box, Property &&property) const {
    std::vector<std::uint32_t> nodes{0};
    while (!nodes.empty()) {
        const TreeNodeView node(
            std::span<const glm::uvec4>(words_).subspan(std::size_t{nodes.back()} * gpu::TREE_NODE_WORDS));
        nodes.pop_back();
        for (std::uint32_t child = 0; child < node.child_count(); ++child) {
            if (!meet(node.box(child), box))
                continue;
            if (child < node.inner_count())
                nodes.push_back(node.first_child() + child);
            else if (property(node.first_place() + child - node.inner_count()))
                return true;
        }
    }
    return false;
}

Sphere SphereTree::lamp(std::uint32_t number) const {
    const MovingBall ball = ball_at(words_[first_lamp_ + number].x);
    return {ball.open, ball.radius, ball.way, lamp_materials_[number]};
}

bool SphereTree::may_hold(const Camera &camera) const {
    const gpu::TreeFrame seen = frame(camera);
    const double nearly =
        side_margin * static_cast<double>(std::max({box_.extent().x, box_.extent().y, box_.extent().z}));
    const auto around = static_cast<int>(nearly) + 1;
    if (!meet(box_, {seen.camera - around, seen.camera + around}) || is_far(camera))
        return false;
    return any_in({seen.camera - around, seen.camera + around}, [&](std::uint32_t place) {
        const MovingBall ball = ball_at(place);
        const MovingBall as_seen{ball.open + camera.shutter_open * ball.way - camera.position,
                                 (camera.shutter_close - camera.shutter_open) * ball.way, ball.radius};
        return may_hold_origin(as_seen, grid_.step);
    });
}

bool SphereTree::finds_close_lamps(WorkProgress &progress) const {
    constexpr std::size_t as_many_spheres = 16; // as take the time of a lamp, to within a small factor
    progress.enter(share_of_close_lamps, static_cast<double>(lamp_materials_.size()));
    for (std::uint32_t lamp = 0; lamp < lamp_materials_.size(); ++lamp) {
        progress.add(1.0, as_many_spheres);
        const std::uint32_t place = words_[first_lamp_ + lamp].x;
        const MovingBall ball = ball_at(place);
        const auto is_close = [&](std::uint32_t other) {
            return other != place && nearly_coincide(ball, ball_at(other));
        };
        // A sphere that nearly coincides with the lamp holds its centre.
        const glm::ivec3 centre = centre_of(words_[first_sphere_ + place]);
        if (any_in({centre, centre}, is_close))
            return true;
    }
    return false;
}

// A camera within twice the grid's reach is a place of the grid, and differences from it are exact. For others the
// middle of the grid is, and what is rounded is small against the distance.
gpu::TreeFrame SphereTree::frame(const Camera &camera) const {
    gpu::TreeFrame frame{};
    frame.camera = is_far(camera) ? glm::ivec3(0) : grid_.place(camera.position);
    frame.shift = glm::vec3(grid_.point(frame.camera) - camera.position);
    frame.step = static_cast<float>(grid_.step);
    frame.first_motion = first_motion_ - first_sphere_;
    frame.first_surface = first_surface_ - first_sphere_;
    frame.first_color = first_color_ - first_sphere_;
    frame.first_lamp = first_lamp_ - first_sphere_;
    frame.middle = glm::vec3(grid_.middle - camera.position);
    frame.shutter_open = static_cast<float>(camera.shutter_open);
    frame.shutter_time = static_cast<float>(camera.shutter_close - camera.shutter_open);
    return frame;
}

} // namespace pt
