/** @file
 * pt: scene files (JSON, with NPY columns) as the structs of pt/pt.h. cli/README.md describes the files.
 *
 * These functions are a library of their own, libpt-scene (pkg-config pt-scene, CMake pt::scene and pt::scene_static).
 * It needs neither libpt nor Vulkan. The rules of pt/pt.h about structs, ownership, results and floating point hold.
 * Only one thread at a time may use a file. Different files are independent. */
#ifndef PT_SCENE_FILE_H
#define PT_SCENE_FILE_H

#include <pt/display.h>
#include <pt/errors.h>
#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A scene file in memory. */
typedef struct pt_scene_file pt_scene_file;

/** A value that replaces a value of the file. */
typedef struct pt_scene_override {
    /** Path and value: "camera.vertical_fov=30", "spheres[0].center=[0, 1, 0]", "film.tonemap=agx". A value that is not
     * JSON is a text. Missing members are added; elements of arrays must exist. */
    const char *setting;
    const char *name; /**< the value's name in messages, such as "--fov"; NULL: setting */
} pt_scene_override;

/** Values of pt_scene_file_info.flags. */
enum {
    PT_SCENE_FILE_FRAME = 1 /**< read the frame pt_scene_file_info.frame of an animation */
};

/** Arguments of pt_open_scene_file. */
typedef struct pt_scene_file_info {
    uint32_t struct_size;               /**< sizeof(pt_scene_file_info) */
    uint32_t override_count;            /**< number of overrides */
    const char *path;                   /**< the file's path; paths in the file are relative to its folder */
    const char *text;                   /**< the file's contents (UTF-8), so that path is not read; or NULL */
    uint64_t text_bytes;                /**< size of text */
    const pt_scene_override *overrides; /**< later ones replace earlier ones; NULL if override_count is 0 */
    uint32_t flags;                     /**< PT_SCENE_FILE_*; all other bits must be 0 */
    /** With PT_SCENE_FILE_FRAME: the number of the frame, which is also added to pt_render.seed. */
    uint32_t frame;
} pt_scene_file_info;

/** Settings of the file for the number of samples and the display (pt/display.h). */
typedef struct pt_scene_film {
    uint32_t struct_size;    /**< sizeof(pt_scene_film) */
    uint32_t sample_count;   /**< samples of a pixel; 0 if the file has none */
    pt_display_info display; /**< input for pt_display, without pixels; struct_size is set */
} pt_scene_film;

/** The source of a value that libpt refuses. */
typedef struct pt_rule_source {
    uint32_t struct_size;   /**< sizeof(pt_rule_source) */
    uint32_t line;          /**< line of the value, from 1; 0: the file does not have it */
    int64_t override_index; /**< index of the override that has the value; -1: none */
    /** "scene.json:7: materials.gold.glossiness = -1: must be >= 0". Valid until the next call with the file. */
    const char *message;
} pt_rule_source;

/** Reads a scene file and its columns. Most ranges of values are only checked later, by libpt. On success the caller
 * owns *file and frees it by pt_close_scene_file; on failure *file is NULL. Any thread. PT_ERROR_INVALID_SCENE: a file
 * is wrong; the message has file, line, value and rule. PT_ERROR_INVALID_ARGUMENT: an override or a field of info is
 * wrong. PT_ERROR_FILE: a file cannot be read. */
PT_API pt_result pt_open_scene_file(const pt_scene_file_info *info, pt_scene_file **file);

/** Frees the file and the arrays of its scene. NULL is allowed. One thread at a time. */
PT_API void pt_close_scene_file(pt_scene_file *file);

/** Fills the structs that are not NULL with the file's contents. Arrays of the scene are valid until
 * pt_close_scene_file. Fields that the file does not set become 0. One thread at a time. */
PT_API pt_result pt_get_scene_file(const pt_scene_file *file, pt_scene *scene, pt_camera *camera, pt_render *render,
                                   pt_scene_film *film);

/** Returns the path of the column file with the given index, or NULL beyond the last one. The scene file owns the
 * string. One thread at a time. */
PT_API const char *pt_get_column_path(const pt_scene_file *file, uint32_t index);

/** Finds the value that broke a rule of pt_set_scene, pt_set_camera, pt_set_render or pt_accumulate (pt/errors.h). One
 * thread at a time. */
PT_API pt_result pt_find_rule_source(pt_scene_file *file, const pt_broken_rule *rule, pt_rule_source *source);

/** Returns the JSON Schema (draft 7) of scene files, for editors. A static string; NULL if there is no memory. Any
 * thread. */
PT_API const char *pt_get_scene_schema(void);

/** Returns the message of this thread's last failed call of this header, or "". It is valid until the next failure on
 * this thread. UTF-8, never NULL. Never fails. */
PT_API const char *pt_last_scene_error(void);

#ifdef __cplusplus
}
#endif

#endif
