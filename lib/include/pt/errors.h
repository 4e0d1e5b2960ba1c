/** @file
 * pt: errors and warnings as data, for programs that show their users where a wrong value came from.
 *
 * A message of pt_last_error about fields has one line per broken rule, made of the members of a pt_broken_rule:
 * "spheres[3].center[0] = nan: must be finite", "render.width * height = 0: ...". */
#ifndef PT_ERRORS_H
#define PT_ERRORS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A field and the rule that it breaks. Strings are UTF-8, zero-terminated and owned by the library. They are valid as
 * long as the message of pt_last_error. */
typedef struct pt_broken_rule {
    uint32_t struct_size; /**< sizeof(pt_broken_rule) */
    int32_t component;    /**< element of member, if member is an array or a pt_column; otherwise -1 */
    int64_t index;        /**< element of subject, if subject is an array of structs; otherwise -1 */
    /** An array of pt_scene: "materials", "spheres", "planes" or "sphere_arrays". Or a struct: "scene", "camera",
     * "render", "accumulate", "image", "stats", "create", "vulkan" or "denoise". Or another argument's name. */
    const char *subject;
    const char *member; /**< the subject's member, or "center.type"; "" for a rule about the argument itself */
    const char *with;   /**< other factors of the value, as "* height" beside "width"; otherwise "" */
    const char *value;  /**< "-1", "NULL" */
    const char *rule;   /**< "must be > 0" */
} pt_broken_rule;

/** Returns the number of broken rules in the message of pt_last_error, 0 if the message concerns no field.
 *
 * If rule is not NULL, it receives the broken rule with the given index. Only the first eight rules are kept, and none
 * if there was no memory for the message. For other indices, all fields after struct_size are 0 or NULL.
 *
 * context and threads are as for pt_last_error. Never fails, and does not change the last error. */
PT_API uint64_t pt_get_broken_rule(const pt_context *context, uint32_t index, pt_broken_rule *rule);

/** Writes a warning about the surface that rounding moves farthest in the image, if it moves by more than a pixel.
 *
 * subject, index, member and component name the field that causes it. rule says how far and what to do, as in
 * "sphere_arrays[0].radius[7] = 1e+06: ...". Without such a surface, or while scene, camera or render settings are
 * missing, all fields after struct_size are 0 or NULL. Strings are valid until the next call with the context.
 *
 * One thread at a time. */
PT_API pt_result pt_get_warning(pt_context *context, pt_broken_rule *warning);

#ifdef __cplusplus
}
#endif

#endif
