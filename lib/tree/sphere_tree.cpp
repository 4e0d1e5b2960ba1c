#include "lib/tree/sphere_tree.h"

#include "lib/tree/coincident_spheres.h"
#include "lib/tree/equal_words.h"
#include "lib/tree/middle.h"
#include "lib/tree/tree_node.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

namespace pt {

namespace {

constexpr std::uint32_t nowhere = ~std::uint32_t{0};

// A new tree is built if the cost of the old shape has grown by this factor. Rays would then be about an eighth slower,
// and building takes twice as long as reuse.
constexpr double most_growth = 1.25;

// For progress.enter(): the fraction of the remaining work that each step takes with a million spheres.
constexpr double share_of_items = 0.1;
constexpr double share_of_shape = 0.65;
constexpr double share_of_spheres = 0.5;
constexpr double share_of_nodes = 0.9;
constexpr double share_of_alike = 0.5;
constexpr double share_of_close_lamps = 0.5;

TreeNodeView node_of(std::span<const glm::uvec4> words, std::uint32_t node) {
    return TreeNodeView(words.subspan(std::size_t{node} * gpu::TREE_NODE_WORDS));
}

std::vector<TreeItem> items_of(const SphereSource &spheres, std::span<const std::uint32_t> left_out, const Grid &grid,
                               WorkProgress &progress) {
    std::vector<TreeItem> items;
    items.reserve(spheres.size() - left_out.size());
    for_each_in_tree(spheres, left_out, progress, [&](std::uint32_t index, const Sphere &sphere) {
        items.push_back({SphereWords(sphere, grid).ball(grid), index});
    });
    return items;
}

} // namespace

SphereTree::SphereTree(const SphereSource &spheres, const TreeChoice &choice, std::span<const TreeMaterial> materials,
                       WorkProgress &progress) :
    SphereTree(spheres, choice) {
    const auto bits_of = [&](std::uint32_t index) {
        const Sphere sphere = spheres[index];
        SphereBits bits{};
        std::ranges::copy(SphereWords(sphere, grid_).all(), bits.begin());
        if (sphere.is_translucent()) {
            bits[8] = materials[sphere.material].index;
            std::ranges::transform(look_columns, bits.begin() + 9,
                                   [&](const LookColumn &look) { return look.word(sphere.look); });
        }
        return bits;
    };
    progress.enter(share_of_items, static_cast<double>(spheres.size()));
    std::vector<TreeItem> items = items_of(spheres, choice.left_out, grid_, progress);
    progress.enter(share_of_shape, static_cast<double>(items.size()));
    {
        TreeShape shape = tree_shape(std::move(items), bits_of, progress);
        depth_ = shape.depth;
        spheres_ = std::make_shared<const std::vector<std::uint32_t>>(std::move(shape.spheres));
        make_room(shape.nodes.size(), progress);
        for (std::size_t node = 0; node < shape.nodes.size(); ++node)
            std::ranges::copy(pt::words_of(shape.nodes[node]), words_of_node(node).begin());
    }
    write_spheres(spheres, materials, progress);
    if (has_opacities_) {
        progress.enter(share_of_alike, static_cast<double>(sphere_count_));
        set_coincident_apart(std::span(words_).subspan(first_sphere_, sphere_count_),
                             std::span(words_).subspan(first_motion_, first_surface_ - first_motion_), *spheres_,
                             progress);
    }
    write_nodes(progress);
    cost_as_made_ = cost_;
    close_lamps_ = finds_close_lamps(progress);
}

std::optional<SphereTree> SphereTree::with_shape_of(const SphereTree &other, const SphereSource &spheres,
                                                    const TreeChoice &choice, std::span<const TreeMaterial> materials,
                                                    WorkProgress &progress) {
    const bool are_the_same = other.scene_sphere_count_ == spheres.size() && other.left_out_ == choice.left_out;
    if (!are_the_same || other.sphere_count_ + choice.left_out.size() != spheres.size())
        return std::nullopt;
    SphereTree tree(spheres, choice);
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

SphereTree::SphereTree(const SphereSource &spheres, const TreeChoice &choice) :
    grid_(choice.extent.grid()),
    moves_(choice.extent.moves),
    kinds_(choice.extent.kinds),
    has_opacities_(spheres.counts().has_opacities),
    scene_sphere_count_(static_cast<std::uint32_t>(spheres.size())),
    left_out_(choice.left_out) {
    std::ranges::copy_if(look_columns, std::back_inserter(looks_),
                         [&](const LookColumn &look) { return spheres.has(look.column); });
    lamp_materials_.reserve(choice.extent.lamp_count);
}

void SphereTree::make_room(std::size_t node_count, WorkProgress &progress) {
    sphere_count_ = static_cast<std::uint32_t>(spheres_->size());
    node_count_ = static_cast<std::uint32_t>(node_count);
    first_sphere_ =
        (node_count_ * gpu::TREE_NODE_WORDS + gpu::TREE_ALIGNMENT - 1) / gpu::TREE_ALIGNMENT * gpu::TREE_ALIGNMENT;
    first_motion_ = first_sphere_ + sphere_count_;
    first_surface_ = first_motion_ + (has_ways() ? sphere_count_ : 0);
    first_look_ = first_surface_ + quarter();
    first_lamp_ = first_of(looks_.size());
    words_.reserve(first_lamp_ + lamp_materials_.capacity());
    // Touching new memory takes long, so progress is reported after each piece.
    constexpr std::size_t some = std::size_t{1} << 20;
    while (words_.size() < first_lamp_) {
        words_.resize(std::min<std::size_t>(words_.size() + some, first_lamp_));
        progress.add(0.0, some);
    }
}

std::span<glm::uvec4> SphereTree::words_of_node(std::size_t node) {
    return std::span(words_).subspan(node * gpu::TREE_NODE_WORDS, gpu::TREE_NODE_WORDS);
}

// Writes in the tree's order, because random reads of the caller's memory are faster than random writes.
void SphereTree::write_spheres(const SphereSource &spheres, std::span<const TreeMaterial> materials,
                               WorkProgress &progress) {
    std::vector<FoundLamp> lamps;
    lamps.reserve(lamp_materials_.capacity());
    progress.enter(share_of_spheres, static_cast<double>(sphere_count_));
    spheres.for_each(*spheres_, progress, [&](std::size_t place, const Sphere &sphere) {
        const auto component = static_cast<int>(place % 4);
        const TreeMaterial &material = materials[sphere.material];
        const SphereWords words(sphere, grid_);
        words_[first_sphere_ + place] = words.place;
        if (has_ways())
            words_[first_motion_ + place] = words.way;
        for (std::size_t i = 0; i < looks_.size(); ++i)
            words_[first_of(i) + place / 4][component] = looks_[i].word(sphere.look);
        words_[first_surface_ + place / 4][component] = material.index;
        if (material.emits)
            lamps.push_back({(*spheres_)[place], static_cast<std::uint32_t>(place), sphere.material});
    });
    write_lamps(std::move(lamps), materials);
}

void SphereTree::write_lamps(std::vector<FoundLamp> lamps, std::span<const TreeMaterial> materials) {
    std::ranges::sort(lamps, {}, &FoundLamp::sphere);
    for (const FoundLamp &lamp : lamps) {
        const auto number = static_cast<std::uint32_t>(lamp_materials_.size());
        lamp_materials_.push_back(lamp.material);
        words_.emplace_back(lamp.place, materials[lamp.material].index, 0, 0);
        words_[first_surface_ + lamp.place / 4][static_cast<int>(lamp.place % 4)] = gpu::TREE_LAMP_BIT + number;
    }
}

void SphereTree::write_nodes(WorkProgress &progress) {
    progress.enter(share_of_nodes, static_cast<double>(node_count()));
    cost_ = 0.0;
    box_ = write_node(0, progress);
    cost_ /= box_.surface();
}

GridBox SphereTree::write_node(std::uint32_t node, WorkProgress &progress) {
    const TreeLinks links = TreeNodeView(words_of_node(node)).links();
    TreeNode written(links);
    for (std::uint32_t child = links.child_count; child-- > 0;)
        written.set_box(child, child < links.inner_count
                                   ? write_node(links.first_child + child, progress)
                                   : words_of(links.first_place + child - links.inner_count).box(grid_));
    cost_ += written.box().surface();
    std::ranges::copy(written.words(), words_of_node(node).begin());
    progress.add(1);
    return written.box();
}

// Whether two spheres are equal except for their motions.
bool SphereTree::has_alike(WorkProgress &progress) const {
    progress.enter(share_of_alike, static_cast<double>(sphere_count_));
    return has_equal_words(std::span(words_).subspan(first_sphere_, sphere_count_), progress);
}

void SphereTree::add_to(Digest &digest) const {
    digest.add(grid_.middle);
    digest.add(grid_.step);
    if (has_opacities_) // the low bits of radii are opacities
        digest.add(std::uint64_t{gpu::TREE_OPACITY_STEPS});
    std::vector<std::uint32_t> places(scene_sphere_count_, nowhere); // left-out spheres and twins keep `nowhere`
    for (std::uint32_t place = 0; place < sphere_count_; ++place)
        places[(*spheres_)[place]] = place;
    std::erase(places, nowhere);
    const bool is_colored = has(&pt_sphere_array::color); // the color is then looks_[0]
    for (const std::uint32_t place : places) {
        const auto component = static_cast<int>(place % 4);
        const SphereWords words = words_of(place);
        const std::uint32_t surface = words_[first_surface_ + place / 4][component];
        const bool is_lamp = (surface & gpu::TREE_LAMP_BIT) != 0;
        const std::uint32_t material = is_lamp ? words_[first_lamp_ + (surface & ~gpu::TREE_LAMP_BIT)].y : surface;
        const auto look = [&](std::size_t i) { return words_[first_of(i) + place / 4][component]; };
        const std::array all = words.all();
        digest.add(std::span(all).first(7));
        add_kind(digest, words.surface(grid_).kind);
        digest.add((std::uint64_t{material} << 32) | (is_colored ? look(0) : color_word(Look{}.color)));
        for (std::size_t i = is_colored ? 1 : 0; i < looks_.size(); ++i)
            digest.add(std::uint64_t{look(i)});
    }
}

bool SphereTree::has(pt_column pt_sphere_array::*look) const {
    return std::ranges::find(looks_, look, &LookColumn::column) != looks_.end();
}

SphereWords SphereTree::words_of(std::uint32_t place) const {
    return {words_[first_sphere_ + place], has_ways() ? words_[first_motion_ + place] : glm::uvec4(0)};
}

bool SphereTree::is_far(const Camera &camera) const {
    const glm::dvec3 steps = glm::abs(camera.position - grid_.middle) / grid_.step;
    return !(std::max({steps.x, steps.y, steps.z}) <= 2.0 * Grid::reach);
}

// Whether a sphere whose rounded box overlaps the box has the property.
template <typename Property>
bool SphereTree::any_in(const GridBox &box, Property &&property) const {
    std::vector<std::uint32_t> nodes{0};
    while (!nodes.empty()) {
        const TreeNodeView node = node_of(words_, nodes.back());
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
    const MovingBall ball = surface_of(words_[first_lamp_ + number].x);
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
        return may_hold_origin(seen_ball(surface_of(place), camera), grid_.step);
    });
}

bool SphereTree::divides_start(const Camera &camera) const {
    if (camera.start_radius == 0.0)
        return false;
    const glm::dvec3 middle = (camera.position - grid_.middle) / grid_.step;
    const double radius = camera.start_radius / grid_.step + 1.0;
    const double beyond = 2.0 * Grid::reach;
    const glm::ivec3 low(glm::floor(glm::clamp(middle - radius, -beyond, beyond)));
    const glm::ivec3 high(glm::ceil(glm::clamp(middle + radius, -beyond, beyond)));
    return any_in({low, high}, [&](std::uint32_t place) {
        return pt::divides_start(seen_ball(surface_of(place), camera), camera, grid_.step);
    });
}

MovingBall SphereTree::region_of(const GridBox &box, const Camera &camera) const {
    const glm::dvec3 low = grid_.point(box.low) - camera.position;
    const glm::dvec3 high = grid_.point(box.high) - camera.position;
    return {0.5 * (low + high), glm::dvec3(0.0), 0.5 * glm::length(high - low)};
}

SphereTree::Least SphereTree::least(const Camera &camera, const std::function<double(const MovingBall &)> &of_region,
                                    const std::function<double(const MovingBall &)> &of_sphere) const {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> entries;
    entries.emplace(0.0, 0);
    Least least{std::numeric_limits<double>::infinity(), nowhere, {}};
    while (!entries.empty() && entries.top().first < least.number) {
        const TreeNodeView node = node_of(words_, entries.top().second);
        entries.pop();
        for (std::uint32_t child = 0; child < node.child_count(); ++child) {
            if (child < node.inner_count()) {
                if (const double bound = of_region(region_of(node.box(child), camera)); bound < least.number)
                    entries.emplace(bound, node.first_child() + child);
            } else {
                const std::uint32_t place = node.first_place() + child - node.inner_count();
                const MovingBall surface = seen_ball(surface_of(place), camera);
                if (const double number = of_sphere(surface); number < least.number)
                    least = {number, (*spheres_)[place], surface};
            }
        }
    }
    return least;
}

SphereTree::Farthest SphereTree::farthest() const {
    const glm::dvec3 middle = middle_of(sphere_count_, [&](std::uint32_t place) { return surface_of(place).open; });
    Farthest farthest{};
    double reach = -1.0;
    for (std::uint32_t place = 0; place < sphere_count_; ++place) {
        const MovingBall surface = surface_of(place);
        const double distance = glm::length(surface.open - middle);
        if (const double own = distance + glm::length(surface.way) + surface.radius; own > reach) {
            reach = own;
            farthest = {(*spheres_)[place], surface, distance};
        }
    }
    return farthest;
}

void SphereTree::visit(const Camera &camera, const std::function<bool(const MovingBall &)> &enters,
                       const std::function<void(const MovingBall &, std::int16_t opacity)> &receive) const {
    std::vector<std::uint32_t> nodes{0};
    while (!nodes.empty()) {
        const TreeNodeView node = node_of(words_, nodes.back());
        nodes.pop_back();
        for (std::uint32_t child = 0; child < node.child_count(); ++child) {
            if (child < node.inner_count()) {
                if (enters(region_of(node.box(child), camera)))
                    nodes.push_back(node.first_child() + child);
            } else {
                const SphereWords words = words_of(node.first_place() + child - node.inner_count());
                receive(seen_ball(words.surface(grid_), camera), has_opacities_ ? words.opacity() : no_opacity);
            }
        }
    }
}

bool SphereTree::finds_close_lamps(WorkProgress &progress) const {
    constexpr std::size_t as_many_spheres = 16;
    progress.enter(share_of_close_lamps, static_cast<double>(lamp_materials_.size()));
    for (std::uint32_t lamp = 0; lamp < lamp_materials_.size(); ++lamp) {
        progress.add(1.0, as_many_spheres);
        const std::uint32_t place = words_[first_lamp_ + lamp].x;
        const MovingBall ball = surface_of(place);
        const auto is_close = [&](std::uint32_t other) {
            return other != place && nearly_coincide(ball, surface_of(other));
        };
        // A sphere that nearly coincides with the lamp contains the lamp's center.
        const glm::ivec3 center(words_[first_sphere_ + place]);
        if (any_in({center, center}, is_close))
            return true;
    }
    return false;
}

// A camera within twice the grid's reach is rounded to a grid point, so that differences are exact. A farther camera is
// replaced by the grid's middle, because rounding is small against the distance.
gpu::TreeFrame SphereTree::frame(const Camera &camera) const {
    gpu::TreeFrame frame{};
    frame.camera = is_far(camera) ? glm::ivec3(0) : grid_.place(camera.position);
    frame.shift = glm::vec3(grid_.point(frame.camera) - camera.position);
    frame.step = static_cast<float>(grid_.step);
    frame.first_motion = first_motion_ - first_sphere_;
    frame.first_surface = first_surface_ - first_sphere_;
    frame.first_color = first_look_ - first_sphere_;
    frame.first_lamp = first_lamp_ - first_sphere_;
    frame.middle = glm::vec3(grid_.middle - camera.position);
    frame.shutter_open = static_cast<float>(camera.shutter_open);
    frame.shutter_time = static_cast<float>(camera.shutter_close - camera.shutter_open);
    return frame;
}

} // namespace pt
