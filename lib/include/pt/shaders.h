/** @file
 * pt: kernels compiled while a program runs, for people who change them.
 *
 * pt_create_info.shader_dir is a folder of GLSL files like the library's shaders/. pt_create compiles them, and
 * pt_reload_shaders compiles them again: pathtrace.comp, fold.comp, add.comp, resolve.comp, estimate.comp,
 * accuracy.comp and first_hit.comp. Included files are beside the including file or in this folder. A relative path is
 * relative to the working directory at the time of the call. The host code shares gpu_layout.h, so do not change the
 * layout of memory. A kernel with a new binding gives PT_ERROR_SHADER.
 *
 * The compiler is the module libpt-glsl.so. It is in a folder pt beside the library (or beside the program, if the
 * library is static), or where the system finds libraries. Without the module the calls return PT_ERROR_UNSUPPORTED.
 */
#ifndef PT_SHADERS_H
#define PT_SHADERS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Compiles the present GLSL files of pt_create_info.shader_dir.
 *
 * Changed kernels replace the old ones on all devices, and the samples are discarded. Without changes, or after a
 * failure, kernels and samples stay.
 *
 * One thread at a time. PT_ERROR_SHADER: a file is missing or does not compile, or a driver refuses a kernel for the
 * present scene. If there are no samples, only the next pt_accumulate detects a refusal. pt_last_error has the
 * compiler's messages, a line each with file and line number. PT_ERROR_INVALID_STATE: there is no shader_dir. */
PT_API pt_result pt_reload_shaders(pt_context *context);

#ifdef __cplusplus
}
#endif

#endif
