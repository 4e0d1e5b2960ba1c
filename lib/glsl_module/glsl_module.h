/* The interface to libpt-glsl.so, the only module that links glslang (7 MB), loaded by dlsym only to compile kernels
 * at run time. Plain C types, no exceptions. */
#ifndef PT_GLSL_MODULE_H
#define PT_GLSL_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Receives the SPIR-V's bytes, or the compiler's log, not zero-terminated; the module's, for the duration of the
 * call. Must not throw. */
typedef void (*pt_glsl_receive_fn)(void *user, const void *bytes, size_t size);

/* Compiles the compute shader directory/name and its included files (beside the including file, then in directory) to
 * the SPIR-V that the build would embed. Calls receive once: with the words, and returns 0; or with the log, whose
 * lines begin with file and line, and returns -1. From any thread. */
typedef int32_t (*pt_compile_glsl_fn)(const char *directory, const char *name, pt_glsl_receive_fn receive, void *user);

#define PT_COMPILE_GLSL_SYMBOL "pt_glsl_compile"

#ifdef __cplusplus
}
#endif

#endif
