/** @file
 * pt: an offscreen path tracer for spheres and planes on any Vulkan device.
 *
 * To render: pt_create, pt_set_scene (with pt_set_camera and pt_set_render), pt_accumulate, pt_readback. What only some
 * programs need is in other headers: pt/async.h (samples that are taken while the program goes on), pt/map.h (images
 * without a copy), pt/stats.h (what was done, and the image's error), pt/errors.h (the last error as data),
 * pt/devices.h (which devices there are), pt/film.h (films that are saved and added), pt/vulkan.h (a device of the
 * caller's own), pt/denoise.h (images without noise), pt/shaders.h (changed kernels) and pt/accuracy.h (how well a
 * device computes).
 *
 * - World: right-handed, lengths in scene units, positions in double, angles in radians, time in [0, 1]. Color is
 *   linear RGB radiance, unclamped. Row 0 of an image is the top row.
 * - Numbers: all finite. Lengths are 0 or lie in [1e-18, 1e18], where their squares are float32 numbers too.
 * - Structs: one passed by pointer begins with struct_size = sizeof(the struct) as the caller compiled it and grows
 *   only at its tail; a zero field means "default". A shorter struct is read as if zeros followed; a longer one is
 *   accepted only if the tail that this library does not know is zero (otherwise PT_ERROR_UNSUPPORTED). Elements of
 *   arrays have no struct_size and are frozen, except pt_sphere_array, which grows like the others. Reserved fields
 *   must be zero.
 * - Ownership: what a call is given is copied or no longer needed when it returns, except callbacks, their user
 *   pointers and other things where a comment says so. Pointers may be NULL only where a comment says so.
 * - Results: a call that fails (result < 0) has changed nothing, except that a lost device stays lost (destroy the
 *   context and create another) and that pt_accumulate may have taken some of its samples. Every failure has a message,
 *   see pt_last_error. Any function can fail with PT_ERROR_OUT_OF_HOST_MEMORY and PT_ERROR_INTERNAL, and with
 *   PT_ERROR_INVALID_ARGUMENT where a pointer is NULL or a struct_size is absurd.
 * - Threads: different contexts are independent; one context is used by one thread at a time. While one thread is in a
 *   call on a context, calls of other threads on it are refused (PT_ERROR_INVALID_STATE), except pt_cancel
 *   (pt/async.h). The library starts no threads (drivers do), prints nothing, reads no files except those of
 *   pt_create_info.shader_dir and has no globals. Calls need less than 256 KiB of stack on Mesa's lavapipe.
 * - Processes: after fork a child may make contexts of its own. Its calls on those of its parent are refused
 *   (PT_ERROR_INVALID_STATE), and pt_destroy leaves them alone: the driver's threads are not in the child.
 * - Callbacks: run inside the call, on the calling thread. In them, calls on the same context are refused
 *   (PT_ERROR_INVALID_STATE), except pt_cancel. They must not throw.
 * - Floating point: calls, and callbacks in them, round to nearest; when they return the caller's rounding mode is
 *   restored. Floating-point exceptions must not be trapped.
 */
#ifndef PT_H
#define PT_H

#include <stdint.h>

#ifndef PT_API
/** Stands before every function; only a build of the library may define it. */
#define PT_API
#endif

/** Version of this header: major * 1000000 + minor * 1000 + patch. */
#define PT_VERSION 3000u

