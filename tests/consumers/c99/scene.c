/* A program that only reads scene files. It has neither libpt nor Vulkan. */
#include <pt/scene_file.h>

#include <stdio.h>
#include <string.h>

int main(void) {
    const char text[] = "{\"film\": {\"width\": 7}}";
    const pt_scene_file_info info = {
        .struct_size = sizeof info, .path = "scene.json", .text = text, .text_bytes = strlen(text)};
    pt_scene_file *file = NULL;
    pt_render render = {.struct_size = sizeof render};
    if (pt_open_scene_file(&info, &file) < 0 || pt_get_scene_file(file, NULL, NULL, &render, NULL) < 0) {
        fprintf(stderr, "%s\n", pt_last_scene_error());
        return 2;
    }
    pt_close_scene_file(file);
    return render.width == 7 ? 0 : 1;
}
