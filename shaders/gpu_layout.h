// What the host and the kernels must agree on: bindings, buffers, push constants.
// Included by the GLSL sources and, for the host, by lib/.
#ifndef PT_GPU_LAYOUT_H
#define PT_GPU_LAYOUT_H

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
namespace pt::gpu {
using uint = std::uint32_t;
using uvec2 = glm::uvec2;
using ivec3 = glm::ivec3;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
#define PT_CONSTANT constexpr uint
#define PT_FUNCTION constexpr
#else
#define PT_CONSTANT const uint
#define PT_FUNCTION
#endif

// ---- Values of specialization constants (specialization.h) ----------------------------------------------------------
PT_CONSTANT SCENE_IN_STORAGE = 0;
PT_CONSTANT SCENE_IN_UNIFORM = 1;
PT_CONSTANT SCENE_IN_CONSTANTS = 2;

// Kinds of surfaces that are held by a ball, a bit each (lib/scene/moving_ball.h).
PT_CONSTANT KIND_BALL = 1;
PT_CONSTANT KIND_CAPSULE = 2;

// The numbers of pt.h.
#include "enumerations.h"

// ---- Numbers of a sample: each that a path consumes is a dimension of its own ---------------------------------------
// They come in blocks of up to four. First the blocks that all branches of a sample share: the place in the pixel (2)
// and the time (1, with MOTION); the place on the lens (2, with LENS); for each of a few lamps (EVERY_LAMP_LIMIT) its
// place as seen from the first vertex (2); with spots, the way by one of them: the direction (2) and which spot (1), and at the spot what a later vertex
// consumes: lamp (3) and direction (2 or 3). Then those of a branch, for each vertex that it leaves: the place on a
// lamp (2) and which lamp (1, if there are several) unless every lamp has been sampled there; the direction (2), the
// specular or diffuse lobe (1, with GLOSS) and survival of Russian roulette (1, for long paths). The dimensions of a
// sequence are dealt to the blocks in this order: the low ones are its best, and go to what makes most of the picture.
PT_CONSTANT EVERY_LAMP_LIMIT = 4;    // scenes with no more lamps sample every one at the first vertex
PT_CONSTANT SPOT_LIMIT = 8;          // spots that a scene may have
PT_CONSTANT ROULETTE_MIN_LENGTH = 8; // paths that may be this long play Russian roulette

PT_FUNCTION uint camera_dimensions(uint motion) { return 2 + motion; }
// How many blocks come before those of the ray towards a spot, how many that ray has, and how many all branches share.
// camera_blocks: those of the camera ray.
PT_FUNCTION uint every_lamp_blocks(uint camera_blocks, uint lamp_count)
{
    return camera_blocks + (lamp_count <= EVERY_LAMP_LIMIT ? lamp_count : 0);
}
PT_FUNCTION uint spot_blocks(uint spot_count) { return spot_count > 0 ? 3 : 0; }
PT_FUNCTION uint shared_blocks(uint camera_blocks, uint lamp_count, uint spot_count)
{
    return every_lamp_blocks(camera_blocks, lamp_count) + spot_blocks(spot_count);
}
PT_FUNCTION uint chosen_lamp_dimensions(uint vertex, uint lamp_count)
{
    return lamp_count == 0 || (vertex == 1 && lamp_count <= EVERY_LAMP_LIMIT) ? 0 : lamp_count == 1 ? 2 : 3;
}
PT_FUNCTION uint direction_dimensions(uint gloss, uint max_path_length)
{
    return 2 + gloss + (max_path_length >= ROULETTE_MIN_LENGTH ? 1 : 0);
}
PT_FUNCTION uint vertex_blocks(uint vertex, uint lamp_count)
{
    return chosen_lamp_dimensions(vertex, lamp_count) > 0 ? 2 : 1;
}

// The blocks of a sample and one of its branches.
PT_FUNCTION uint path_blocks(uint max_path_length, uint camera_blocks, uint lamp_count, uint spot_count)
{
    const uint of_sample = shared_blocks(camera_blocks, lamp_count, spot_count);
    const uint first = of_sample + vertex_blocks(1, lamp_count);
    return max_path_length < 2 ? of_sample : first + (max_path_length - 2) * vertex_blocks(2, lamp_count);
}

// Blocks of a row of the point table, one sample's: the shared ones, then for each branch its own. The points of the
// branches are those of samples of their own: with B branches, B i + b for branch b of sample i.
PT_FUNCTION uint row_blocks(uint table_blocks, uint shared_count, uint branches)
{
    return table_blocks == 0 ? 0 : shared_count + branches * (table_blocks - shared_count);
}

// ---- Bindings of set 0 ---------------------------------------------------------------------------------------------
PT_CONSTANT BINDING_SCENE_UNIFORM = 0;
PT_CONSTANT BINDING_SCENE_STORAGE = 1;
PT_CONSTANT BINDING_FILM = 2;
PT_CONSTANT BINDING_POINTS = 4;
PT_CONSTANT BINDING_TREE_NODES = 5;
PT_CONSTANT BINDING_TREE_SPHERES = 6;
PT_CONSTANT BINDING_TILES = 7;
// resolve.comp and estimate.comp, besides BINDING_FILM; first_hit.comp, besides those of the scene and the tree.
PT_CONSTANT BINDING_RESOLVED = 3;
PT_CONSTANT BINDING_FINDINGS = 4;
// coverage.comp, besides those of the scene, the tree and the points.
PT_CONSTANT BINDING_COVERED = 3;
// estimate.comp.
PT_CONSTANT BINDING_TILE_COUNTS = 4;
PT_CONSTANT BINDING_TILE_SQUARES = 5;
// add.comp, likewise.
PT_CONSTANT BINDING_ADDED = 3;

// Invocations of a workgroup, one pixel each: a multiple of every vector width of software Vulkan and of GPU subgroups.
PT_CONSTANT WORKGROUP_SIZE = 64;

// ---- Scene buffer: an array of vec4, positions relative to the camera -----------------------------------------------
// A surface is its index: spheres first, then planes, then with TREE the spheres of the tree.
PT_CONSTANT NO_SURFACE = 0xffffffffu;
// With S = spheres + planes and each block following the one before:
//   geometry[S]       sphere: centre as the shutter opens, radius; plane: unit normal, offset (lib/scene/seen_scene.h)
//   emission[S]       radiance R, G, B; mean of the three
//   diffuse[S]        albedo / pi; probability of choosing the specular lobe
//   specular[S]       factor (n + 2) / (2 pi); glossiness n (only with GLOSS)
//   motion[spheres]   way of the centre while the shutter is open; 0. Of a capsule, which is a sphere that is swept from
//                     one end to the other: the way between these; 1 / its length (only with HAS_WAYS)
//   curvature[planes] curvature; way of the surface while the shutter is open (only with CURVATURE)
//   tree              of lamps, if they have one (below), which is read from the storage buffer
//   spots[SPOT_COUNT] lamp and surface: MATERIAL_INDEX_BITS + each, as the bits of floats; what the surface reflects of
//                     light, the mean of R, G and B; glossiness of a mirror image, -1 of a glow (never in the storage buffer)
// The uniform buffer has the 16 KiB that every Vulkan device offers.
PT_CONSTANT UNIFORM_SCENE_WORDS = 1024;
// A scene that would be longer is in the storage buffer, where surfaces of one material share its words:
//   geometry[S]
//   emission[E]       of the E surfaces that may emit: lamps, skies, and with PLANES_EMIT the planes
//   motion[spheres]
//   curvature[planes]
//   tree
//   index[S]          four to a word: MATERIAL_INDEX_BITS + the surface's place in the table, as the bits of a float
//   tree[5]           with TREE: TreeFrame
//   table             for each material its word of diffuse and, with GLOSS, that of specular
// Emission is not in the table, as the many lamps of such a scene are asked for it one after the other.
// The bits of 1.0: any index below 2^30 makes a finite number of them, and none that a device may flush to 0.
PT_CONSTANT MATERIAL_INDEX_BITS = 0x3f800000;

// ---- Tree buffer: texels of four integers, the spheres that are not in the scene buffer -------------------------------
// Texels, as lavapipe reads them 1.3 times as fast as a storage buffer, and sees 2 GiB of them instead of 128 MiB. The nodes
// have a binding of their own, so that each may take what a binding can hold. They end at a multiple of TREE_ALIGNMENT words.
// Places are on an integer grid, so that neither spheres nor boxes change with the camera (lib/tree/grid.h). Surfaces are
// numbered as the scene buffer has them, and then the spheres of the tree by place, which is an order of the tree.
//   node[nodes][3]    the root first. x, y, z of the low corner of its box; five bits each: the exponents of its steps
//                     along x, y and z, as powers of two, then a bit, and from bit 16 on the number of children, and from
//                     bit 20 on of those that are nodes
//                     first of these, and place of the first of the others, which are spheres: both consecutive; the
//                     low sides of the children's boxes in steps from the corner, a byte a child, along x and y
//                     low sides along z, high sides along x, y and z
//   sphere[places]    x, y, z of the centre at time 0; the radius, as the bits of a float. With TREE_OPACITY the last
//                     eight of these are the opacity times TREE_OPACITY_STEPS
//   motion[places]    way of the centre in a unit of time, as bits of floats; 0. Of a capsule: as in the scene buffer
//                     (only if some sphere moves or is swept)
//   surface[places]   four to a word: the place of the material in the table, or TREE_LAMP_BIT + the number of a lamp
//   color[places]     four to a word: what multiplies the diffuse reflection, the root of each component times
//                     TREE_COLOR_STEPS in ten bits (only with TREE_COLORS)
//   lamp[tree lamps]  place; place of the material in the table; 0; 0
PT_CONSTANT TREE_WIDTH = 4;
PT_CONSTANT TREE_STACK_SIZE = 27; // nodes from the root to the deepest, at most (lib/tree/sphere_order.h)
PT_CONSTANT TREE_NODE_WORDS = 3;
PT_CONSTANT TREE_ALIGNMENT = 16; // 256 bytes: no device asks for more (Vulkan specification, "Limits")
PT_CONSTANT TREE_LAMP_BIT = 0x80000000u;
PT_CONSTANT TREE_COLOR_STEPS = 1023;
PT_CONSTANT TREE_OPACITY_STEPS = 255u;

// The tree as a camera sees it: a place p of the grid is at (p - camera) step + shift, relative to the camera.
struct TreeFrame {
    ivec3 camera;       // a place of the grid
    uint reserved_0;
    vec3 shift;
    float step;         // a power of two
    vec3 middle;        // of the grid
    float shutter_open; // in units of time of motion
    uint first_motion;  // words from the first sphere's on
    uint first_surface;
    uint first_color;
    uint first_lamp;
    float shutter_time; // while the shutter is open
    uint reserved[3];
};
PT_CONSTANT TREE_REACH = 0x20000000; // coordinates of places in a tree are at most this, 2^29

// ---- The tree of lamps (shaders/lamp_tree.glsl) ----------------------------------------------------------------------
// Its shape depends on the number of lamps alone. Nodes come in groups of four siblings: on top there are one to four
// groups, below them for each node a group of its children, level by level; the nodes of the last level are slots for
// lamps. A group has lamp_tree_group_words() words, each with a component for each sibling:
//   x, y, z    its middle as the shutter opens: the mean of its lamps' centres by their power
//   power      the sum of radiance r^2 over its lamps, up to a factor; 0: an empty slot
//   spread     mean by power of the squared distances of its lamps from its middle, and of three times their squared
//              radii; at least a 64th of the square of the radius of a ball about the middle that holds them at any
//              time. Of a slot, its lamp's radius
//   x, y, z    way of the middle while the shutter is open (only with MOTION)
// Then for each slot its lamp, and for each lamp its slot, four to a word: MATERIAL_INDEX_BITS + the number as the bits
// of a float.
PT_CONSTANT LAMP_TREE_TOP_GROUPS = 4; // at most
PT_CONSTANT LAMP_TREE_BALL = 64;      // what the spread is at least, as above

PT_FUNCTION uint lamp_tree_group_words(uint motion) { return 5 + 3 * motion; }

// Groups at the top of a tree with this many levels below.
PT_FUNCTION uint lamp_tree_top_groups(uint lamp_count, uint levels)
{
    return (lamp_count + (4u << (2u * levels)) - 1u) >> (2u * levels + 2u);
}

// Groups of the last level, one for four slots, and groups of all levels together.
PT_FUNCTION uint lamp_tree_slot_groups(uint lamp_count, uint levels)
{
    return lamp_tree_top_groups(lamp_count, levels) << (2u * levels);
}
PT_FUNCTION uint lamp_tree_groups(uint lamp_count, uint levels)
{
    return lamp_tree_top_groups(lamp_count, levels) * (((4u << (2u * levels)) - 1u) / 3u);
}

// ---- Film: two parts, each planes of one uint per pixel of the strip -------------------------------------------------
// Each has samples of its own (lib/film/sample_set.h): the image is the sum of both, and their difference tells its error.
PT_CONSTANT FILM_PARTS = 2;
// Of a part, words 0 to 3, 4 to 7 and 8 to 11 are the exact sums of R, G and B: unsigned 128-bit fixed point, least
// significant word first, of which the last FILM_FRACTION_BITS bits are the fraction, in film units
// (FrameConstants.film_scale).
PT_CONSTANT FILM_SUM_WORDS = 4;
PT_CONSTANT FILM_FRACTION_BITS = 60;
PT_CONSTANT FILM_ACCEPTED = 12; // samples in the sums
PT_CONSTANT FILM_REJECTED = 13; // samples left out
PT_CONSTANT FILM_WORDS = 14;
// An invocation gathers at most this many samples (film.glsl).
PT_CONSTANT FILM_MAX_GATHERED = 511;
// A sample is accepted if all its components, in film units, lie in [0, 2^28): 2^32 of them stay below 2^60.
PT_CONSTANT FILM_MAX_EXPONENT = 28;
// With fewer samples the difference of the parts says next to nothing, so no standard error is given.
PT_CONSTANT FILM_MIN_ERROR_SAMPLES = 9;

// ---- The error of an image -----------------------------------------------------------------------------------------
// The side of a tile in pixels: large compared with what neighbouring pixels have in common, and small enough for a
// small image to have hundreds of tiles.
PT_CONSTANT TILE_SIZE = 8;
PT_CONSTANT ESTIMATE_WORKGROUP_SIZE = 128; // pixels side by side, in 16 tiles; what every device allows

// The sum of the expected squares of errors in some tiles, and how it is distributed. Shares in the sum are used because
// their squares stay within the range of float.
struct ErrorSquares {
    float sum;          // over pixels and channels
    float pixel_shares; // sum of the squares of the pixels' shares
    float tile_shares;  // sum of the squares of the tiles' shares
    float part_share;   // sum of the tiles' shares, each times its pixels over those of a whole tile
};

// What the tiles of a workgroup say about the error of the image.
struct TileErrors {
    ErrorSquares square;          // of (x - r)^2, in film units
    ErrorSquares relative_square; // of (x - r)^2 / (r^2 + offset^2), times relative_scale^2, without values met once
    ErrorSquares met_once;        // the same for values met once, with limits r that are known without them
    ErrorSquares as_lamps;        // the same for values met once, with their own means as r
    float unseen;                 // the same of light that no sample met, not scaled
    uint met_again;               // values
    uint unknown_pixels;          // without a sample in either part
    uint lost_pixels;             // whose samples a driver lost
    uvec2 rejected;               // samples, low and high word
};

// ---- Push constants ----------------------------------------------------------------------------------------------
// The camera, for all kernels that take rays from it.
struct CameraView {
    vec3 right;        // unit vector
    float start_scale; // rays start this times their distance from the image's middle in pixels off the origin
    vec3 up;           // unit vector
    uint width;        // of the image, pixels
    vec3 forward;      // as long as the image plane is far away in pixels; of parallel rays a unit vector
    uint height;       // of the image, pixels
    float lens_radius; // where rays start (only with LENS)
    float lens_blur;   // radius in pixels of the image of a point infinitely far away (likewise)
    uint reserved[2];
};

struct FrameConstants {
    CameraView camera;
    uvec2 seed;             // well mixed words made from pt_render.seed
    float film_scale;       // radiance times this is in film units; a power of two
    uint film_first_pixel;  // index of the film's first pixel in the image, row by row
    uint strip_first_pixel; // of the strip's, in the film
    uint strip_pixel_count;
    uint first_entry;  // of this dispatch in the list of tiles
    uint film_part;    // to which the samples of this dispatch are added
    uint is_first;     // 1: the part has no samples of these pixels yet; of a fold, that such a dispatch follows
    uint first_sample; // index in the sequence
    uint sample_count; // >= 1
    uint share;        // samples that an invocation takes, at the most; those along y have the next ones
};

PT_CONSTANT ANY_COUNT = 0xffffffffu;

// resolve.comp. Pixels are numbered row by row over the film.
struct ResolveConstants {
    uvec2 sample_counts; // that each pixel must have in the older and in the newer part; ANY_COUNT: not looked at
    int exponent;        // of the unit in which sums are counted, as a power of two, in radiance
    uint quantity;       // PT_QUANTITY_* of pt.h
    uint film_width;
    uint strip_first_pixel;
    uint strip_pixel_count;
    uint first_pixel; // of the rectangle that is resolved
    uint width;       // of that rectangle
    uint pixel_count; // in it
    uint first_word;  // of the image in its buffer
    uint row_words;   // from a row to the next
};

// first_hit.comp. Pixels are numbered row by row over the image.
struct FirstHitConstants {
    CameraView camera;
    float start_distance; // of the scene's origin from the pinhole, along the view
    uint quantity;        // PT_QUANTITY_* of pt.h
    uint format;          // PT_FORMAT_* of pt.h
    uint first_pixel;     // of a rectangle
    uint rectangle_width;
    uint first_of_rectangle; // of the pixels that are looked at, counted row by row over the rectangle
    uint pixel_count;
};
// How many rays of a pixel are averaged, if any are. Divides a workgroup.
PT_CONSTANT FILTER_RAYS = 16;
PT_FUNCTION uint rays_of_pixel(uint quantity)
{
    return quantity == QUANTITY_NORMAL || quantity == QUANTITY_ALBEDO ? FILTER_RAYS : 1;
}

// coverage.comp. Pixels as above. The samples form a range, of which each tile may have a part.
struct CoverageConstants {
    CameraView camera;
    uvec2 seed;
    uint first_row; // of the film, in the image: tiles count from there
    uint first_pixel;
    uint rectangle_width;
    uint first_of_rectangle;
    uint pixel_count;
    uint first_sample;
    uint last_sample;
};

// estimate.comp, for a strip of whole rows.
struct EstimateConstants {
    uint film_width;
    uint strip_pixel_count;
    uint row_count;
    uint first_tile;       // of the strip, in the film
    uvec2 sample_counts;   // of each pixel in the older and in the newer part; ANY_COUNT: tiles differ
    uint by_tile;          // 1: also writes what each tile says of itself
    float relative_offset; // in film units
    float relative_scale;
};

// add.comp: consecutive pixels of one strip, and equally many that are added to them.
struct AddConstants {
    uint strip_pixel_count;
    uint first_pixel; // in the strip
    uint pixel_count;
    uint added_first_pixel;
    uint added_stride; // words of a plane
};

#ifdef __cplusplus
// Vulkan guarantees 128 bytes of push constants; the offsets are those of GLSL's std430.
static_assert(sizeof(CameraView) == 64 && offsetof(CameraView, start_scale) == 12 && offsetof(CameraView, up) == 16);
static_assert(offsetof(CameraView, forward) == 32 && offsetof(CameraView, height) == 44);
static_assert(offsetof(CameraView, lens_radius) == 48 && offsetof(CameraView, lens_blur) == 52);
static_assert(sizeof(FrameConstants) == 112 && sizeof(FrameConstants) <= 128);
static_assert(offsetof(FrameConstants, seed) == 64 && offsetof(FrameConstants, share) == 108);
static_assert(sizeof(TreeFrame) == 80 && offsetof(TreeFrame, middle) == 32 && offsetof(TreeFrame, first_motion) == 48);
static_assert(sizeof(ResolveConstants) == 48 && offsetof(ResolveConstants, row_words) == 44);
static_assert(sizeof(FirstHitConstants) == 92 && offsetof(FirstHitConstants, pixel_count) == 88);
static_assert(WORKGROUP_SIZE % FILTER_RAYS == 0);
static_assert(sizeof(CoverageConstants) == 100 && offsetof(CoverageConstants, seed) == 64);
static_assert(sizeof(EstimateConstants) == 36 && offsetof(EstimateConstants, sample_counts) == 16);
static_assert(sizeof(TileErrors) == 88 && offsetof(TileErrors, rejected) == 80);
static_assert(sizeof(AddConstants) == 20 && offsetof(AddConstants, added_stride) == 16);
} // namespace pt::gpu
#endif
#undef PT_CONSTANT
#undef PT_FUNCTION

#endif
