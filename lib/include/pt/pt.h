/** @file
 * pt: an offscreen path tracer for spheres and planes on any Vulkan device.
 *
 * To render: pt_create, pt_set_scene (with pt_set_camera and pt_set_render), pt_accumulate, pt_readback. Other headers:
 * pt/async.h (samples in the background), pt/map.h (images without a copy), pt/stats.h (statistics, the image's error),
 * pt/errors.h (the last error as data), pt/devices.h (devices), pt/film.h (films that are saved and added), pt/vulkan.h
 * (the caller's own device), pt/denoise.h (denoised images), pt/compare.h (whether two images show the same light),
 * pt/shaders.h (changed kernels) and pt/accuracy.h (a device's accuracy).
 *
 * - World: right-handed, lengths in scene units, positions in double, angles in radians, time in [0, 1]. Color is
 *   linear RGB radiance, unclamped. Row 0 of an image is the top row.
 * - Numbers: all finite. Lengths are 0 or lie in [1e-18, 1e18], where their squares are float32 numbers too.
 * - Structs: one passed by pointer begins with struct_size = sizeof(the struct) as the caller compiled it and grows
 *   only at its tail; a zero field means "default". A shorter struct is read as if zeros followed; in a longer one the
 *   unknown tail must be zero (otherwise PT_ERROR_UNSUPPORTED). Elements of arrays have no struct_size and gain no
 *   fields, except pt_sphere_array. Reserved fields must be zero.
 * - Ownership: arguments are copied or no longer needed when a call returns, except callbacks, their user pointers and
 *   where a comment says so. Pointers may be NULL only where a comment says so.
 * - Results: a call that fails (result < 0) has changed nothing, except that a lost device stays lost (destroy the
 *   context and create another) and that pt_accumulate may have taken some of its samples. Every failure has a message,
 *   see pt_last_error. Any function can fail with PT_ERROR_OUT_OF_HOST_MEMORY and PT_ERROR_INTERNAL, and with
 *   PT_ERROR_INVALID_ARGUMENT where a pointer is NULL or a struct_size is absurd.
 * - Threads: different contexts are independent; one context is used by one thread at a time. While one thread is in a
 *   call on a context, calls of other threads on it are refused (PT_ERROR_INVALID_STATE), except pt_cancel
 *   (pt/async.h). The library starts no threads (drivers do), prints nothing, reads no files outside
 *   pt_create_info.shader_dir and has no globals. Calls need less than 256 KiB of stack on Mesa's lavapipe.
 * - Processes: after fork a child may make contexts of its own. Its calls on its parent's contexts are refused
 *   (PT_ERROR_INVALID_STATE), and pt_destroy leaves them alone: the driver's threads are not in the child.
 * - Callbacks: run inside the call, on the calling thread. They must not throw. Their calls on the same context are
 *   refused (PT_ERROR_INVALID_STATE), except pt_cancel.
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

/** major * 1000000 + minor * 1000 + patch. */
#define PT_VERSION 3000u