#ifdef __cplusplus
extern "C" {
#endif

/** The result of a call. < 0: error; 0: done; > 0: done with a remark. The numbers never change. */
typedef int32_t pt_result;
/** Values of pt_result. */
enum {
    PT_OK = 0,                          /**< done */
    PT_CANCELLED = 1,                   /**< the caller asked to stop; whole samples, or the earlier scene, were kept */
    PT_TARGET_REACHED = 2,              /**< the target error was reached before all samples were taken */
    PT_PENDING = 3,                     /**< samples are under way, see pt/async.h */
    PT_ERROR_INVALID_ARGUMENT = -1,     /**< a field, size or pointer breaks a rule of this header */
    PT_ERROR_INVALID_SCENE = -2,        /**< a scene breaks a rule; the message names field, value and rule */
    PT_ERROR_INVALID_STATE = -3,        /**< something has to be set or to end first, or another call is under way */
    PT_ERROR_UNSUPPORTED = -4,          /**< valid, but beyond this device, driver or library */
    PT_ERROR_NO_DEVICE = -5,            /**< no Vulkan driver, or no device fits; the message has the reasons */
    PT_ERROR_OUT_OF_HOST_MEMORY = -6,   /**< the machine has too little memory left */
    PT_ERROR_OUT_OF_DEVICE_MEMORY = -7, /**< the device has too little memory left, for this image for instance */
    PT_ERROR_DEVICE_LOST = -8,          /**< the device or its driver gave up; the context can only be destroyed */
    PT_ERROR_SHADER = -9,               /**< the driver refused to build the kernel, or its GLSL does not compile */
    PT_ERROR_INTERNAL = -10,            /**< a bug in this library or in the driver */
    PT_ERROR_INCOMPATIBLE = -11         /**< a film that does not belong to what is rendered (pt/film.h) */
};

/** One renderer, on one device or several. Made by pt_create and owned by its caller until pt_destroy. */
typedef struct pt_context pt_context;

/** The caller's own Vulkan; defined in pt/vulkan.h. */
typedef struct pt_vulkan pt_vulkan;

/** Called now and then during a long call with the share of it that is done, in [0, 1], never falling.
 *
 * Return 0 to go on; anything else asks the call to stop, which then returns PT_CANCELLED. pt_scene and
 * pt_accumulate_info say what is kept then, and how often the function is called. user is the progress_user given
 * beside the function. */
typedef int32_t (*pt_progress_fn)(void *user, double fraction);

/* ---- Scene ------------------------------------------------------------------------------------------------------ */

/** How a surface reflects and shines.
 *
 * Reflection is the physically-normalised Phong model
 *
 *     f(wi, wo) = diffuse / pi + specular * (n + 2) / (2 pi) * max(0, dot(wo, reflect(wi)))^n,   n = glossiness,
 *
 * where n = 0 stands for the limit n -> 0: a lobe that is constant on the half space about the mirror direction.
 * Components are R, G, B, each in [0, 1e18]; diffuse + specular may exceed 1 (such a surface gains energy). */
typedef struct pt_material {
    float diffuse[3];  /**< share of the light that is reflected diffusely */
    float specular[3]; /**< weight of the lobe about the mirror direction */
    float emission[3]; /**< radiance, the same in every direction and on both sides */
    float glossiness;  /**< n in [0, 1e9] */
    uint32_t flags;    /**< PT_MATERIAL_* */
} pt_material;

/** Bits of pt_material.flags. */
enum {
    /** Rays from the camera pass through surfaces of the material; all other rays meet them as if the bit were not set.
     * So a lamp can be out of the picture and still light it and be seen in reflections, or the camera can look through
     * a wall into a room. Such spheres are tested one by one, even if others are in a tree (PT_FEATURE_TREE), so they
     * should be few. If surfaces are merged (pt_sphere), the material of the first one decides. */
    PT_MATERIAL_HIDDEN_FROM_CAMERA = 1
};

/** A ball. Visible, lit and emitting on both sides. The centre at time t is center + t * motion.
 *
 * Spheres too close for float32 to separate, seen from the camera, are merged; the first one in the scene wins. So are
 * planes. Spheres are merged if their radii differ by less than 2^-18 of the radius, and their centres by less than
 * 2^-18 of the radius plus 2^-21 of the distance, but never if the centres differ by a quarter of the radius or more.
 *
 * Spheres in a tree (PT_FEATURE_TREE) are merged only if everything that the tree holds of them is equal. Of different
 * ones about one centre the largest is seen. A camera nearer to the surface of such a sphere than 2^-22 of its radius
 * plus 2^-28 of the extent of the spheres in the tree may see the other side of the surface. */
typedef struct pt_sphere {
    double center[3]; /**< at time 0 */
    double radius;    /**< > 0 */
    /** Displacement from time 0 to time 1. A sphere whose surface is nearer to the camera than 1/65536 of its radius
     * when the shutter opens must move by less than 1/32 of its radius while the shutter is open (otherwise
     * pt_accumulate returns PT_ERROR_UNSUPPORTED). With an orthographic projection the rule applies only if the view's
     * half diagonal is less than that, too, and the distance is that to the first surface in view. */
    double motion[3];
    uint32_t material; /**< index into pt_scene.materials */
    uint32_t reserved; /**< 0 */
} pt_sphere;

/** Values of pt_column.type: what a component is. */
enum {
    PT_TYPE_FLOAT32 = 1, /**< float */
    PT_TYPE_FLOAT64 = 2, /**< double */
    PT_TYPE_UINT32 = 3,  /**< uint32_t */
    /** uint8_t, for colors only: 255 times the sRGB encoding (IEC 61966-2-1) of a linear value in [0, 1], as in
     * pictures and color maps. */
    PT_TYPE_SRGB8 = 4
};

/** One property of many spheres, read from the caller's memory. The value of sphere i begins at data + i *
 * stride_bytes, with its components one after the other; no alignment is needed. All zero: no column, the property has
 * its default. */
typedef struct pt_column {
    const void *data;      /**< NULL only if there is no column */
    uint32_t stride_bytes; /**< < 2^31; at least the size of one value, or 0: one value for all spheres */
    uint32_t type;         /**< PT_TYPE_* */
} pt_column;

/** Spheres by columns, as simulations have them. Each value obeys the rules of the same field of pt_sphere. */
typedef struct pt_sphere_array {
    uint32_t struct_size; /**< sizeof(pt_sphere_array), equal in all elements: also the distance between them */
    uint32_t count;       /**< number of spheres; if 0, the columns are not looked at */
    pt_column center;     /**< x, y, z at time 0; FLOAT32 or FLOAT64; required */
    pt_column radius;     /**< FLOAT32 or FLOAT64; required */
    pt_column motion;     /**< x, y, z; FLOAT32 or FLOAT64; default (0, 0, 0) */
    pt_column material;   /**< index into pt_scene.materials; UINT32; default 0 */
    /** R, G, B in [0, 1], by which the diffuse of the sphere's material is multiplied; FLOAT32 or FLOAT64, linear like
     * all colors, or SRGB8; default (1, 1, 1). So spheres of one white material can each have their own color. Held to
     * a thousandth if spheres are in a tree (PT_FEATURE_TREE). */
    pt_column color;
    /** x, y, z of a second center; FLOAT32 or FLOAT64; default none. With it each is a capsule: all points that are no
     * farther than the radius from the segment between center and end. Capsules do not emit and do not move
     * (PT_ERROR_INVALID_SCENE); their surface is off by 2^-21 of their length and radius where these are larger than
     * the distance. They are spheres otherwise, in counts, trees and numbers of objects. */
    pt_column end;
    /** Share of rays in [0, 1] that meet the sphere; the others pass it as though it were not there, decided at random
     * for each camera, path and shadow ray. Spheres that differ in anything decide independently: the product of their
     * 1 - opacity passes. With the default sampler a pixel's rays meet one sphere in even proportion; what two and more
     * let through, and what depends on the place in the pixel or on the lamp too, has an error that falls with the root
     * of the sample count, as with random numbers. FLOAT32 or FLOAT64, held to a 255th; default 1. Below 1 the
     * material neither emits nor is hidden (PT_ERROR_INVALID_SCENE), and the sphere is in a tree, however few or far it
     * is: centers are held to 2^-30 of the extent of all that are in it, radii to 2^-16 of themselves. */
    pt_column opacity;
} pt_sphere_array;

/** The points x with dot(normal, x) + offset = 0. Visible, lit and emitting on both sides. */
typedef struct pt_plane {
    double normal[3];  /**< any length except 0; normal and offset are divided by it */
    double offset;     /**< minus the distance from the origin along the normal, times the normal's length */
    uint32_t material; /**< index into pt_scene.materials */
    uint32_t reserved; /**< 0 */
} pt_plane;

/** What is to be seen. pt_set_scene reads the caller's arrays and keeps none of them. Spheres are counted in the order
 * of spheres, followed by those of each element of sphere_arrays. */
typedef struct pt_scene {
    uint32_t struct_size;                 /**< sizeof(pt_scene) */
    uint32_t material_count;              /**< elements of materials */
    uint32_t sphere_count;                /**< elements of spheres; with those of sphere_arrays at most 2^26 */
    uint32_t plane_count;                 /**< elements of planes; with all spheres fewer than 2^30 */
    const pt_material *materials;         /**< NULL only if the count is 0, like all arrays here */
    const pt_sphere *spheres;             /**< in any order */
    const pt_plane *planes;               /**< in any order */
    const pt_sphere_array *sphere_arrays; /**< more spheres, for instance one element for each species; in any order */
    uint32_t sphere_array_count;          /**< elements of sphere_arrays, at most 65536 */
    uint32_t reserved;                    /**< 0 */
    /** NULL, or called during pt_set_scene, which takes some seconds for ten million spheres: every few milliseconds if
     * there are many spheres, and always with 1 before the scene is taken over. If it asks to stop, pt_set_scene
     * returns PT_CANCELLED, and everything is as before, including the scene and the samples. The share grows roughly
     * with time, but jumps if a tree's shape is kept (PT_FEATURE_TREE). */
    pt_progress_fn progress;
    void *progress_user; /**< handed to progress; the library does not look at it */
} pt_scene;

/** Values of pt_camera.projection. */
enum {
    PT_PROJECTION_PERSPECTIVE = 0, /**< a pinhole: all rays start at position; or a lens (pt_camera.aperture) */
    /** parallel rays along the viewing direction, which start on the plane through position perpendicular to it. What
     * lies behind this plane is not seen; of a ball that the plane cuts, the inside is. An object has the same size in
     * the image wherever it is. */
    PT_PROJECTION_ORTHOGRAPHIC = 1
};

/** Where the image is seen from. Its vertical axis is the part of up that is perpendicular to the viewing direction. */
typedef struct pt_camera {
    uint32_t struct_size; /**< sizeof(pt_camera) */
    uint32_t projection;  /**< PT_PROJECTION_* */
    double position[3];   /**< of the pinhole, or where the ray in the middle of the image starts; default the origin */
    double target[3];     /**< the point in the middle of the image; must differ from position */
    double up[3];         /**< not parallel to the viewing direction; default (0, 1, 0) */
    double vertical_fov;  /**< perspective: full vertical angle in [1e-8, pi); default pi / 4. Orthographic: 0 */
    double shutter_open;  /**< when the shutter opens, in the time of pt_sphere.motion: 0 <= open <= close <= 1 */
    double shutter_close; /**< light is gathered evenly from shutter_open to here; both 0: the instant 0 */
    /** Orthographic: full height of the view, in [1e-18, 1e18]. Its width, which is the height times width / height of
     * the image, must lie there too (otherwise pt_accumulate returns PT_ERROR_UNSUPPORTED). There is no default.
     * Perspective: 0. */
    double vertical_extent;
    /** Perspective: diameter of a thin lens about position, perpendicular to the viewing direction; 0: a pinhole.
     * Points in the plane at the depth focus are sharp; at the depth z, the lens spreads the rays of a pixel over a
     * disc of the diameter aperture * |z / focus - 1|. Other renderers ask for the lens radius, which is half of it; a
     * photographic lens has the diameter focal length / f-number. At most 2 * focus. Orthographic: 0. */
    double aperture;
    /** Perspective with an aperture: depth of the plane in focus, along the viewing direction; a length; default the
     * distance of target. Not used without an aperture. Orthographic: 0. */
    double focus;
} pt_camera;

/* ---- Rendering -------------------------------------------------------------------------------------------------- */

/** Values of pt_render.estimator: how light is found. All converge to the same image, with different noise and time.
 * Lamps are emitting spheres that can be sampled. A sphere around the camera, like a sky, and emitting planes are found
 * by directions, whatever the estimator. */
enum {
    PT_ESTIMATOR_BEST = 0,    /**< what this version considers best: mis */
    PT_ESTIMATOR_UNIFORM = 1, /**< directions uniform on the hemisphere; lamps are found by chance */
    PT_ESTIMATOR_COSINE = 2,  /**< directions in proportion to the cosine to the normal; lamps are found by chance */
    PT_ESTIMATOR_BSDF = 3,    /**< directions by the material, cosine and specular lobe; lamps are found by chance */
    PT_ESTIMATOR_LIGHT = 4,   /**< lamps sampled by solid angle; directions as bsdf, which count no such lamps */
    PT_ESTIMATOR_MIS = 5      /**< lamps sampled by solid angle and directions as bsdf, combined by weights */
};

/** Values of pt_render.sampler: where a sample's numbers come from. All converge to the same image, at different
 * rates. */
enum {
    PT_SAMPLER_BEST = 0,      /**< what this version considers best: sobol */
    PT_SAMPLER_RANDOM = 1,    /**< independent random numbers */
    PT_SAMPLER_HALTON = 2,    /**< radical inverses in prime bases, the same points in every pixel */
    PT_SAMPLER_HALTON_CP = 3, /**< the same, rotated by a random offset per pixel and dimension (Cranley, Patterson) */
    PT_SAMPLER_SOBOL = 4      /**< Sobol points, Owen-scrambled per pixel and dimension */
};

/** The default of pt_render.max_path_length. */
#define PT_DEFAULT_MAX_PATH_LENGTH 6u

/** The size of the image, and how it is made. */
typedef struct pt_render {
    uint32_t struct_size;     /**< sizeof(pt_render) */
    uint32_t width;           /**< pixels, >= 1; width * height <= 2^32 - 1 */
    uint32_t height;          /**< pixels, >= 1 */
    uint32_t max_path_length; /**< surface vertices after the camera, 1 = emission only; [1, 1024] */
    uint64_t seed;            /**< equal inputs, device, driver and seed give equal bits */
    uint32_t first_sample;    /**< index of the first sample: samples a..b of one sequence may be taken anywhere */
    uint32_t estimator;       /**< PT_ESTIMATOR_* */
    uint32_t sampler;         /**< PT_SAMPLER_* */
    uint32_t reserved;        /**< 0 */
    uint32_t first_row;       /**< only these rows are rendered, and read back as an image of their own: an image */
    uint32_t row_count;       /**< too large for a device is rendered in pieces, same bits. 0: all from first_row on */
} pt_render;

/** Values of pt_accumulate_info.sampling: where samples go. All converge to the same image. */
enum {
    PT_SAMPLING_BEST = 0,    /**< adaptive with a target error, else uniform */
    PT_SAMPLING_UNIFORM = 1, /**< to all pixels alike */
    /** where they reduce the error most; needs a target error. As long as tiles of 8 x 8 pixels are much alike, all
     * pixels get the same. After that, a tile's samples are doubled while the gain for the cost exceeds a bound, which
     * falls until the image has the target error. Whenever the bound falls, pixels with fewer than half of the mean
     * number of samples are brought up to that half. */
    PT_SAMPLING_ADAPTIVE = 2
};

/** How many samples pt_accumulate is to add. */
typedef struct pt_accumulate_info {
    uint32_t struct_size; /**< sizeof(pt_accumulate_info) */
    /** samples to add to every pixel, >= 1; indices must stay below 2^32. With a target_error, the most samples to add
     * to the pixels that have most; 0 then adds only to other pixels, which a stopped call may have left behind. */
    uint32_t sample_count;
    /** NULL, or called by pt_accumulate after every submission to a device. pt_start refuses it.
     *
     * The share does not grow with submissions that take no samples, such as those with which a device makes room for
     * the samples of another one. Before the first call the driver builds a kernel, which cannot be interrupted. Mesa's
     * lavapipe takes a tenth of a second for that, and two or three tenths more in the first submission that takes
     * samples, unless its cache has the kernel (pt_prepare does both).
     *
     * If it asks to stop, the call ends with the submissions that are under way then, at most two to each device; and
     * if one sample of all pixels takes several submissions, with those that complete it. */
    pt_progress_fn progress;
    void *progress_user; /**< handed to progress; the library does not look at it */
    /** 0: none. Otherwise no more samples are added once pt_error_estimate.relative_rmse_high is at or below it: the
     * call then returns PT_TARGET_REACHED, or PT_OK if sample_count runs out first. The error is checked only when all
     * pixels have as many samples as pt_next_check says or, where tiles differ (PT_SAMPLING_ADAPTIVE), when no tile
     * wants more at the present bound. So where a sequence ends, and with which samples in which pixels, does not
     * depend on how it is split over calls, devices, or films that are saved and added again. Finite, >= 0. */
    double target_error;
    uint32_t sampling; /**< PT_SAMPLING_*: where samples go */
    uint32_t reserved; /**< 0 */
    /** NULL: all pixels get the same, or as the target error decides. Otherwise how many samples each tile takes, from
     * 0 to sample_count: those from pt_render.first_sample on that the tile lacks. target_error must then be 0. Tiles
     * are squares of 8 x 8 pixels, row by row from the top left of what is rendered, smaller at the right and lower
     * edges. So machines can share what a film is to take next (pt_plan_film). Read only during the call. */
    const uint32_t *tile_samples;
    uint32_t tile_count; /**< elements of tile_samples: all tiles of what is rendered, or 0 */
    uint32_t reserved2;  /**< 0 */
} pt_accumulate_info;

/** Values of pt_image.quantity. */
enum {
    PT_QUANTITY_RADIANCE = 0, /**< mean of the samples */
    /** standard error of that mean, from the difference between the means of two parts of the samples; if the parts
     * have equal size, it is half of the difference's magnitude. The first part has the largest power of two below the
     * number of samples. One difference has one degree of freedom, so in a single pixel this is only a hint: a quarter
     * of all values are below a third of the true one. INFINITY if a part has no sample: up to 8 samples are all in the
     * first. */
    PT_QUANTITY_STANDARD_ERROR = 1,
    PT_QUANTITY_SAMPLE_COUNT = 2, /**< samples that the pixel has, rounded to float32, the same in all channels */
    /* The next four tell what camera rays meet first in the present scene, for compositing, denoising and picking. They
     * need no samples: a kernel of their own, built when one of them is first read, computes them at every read. A
     * camera with an aperture is a pinhole here: its rays go through the middle of the lens, so edges are sharp here
     * that the lens blurs in the radiance and in PT_QUANTITY_COVERAGE. */
    /** depth along the viewing direction, as in compositing programs: dot(x - camera.position, unit viewing direction)
     * for the point x that the ray through the pixel's centre meets halfway between shutter_open and shutter_close; the
     * same in all channels. For parallel rays that is the distance from where they start. INFINITY where the ray meets
     * nothing. The channel Z of OpenEXR. */
    PT_QUANTITY_DEPTH = 3,
    /** unit normal in world coordinates x, y, z, on the side of the camera: the mean over 16 rays that are spread
     * evenly over the pixel and the shutter's time, since denoisers want it filtered like radiance; at edges it is
     * shorter than 1. A ray that meets nothing counts as 0. */
    PT_QUANTITY_NORMAL = 4,
    /** diffuse + specular, each component at most 1: the mean over the same 16 rays. A ray that meets nothing counts as
     * 0. */
    PT_QUANTITY_ALBEDO = 5,
    /** index of the surface whose depth PT_QUANTITY_DEPTH tells: for a sphere as pt_scene counts them, for a plane the
     * number of all spheres + its index in planes; PT_NO_OBJECT where the ray meets nothing. For merged surfaces
     * (pt_sphere), the first. Its format is PT_FORMAT_R32UI. */
    PT_QUANTITY_OBJECT = 6,
    /** share of the pixel's samples whose camera rays meet a surface, the same in all channels. It is the alpha of the
     * mean radiance, which is already multiplied by it, since rays that meet nothing are black. It is counted at every
     * read, by a kernel that traces the camera rays of all these samples again, and takes as long as they did.
     */
    PT_QUANTITY_COVERAGE = 7
};

/** The value of PT_QUANTITY_OBJECT where a ray meets nothing. */
#define PT_NO_OBJECT 0xffffffffu

/** Values of pt_image.format: what a pixel is. Components follow each other in the machine's byte order; A is 1. */
enum {
    PT_FORMAT_RGB32F = 0,  /**< R, G, B as float32: 12 bytes */
    PT_FORMAT_RGBA32F = 1, /**< R, G, B, A as float32: 16 bytes */
    /** R, G, B, A as float16: 8 bytes. The float32 numbers rounded to nearest, ties to even; from 65520 on they are
     * infinity. */
    PT_FORMAT_RGBA16F = 2,
    PT_FORMAT_R32UI = 3 /**< one uint32_t: 4 bytes. For PT_QUANTITY_OBJECT only */
};

/** The caller's memory that receives an image, or a rectangle of it. A pixel's numbers do not depend on which other
 * pixels are read. */
typedef struct pt_image {
    uint32_t struct_size; /**< sizeof(pt_image) */
    uint32_t quantity;    /**< PT_QUANTITY_* */
    void *data;           /**< receives the pixels, row by row from the top; aligned to a component, 4 or 2 bytes */
    uint64_t size_bytes;  /**< of data; at least (height - 1) * row_bytes + width * bytes of a pixel */
    uint64_t row_bytes;   /**< distance between rows, whole components; default and least: width * bytes of a pixel */
    uint32_t x;           /**< first column that is read */
    uint32_t y;           /**< first row, counted from the first that is rendered (pt_render.first_row) */
    uint32_t width;       /**< columns, >= 1 and within the image; x, y, width and height all 0: the whole image */
    uint32_t height;      /**< rows, likewise */
    uint32_t format;      /**< PT_FORMAT_* */
    uint32_t reserved;    /**< 0 */
} pt_image;

/* ---- Context ---------------------------------------------------------------------------------------------------- */

/** Level of a log line. */
enum {
    PT_LOG_ERROR = 1,   /**< something is wrong */
    PT_LOG_WARNING = 2, /**< something may be wrong */
    PT_LOG_INFO = 3     /**< something to know: the devices, the kernels that drivers build and how long that takes */
};

/** Receives one UTF-8 line without its line break; line is valid during the call. level is a PT_LOG_*, user is
 * pt_create_info.log_user. */
typedef void (*pt_log_fn)(void *user, int32_t level, const char *line);

/** Gives back what pt_store_kernels_fn has stored under a key, perhaps in another process.
 *
 * Returns how many bytes there are, 0 for none, and writes them to data if they are no more than size_bytes. It is
 * called first with NULL and 0, to learn the number. Bytes that are damaged or belong to another driver or version are
 * not used: the kernels are then built anew, and no call fails. key is as for pt_store_kernels_fn, user is
 * pt_create_info.kernels_user. */
typedef uint64_t (*pt_load_kernels_fn)(void *user, const char *key, void *data, uint64_t size_bytes);

/** Stores kernels as a driver has compiled them under a key, in place of what was there.
 *
 * key has 32 hexadecimal digits, which stand for the device's model, its driver and the kernels' code; it can be the
 * name of a file. data is valid during the call: from some dozens of bytes to some megabytes, mostly the driver's own.
 * If it cannot be kept, that is no error. user is pt_create_info.kernels_user. */
typedef void (*pt_store_kernels_fn)(void *user, const char *key, const void *data, uint64_t size_bytes);

/** Bits of pt_create_info.flags. */
enum {
    PT_CREATE_VALIDATION = 1, /**< the Khronos validation layer reports to log; absent: PT_ERROR_UNSUPPORTED */
    /** No kernels with a scene's numbers as constants. On CPUs such a kernel is up to 1.5 times as fast. The first
     * scene of a context gets one, as does each that is rendered for some time, at first a second. Building it takes a
     * third of a second; pt_poll builds none. With this bit, nothing is built when the camera moves. */
    PT_CREATE_NO_SCENE_KERNELS = 2
};

/** What a context is to run on. Zeros are defaults, except for struct_size. */
typedef struct pt_create_info {
    uint32_t struct_size;         /**< sizeof(pt_create_info) */
    uint32_t flags;               /**< PT_CREATE_* */
    const char *device;           /**< NULL: the best one; else "gpu", "cpu", a part of a name, or as in pt/devices.h */
    pt_log_fn log;                /**< may be NULL; called by pt_create and any call on the context */
    void *log_user;               /**< handed to log; the library does not look at it */
    uint32_t submit_milliseconds; /**< aim for the length of one submission, [1, 1000]; default 50 */
    uint32_t reserved;            /**< 0 */
    /** NULL: the context makes an instance and devices of its own. Else it runs on this device alone, see pt/vulkan.h;
     * device must be NULL, and flags without PT_CREATE_VALIDATION. Read by pt_create alone. */
    const pt_vulkan *vulkan;
    /** NULL or empty: the kernels in the library. Else a folder of their GLSL files, see pt/shaders.h. */
    const char *shader_dir;
    /** Either may be NULL. With these the caller keeps what drivers have compiled, so that contexts of later processes
     * start sooner. load_kernels is called by pt_create, for each device; store_kernels at the end of calls that have
     * built kernels, even if they fail (pt_prepare, pt_accumulate, pt_reload_shaders, pt_readback of what camera rays
     * meet first; on GPUs any pt_readback, and pt_get_error_estimate). Drivers with a cache of their own, such as
     * Mesa's lavapipe, hand over almost nothing. */
    pt_load_kernels_fn load_kernels;
    pt_store_kernels_fn store_kernels; /**< see load_kernels */
    void *kernels_user;                /**< handed to both; the library does not look at it */
} pt_create_info;

/* -- any thread, no context -- */

/** Version of the library, like PT_VERSION. Any thread; never fails. */
PT_API uint32_t pt_version(void);

/** Name of a result as in this header ("PT_ERROR_NO_DEVICE"); "unknown result" for other numbers. A static string,
 * never NULL. Any thread; never fails. */
PT_API const char *pt_result_name(pt_result result);

/** Makes a context.
 *
 * info may be NULL: all defaults. On success the caller owns the context and frees it by pt_destroy; on failure
 * *context is NULL.
 *
 * Any thread, also while other contexts are in use. PT_ERROR_INVALID_ARGUMENT: info breaks a rule. PT_ERROR_NO_DEVICE:
 * there is no Vulkan, no such device, or none that fits. PT_ERROR_UNSUPPORTED: no validation layer, or a newer struct.
 * PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_DEVICE_LOST: the driver said so. PT_ERROR_SHADER: the driver refused a
 * kernel, or a file of shader_dir does not compile. */
PT_API pt_result pt_create(const pt_create_info *info, pt_context **context);

/** Message of the last call on this context that failed ("" if none did), valid until the next call on it.
 *
 * If this thread's last call on the context was refused because another call was under way, it is the message of that
 * refusal. While another thread is in a call on the context, it is a message that says so.
 *
 * With NULL: the message of this thread's last failed call without a context (pt_create, pt_get_devices, films), valid
 * until the next such call. UTF-8, never NULL, owned by the library. With a context, call it on the thread that uses
 * the context. Never fails. */
PT_API const char *pt_last_error(const pt_context *context);

/* -- one thread at a time per context -- */

/** Waits for the device and frees everything. NULL is allowed. Call it from one thread, after all other calls on the
 * context; never fails.
 *
 * In a callback of the context, or while another thread is in a call on it, nothing is freed: the context stays as it
 * is, to be destroyed later, and the log and pt_last_error say so. In a forked child nothing is freed either. */
PT_API void pt_destroy(pt_context *context);

/** Takes over a scene, and discards the samples accumulated so far.
 *
 * The three setters may be called in any order and again at any time. Each copies what it is given.
 *
 * Many spheres are put into a tree here, which takes most of the time. If a scene has as many spheres as the one
 * before, and they have only moved a little or changed their colors, the tree's shape is kept, and the call takes half
 * of the time. The bits of the image and of its films do not depend on that.
 *
 * One thread at a time per context. PT_CANCELLED: pt_scene.progress asked to stop. PT_ERROR_INVALID_SCENE: a rule is
 * broken; the message has a line for each broken rule, such as "spheres[3].radius = -1: must be > 0" or, for a column,
 * "sphere_arrays[0].radius[123] = -1: must be > 0"; after eight lines, further rules are only counted.
 * PT_ERROR_DEVICE_LOST. */
PT_API pt_result pt_set_scene(pt_context *context, const pt_scene *scene);

/** Takes over a camera, and discards the samples accumulated so far.
 *
 * One thread at a time per context. PT_ERROR_INVALID_ARGUMENT: a rule is broken. PT_ERROR_DEVICE_LOST. */
PT_API pt_result pt_set_camera(pt_context *context, const pt_camera *camera);

/** Takes over render settings, and discards the samples accumulated so far.
 *
 * The device's memory for the image is allocated here: 112 bytes a pixel. One thread at a time per context.
 * PT_ERROR_INVALID_ARGUMENT: a rule is broken. PT_ERROR_UNSUPPORTED: the device has no buffers of that size.
 * PT_ERROR_OUT_OF_DEVICE_MEMORY: it has too little memory left. In both cases, render fewer rows at a time.
 * PT_ERROR_DEVICE_LOST. */
PT_API pt_result pt_set_render(pt_context *context, const pt_render *render);

/** Builds the kernels that pt_accumulate needs for the present scene, camera and render settings, so that it does not
 * have to. On Mesa's lavapipe this takes a third of a second for a few spheres, on a GPU about as long if its driver
 * has not kept them.
 *
 * Without this call pt_accumulate builds what it needs. A context keeps the last eight kernels, so settings that come
 * back find theirs. Which kernel a scene needs depends on the kinds and numbers of things in it and on which sides of
 * them the camera is, but not on where they are. If that is faster, the scene gets its own kernel at once here (see
 * PT_CREATE_NO_SCENE_KERNELS). Samples stay as they are. Drivers cannot be interrupted, and so neither can this call.
 *
 * One thread at a time per context. PT_ERROR_INVALID_STATE: something is not set. PT_ERROR_UNSUPPORTED: the scene is
 * beyond the device. PT_ERROR_SHADER, PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_prepare(pt_context *context);

/** Adds samples to every pixel, or as info says, and returns when they are done.
 *
 * However the samples are split over calls, the sum has the same bits. Needs scene, camera and render settings. Samples
 * more than 2^20 times as bright as the brightest emission in the scene are left out and counted
 * (pt_stats.rejected_samples): estimators that do not sample the material's lobe to find lamps (uniform, cosine, light)
 * meet them on surfaces of glossiness beyond 1e5, for which they should not be used.
 *
 * One thread at a time per context. PT_CANCELLED and PT_TARGET_REACHED: fewer samples than asked for were taken, all of
 * them whole. PT_ERROR_INVALID_STATE: something is not set. PT_ERROR_INVALID_ARGUMENT: a rule is broken.
 * PT_ERROR_UNSUPPORTED: the scene is beyond the device. PT_ERROR_SHADER, PT_ERROR_OUT_OF_DEVICE_MEMORY,
 * PT_ERROR_DEVICE_LOST: the driver said so. After a failure the whole samples that were taken stay, and
 * pt_stats.sample_count says how many: none if several devices had begun samples that they could not complete. */
PT_API pt_result pt_accumulate(pt_context *context, const pt_accumulate_info *info);

/** Writes the mean radiance of the samples so far, its standard error, or another PT_QUANTITY_*, of all pixels or of a
 * rectangle.
 *
 * After a failure the contents of image->data are undefined. One thread at a time per context. PT_ERROR_INVALID_STATE:
 * there is no sample or, for what camera rays meet first, no scene, camera or render settings.
 * PT_ERROR_INVALID_ARGUMENT: the image breaks a rule. PT_ERROR_DEVICE_LOST; what camera rays meet first can also fail
 * as pt_prepare does. */
PT_API pt_result pt_readback(pt_context *context, const pt_image *image);

#ifdef __cplusplus
}
#endif

#endif
