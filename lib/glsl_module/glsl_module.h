/* The interface between the library and the module libpt-glsl.so, which is the only one that links glslang: so its 7 MB
 * are loaded only when kernels are compiled at run time. The library finds its function by dlsym. Plain C types, no
 * exceptions. */
#ifndef PT_GLSL_MODULE_H
#define PT_GLSL_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Receives the words of the SPIR-V, or the compiler's log, which is not zero-terminated. Both belong to the module and
 * are valid during the call. Must not throw. */
typedef void (*pt_glsl_receive_fn)(void *user, const void *bytes, size_t size);

/* Compiles the compute shader directory/name as it is now, with the files that it includes, to the same SPIR-V that the
 * build embeds for the same text. An included file is looked for beside the file that includes it, then in directory.
 * Calls receive once, with the words, and returns 0; or with the log, whose lines begin with the names of file and
 * line, and returns -1. From any thread. */
typedef int32_t (*pt_compile_glsl_fn)(const char *directory, const char *name, pt_glsl_receive_fn receive, void *user);

#define PT_COMPILE_GLSL_SYMBOL "pt_glsl_compile"

#ifdef __cplusplus
}
#endif

#endif