#ifdef __cplusplus
extern "C" {
#endif

/** The result of a call. < 0: error; 0: done; > 0: done with a remark. Numbers never change. */
typedef int32_t pt_result;
/** Values of pt_result. */
enum {
    PT_OK = 0,                          /**< done */
    PT_CANCELLED = 1,                   /**< the caller asked to stop; whole samples, or the earlier scene, are kept */
    PT_TARGET_REACHED = 2,              /**< the target error was reached before all samples were taken */
    PT_PENDING = 3,                     /**< samples are under way, see pt/async.h */
    PT_ERROR_INVALID_ARGUMENT = -1,     /**< a field, size or pointer breaks a rule of this header */
    PT_ERROR_INVALID_SCENE = -2,        /**< a scene breaks a rule; the message names field, value and rule */
    PT_ERROR_INVALID_STATE = -3,        /**< something must be set or end first, or another call is under way */
    PT_ERROR_UNSUPPORTED = -4,          /**< valid, but beyond this device, driver or library */
    PT_ERROR_NO_DEVICE = -5,            /**< no Vulkan driver, or no device fits; the message has the reasons */
    PT_ERROR_OUT_OF_HOST_MEMORY = -6,   /**< the machine has too little memory left */
    PT_ERROR_OUT_OF_DEVICE_MEMORY = -7, /**< the device has too little memory left, for this image for instance */
    PT_ERROR_DEVICE_LOST = -8,          /**< the device or its driver gave up; the context can only be destroyed */
    PT_ERROR_SHADER = -9,               /**< the driver refused to build the kernel, or its GLSL does not compile */
    PT_ERROR_INTERNAL = -10,            /**< a bug in this library or in the driver */
    PT_ERROR_INCOMPATIBLE = -11         /**< bytes that are no film of this picture (pt/film.h) */
};

/** A renderer on one or several devices. Made by pt_create and owned by its caller until pt_destroy. */
typedef struct pt_context pt_context;

/** The caller's own Vulkan; defined in pt/vulkan.h. */
typedef struct pt_vulkan pt_vulkan;

/** Called during a long call with the share that is done, in [0, 1], never falling.
 *
 * Return 0 to go on. Anything else asks the call to stop, which then returns PT_CANCELLED. pt_scene and
 * pt_accumulate_info state how often it is called and what is kept. user is the progress_user given beside the
 * function. */
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
    /** Camera rays pass through surfaces of the material; all other rays meet them. So a lamp out of the picture lights
     * it, or the camera looks through a wall into a room. Hidden spheres are tested one by one, even if others are in a
     * tree (PT_FEATURE_TREE), so they should be few. The first of merged surfaces (pt_sphere) decides. */
    PT_MATERIAL_HIDDEN_FROM_CAMERA = 1
};

/** A ball. Visible, lit and emitting on both sides. The center at time t is center + t * motion.
 *
 * Spheres too close for float32 to separate, seen from the camera, are merged; the first one in the scene wins. So are
 * planes. Spheres are merged if their radii differ by less than 2^-18 of the radius, and their centers by less than
 * 2^-18 of the radius plus 2^-21 of the distance, but never by a quarter of the radius or more.
 *
 * Spheres in a tree (PT_FEATURE_TREE) are merged only if the tree holds equal numbers for them. The largest of
 * concentric ones is seen. A camera nearer to such a sphere's surface than 2^-22 of its radius plus 2^-28 of the extent
 * of the spheres in the tree may see the surface's other side. */
typedef struct pt_sphere {
    double center[3]; /**< at time 0 */
    double radius;    /**< > 0 */
    /** Displacement from time 0 to time 1. A sphere whose surface is nearer to the camera than 1/65536 of its radius
     * when the shutter opens must move by less than 1/32 of its radius while it is open (otherwise pt_accumulate
     * returns PT_ERROR_UNSUPPORTED). With an orthographic projection the first visible surface's distance counts, and
     * only if the view's half diagonal is below 1/65536 of the radius, too. */
    double motion[3];
    uint32_t material; /**< index into pt_scene.materials */
    uint32_t reserved; /**< 0 */
} pt_sphere;

/** Values of pt_column.type: what a component is. */
enum {
    PT_TYPE_FLOAT32 = 1, /**< float */
    PT_TYPE_FLOAT64 = 2, /**< double */
    PT_TYPE_UINT32 = 3,  /**< uint32_t */
    /** uint8_t, for colors only: 255 times the sRGB encoding (IEC 61966-2-1) of a linear value in [0, 1]. */
    PT_TYPE_SRGB8 = 4
};

/** One property of many spheres in the caller's memory. Sphere i's value is at data + i * stride_bytes, its components
 * side by side, without alignment. All zero: the property has its default. */
typedef struct pt_column {
    const void *data;      /**< NULL only if there is no column */
    uint32_t stride_bytes; /**< < 2^31; at least the size of one value, or 0: one value for all spheres */
    uint32_t type;         /**< PT_TYPE_* */
} pt_column;

