/** @file
 * pt: errors and warnings as data.
 *
 * If fields break rules, the message of pt_last_error has a line for each rule: "spheres[3].center[0] = nan: must be
 * finite". pt_broken_rule has the parts of such a line. */
#ifndef PT_ERRORS_H
#define PT_ERRORS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A field and the rule that it breaks. The library owns the strings, which are UTF-8. They are valid as long as the
 * message of pt_last_error. */
typedef struct pt_broken_rule {
    uint32_t struct_size; /**< sizeof(pt_broken_rule) */
    int32_t component;    /**< index in member, if member is an array or a pt_column; otherwise -1 */
    int64_t index;        /**< index in subject, if subject is an array of structs; otherwise -1 */
    /** The name of an array of pt_scene ("materials", "spheres", "planes" or "sphere_arrays"), of a struct ("scene",
     * "camera", "render", "accumulate", "image", "stats", "create", "vulkan" or "denoise") or of another argument. */
    const char *subject;
    const char *member; /**< the subject's member, or "center.type"; "" for a rule about the argument itself */
    const char *with;   /**< other factors of the value, for example "* height"; otherwise "" */
    const char *value;  /**< the value, such as "-1" or "NULL" */
    const char *rule;   /**< the rule, such as "must be > 0" */
} pt_broken_rule;

/** Returns the number of broken rules of the last error; 0 if the error concerns no field. If rule is not NULL, it
 * receives the broken rule with the given index. Only the first eight rules are kept, and none without memory. For
 * other indices, all fields after struct_size are 0 or NULL.
 *
 * context and threads are as for pt_last_error. Never fails, and does not change the last error. */
PT_API uint64_t pt_get_broken_rule(const pt_context *context, uint32_t index, pt_broken_rule *rule);

/** Writes a warning about the surface that rounding moves farthest in the image, if it moves by more than a pixel. The
 * warning names the field that causes this, the distance in the image, and a remedy. Without such a surface, or while
 * scene, camera or render settings are missing, all fields after struct_size are 0 or NULL. Strings are valid until the
 * next call on the context. One thread at a time. */
PT_API pt_result pt_get_warning(pt_context *context, pt_broken_rule *warning);

#ifdef __cplusplus
}
#endif

#endif
