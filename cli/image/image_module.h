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

// What the channels of a layer are.
enum : uint32_t {
    PT_LAYER_COLOR = 0,   // R, G and B; or one number, for which the layer is the channel
    PT_LAYER_VECTOR = 1,  // X, Y and Z
    PT_LAYER_NUMBERS = 2, // one whole number
};

// Channels of an image whose values stand together.
struct pt_image_layer {
    const char *name;                  // empty for the main one
    uint32_t channel_count;            // 3 or 1
    uint32_t kind;                     // PT_LAYER_*
    const float *values;               // pixel by pixel, row by row from the top
    const uint32_t *numbers = nullptr; // in place of values, of PT_LAYER_NUMBERS
};

struct pt_image_data {
    const char *extension; // "exr" or "jpg"
    uint32_t width;        // of the pixels
    uint32_t height;
    uint32_t x; // where they begin in the picture
    uint32_t y;
    uint32_t full_width; // of the picture
    uint32_t full_height;
    const pt_image_layer *layers; // for "exr", else NULL
    size_t layer_count;
    const uint8_t *bytes;  // R, G, B triples for the others, else NULL
    const uint16_t *words; // for PNG in place of bytes: 16 bits to a channel
    uint32_t has_alpha;    // 1: for PNG, R, G, B, A in place of triples, colors not multiplied by A
    double gamma;          // light is the byte / 255 to this power; 0: by the sRGB curve. For PNG
    const pt_image_attribute *attributes;
    size_t attribute_count;
};

// Receives the whole encoded file. Must not throw.
using pt_image_sink = void (*)(void *user, const void *bytes, size_t size);

// Encodes an image in memory. Returns 0, or -1 with a zero-terminated reason in message.
using pt_encode_image_fn = int32_t (*)(const pt_image_data *image, pt_image_sink sink, void *user, char *message,
                                       size_t message_size);

// What a file holds. Valid during the call that hands it out.
struct pt_decoded_image {
    int32_t x; // where the pixels begin in the picture; may lie outside of it
    int32_t y;
    uint32_t width; // of the pixels
    uint32_t height;
    uint32_t full_width; // of the picture
    uint32_t full_height;
    int32_t is_float; // 0: whole numbers, as displays take them, scaled to [0, 1]
    uint32_t channel_count;
    const char *const *channel_names;
    const float *values; // channel by channel of a pixel, row by row from the top
    const pt_image_attribute *attributes;
    size_t attribute_count;
};

// Must not throw.
using pt_decoded_sink = void (*)(void *user, const pt_decoded_image *image);

// Reads a file in any format that OpenImageIO knows. Returns like pt_encode_image.
using pt_decode_image_fn = int32_t (*)(const char *path, pt_decoded_sink sink, void *user, char *message,
                                       size_t message_size);
}

#define PT_ENCODE_IMAGE_SYMBOL "pt_encode_image"
#define PT_DECODE_IMAGE_SYMBOL "pt_decode_image"
