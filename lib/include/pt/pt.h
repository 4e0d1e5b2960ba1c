/** @file
 * pt: an offscreen path tracer for spheres and planes on any Vulkan device.
 *
 * A program calls pt_create, pt_set_scene, pt_set_camera, pt_set_render, pt_accumulate and pt_readback. All headers
 * share these conventions:
 * - World: The coordinate system is right-handed. Lengths are in scene units, positions in double, angles in radians,
 *   times in [0, 1]. Colors are linear RGB radiance, unclamped. Row 0 of an image is the top row.
 * - Numbers: All numbers must be finite. A length is 0 or lies in [1e-18, 1e18], so that float32 can hold its square.
 * - Structs: A struct passed by pointer begins with struct_size, which the caller sets to sizeof(the struct). Later
 *   versions may add fields at its end. A zero field means "default". A shorter struct is read as if zeros followed. If
 *   a longer struct has nonzero bytes after the fields known to the library, the call returns PT_ERROR_UNSUPPORTED. A
 *   call that fills a struct writes at most struct_size bytes. Elements of arrays have no struct_size and gain no
 *   fields, except pt_sphere_array. Reserved fields must be 0.
 * - Lists: A call that lists elements writes at most *count of them to an array. *count then receives the number
 *   written or, if the array is NULL, the number of elements.
 * - Ownership: When a call returns, it no longer needs its arguments, except callbacks, their user pointers and
 *   arguments whose comments say so. A pointer may be NULL only if its comment says so.
 * - Results: A negative result is an error. Every error has a message, see pt_last_error. A failed call changes
 *   nothing, with two exceptions: pt_accumulate may have added some of its samples, and after PT_ERROR_DEVICE_LOST the
 *   context can only be destroyed.
 * - Errors: Any function can return PT_ERROR_OUT_OF_HOST_MEMORY and PT_ERROR_INTERNAL. An argument that breaks a rule
 *   of the headers gives PT_ERROR_INVALID_ARGUMENT. A driver's failure gives PT_ERROR_SHADER,
 *   PT_ERROR_OUT_OF_DEVICE_MEMORY or PT_ERROR_DEVICE_LOST. A call that needs a scene, camera or render settings returns
 *   PT_ERROR_INVALID_STATE if they are missing. Comments of functions list only further errors and causes.
 * - Threads: Different contexts are independent. Only one thread at a time may use a context or a film. While one
 *   thread is in a call, calls of other threads on the same context return PT_ERROR_INVALID_STATE, except pt_cancel
 *   (pt/async.h). The library starts no threads (drivers do), prints nothing and has no globals. The library reads no
 *   files outside pt_create_info.shader_dir. On Mesa's lavapipe, calls need less than 256 KiB of stack.
 * - Processes: A forked child may create its own contexts. Its calls on the parent's contexts return
 *   PT_ERROR_INVALID_STATE, and its pt_destroy does not touch them, because the child lacks the driver's threads.
 * - Callbacks: A callback runs inside the call, on the calling thread, and must not throw. The calls that it makes on
 *   the same context return PT_ERROR_INVALID_STATE, except pt_cancel.
 * - Floating point: Calls and their callbacks round to nearest. A call restores the caller's rounding mode when it
 *   returns. Floating-point exceptions must not be trapped.
 */
#ifndef PT_H
#define PT_H

#include <stdint.h>

#ifndef PT_API
/** Attributes of every function. Only a build of the library defines them. */
#define PT_API
#endif

/** major * 1000000 + minor * 1000 + patch. */
#define PT_VERSION 4000u

