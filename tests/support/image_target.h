#pragma once

#include "tests/support/sized.h"

#include <pt/pt.h>

#include <cstdint>
#include <span>

inline pt_image image_target(std::span<float> values, uint32_t quantity = PT_QUANTITY_RADIANCE,
                             uint64_t row_bytes = 0) {
    auto image = sized<pt_image>();
    image.quantity = quantity;
    image.data = values.data();
    image.size_bytes = values.size_bytes();
    image.row_bytes = row_bytes;
    return image;
}

struct ImagePart {
    uint32_t x, y, width, height;
};

template <typename Image>
void set_part(Image &image, const ImagePart &part) {
    image.x = part.x;
    image.y = part.y;
    image.width = part.width;
    image.height = part.height;
}
