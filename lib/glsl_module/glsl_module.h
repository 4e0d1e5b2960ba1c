/* The interface to libpt-glsl.so, the only module that links glslang. It is loaded only to compile kernels at run
 * time. Plain C types, no exceptions. */
#ifndef PT_GLSL_MODULE_H
#define PT_GLSL_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Receives the SPIR-V's bytes, or the compiler's log, not zero-terminated. They are valid during the call. Must not
 * throw. */
typedef void (*pt_glsl_receive_fn)(void *user, const void *bytes, size_t size);

/* Compiles the compute shader directory/name to the SPIR-V that the build would embed. Included files are beside the
 * including file or in directory. Calls receive once and returns 0 with the words, or -1 with the log, whose lines
 * begin with file and line. Thread-safe. */
typedef int32_t (*pt_compile_glsl_fn)(const char *directory, const char *name, pt_glsl_receive_fn receive, void *user);

#define PT_COMPILE_GLSL_SYMBOL "pt_glsl_compile"

#ifdef __cplusplus
}
#endif

#endif