/** Spheres by columns. Each value obeys the rules of the same field of pt_sphere. */
typedef struct pt_sphere_array {
    uint32_t struct_size; /**< sizeof(pt_sphere_array), equal in all elements: also the distance between them */
    uint32_t count;       /**< number of spheres; if 0, the columns are ignored */
    pt_column center;     /**< x, y, z at time 0; FLOAT32 or FLOAT64; required */
    pt_column radius;     /**< FLOAT32 or FLOAT64; required */
    pt_column motion;     /**< x, y, z; FLOAT32 or FLOAT64; default (0, 0, 0) */
    pt_column material;   /**< index into pt_scene.materials; UINT32; default 0 */
    /** R, G, B in [0, 1], factors of the material's diffuse, so that spheres of one material have their own colors;
     * FLOAT32 or FLOAT64, linear, or SRGB8; default (1, 1, 1). Held to a thousandth in a tree (PT_FEATURE_TREE). */
    pt_column color;
    /** x, y, z of a second center; FLOAT32 or FLOAT64; default none. It makes each a capsule: all points no farther
     * than the radius from the segment between center and end. Capsules neither emit nor move (PT_ERROR_INVALID_SCENE);
     * their surface is off by 2^-21 of their length and radius where these exceed the distance. Capsules are spheres in
     * all other respects. */
    pt_column end;
    /** Share of rays in [0, 1] that meet the sphere; the others pass it. The choice is random for each camera, path and
     * shadow ray and each sphere, so the product of the spheres' 1 - opacity passes. All samplers but PT_SAMPLER_RANDOM
     * spread a sphere's choices evenly over 16 samples, so a single sphere adds less noise than several, which decide
     * independently. The error falls as 1 / sqrt(samples). FLOAT32 or FLOAT64, held to a 255th; default 1.
     * Below 1 the material neither emits nor is hidden (PT_ERROR_INVALID_SCENE), and the sphere is in a tree: centers
     * are held to 2^-30 of the extent of all spheres in it, radii to a relative 2^-16. */
    pt_column opacity;
} pt_sphere_array;

/** The points x with dot(normal, x) + offset = 0. Visible, lit and emitting on both sides. */
typedef struct pt_plane {
    double normal[3];  /**< any length except 0; normal and offset are divided by it */
    double offset;     /**< minus the distance from the origin along the normal, times the normal's length */
    uint32_t material; /**< index into pt_scene.materials */
    uint32_t reserved; /**< 0 */
} pt_plane;

/** A scene. pt_set_scene reads the caller's arrays and keeps none of them. Spheres are numbered in the order of
 * spheres, then of sphere_arrays. */
typedef struct pt_scene {
    uint32_t struct_size;                 /**< sizeof(pt_scene) */
    uint32_t material_count;              /**< elements of materials */
    uint32_t sphere_count;                /**< elements of spheres; with all sphere_arrays at most 2^26 */
    uint32_t plane_count;                 /**< elements of planes; with all spheres fewer than 2^30 */
    const pt_material *materials;         /**< NULL only if the count is 0, like all arrays here */
    const pt_sphere *spheres;             /**< in any order */
    const pt_plane *planes;               /**< in any order */
    const pt_sphere_array *sphere_arrays; /**< more spheres, for instance one element per species */
    uint32_t sphere_array_count;          /**< elements of sphere_arrays, at most 65536 */
    uint32_t reserved;                    /**< 0 */
    /** NULL, or called during pt_set_scene, which takes some seconds for ten million spheres: every few milliseconds if
     * there are many, and always with 1 before the scene is taken over. If it asks to stop, pt_set_scene returns
     * PT_CANCELLED and has changed nothing. The share jumps if a tree's shape is kept (PT_FEATURE_TREE). */
    pt_progress_fn progress;
    void *progress_user; /**< handed to progress; the library does not look at it */
} pt_scene;

/** Values of pt_camera.projection. */
enum {
    PT_PROJECTION_PERSPECTIVE = 0, /**< a pinhole: all rays start at position; or a lens (pt_camera.aperture) */
    /** parallel rays along the viewing direction, which start on the plane through position perpendicular to it.
     * Surfaces behind this plane are not seen; a ball that it cuts shows its inside. An object's size does not depend
     * on its distance. */
    PT_PROJECTION_ORTHOGRAPHIC = 1
};

