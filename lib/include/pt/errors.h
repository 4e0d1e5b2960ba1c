/** @file
 * pt: the last error as data, for programs that lead it back to where their users gave the value.
 *
 * Where a message of pt_last_error is about fields, it has a line for each rule that is broken, put together from the
 * members of a pt_broken_rule: "spheres[3].center[0] = nan: must be finite", "render.width * height = 0: ...".
 */
#ifndef PT_ERRORS_H
#define PT_ERRORS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A field and the rule that it breaks. Strings are UTF-8, zero-terminated and the library's; they live as long as the
 * message of pt_last_error does. */
typedef struct pt_broken_rule {
    uint32_t struct_size; /**< sizeof(pt_broken_rule); must be set by the caller */
    int32_t component;    /**< which element of the member, an array or a pt_column; -1: the member is neither */
    int64_t index;        /**< which element of the subject, an array of structs; -1: the subject is none */
    /** "materials", "spheres", "planes" or "sphere_arrays" of pt_scene; "scene", "camera", "render", "accumulate",
     * "image", "stats", "create" or "vulkan" for the struct itself; or the name of another argument */
    const char *subject;
    const char *member; /**< of the subject's struct, or "center.type"; "" for a rule about the argument itself */
    const char *with;   /**< what else enters the value, as "* height" beside "width"; else "" */
    const char *value;  /**< "-1", "NULL" */
    const char *rule;   /**< "must be > 0" */
} pt_broken_rule;

/** How many broken rules the message of pt_last_error is about; 0 where it is about no field.
 *
 * If rule is not NULL, that of the given index is written to as many bytes as rule->struct_size says. The first eight
 * are kept, those that the message shows; of others, and from the end on, the strings are NULL. Where no memory was
 * left for the message, there are none.
 *
 * The same context, or NULL, and the same threads as for pt_last_error; never fails, and changes no last error. */
PT_API uint64_t pt_get_broken_rule(const pt_context *context, uint32_t index, pt_broken_rule *rule);

#ifdef __cplusplus
}
#endif

#endif
