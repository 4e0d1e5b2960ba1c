// Bindings, buffers and push constants, for the GLSL sources and the host (lib/).
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

PT_CONSTANT KIND_BALL = 1;
PT_CONSTANT KIND_CAPSULE = 2;

#include "enumerations.h"

// ---- Dimensions: the random numbers of a sample -------------------------------------------------------------------
// A block has up to four random numbers. The first dimensions of a sequence are its best, so the most important blocks
// come first. Blocks that all branches of a sample share:
//   point in the pixel (2), time (1, with MOTION)
//   point on the lens (2, with LENS)
//   point on a lamp as seen from the first vertex (2), for each of up to EVERY_LAMP_LIMIT lamps
//   direction to a spot (2) and choice of the spot (1); at the spot, lamp (3) and direction (2 or 3)
// Blocks of each vertex from which a branch continues:
//   point on a lamp (2) and choice of the lamp (1, if there are several), unless every lamp has been sampled
//   direction (2), specular or diffuse lobe (1, with GLOSS), survival of Russian roulette (1, for long paths)
PT_CONSTANT EVERY_LAMP_LIMIT = 4;    // up to this number of lamps, the first vertex samples all
PT_CONSTANT SPOT_LIMIT = 8;
PT_CONSTANT ROULETTE_MIN_LENGTH = 8; // minimum MAX_PATH_LENGTH with Russian roulette

PT_FUNCTION uint camera_dimensions(uint motion) { return 2 + motion; }
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

PT_FUNCTION uint path_blocks(uint max_path_length, uint camera_blocks, uint lamp_count, uint spot_count)
{
    const uint of_sample = shared_blocks(camera_blocks, lamp_count, spot_count);
    const uint first = of_sample + vertex_blocks(1, lamp_count);
    return max_path_length < 2 ? of_sample : first + (max_path_length - 2) * vertex_blocks(2, lamp_count);
}

// Number of blocks of a sample in the point table: first the shared blocks, then the blocks of each branch.
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
// In resolve.comp, estimate.comp and first_hit.comp:
PT_CONSTANT BINDING_RESOLVED = 3;
PT_CONSTANT BINDING_FINDINGS = 4;
// In estimate.comp:
PT_CONSTANT BINDING_TILE_COUNTS = 4;
PT_CONSTANT BINDING_TILE_SQUARES = 5;
// In add.comp:
PT_CONSTANT BINDING_ADDED = 3;

PT_CONSTANT WORKGROUP_SIZE = 64;

// ---- Scene buffer: an array of vec4, positions relative to the camera -----------------------------------------------
// Surface indices count spheres, then planes, then with TREE the tree's spheres by slot.
PT_CONSTANT NO_SURFACE = 0xffffffffu;
// Consecutive blocks, with S = spheres + planes:
//   geometry[S]       sphere: center as the shutter opens, radius; plane: unit normal, offset (lib/view/seen_scene.h)
//   emission[S]       radiance R, G, B; mean of the three
//   diffuse[S]        albedo / pi; probability of choosing the specular lobe
//   specular[S]       factor (n + 2) / (2 pi); glossiness n (with GLOSS)
//   motion[spheres]   ball: displacement of the center while the shutter is open, 0; capsule: vector from one end to
//                     the other, 1 / its length (with HAS_WAYS)
//   curvature[planes] curvature; displacement of the surface while the shutter is open (with CURVATURE)
//   tree              tree of lamps (below), if any; only in the storage buffer
//   spots[SPOT_COUNT] lamp and surface, each + MATERIAL_INDEX_BITS, as the bits of floats; mean reflectance; glossiness
//                     of a mirror image, -1 for a glow (not in the storage buffer)
// Largest number of words in a uniform buffer. Vulkan guarantees 16 KiB.
PT_CONSTANT UNIFORM_SCENE_WORDS = 1024;
// Longer scenes are in the storage buffer, where surfaces of one material share its words:
//   geometry[S]
//   emission[E]       of lamps, skies and, with PLANES_EMIT, planes
//   motion[spheres]
//   curvature[planes]
//   tree              of lamps
//   index[S]          four to a word: MATERIAL_INDEX_BITS + index in the table, as the bits of a float
//   tree[5]           TreeFrame (with TREE)
//   table             per material: diffuse and, with GLOSS, specular
// The bits of 1.0. The sum with an index below 2^30 is a finite float that is not denormal, so no device flushes it.
PT_CONSTANT MATERIAL_INDEX_BITS = 0x3f800000;

