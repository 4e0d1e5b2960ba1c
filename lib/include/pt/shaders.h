/** @file
 * pt: kernels compiled at run time.
 *
 * pt_create_info.shader_dir is a folder of GLSL files like the library's shaders/. pt_create compiles them, and
 * pt_reload_shaders compiles them again: pathtrace.comp, fold.comp, add.comp, resolve.comp, estimate.comp,
 * accuracy.comp and first_hit.comp. Included files are beside the including file or in this folder. Do not change the
 * memory layout in gpu_layout.h, because the library uses it too. A kernel with a new binding gives PT_ERROR_SHADER.
 *
 * The compiler is the module libpt-glsl.so, in a folder pt beside the library (or beside the program, if the library is
 * static), or on the system's library path. Without the module both calls return PT_ERROR_UNSUPPORTED.
 */
#ifndef PT_SHADERS_H
#define PT_SHADERS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Compiles the present GLSL files of pt_create_info.shader_dir.
 *
 * Changed kernels replace the old ones on all devices, and the samples are discarded. If no kernel has changed, or
 * after a failure, kernels and samples stay.
 *
 * One thread at a time. PT_ERROR_SHADER: a file is missing or does not compile, or a driver refuses a kernel for the
 * present scene. If there are no samples, only the next pt_accumulate detects the refusal. pt_last_error has the
 * compiler's messages with file and line number. PT_ERROR_INVALID_STATE: there is no shader_dir. */
PT_API pt_result pt_reload_shaders(pt_context *context);

#ifdef __cplusplus
}
#endif

#endif
