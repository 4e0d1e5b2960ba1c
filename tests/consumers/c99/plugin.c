/* A host of plugins. It loads the library argv[1], renders, and ends without destroying the context. A second
 * argument unloads the library before the end. */
#include <pt/pt.h>

#include <dlfcn.h>
#include <stdio.h>

#define LOAD(name) (*(void **)&name = dlsym(library, #name))

int main(int count, char **arguments) {
    static const pt_material lamp = {.emission = {1, 1, 1}};
    static const pt_sphere around = {.radius = 2};
    pt_result (*pt_create)(const pt_create_info *, pt_context **);
    pt_result (*pt_set_scene)(pt_context *, const pt_scene *);
    pt_result (*pt_set_camera)(pt_context *, const pt_camera *);
    pt_result (*pt_set_render)(pt_context *, const pt_render *);
    pt_result (*pt_accumulate)(pt_context *, const pt_accumulate_info *);
    pt_result (*pt_readback)(pt_context *, const pt_image *);
    pt_context *context = NULL;
    float pixel[3] = {0};
    void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (!library || !LOAD(pt_create) || !LOAD(pt_set_scene) || !LOAD(pt_set_camera) || !LOAD(pt_set_render) ||
        !LOAD(pt_accumulate) || !LOAD(pt_readback)) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    if (pt_create(NULL, &context) < 0 ||
        pt_set_scene(context, &(pt_scene){.struct_size = sizeof(pt_scene),
                                          .material_count = 1,
                                          .materials = &lamp,
                                          .sphere_count = 1,
                                          .spheres = &around}) < 0 ||
        pt_set_camera(context, &(pt_camera){.struct_size = sizeof(pt_camera), .target = {0, 0, -1}}) < 0 ||
        pt_set_render(context, &(pt_render){.struct_size = sizeof(pt_render), .width = 1, .height = 1}) < 0 ||
        pt_accumulate(context, &(pt_accumulate_info){.struct_size = sizeof(pt_accumulate_info), .sample_count = 1}) < 0 ||
        pt_readback(context, &(pt_image){.struct_size = sizeof(pt_image), .data = pixel, .size_bytes = sizeof pixel}) < 0)
        return 1;
    return (count > 2 && dlclose(library) != 0) || pixel[0] != 1;
}