// ---- Tree buffer: texels of four integers ---------------------------------------------------------------------------
// lavapipe reads texels faster than storage buffers and allows 2 GiB of them in a binding. So nodes and spheres have
// separate bindings. Coordinates are on an integer grid (lib/tree/grid.h). The nodes are padded to a multiple of
// TREE_ALIGNMENT words.
//   node[nodes][3]    the root first:
//                     low corner of the box, x, y, z; exponents of the steps along x, y, z, five bits each, then the
//                     number of children (from bit 16) and of child nodes (from bit 20)
//                     first child node; slot of the first child sphere; low sides of the children's boxes along x, in
//                     steps from the corner, a byte per child; low sides along y
//                     low sides along z; high sides along x, y and z
//   sphere[places]    center at time 0; radius as the bits of a float, whose low eight bits are the opacity times
//                     TREE_OPACITY_STEPS (with TREE_OPACITY)
//   motion[places]    ball: velocity of the center, 0; capsule: as in the scene buffer (with MOTION or capsules)
//   surface[places]   four to a word: index in the material table, or TREE_LAMP_BIT + lamp number
//   color[places]     four to a word: square root of each color component times TREE_COLOR_STEPS, ten bits each (with
//                     TREE_COLORS)
//   lamp[tree lamps]  slot; index in the material table; 0; 0
PT_CONSTANT TREE_WIDTH = 4;
PT_CONSTANT TREE_STACK_SIZE = 27; // largest number of nodes from the root to a sphere
PT_CONSTANT TREE_NODE_WORDS = 3;
PT_CONSTANT TREE_ALIGNMENT = 16; // 256 bytes, the largest alignment that Vulkan allows devices to require ("Limits")
PT_CONSTANT TREE_LAMP_BIT = 0x80000000u;
PT_CONSTANT TREE_COLOR_STEPS = 1023;
PT_CONSTANT TREE_OPACITY_STEPS = 255u;
PT_CONSTANT TREE_OPACITY_BITS = 0xfffu; // bits of opacity_number() that choose the lattice

// Grid point p has the position (p - camera) step + shift, relative to the camera.
struct TreeFrame {
    ivec3 camera;       // grid point
    uint reserved_0;
    vec3 shift;
    float step;         // a power of two
    vec3 middle;        // the grid's center
    float shutter_open; // time in [0, 1]
    uint first_motion;  // offsets in words from the first sphere
    uint first_surface;
    uint first_color;
    uint first_lamp;
    float shutter_time;
    uint reserved[3];
};
PT_CONSTANT TREE_REACH = 0x20000000; // largest absolute coordinate on the grid, 2^29

// ---- The tree of lamps (lamp_tree.glsl) -----------------------------------------------------------------------------
// The shape depends only on the number of lamps. Nodes form groups of four siblings: one to four groups at the top, and
// in each further level a group of children for each node. The nodes of the last level are slots for lamps.
// A group has lamp_tree_group_words() words, each with a component per sibling:
//   x, y, z    middle as the shutter opens: mean of the lamps' centers, weighted by power
//   power      sum of radiance r^2, up to a common factor; 0: an empty slot
//   spread     slot: radius r; node: mean, weighted by power, of 3 r^2 + the squared distance from the middle, but at
//              least R^2 / LAMP_TREE_BALL, where the ball of radius R about the middle contains the lamps at all times
//   x, y, z    displacement of the middle while the shutter is open (with MOTION)
// After the groups come the lamp of each slot and the slot of each lamp, four to a word: MATERIAL_INDEX_BITS + number,
// as the bits of a float.
PT_CONSTANT LAMP_TREE_TOP_GROUPS = 4;
PT_CONSTANT LAMP_TREE_BALL = 64;

