// The interface between the program and the module libpt-image-file.so, which alone links OpenImageIO: its 261 shared
// objects and 0.2 s are paid only when an image is read, or written in another format than PNG. Plain C types, and no
// exception crosses it.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

struct pt_image_attribute {
    const char *name;
    const char *text; // NULL: a number
    double number;
    int32_t is_float; // 1: a number written as float32; 0: as int32
    int32_t reserved;
};

struct pt_image_data {
    const char *extension; // "exr" or "jpg"
    uint32_t width;
    uint32_t height;
    const float *radiance; // R, G, B triples for "exr", else NULL
    const uint8_t *bytes;  // R, G, B triples for the others, else NULL
    double gamma;          // light is the byte / 255 to this power; 0: by the sRGB curve. For PNG
    const pt_image_attribute *attributes;
    size_t attribute_count;
};

// Receives the whole encoded file. Must not throw.
using pt_image_sink = void (*)(void *user, const void *bytes, size_t size);

// Encodes an image in memory. Returns 0, or -1 with a zero-terminated reason in message.
using pt_encode_image_fn = int32_t (*)(const pt_image_data *image, pt_image_sink sink, void *user, char *message,
                                       size_t message_size);

// Receives a whole image, R, G, B triples row by row from the top. Must not throw.
using pt_radiance_sink = void (*)(void *user, uint32_t width, uint32_t height, const float *radiance);

// Reads the channels R, G and B of a file in any format that OpenImageIO knows. Returns like pt_encode_image.
using pt_decode_image_fn = int32_t (*)(const char *path, pt_radiance_sink sink, void *user, char *message,
                                       size_t message_size);
}

#define PT_ENCODE_IMAGE_SYMBOL "pt_encode_image"
#define PT_DECODE_IMAGE_SYMBOL "pt_decode_image"
