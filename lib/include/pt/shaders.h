/** @file
 * pt: kernels compiled while a program runs, for people who change them.
 *
 * pt_create_info.shader_dir is a folder of GLSL files like the library's own shaders/, compiled by pt_create and again
 * by pt_reload_shaders: pathtrace.comp, fold.comp, add.comp, resolve.comp, estimate.comp, accuracy.comp,
 * first_hit.comp, coverage.comp and the files that they include, beside the including file or in this folder. A
 * relative path is relative to the working directory at that time. gpu_layout.h is shared with the host code: do not
 * change the layout of memory. A binding that a kernel's layout lacks is refused (PT_ERROR_SHADER). The compiler is the
 * module libpt-glsl.so, in a folder pt beside the library (or the program, if the library is static), or where the
 * system finds libraries; without it, PT_ERROR_UNSUPPORTED.
 */
#ifndef PT_SHADERS_H
#define PT_SHADERS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Compiles the present GLSL files of pt_create_info.shader_dir.
 *
 * Changed kernels replace the old ones on all devices and discard the samples; otherwise nothing changes. After a
 * failure kernels and samples are as before.
 *
 * One thread at a time per context. PT_ERROR_SHADER: a file is missing or does not compile, with the compiler's
 * messages (a line each, with file and line number) in pt_last_error; or a driver refuses the kernels for the present
 * scene (without samples, only the next pt_accumulate finds that out). PT_ERROR_INVALID_STATE: there is no shader_dir.
 * PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_reload_shaders(pt_context *context);

#ifdef __cplusplus
}
#endif

#endif