PT_FUNCTION uint lamp_tree_group_words(uint motion) { return 5 + 3 * motion; }

PT_FUNCTION uint lamp_tree_top_groups(uint lamp_count, uint levels)
{
    return (lamp_count + (4u << (2u * levels)) - 1u) >> (2u * levels + 2u);
}

PT_FUNCTION uint lamp_tree_slot_groups(uint lamp_count, uint levels)
{
    return lamp_tree_top_groups(lamp_count, levels) << (2u * levels);
}
PT_FUNCTION uint lamp_tree_groups(uint lamp_count, uint levels)
{
    return lamp_tree_top_groups(lamp_count, levels) * (((4u << (2u * levels)) - 1u) / 3u);
}

// ---- Film: two parts, each with FILM_WORDS planes of one uint per pixel of the strip ------------------------------
// The parts have different samples (lib/film/sample_set.h). Their sum gives the image, their difference its error.
PT_CONSTANT FILM_PARTS = 2;
// Words 0 to 11 of a part are sums of R, G and B in film units (FrameConstants.film_scale): unsigned 128-bit fixed
// point, least significant word first, with FILM_FRACTION_BITS bits of fraction.
PT_CONSTANT FILM_SUM_WORDS = 4;
PT_CONSTANT FILM_FRACTION_BITS = 60;
PT_CONSTANT FILM_ACCEPTED = 12;
PT_CONSTANT FILM_REJECTED = 13;
PT_CONSTANT FILM_WORDS = 14;
// With COVERAGE one more plane follows both parts: the number of samples, also rejected ones, whose camera rays hit a
// surface.
PT_CONSTANT FILM_COVERED = FILM_PARTS * FILM_WORDS;
// The largest number of samples that an invocation may sum (film.glsl).
PT_CONSTANT FILM_MAX_GATHERED = 511;
// Accepted components are in [0, 2^28) film units, so a sum of 2^32 samples is below 2^60.
PT_CONSTANT FILM_MAX_EXPONENT = 28;
// Pixels with fewer samples have no standard error.
PT_CONSTANT FILM_MIN_ERROR_SAMPLES = 9;

// ---- The error of an image -----------------------------------------------------------------------------------------
// Side of a tile in pixels, far larger than the distance over which errors of pixels are correlated.
PT_CONSTANT TILE_SIZE = 8;
PT_CONSTANT ESTIMATE_WORKGROUP_SIZE = 128; // 16 adjacent tiles; Vulkan guarantees this size

struct ErrorSquares {
    float sum;          // sum over pixels and channels
    float pixel_shares; // sum over pixels of (pixel's square / `sum`)^2
    float tile_shares;  // sum over tiles of (tile's square / `sum`)^2
    float part_share;   // sum over tiles of (tile's square / `sum`) * (tile's pixels / pixels of a whole tile)
};

struct TileErrors {
    ErrorSquares square;          // (x - r)^2 in film units; x: mean of a pixel, r: estimate of its limit
    ErrorSquares relative_square; // (x - r)^2 / (r^2 + offset^2) * relative_scale^2, without pixels of met_once
    ErrorSquares met_once;        // like relative_square, if only one part hits the light; r: the other part's mean
    ErrorSquares as_lamps;        // like met_once with r = x
    float unseen;                 // expected square of the error from light that no sample hit
    uint met_again;               // number of values that both parts hit (pixel_error.h)
    uint unknown_pixels;          // pixels without samples in a part
    uint lost_pixels;             // pixels that a driver lost
    uvec2 rejected;               // low word, high word
};

// ---- Push constants ----------------------------------------------------------------------------------------------
struct CameraView {
    vec3 right;
    float start_scale; // distance between the starts of neighboring pixels' rays
    vec3 up;
    uint width;        // image size in pixels
    vec3 forward;      // its length is the distance of the image plane in pixels, or 1 for parallel rays
    uint height;
    float lens_radius; // radius of the disc where rays start (with LENS)
    float lens_blur;   // pixels; radius of the image of an infinitely far point (with LENS)
    uint reserved[2];
};

