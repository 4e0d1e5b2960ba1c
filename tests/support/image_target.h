#pragma once

#include <pt/pt.h>

#include <cstdint>
#include <span>

inline pt_image image_target(std::span<float> values, uint32_t quantity = PT_QUANTITY_RADIANCE,
                             uint64_t row_bytes = 0) {
    pt_image image{};
    image.struct_size = sizeof image;
    image.quantity = quantity;
    image.data = values.data();
    image.size_bytes = values.size_bytes();
    image.row_bytes = row_bytes;
    return image;
}