/** The camera. The image's vertical axis is the part of up perpendicular to the viewing direction. */
typedef struct pt_camera {
    uint32_t struct_size; /**< sizeof(pt_camera) */
    uint32_t projection;  /**< PT_PROJECTION_* */
    double position[3];   /**< the pinhole, or where the image's middle ray starts; default the origin */
    double target[3];     /**< seen in the middle of the image; must differ from position */
    double up[3];         /**< not parallel to the viewing direction; default (0, 1, 0) */
    double vertical_fov;  /**< perspective: full vertical angle in [1e-8, pi); default pi / 4. Orthographic: 0 */
    double shutter_open;  /**< when the shutter opens, in the time of pt_sphere.motion: 0 <= open <= close <= 1 */
    double shutter_close; /**< light is gathered evenly from shutter_open on; both 0: the instant 0 */
    /** Orthographic: full height of the view. Height and width (height times the image's width / height) lie in
     * [1e-18, 1e18] (a width outside: PT_ERROR_UNSUPPORTED of pt_accumulate). No default. Perspective: 0. */
    double vertical_extent;
    /** Perspective: diameter of a thin lens about position, perpendicular to the viewing direction; 0: a pinhole.
     * Points at the depth focus are sharp; a pixel's rays spread at depth z over a disc of the diameter
     * aperture * |z / focus - 1|. A photographic lens has the diameter focal length / f-number. At most 2 * focus.
     * Orthographic: 0. */
    double aperture;
    /** Perspective with an aperture: depth of the plane in focus, along the viewing direction; default the distance
     * of target. Ignored without an aperture. Orthographic: 0. */
    double focus;
} pt_camera;

/* ---- Rendering -------------------------------------------------------------------------------------------------- */

/** Values of pt_render.estimator: how light is found. All converge to the same image, with different noise and time.
 * Lamps are emitting spheres that can be sampled; only directions find a sky (an emitting sphere around the camera) and
 * emitting planes. */
enum {
    PT_ESTIMATOR_BEST = 0,    /**< what this version considers best: mis */
    PT_ESTIMATOR_UNIFORM = 1, /**< directions uniform on the hemisphere; lamps are found by chance */
    PT_ESTIMATOR_COSINE = 2,  /**< directions in proportion to the cosine to the normal; lamps are found by chance */
    PT_ESTIMATOR_BSDF = 3,    /**< directions by the material, cosine and specular lobe; lamps are found by chance */
    PT_ESTIMATOR_LIGHT = 4,   /**< lamps sampled by solid angle; directions as bsdf, which do not count these lamps */
    PT_ESTIMATOR_MIS = 5      /**< lamps sampled by solid angle and directions as bsdf, combined by weights */
};

/** Values of pt_render.sampler: the source of a sample's numbers. All converge to the same image, at different rates.
 */
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
    uint64_t seed;            /**< equal inputs, devices, drivers and seeds give equal bits */
    uint32_t first_sample;    /**< index of the first sample: parts of one sequence may be taken anywhere */
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
    /** where they reduce the error most; needs a target error. While tiles of 8 x 8 pixels are much alike, all pixels
     * get the same. Then a tile's samples are doubled while the gain for the cost exceeds a bound, which falls until
     * the image has the target error. Whenever it falls, pixels with fewer than half of the mean number of samples get
     * that half. */
    PT_SAMPLING_ADAPTIVE = 2
};

/** How many samples pt_accumulate is to add. */
typedef struct pt_accumulate_info {
    uint32_t struct_size; /**< sizeof(pt_accumulate_info) */
    /** samples to add to every pixel, >= 1; indices stay below 2^32. If there is a target_error: the most samples to
     * add to the pixels that have most; 0 then adds only to other pixels, which a stopped call may have left behind. */
    uint32_t sample_count;
    /** NULL, or called by pt_accumulate after every submission to a device. pt_start refuses it.
     *
     * The share does not grow with submissions that take no samples. Before the first call the driver builds a kernel,
     * which cannot be interrupted: on Mesa's lavapipe some tenths of a second, unless its cache has the kernel
     * (pt_prepare builds it ahead).
     *
     * If it asks to stop, the call ends with the submissions under way, at most two per device, and with those that
     * complete a sample of all pixels. */
    pt_progress_fn progress;
    void *progress_user; /**< handed to progress; the library does not look at it */
    /** 0: none. Otherwise no more samples are added once pt_error_estimate.relative_rmse_high is at or below it and
     * pixels with lamps smaller than a pixel have enough samples to meet them: the call then returns PT_TARGET_REACHED.
     * It returns PT_OK if sample_count runs out first, or the pixels that need more have sample_limit samples. The
     * error is checked only when all pixels have as many samples as pt_next_check says or, where tiles differ
     * (PT_SAMPLING_ADAPTIVE), when no tile wants more at the present bound. So the samples of each pixel at the end do
     * not depend on the split over calls with the same sample_limit, devices, or films that are saved and added again.
     * Finite, >= 0. */
    double target_error;
    uint32_t sampling; /**< PT_SAMPLING_*: where samples go */
    /** Used if there is a target_error: the most samples of a pixel after this call and later ones. While pixels that
     * need more have that many, the others take more, until all have them. 0, or a number that this call may pass: the
     * number that it may reach. */
    uint32_t sample_limit;
    /** NULL: all pixels get the same, or as the target error decides. Otherwise each tile takes this many samples, from
     * 0 to sample_count: the first ones from pt_render.first_sample on that it lacks. target_error must be 0. Tiles are
     * squares of 8 x 8 pixels, row by row from the top left of the rendered rows, smaller at the right and lower edges.
     * So machines can share a film's next samples (pt_plan_film). Read only during the call. */
    const uint32_t *tile_samples;
    uint32_t tile_count; /**< elements of tile_samples: all tiles, or 0 */
    uint32_t reserved2;  /**< 0 */
} pt_accumulate_info;

