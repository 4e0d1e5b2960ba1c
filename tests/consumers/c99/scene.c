/* A program that only reads scene files. It has neither libpt nor Vulkan. */
#include <pt/scene_file.h>

#include <stdio.h>

int main(void) {
    pt_scene_file_info info = {0};
    pt_scene_file *file = NULL;
    pt_render render = {0};
    const char text[] = "{\"film\": {\"width\": 7}}";

    info.struct_size = sizeof info;
    info.path = "scene.json";
    info.text = text;
    info.text_bytes = sizeof text - 1;
    render.struct_size = sizeof render;
    if (pt_open_scene_file(&info, &file) < 0 || pt_get_scene_file(file, NULL, NULL, &render, NULL) < 0) {
        fprintf(stderr, "%s\n", pt_last_scene_error());
        return 2;
    }
    pt_close_scene_file(file);
    return render.width == 7 ? 0 : 1;
}