#ifdef __cplusplus
extern "C" {
#endif

/** The result of a call: < 0 for an error, 0 for success, > 0 for success with a remark. The numbers never change. */
typedef int32_t pt_result;
/** Values of pt_result. */
enum {
    PT_OK = 0,                          /**< done */
    PT_CANCELLED = 1,                   /**< the caller stopped the call */
    PT_TARGET_REACHED = 2,              /**< the target error is reached; not all samples were taken */
    PT_PENDING = 3,                     /**< samples are still being taken (pt/async.h) */
    PT_LIMIT_REACHED = 4,               /**< the time limit is reached; not all samples were taken */
    PT_ERROR_INVALID_ARGUMENT = -1,     /**< a field, size or pointer breaks a rule of this header */
    PT_ERROR_INVALID_SCENE = -2,        /**< a scene breaks a rule; the message names field, value and rule */
    PT_ERROR_INVALID_STATE = -3,        /**< another call must come first or must end first */
    PT_ERROR_UNSUPPORTED = -4,          /**< this device, driver or library cannot do it */
    PT_ERROR_NO_DEVICE = -5,            /**< no Vulkan driver or no suitable device; the message has the reasons */
    PT_ERROR_OUT_OF_HOST_MEMORY = -6,   /**< the machine has too little free memory */
    PT_ERROR_OUT_OF_DEVICE_MEMORY = -7, /**< the device has too little free memory */
    PT_ERROR_DEVICE_LOST = -8,          /**< the device stopped working; the context can only be destroyed */
    PT_ERROR_SHADER = -9,               /**< the driver refused to build the kernel, or its GLSL does not compile */
    PT_ERROR_INTERNAL = -10,            /**< a bug in this library or in the driver */
    PT_ERROR_INCOMPATIBLE = -11,        /**< the bytes are not a film of this picture (pt/film.h) */
    PT_ERROR_FILE = -12                 /**< a file cannot be read (pt/scene_file.h) */
};

/** A renderer on one or several devices. The caller owns it from pt_create to pt_destroy. */
typedef struct pt_context pt_context;

/** The caller's own Vulkan (pt/vulkan.h). */
typedef struct pt_vulkan pt_vulkan;

/** Reports the finished fraction of a long call, in [0, 1], which never decreases. Return 0 to go on. Any other value
 * asks the call to stop and return PT_CANCELLED. */
typedef int32_t (*pt_progress_fn)(void *user, double fraction);

/* ---- Scene ------------------------------------------------------------------------------------------------------ */

/** How a surface reflects and emits light.
 *
 * Reflection is the physically normalised Phong model
 *
 *     f(wi, wo) = diffuse / pi + specular * (n + 2) / (2 pi) * max(0, dot(wo, reflect(wi)))^n,   n = glossiness.
 *
 * Color components lie in [0, 1e18]. If diffuse + specular exceeds 1, the surface may reflect more light than it
 * receives. */
typedef struct pt_material {
    float diffuse[3];  /**< fraction of light reflected diffusely */
    float specular[3]; /**< weight of the lobe about the mirror direction */
    float emission[3]; /**< radiance, the same in every direction and on both sides */
    float glossiness;  /**< n in [0, 1e9] */
    uint32_t flags;    /**< PT_MATERIAL_* */
} pt_material;

/** Bits of pt_material.flags. */
enum {
    /** camera rays pass through surfaces of this material. All other rays hit them. Hidden spheres should be few,
     * because they are outside the tree (PT_FEATURE_TREE) and every ray tests each of them. */
    PT_MATERIAL_HIDDEN_FROM_CAMERA = 1
};

/** A ball. Its surface is visible, lit and emitting on both sides. The center at time t is center + t * motion.
 *
 * Spheres that float32 cannot separate, as seen from the camera, are merged into the first one in the scene. Planes are
 * merged by the same rule. Two spheres are merged if
 * - their radii differ by less than 2^-18 * radius, and
 * - their centers differ by less than 2^-18 * radius + 2^-21 * distance, and by less than radius / 4.
 *
 * Spheres in a tree (PT_FEATURE_TREE) are merged only if the tree stores equal numbers for them. A camera outside such
 * a sphere may see its inside if the distance from the surface is below 2^-22 * radius + 2^-28 * extent of all spheres
 * in the tree. */
typedef struct pt_sphere {
    double center[3]; /**< at time 0 */
    double radius;    /**< > 0 */
    /** Displacement from time 0 to time 1. If the camera is nearer to the surface than 1/65536 of the radius when the
     * shutter opens, the sphere must move by less than 1/32 of the radius while the shutter is open. Otherwise
     * pt_accumulate returns PT_ERROR_UNSUPPORTED. */
    double motion[3];
    uint32_t material; /**< index into pt_scene.materials */
    uint32_t reserved; /**< 0 */
} pt_sphere;

/** Values of pt_column.type: the type of a component. */
enum {
    PT_TYPE_FLOAT32 = 1, /**< float */
    PT_TYPE_FLOAT64 = 2, /**< double */
    PT_TYPE_UINT32 = 3,  /**< uint32_t */
    /** uint8_t, for colors only: 255 times the sRGB encoding (IEC 61966-2-1) of a linear value in [0, 1]. */
    PT_TYPE_SRGB8 = 4
};

/** One property of many spheres in the caller's memory.
 *
 * The value of sphere i begins at data + i * stride_bytes, with any alignment. Its components are adjacent. If all
 * fields are 0, the property has its default. */
typedef struct pt_column {
    const void *data;      /**< NULL only if all fields are 0 */
    uint32_t stride_bytes; /**< at least the size of a value and < 2^31, or 0: one value for all spheres */
    uint32_t type;         /**< PT_TYPE_* */
} pt_column;

/** Spheres by columns. Each value obeys the rules of the same field of pt_sphere. */
typedef struct pt_sphere_array {
    uint32_t struct_size; /**< sizeof(pt_sphere_array): the distance between elements, equal in all of them */
    uint32_t count;       /**< number of spheres; if 0, the columns are ignored */
    pt_column center;     /**< x, y, z at time 0; FLOAT32 or FLOAT64; required */
    pt_column radius;     /**< FLOAT32 or FLOAT64; required */
    pt_column motion;     /**< x, y, z; FLOAT32 or FLOAT64; default (0, 0, 0) */
    pt_column material;   /**< index into pt_scene.materials; UINT32; default 0 */
    /** R, G, B in [0, 1], multiplied by the material's diffuse. FLOAT32 or FLOAT64 for linear values, or SRGB8; default
     * (1, 1, 1). A tree (PT_FEATURE_TREE) rounds them by up to 0.001. */
    pt_column color;
    /** x, y, z of a second center. Each sphere then becomes a capsule: all points no farther than the radius from the
     * segment between center and end. FLOAT32 or FLOAT64; default none. A capsule that emits or moves gives
     * PT_ERROR_INVALID_SCENE. If length + radius exceeds the distance from the camera, the surface is off by up to
     * 2^-21 * (length + radius). */
    pt_column end;
    /** Probability in [0, 1] that a ray hits the sphere. Every ray, also a shadow ray, decides at random for each
     * sphere. So the mean fraction of light that passes several spheres is the product of their 1 - opacity. FLOAT32 or
     * FLOAT64, rounded to a multiple of 1/255; default 1.
     *
     * A sphere with an opacity below 1 is always in a tree (PT_FEATURE_TREE), and its radius is rounded by up to 2^-16
     * of its value. If its material emits or is hidden, pt_set_scene returns PT_ERROR_INVALID_SCENE. */
    pt_column opacity;
} pt_sphere_array;

/** The points x with dot(normal, x) + offset = 0. The plane is visible, lit and emitting on both sides. */
typedef struct pt_plane {
    double normal[3];  /**< any length except 0; normal and offset are divided by it */
    double offset;     /**< -dot(normal, x) for any point x of the plane */
    uint32_t material; /**< index into pt_scene.materials */
    uint32_t reserved; /**< 0 */
} pt_plane;

/** A scene. Sphere indices begin with spheres and continue through sphere_arrays. */
typedef struct pt_scene {
    uint32_t struct_size;                 /**< sizeof(pt_scene) */
    uint32_t material_count;              /**< elements of materials */
    uint32_t sphere_count;                /**< elements of spheres; all spheres together at most 2^26 */
    uint32_t plane_count;                 /**< elements of planes; spheres and planes together fewer than 2^30 */
    const pt_material *materials;         /**< each array may be NULL only if its count is 0 */
    const pt_sphere *spheres;             /**< in any order */
    const pt_plane *planes;               /**< in any order */
    const pt_sphere_array *sphere_arrays; /**< further spheres */
    uint32_t sphere_array_count;          /**< elements of sphere_arrays, at most 65536 */
    uint32_t reserved;                    /**< 0 */
    /** NULL, or a function that pt_set_scene calls every few milliseconds, and at the end with 1. If it asks to stop,
     * pt_set_scene returns PT_CANCELLED and changes nothing. */
    pt_progress_fn progress;
    void *progress_user; /**< argument of progress */
} pt_scene;

/** Values of pt_camera.projection. */
enum {
    PT_PROJECTION_PERSPECTIVE = 0, /**< rays start at position (a pinhole) or on a lens (pt_camera.aperture) */
    /** parallel rays along the viewing direction. The rays start on the plane through position perpendicular to this
     * direction. Surfaces behind the plane are invisible. */
    PT_PROJECTION_ORTHOGRAPHIC = 1
};

/** The camera. The image's vertical axis is the part of up perpendicular to the viewing direction. */
typedef struct pt_camera {
    uint32_t struct_size; /**< sizeof(pt_camera) */
    uint32_t projection;  /**< PT_PROJECTION_* */
    double position[3];   /**< the pinhole, or the start of the image's middle ray; default the origin */
    double target[3];     /**< the point in the middle of the image; must differ from position */
    double up[3];         /**< not parallel to the viewing direction; default (0, 1, 0) */
    double vertical_fov;  /**< perspective: full vertical angle in [1e-8, pi); default pi / 4. Orthographic: 0 */
    double shutter_open;  /**< time at which the shutter opens; 0 <= shutter_open <= shutter_close <= 1 */
    double shutter_close; /**< time at which the shutter closes */
    /** Orthographic: full height of the view, in [1e-18, 1e18]; no default. If the view's width is outside this range,
     * pt_accumulate returns PT_ERROR_UNSUPPORTED. Perspective: 0. */
    double vertical_extent;
    /** Perspective: diameter of a thin lens about position, perpendicular to the viewing direction, at most 2 * focus;
     * 0: a pinhole. Orthographic: 0. */
    double aperture;
    /** Perspective with an aperture: depth of the plane in focus along the viewing direction; default the distance of
     * target. Orthographic: 0. */
    double focus;
} pt_camera;

/* ---- Rendering -------------------------------------------------------------------------------------------------- */

/** Values of pt_render.estimator: how paths find light. All estimators converge to the same image. A lamp is an
 * emitting sphere, except one around the camera. Other emitting surfaces are found only by random directions. */
enum {
    PT_ESTIMATOR_BEST = 0,    /**< the best one in this version: mis */
    PT_ESTIMATOR_UNIFORM = 1, /**< directions uniform on the hemisphere; lamps are found by chance */
    PT_ESTIMATOR_COSINE = 2,  /**< density proportional to the cosine to the normal; lamps are found by chance */
    PT_ESTIMATOR_BSDF = 3,    /**< density by cosine and specular lobe; lamps are found by chance */
    PT_ESTIMATOR_LIGHT = 4,   /**< lamps sampled by solid angle; all other light as bsdf */
    PT_ESTIMATOR_MIS = 5      /**< light and bsdf combined by weights */
};

/** Values of pt_render.sampler: the source of a sample's numbers. */
enum {
    PT_SAMPLER_BEST = 0,      /**< the best one in this version: sobol */
    PT_SAMPLER_RANDOM = 1,    /**< independent random numbers */
    PT_SAMPLER_HALTON = 2,    /**< Halton points, the same in every pixel */
    PT_SAMPLER_HALTON_CP = 3, /**< Halton points, rotated at random per pixel and dimension (Cranley, Patterson) */
    PT_SAMPLER_SOBOL = 4      /**< Sobol points, Owen-scrambled per pixel and dimension */
};

/** The default of pt_render.max_path_length. */
#define PT_DEFAULT_MAX_PATH_LENGTH 6u

/** Bits of pt_render.flags. */
enum {
    /** samples whose camera rays hit a surface are counted, for PT_QUANTITY_COVERAGE. The count takes 4 more bytes a
     * pixel and changes no bit of the radiance. */
    PT_RENDER_COVERAGE = 1
};

/** The size of the image and the method of rendering.
 *
 * first_row and row_count select some rows, which are read back as an image of their own. */
typedef struct pt_render {
    uint32_t struct_size;     /**< sizeof(pt_render) */
    uint32_t width;           /**< pixels, >= 1; width * height <= 2^32 - 1 */
    uint32_t height;          /**< pixels, >= 1 */
    uint32_t max_path_length; /**< most surface hits of a path, in [1, 1024]; 1: emission only */
    uint64_t seed;            /**< equal inputs, devices, drivers and seeds give equal bits */
    uint32_t first_sample;    /**< index of the first sample */
    uint32_t estimator;       /**< PT_ESTIMATOR_* */
    uint32_t sampler;         /**< PT_SAMPLER_* */
    uint32_t flags;           /**< PT_RENDER_* */
    uint32_t first_row;       /**< first row that is rendered */
    uint32_t row_count;       /**< rows that are rendered; 0: all from first_row on */
} pt_render;

/** Values of pt_accumulate_info.sampling: the numbers of samples of pixels. */
enum {
    PT_SAMPLING_BEST = 0,    /**< adaptive with a target error, otherwise uniform */
    PT_SAMPLING_UNIFORM = 1, /**< the same number in all pixels */
    /** more samples where they reduce the error most (shaders/README.md, section 11). Needs a target error. Tiles of 8
     * x 8 pixels get different numbers, each at least half of the mean number. */
    PT_SAMPLING_ADAPTIVE = 2
};

/** Rules that end work early, >= 0. 0: no rule. */
typedef struct pt_stopping {
    /** PT_TARGET_REACHED once pt_error_estimate.relative_rmse_high is at most this value, and pixels with lamps smaller
     * than a pixel have enough samples to hit them */
    double target_error;
    /** PT_LIMIT_REACHED after this many seconds and at least one sample of each pixel */
    double time_limit;
} pt_stopping;

/** How many samples pt_accumulate is to add. */
typedef struct pt_accumulate_info {
    uint32_t struct_size; /**< sizeof(pt_accumulate_info) */
    /** Samples to add to every pixel, >= 1; their indices stay below 2^32. If target_error is set, the pixels with most
     * samples get at most this number. If sample_count is then 0, samples are added only to pixels that a stopped call
     * left with fewer than others. */
    uint32_t sample_count;
    /** NULL, or a function that pt_accumulate calls after every submission to a device. NULL for pt_start.
     *
     * If it asks to stop, the call waits for the current submissions, at most two per device, and completes the current
     * sample of all pixels. The function cannot interrupt a driver that builds a kernel (pt_prepare). */
    pt_progress_fn progress;
    void *progress_user; /**< argument of progress */
    uint32_t sampling;   /**< PT_SAMPLING_* */
    /** Largest number of samples of a pixel after this call and later ones, if target_error is set; otherwise 0. When
     * the pixels that need more samples reach this number, the other pixels take more. A sample_limit below the number
     * that sample_count allows is raised to that number. */
    uint32_t sample_limit;
    /** NULL, or the number of samples that each tile takes, 0 to sample_count. target_error must then be 0. A tile
     * takes the first samples that it lacks, from pt_render.first_sample on. Tiles are squares of 8 x 8 pixels, row by
     * row from the top left of the rendered rows, smaller at the right and lower edges. */
    const uint32_t *tile_samples;
    uint32_t tile_count; /**< number of tiles, or 0 if tile_samples is NULL */
    uint32_t reserved2;  /**< 0 */
    /** PT_OK if sample_count is exhausted first, or all pixels have sample_limit samples.
     *
     * The error is checked at the numbers of samples that pt_next_check returns. With PT_SAMPLING_ADAPTIVE it is also
     * checked after each round of sampling. So with the same sample_limit, the final samples of each pixel do not
     * depend on the split over calls, devices and saved films. */
    pt_stopping stopping;
} pt_accumulate_info;

/** Values of pt_image.quantity. */
enum {
    PT_QUANTITY_RADIANCE = 0, /**< mean of the samples */
    /** standard error of the mean, from the difference between the means of two parts of the samples. The number of
     * samples in the first part is the largest power of two below the number of all samples. Up to 8 samples the value
     * is INFINITY. */
    PT_QUANTITY_STANDARD_ERROR = 1,
    PT_QUANTITY_SAMPLE_COUNT = 2, /**< number of the pixel's samples, the same in all channels */
    /* The next four describe the first hits of camera rays in the present scene. These quantities need no samples, and
     * treat a lens as a pinhole. */
    /** depth along the viewing direction: dot(x - camera.position, unit viewing direction), the same in all channels. x
     * is the first hit of the ray through the pixel's center, halfway between shutter_open and shutter_close. INFINITY
     * if the ray hits nothing. */
    PT_QUANTITY_DEPTH = 3,
    /** unit normal in world coordinates, towards the camera: the mean over 16 rays spread evenly over pixel and shutter
     * time. A ray that hits nothing counts as 0. */
    PT_QUANTITY_NORMAL = 4,
    /** diffuse + specular, each component at most 1: the mean over the same 16 rays. A ray that hits nothing counts as
     * 0. */
    PT_QUANTITY_ALBEDO = 5,
    /** index of the surface that PT_QUANTITY_DEPTH hits: spheres as in pt_scene, then planes. Merged surfaces have the
     * index of the first one (pt_sphere). PT_NO_OBJECT if the ray hits nothing. The format must be PT_FORMAT_R32UI. */
    PT_QUANTITY_OBJECT = 6,
    /** fraction of the pixel's samples whose camera rays hit a surface, the same in all channels. Use it as alpha; the
     * mean radiance is already multiplied by it. Needs PT_RENDER_COVERAGE. */
    PT_QUANTITY_COVERAGE = 7
};

/** The value of PT_QUANTITY_OBJECT where a ray hits nothing. */
#define PT_NO_OBJECT 0xffffffffu

/** Values of pt_image.format. Components are in the machine's byte order. A is 1. */
enum {
    PT_FORMAT_RGB32F = 0,  /**< R, G, B as float32: 12 bytes */
    PT_FORMAT_RGBA32F = 1, /**< R, G, B, A as float32: 16 bytes */
    /** R, G, B, A as float16: 8 bytes. Rounded to nearest, ties to even. Numbers from 65520 on become infinity. */
    PT_FORMAT_RGBA16F = 2,
    PT_FORMAT_R32UI = 3 /**< one uint32_t: 4 bytes. For PT_QUANTITY_OBJECT only */
};

/** The caller's memory for an image or a rectangle of it. */
typedef struct pt_image {
    uint32_t struct_size; /**< sizeof(pt_image) */
    uint32_t quantity;    /**< PT_QUANTITY_* */
    void *data;           /**< receives pixels row by row from the top; aligned to the size of a component */
    uint64_t size_bytes;  /**< at least (height - 1) * row_bytes + width * bytes of a pixel */
    uint64_t row_bytes;   /**< distance between rows, whole components; default and minimum: width * bytes of a pixel */
    uint32_t x;           /**< first column that is read */
    uint32_t y;           /**< first row, counted from pt_render.first_row */
    uint32_t width;       /**< columns, >= 1 and within the image; x, y, width and height all 0: the whole image */
    uint32_t height;      /**< rows; see width */
    uint32_t format;      /**< PT_FORMAT_* */
    uint32_t reserved;    /**< 0 */
} pt_image;

/* ---- Context ---------------------------------------------------------------------------------------------------- */

/** Level of a log line. */
enum {
    PT_LOG_ERROR = 1,   /**< something is wrong */
    PT_LOG_WARNING = 2, /**< something may be wrong */
    PT_LOG_INFO = 3     /**< devices, built kernels and their build times */
};

/** Receives one UTF-8 line without its line break. line is valid during the call. level is a PT_LOG_*. */
typedef void (*pt_log_fn)(void *user, int32_t level, const char *line);

/** Reads bytes that pt_store_kernels_fn has stored under a key. Returns their number, 0 if there are none, and writes
 * them to data if size_bytes suffices. The first call only asks for the number: data is NULL, size_bytes 0. The library
 * ignores bytes that are damaged or come from another driver or version. */
typedef uint64_t (*pt_load_kernels_fn)(void *user, const char *key, void *data, uint64_t size_bytes);

/** Stores a driver's compiled kernels under a key, in place of earlier ones. Storing may fail. key has 32 hexadecimal
 * digits and can be a file's name. data is valid during the call.
 */
typedef void (*pt_store_kernels_fn)(void *user, const char *key, const void *data, uint64_t size_bytes);

/** Bits of pt_create_info.flags. */
enum {
    PT_CREATE_VALIDATION = 1, /**< the Khronos validation layer reports to log; absent: PT_ERROR_UNSUPPORTED */
    /** build no kernels that have a scene's numbers as constants. By default, scenes that are rendered for some time
     * get such kernels, which are faster on CPUs. */
    PT_CREATE_NO_SCENE_KERNELS = 2
};

/** Arguments of pt_create. */
typedef struct pt_create_info {
    uint32_t struct_size;         /**< sizeof(pt_create_info) */
    uint32_t flags;               /**< PT_CREATE_* */
    const char *device;           /**< NULL: the best device; otherwise see pt/devices.h */
    pt_log_fn log;                /**< may be NULL; called by pt_create and any call on the context */
    void *log_user;               /**< argument of log */
    uint32_t submit_milliseconds; /**< intended duration of a submission, [1, 1000]; default 50 */
    uint32_t reserved;            /**< 0 */
    /** NULL, or the only device that the context uses (pt/vulkan.h). device must then be NULL, and PT_CREATE_VALIDATION
     * must not be set. */
    const pt_vulkan *vulkan;
    const char *shader_dir; /**< folder of changed GLSL files (pt/shaders.h); NULL or empty: none */
    /** Functions that keep compiled kernels, so that later processes start sooner. Either may be NULL. pt_create calls
     * load_kernels for each device. Any call that has built kernels calls store_kernels at its end, even if it
     * fails. */
    pt_load_kernels_fn load_kernels;
    pt_store_kernels_fn store_kernels; /**< see load_kernels */
    void *kernels_user;                /**< argument of both functions */
} pt_create_info;

/** The library's PT_VERSION. Any thread; never fails. */
PT_API uint32_t pt_version(void);

/** Name of a result as in this header ("PT_ERROR_NO_DEVICE"); "unknown result" for other numbers. A static string,
 * never NULL. Any thread; never fails. */
PT_API const char *pt_result_name(pt_result result);

/** Makes a context. If info is NULL, all arguments have their defaults.
 *
 * On success the caller owns the context and frees it by pt_destroy. On failure *context is NULL. Any thread.
 * PT_ERROR_NO_DEVICE: there is no Vulkan, or no suitable device. PT_ERROR_SHADER: a file of pt_create_info.shader_dir
 * does not compile. */
PT_API pt_result pt_create(const pt_create_info *info, pt_context **context);

/** Message of the last failed call on this context, or "". The message is valid until the next call on the context.
 *
 * If this thread's last call was refused because another call was running, this is the message of that refusal. While
 * another thread is in a call on the context, the message says so.
 *
 * If context is NULL, this is the message of this thread's last failed call without a context. The message is valid
 * until the next such call. The string is UTF-8, never NULL, and owned by the library. Never fails. */
PT_API const char *pt_last_error(const pt_context *context);

/** Waits for the device and frees everything. NULL is allowed. Call it from one thread, after all other calls on the
 * context. It never fails.
 *
 * pt_destroy frees nothing in a forked child, in a callback of the context, or while another thread is in a call on it.
 * The log and pt_last_error report the last two cases, after which the context can be destroyed later. */
PT_API void pt_destroy(pt_context *context);

/** Copies a scene into the context and discards the samples.
 *
 * The three setters may be called in any order and repeatedly.
 *
 * One thread at a time. PT_CANCELLED: pt_scene.progress asked to stop. PT_ERROR_INVALID_SCENE: the scene breaks a rule.
 * The message has a line for each of the first eight broken rules and the number of the others. */
PT_API pt_result pt_set_scene(pt_context *context, const pt_scene *scene);

/** Copies a camera into the context and discards the samples. One thread at a time. */
PT_API pt_result pt_set_camera(pt_context *context, const pt_camera *camera);

/** Copies render settings into the context and discards the samples.
 *
 * Allocates 112 bytes a pixel on the device. One thread at a time. PT_ERROR_UNSUPPORTED: the device has no buffers of
 * that size. In this case, and after PT_ERROR_OUT_OF_DEVICE_MEMORY, render fewer rows at a time. */
PT_API pt_result pt_set_render(pt_context *context, const pt_render *render);

/** Builds the kernels for the present scene, camera and render settings ahead of pt_accumulate.
 *
 * A kernel depends on the kinds and numbers of surfaces, and on which side of them the camera is, but not on their
 * positions. The samples stay.
 *
 * One thread at a time. PT_ERROR_UNSUPPORTED: the scene exceeds the device's limits. */
PT_API pt_result pt_prepare(pt_context *context);

/** Adds samples, and returns when they are taken.
 *
 * The bits of the sum do not depend on how samples are split over calls. Samples more than 2^20 times as bright as the
 * brightest emission are left out and counted (pt_stats.rejected_samples).
 *
 * One thread at a time. PT_CANCELLED, PT_TARGET_REACHED, PT_LIMIT_REACHED: fewer samples were taken, all of them
 * complete.
 * PT_ERROR_UNSUPPORTED: the scene exceeds the device's limits. After a failure complete samples are kept, and
 * pt_stats.sample_count is their number. The number is 0 if several devices had begun samples that they could not
 * complete. */
PT_API pt_result pt_accumulate(pt_context *context, const pt_accumulate_info *info);

/** Writes a quantity of all pixels or of a rectangle.
 *
 * After a failure the contents of image->data are undefined. One thread at a time. PT_ERROR_INVALID_STATE: there is no
 * sample. First hits need no sample and fail as pt_prepare does. */
PT_API pt_result pt_readback(pt_context *context, const pt_image *image);

#ifdef __cplusplus
}
#endif

#endif
