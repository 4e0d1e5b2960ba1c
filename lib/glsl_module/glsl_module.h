/* The interface of libpt-glsl.so, which links glslang. libpt loads it only to compile kernels at run time. It has only
 * C types and no exceptions. */
#ifndef PT_GLSL_MODULE_H
#define PT_GLSL_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Receives the bytes of the SPIR-V, or the compiler's log without a terminating zero. The bytes are valid during the
 * call. Must not throw. */
typedef void (*pt_glsl_receive_fn)(void *user, const void *bytes, size_t size);

/* Compiles the compute shader directory/name to the SPIR-V that the build would embed. Calls `receive` once. Returns 0
 * if it passed the SPIR-V, and -1 if it passed the log. Lines of the log begin with file and line. Thread-safe. */
typedef int32_t (*pt_compile_glsl_fn)(const char *directory, const char *name, pt_glsl_receive_fn receive, void *user);

#define PT_COMPILE_GLSL_SYMBOL "pt_glsl_compile"

#ifdef __cplusplus
}
#endif

#endif
