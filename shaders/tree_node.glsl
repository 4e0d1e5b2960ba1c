#ifndef TREE_NODE_GLSL
#define TREE_NODE_GLSL

#include "scene.glsl"

// A ray on the grid. Differences of grid points are exact, so the rays are precise near spheres, wherever the camera
// is.
struct GridRay {
    ivec3 base;    // grid point next to the start
    vec3 rest;     // vector from base to the start, in steps
    float advance; // distance from the origin to the start
    float margin;  // enlargement of boxes, in steps
    bool is_near;
};

// Rays from far away are advanced to a ball about the grid, so that the rounding of their start is the same for all
// spheres. Boxes are enlarged by four times the rounding of a hit (shaders/README.md, section 3).
GridRay grid_ray(vec3 origin, vec3 direction)
{
    const float reach = float(TREE_REACH);
    const float margin = 1.9073486e-6; // 2^-19
    GridRay ray;
    ray.advance = 0.0;
    ray.is_near = true;
    vec3 to_middle = tree_middle() - origin;
    vec3 far = abs(to_middle);
    if (max(far.x, max(far.y, far.z)) > 2.0 * reach * tree_step()) {
        float radius = 1.75 * reach * tree_step(); // more than sqrt(3) reach
        float b = dot(to_middle, direction);
        vec3 across = to_middle - b * direction;
        ray.is_near = b > 0.0 && dot(across, across) < radius * radius;
        ray.advance = ray.is_near ? b - radius : 0.0;
        origin += ray.advance * direction;
    }
    vec3 from_camera = (origin - tree_shift()) / tree_step();
    vec3 place = floor(clamp(from_camera, -3.0 * reach, 3.0 * reach) + 0.5);
    ray.base = tree_camera() + ivec3(place);
    ray.rest = from_camera - place;
    uvec3 size = uvec3(abs(ray.base));
    ray.margin = margin * (float(max(size.x, max(size.y, size.z))) + reach);
    return ray;
}

// tree_step() / direction. Components below 2^-60 become +-2^-60, which moves the ray by less than its margin.
vec3 inverse_of(vec3 direction)
{
    const float least = 8.6736174e-19; // 2^-60
    vec3 sides = vec3(direction.x < 0.0 ? -least : least, direction.y < 0.0 ? -least : least,
                      direction.z < 0.0 ? -least : least);
    return tree_step() / mix(direction, sides, lessThan(abs(direction), vec3(least)));
}

const uint NO_NODE = ~0u;

// A group has up to three children that are still to be entered, nearest first. The low six bits are three fields with
// the children's offsets; unused fields repeat the last child. The bits above are the node number of the first child,
// never 0.
uint next_of(uint group) { return (group >> 6) + (group & 3u); }
bool has_one(uint group) { return ((group ^ (group >> 2)) & 3u) == 0u; }
uint without_next(uint group) { return (group & ~15u) | ((group >> 2) & 15u); }

// 1 + byte / 256 for byte i of the word.
float byte_as_float(uint word, uint i)
{
    uint bits = i == 0u ? word << 15 : i == 1u ? word << 7 : i == 2u ? word >> 1 : word >> 9;
    return uintBitsToFloat((bits & 0x7f8000u) | 0x3f800000u);
}

// The children of a node that a ray enters before a distance. Distances are compared by their bits as integers.
struct Entered {
    uint node;   // nearest child node, or NO_NODE
    uint others;
    bool has_others;
    uint first_place;
    uint spheres; // bit i: the ray enters the box of the sphere at first_place + i
};

struct NodeWords {
    uvec4 head;
    uvec4 links;
    uvec4 sides;
};

NodeWords node_words(uint node)
{
    return NodeWords(tree_node_word(3u * node), tree_node_word(3u * node + 1u), tree_node_word(3u * node + 2u));
}

Entered enter_node(NodeWords words, GridRay ray, vec3 inverse, float before)
{
    uvec4 head = words.head;
    uvec4 links = words.links;
    uvec4 sides = words.sides;
    uvec3 low = uvec3(links.z, links.w, sides.x);
    uvec3 high = sides.yzw;
    bvec3 backwards = lessThan(inverse, vec3(0.0));
    uvec3 nearer = uvec3(backwards.x ? high.x : low.x, backwards.y ? high.y : low.y, backwards.z ? high.z : low.z);
    uvec3 farther = uvec3(backwards.x ? low.x : high.x, backwards.y ? low.y : high.y, backwards.z ? low.z : high.z);

    // `width` is the distance along the ray for 256 node steps. `corner` is the distance to the low corner minus one
    // `width`, because byte_as_float() returns 1 + byte / 256.
    uvec3 exponents = uvec3(head.w, head.w >> 5, head.w >> 10) & 31u;
    vec3 width = uintBitsToFloat((exponents + 135u) << 23) * inverse;
    vec3 corner = (vec3(ivec3(head.xyz) - ray.base) - ray.rest) * inverse - width;
    vec3 margin = ray.margin * abs(inverse);
    vec3 nearer_corner = corner - margin;
    vec3 farther_corner = corner + margin;
    int latest = max(floatBitsToInt(before), 0);

    uint inner_count = (head.w >> 20) & 7u;
    uint child_count = (head.w >> 16) & 7u;
    uint keys[TREE_WIDTH]; // distances of entered child nodes, with the child's index in the two low bits
    uint entered = 0u;
    uint i = 0u;
    [[unroll]] do {
        vec3 low_side = vec3(byte_as_float(nearer.x, i), byte_as_float(nearer.y, i), byte_as_float(nearer.z, i));
        vec3 high_side = vec3(byte_as_float(farther.x, i), byte_as_float(farther.y, i), byte_as_float(farther.z, i));
        ivec3 begins = floatBitsToInt(low_side * width + nearer_corner);
        ivec3 ends = floatBitsToInt(high_side * width + farther_corner);
        int begin = max(max(begins.x, begins.y), max(begins.z, 0));
        int end = min(min(ends.x, ends.y), min(ends.z, latest));
        entered |= begin <= end ? 1u << i : 0u;
        keys[i] = begin <= end && i < inner_count ? (uint(begin) & ~3u) | i : ~0u;
        ++i;
    } while (i < TREE_WIDTH);
    entered &= (1u << child_count) - 1u;

    uint a = min(keys[0], keys[1]);
    uint b = max(keys[0], keys[1]);
    uint c = min(keys[2], keys[3]);
    uint d = max(keys[2], keys[3]);
    uint lower = max(a, c);
    uint upper = min(b, d);
    const uint none = ~0u;
    uint first = min(a, c);
    uint second = min(lower, upper);
    uint third = max(lower, upper);
    uint fourth = max(b, d);
    third = third == none ? second : third;
    fourth = fourth == none ? third : fourth;
    uint others = (links.x << 6) | ((fourth & 3u) << 4) | ((third & 3u) << 2) | (second & 3u);
    uint nearest = first == none ? NO_NODE : links.x + (first & 3u);
    return Entered(nearest, others, second != none, links.y, entered >> inner_count);
}

#endif
