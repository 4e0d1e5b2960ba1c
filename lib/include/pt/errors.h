/** @file
 * pt: errors and warnings as data, for programs that show their users where a wrong value came from.
 *
 * A message of pt_last_error about fields has a line per broken rule, made of the members of a pt_broken_rule:
 * "spheres[3].center[0] = nan: must be finite", "render.width * height = 0: ...". */
#ifndef PT_ERRORS_H
#define PT_ERRORS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A field and the rule that it breaks. Strings are UTF-8, zero-terminated and the library's, valid as long as the
 * message of pt_last_error. */
typedef struct pt_broken_rule {
    uint32_t struct_size; /**< sizeof(pt_broken_rule); must be set by the caller */
    int32_t component;    /**< element of member, if that is an array or a pt_column; otherwise -1 */
    int64_t index;        /**< element of subject, if that is an array of structs; otherwise -1 */
    /** "materials", "spheres", "planes" or "sphere_arrays" of pt_scene; "scene", "camera", "render", "accumulate",
     * "image", "stats", "create", "vulkan" or "denoise" for the struct itself; or the name of another argument */
    const char *subject;
    const char *member; /**< the subject's member, or "center.type"; "" for a rule about the argument itself */
    const char *with;   /**< other factors of the value, as "* height" beside "width"; else "" */
    const char *value;  /**< "-1", "NULL" */
    const char *rule;   /**< "must be > 0" */
} pt_broken_rule;

/** Returns the number of broken rules in the message of pt_last_error; 0 if it is about no field.
 *
 * If rule is not NULL, it receives the broken rule with the given index, rule->struct_size bytes of it. Only the first
 * eight are kept, as in the message; beyond these all other fields are 0 or NULL. No rules are kept if there was no
 * memory for the message.
 *
 * context and threads are as for pt_last_error. Never fails, and does not change the last error. */
PT_API uint64_t pt_get_broken_rule(const pt_context *context, uint32_t index, pt_broken_rule *rule);

/** Writes a warning about the scene as the camera sees it: the surface that rounding moves farthest, if that is more
 * than a pixel (pt_sphere_array.end and opacity state the precision). subject, index, member and component name the
 * field that causes it; rule says by how much and what to do. "sphere_arrays[0].radius[7] = 1e+06: ..."
 *
 * Without such a surface, or as long as scene, camera or render settings are missing, all other fields are 0 or NULL.
 * Strings live until the next call with the context. warning->struct_size must be set; no more bytes than that are
 * written. Refused while samples are under way (pt/async.h). One thread at a time per context. */
PT_API pt_result pt_get_warning(pt_context *context, pt_broken_rule *warning);

#ifdef __cplusplus
}
#endif

#endif