struct FrameConstants {
    CameraView camera;
    uvec2 seed;             // hash of pt_render.seed
    float film_scale;       // film units per radiance, a power of two
    uint film_first_pixel;  // index in the image, row by row
    uint strip_first_pixel; // index in the film
    uint strip_pixel_count;
    uint first_entry; // index in the list of tiles
    uint film_part;   // the part that gets the samples
    uint is_first;    // 1: the part has no sample of these pixels; in fold.comp: the next dispatch has is_first
    uint first_sample;
    uint sample_count;
    uint share;        // sample limit of an invocation; invocations along y divide a pixel's samples
};

PT_CONSTANT ANY_COUNT = 0xffffffffu;

// For resolve.comp. Pixels are numbered row by row over the film.
struct ResolveConstants {
    uvec2 sample_counts; // expected in the older and the newer part; ANY_COUNT: not checked
    int exponent;        // a unit of sums is 2^exponent radiance
    uint quantity;       // PT_QUANTITY_*
    uint film_width;
    uint strip_first_pixel;
    uint strip_pixel_count;
    uint first_pixel; // the rectangle's corner
    uint width;
    uint pixel_count;
    uint first_word;
    uint row_words;
};

// For first_hit.comp. Pixels are numbered row by row over the image.
struct FirstHitConstants {
    CameraView camera;
    float start_distance; // distance from the pinhole to the scene's origin, along the view
    uint quantity;        // PT_QUANTITY_*
    uint format;          // PT_FORMAT_*
    uint first_pixel;     // the rectangle's corner
    uint rectangle_width;
    uint first_of_rectangle; // first pixel of this dispatch, counted row by row over the rectangle
    uint pixel_count;
};
PT_CONSTANT FILTER_RAYS = 16;
PT_FUNCTION uint rays_of_pixel(uint quantity)
{
    return quantity == QUANTITY_NORMAL || quantity == QUANTITY_ALBEDO ? FILTER_RAYS : 1;
}

// For estimate.comp. The strip has whole rows.
struct EstimateConstants {
    uint film_width;
    uint strip_pixel_count;
    uint row_count;
    uint first_tile;
    uvec2 sample_counts;   // samples of a pixel in the two parts; ANY_COUNT: tiles have other numbers
    uint by_tile;          // 1: also writes each tile's errors
    float relative_offset; // in film units
    float relative_scale;
};

// For add.comp.
struct AddConstants {
    uint strip_pixel_count;
    uint first_pixel;
    uint pixel_count;
    uint added_first_pixel;
    uint added_stride; // words of a plane
    uint has_coverage; // 1: both films have the plane FILM_COVERED
};

#ifdef __cplusplus
// Vulkan guarantees 128 bytes of push constants.
static_assert(sizeof(CameraView) == 64 && offsetof(CameraView, start_scale) == 12 && offsetof(CameraView, up) == 16);
static_assert(offsetof(CameraView, forward) == 32 && offsetof(CameraView, height) == 44);
static_assert(offsetof(CameraView, lens_radius) == 48 && offsetof(CameraView, lens_blur) == 52);
static_assert(sizeof(FrameConstants) == 112 && sizeof(FrameConstants) <= 128);
static_assert(offsetof(FrameConstants, seed) == 64 && offsetof(FrameConstants, share) == 108);
static_assert(sizeof(TreeFrame) == 80 && offsetof(TreeFrame, middle) == 32 && offsetof(TreeFrame, first_motion) == 48);
static_assert(sizeof(ResolveConstants) == 48 && offsetof(ResolveConstants, row_words) == 44);
static_assert(sizeof(FirstHitConstants) == 92 && offsetof(FirstHitConstants, pixel_count) == 88);
static_assert(WORKGROUP_SIZE % FILTER_RAYS == 0);
static_assert(sizeof(EstimateConstants) == 36 && offsetof(EstimateConstants, sample_counts) == 16);
static_assert(sizeof(TileErrors) == 88 && offsetof(TileErrors, rejected) == 80);
static_assert(sizeof(AddConstants) == 24 && offsetof(AddConstants, added_stride) == 16);
} // namespace pt::gpu
#endif
#undef PT_CONSTANT
#undef PT_FUNCTION

#endif