/** Values of pt_image.quantity. */
enum {
    PT_QUANTITY_RADIANCE = 0, /**< mean of the samples */
    /** standard error of that mean, from the difference between the means of two parts of the samples: half of it if
     * the parts are equal. The first part has the largest power of two below the number of samples. A single pixel's
     * value is only a hint: it has one degree of freedom, and a quarter of all values are below a third of the true
     * one. INFINITY if a part has no sample: up to 8 samples are all in the first. */
    PT_QUANTITY_STANDARD_ERROR = 1,
    PT_QUANTITY_SAMPLE_COUNT = 2, /**< the pixel's samples, rounded to float32, the same in all channels */
    /* The next four describe the first hit of camera rays in the present scene. They need no samples: a kernel of
     * their own, built on first use, computes them at every read. A camera with an aperture is a pinhole here, so edges
     * are sharp that the lens blurs in the radiance and in PT_QUANTITY_COVERAGE. */
    /** depth along the viewing direction: dot(x - camera.position, unit viewing direction) for the point x that the ray
     * through the pixel's center meets halfway between shutter_open and shutter_close; the same in all channels. For
     * parallel rays, the distance from their start. INFINITY where the ray meets nothing. The channel Z of OpenEXR. */
    PT_QUANTITY_DEPTH = 3,
    /** unit normal in world coordinates, on the side of the camera: the mean over 16 rays spread evenly over pixel and
     * shutter time; shorter than 1 at edges. A ray that meets nothing counts as 0. */
    PT_QUANTITY_NORMAL = 4,
    /** diffuse + specular, each component at most 1: the mean over the same 16 rays. A ray that meets nothing counts as
     * 0. */
    PT_QUANTITY_ALBEDO = 5,
    /** index of the surface of PT_QUANTITY_DEPTH: spheres as numbered in pt_scene, then planes; PT_NO_OBJECT where
     * the ray meets nothing. The first one of merged surfaces (pt_sphere). Its format is PT_FORMAT_R32UI. */
    PT_QUANTITY_OBJECT = 6,
    /** share of the pixel's samples whose camera rays meet a surface, the same in all channels: the alpha of the mean
     * radiance, which is already multiplied by it. Every read traces these camera rays again. */
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

/** The caller's memory for an image, or a rectangle of it. A pixel's numbers do not depend on which others are read. */
typedef struct pt_image {
    uint32_t struct_size; /**< sizeof(pt_image) */
    uint32_t quantity;    /**< PT_QUANTITY_* */
    void *data;           /**< receives pixels row by row from the top; aligned to a component, 4 or 2 bytes */
    uint64_t size_bytes;  /**< at least (height - 1) * row_bytes + width * bytes of a pixel */
    uint64_t row_bytes;   /**< distance between rows, whole components; default and least: width * bytes of a pixel */
    uint32_t x;           /**< first column that is read */
    uint32_t y;           /**< first row, counted from pt_render.first_row */
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
    PT_LOG_INFO = 3     /**< devices, the kernels that drivers build, and how long that takes */
};

/** Receives one UTF-8 line without its line break; line is valid during the call. level is a PT_LOG_*, user is
 * pt_create_info.log_user. */
typedef void (*pt_log_fn)(void *user, int32_t level, const char *line);

/** Hands out bytes that pt_store_kernels_fn has stored under a key, perhaps in another process.
 *
 * Returns their number, 0 for none, and writes them to data if they are no more than size_bytes. Called first with NULL
 * and 0. Bytes that are damaged or of another driver or version are ignored: kernels are then built again. key is as
 * for pt_store_kernels_fn, user is pt_create_info.kernels_user. */
typedef uint64_t (*pt_load_kernels_fn)(void *user, const char *key, void *data, uint64_t size_bytes);

/** Stores a driver's compiled kernels under a key, in place of earlier ones.
 *
 * key has 32 hexadecimal digits, which stand for the device's model, its driver and the kernels' code; it can be a
 * file's name. data, dozens of bytes to some megabytes, is valid during the call. Failing to keep it is no error.
 * user is pt_create_info.kernels_user. */
typedef void (*pt_store_kernels_fn)(void *user, const char *key, const void *data, uint64_t size_bytes);

/** Bits of pt_create_info.flags. */
enum {
    PT_CREATE_VALIDATION = 1, /**< the Khronos validation layer reports to log; absent: PT_ERROR_UNSUPPORTED */
    /** No kernels with a scene's numbers as constants, so nothing is built when the camera moves. On CPUs such kernels
     * are up to 1.5 times as fast. The first scene of a context gets one, as does each that is rendered for some time,
     * at first a second. Building takes a third of a second; pt_poll builds none. */
    PT_CREATE_NO_SCENE_KERNELS = 2
};

/** How to make a context. Zeros are defaults, except for struct_size. */
typedef struct pt_create_info {
    uint32_t struct_size;         /**< sizeof(pt_create_info) */
    uint32_t flags;               /**< PT_CREATE_* */
    const char *device;           /**< NULL: the best; else "gpu", "cpu", a part of a name, or as in pt/devices.h */
    pt_log_fn log;                /**< may be NULL; called by pt_create and any call on the context */
    void *log_user;               /**< handed to log; the library does not look at it */
    uint32_t submit_milliseconds; /**< aim for the duration of a submission, [1, 1000]; default 50 */
    uint32_t reserved;            /**< 0 */
    /** NULL: the context makes an instance and devices of its own. Otherwise it runs on this device alone, see
     * pt/vulkan.h; device must be NULL, and PT_CREATE_VALIDATION not set. Read by pt_create alone. */
    const pt_vulkan *vulkan;
    /** NULL or empty: the library's kernels. Else a folder of their GLSL files, see pt/shaders.h. */
    const char *shader_dir;
    /** Either may be NULL. They let the caller keep compiled kernels, so that contexts of later processes start sooner.
     * load_kernels is called by pt_create, for each device; store_kernels at the end of calls that have built kernels,
     * even if they fail (pt_prepare, pt_accumulate, pt_reload_shaders, pt_readback of first hits; on GPUs any
     * pt_readback, and pt_get_error_estimate). Drivers with a cache of their own hand over almost nothing. */
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
 * there is no Vulkan, or no device that fits. PT_ERROR_UNSUPPORTED: no validation layer, or a newer struct.
 * PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_DEVICE_LOST: the driver said so. PT_ERROR_SHADER: the driver refused a
 * kernel, or a file of shader_dir does not compile. */
PT_API pt_result pt_create(const pt_create_info *info, pt_context **context);

/** Message of the last failed call on this context ("" if none), valid until the next call on it. Call it on the thread
 * that uses the context.
 *
 * If this thread's last call was refused because another call was under way, the message of that refusal. While another
 * thread is in a call, a message that states this.
 *
 * If context is NULL: the message of this thread's last failed call without a context (pt_create, pt_get_devices,
 * films), valid until the next such call. UTF-8, never NULL, owned by the library. Never fails. */
PT_API const char *pt_last_error(const pt_context *context);

/* -- one thread at a time per context -- */

/** Waits for the device and frees everything. NULL is allowed. Call it from one thread, after all other calls on the
 * context; never fails.
 *
 * Frees nothing in a forked child, in a callback of the context, or while another thread is in a call on it. After the
 * last two the context can still be destroyed later, and the log and pt_last_error say so. */
PT_API void pt_destroy(pt_context *context);

/** Takes over a scene, and discards the samples.
 *
 * The three setters may be called in any order and again at any time. Each copies its argument.
 *
 * Building a tree over many spheres takes most of the time. If as many spheres as before have only moved a little or
 * changed their colors, the tree's shape is kept, which halves the time and changes no bits of the image or of films.
 *
 * One thread at a time per context. PT_CANCELLED: pt_scene.progress asked to stop. PT_ERROR_INVALID_SCENE: the message
 * has a line for each broken rule, such as "spheres[3].radius = -1: must be > 0" or, for a column,
 * "sphere_arrays[0].radius[123] = -1: must be > 0"; after eight lines, further rules are only counted.
 * PT_ERROR_DEVICE_LOST. */
PT_API pt_result pt_set_scene(pt_context *context, const pt_scene *scene);

/** Takes over a camera, and discards the samples.
 *
 * One thread at a time per context. PT_ERROR_INVALID_ARGUMENT: a rule is broken. PT_ERROR_DEVICE_LOST. */
PT_API pt_result pt_set_camera(pt_context *context, const pt_camera *camera);

/** Takes over render settings, and discards the samples.
 *
 * Allocates the device's memory for the image, 112 bytes a pixel. One thread at a time per context.
 * PT_ERROR_INVALID_ARGUMENT: a rule is broken. PT_ERROR_UNSUPPORTED: the device has no buffers of that size.
 * PT_ERROR_OUT_OF_DEVICE_MEMORY: it has too little memory left. In both cases, render fewer rows at a time.
 * PT_ERROR_DEVICE_LOST. */
PT_API pt_result pt_set_render(pt_context *context, const pt_render *render);

/** Builds the kernels for the present scene, camera and render settings ahead of pt_accumulate. This takes a third of a
 * second on Mesa's lavapipe for a few spheres, and about as long on a GPU whose driver has not kept them.
 *
 * A context keeps the last eight kernels. A kernel depends on the kinds and numbers of things in the scene and on the
 * camera's side of them, not on their places. If that is faster, the scene also gets a kernel of its own (see
 * PT_CREATE_NO_SCENE_KERNELS). Samples stay as they are. The call cannot be interrupted, as drivers cannot.
 *
 * One thread at a time per context. PT_ERROR_INVALID_STATE: something is not set. PT_ERROR_UNSUPPORTED: the scene is
 * beyond the device. PT_ERROR_SHADER, PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_prepare(pt_context *context);

/** Adds samples to every pixel, or as info says, and returns when they are done.
 *
 * The sum's bits do not depend on how samples are split over calls. Needs scene, camera and render settings. Samples
 * more than 2^20 times as bright as the brightest emission are left out and counted (pt_stats.rejected_samples).
 * Estimators that do not sample the material's lobe to find lamps (uniform, cosine, light) meet such samples on
 * surfaces of glossiness beyond 1e5, and should not be used for these.
 *
 * One thread at a time per context. PT_CANCELLED and PT_TARGET_REACHED: fewer samples were taken, all of them whole.
 * PT_ERROR_INVALID_STATE: something is not set. PT_ERROR_INVALID_ARGUMENT: a rule is broken. PT_ERROR_UNSUPPORTED: the
 * scene is beyond the device. PT_ERROR_SHADER, PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_DEVICE_LOST: the driver said so.
 * After a failure whole samples stay, and pt_stats.sample_count is their number: none if several devices had begun
 * samples that they could not complete. */
PT_API pt_result pt_accumulate(pt_context *context, const pt_accumulate_info *info);

/** Writes the mean radiance of the samples so far, its standard error, or another PT_QUANTITY_*, of all pixels or a
 * rectangle.
 *
 * After a failure the contents of image->data are undefined. One thread at a time per context. PT_ERROR_INVALID_STATE:
 * there is no sample or, for first hits, no scene, camera or render settings. PT_ERROR_INVALID_ARGUMENT: the image
 * breaks a rule. PT_ERROR_DEVICE_LOST. First hits and coverage can also fail as pt_prepare does. */
PT_API pt_result pt_readback(pt_context *context, const pt_image *image);

#ifdef __cplusplus
}
#endif

#endif
