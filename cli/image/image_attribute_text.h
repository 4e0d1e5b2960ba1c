// An image's attribute as text, for formats whose metadata are text alone (PNG, JPEG).
#pragma once

#include "cli/image/image_module.h"

#include <array>
#include <cstdio>
#include <string>

inline std::string image_attribute_text(const pt_image_attribute &attribute) {
    if (attribute.text != nullptr)
        return attribute.text;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), attribute.is_float != 0 ? "%.9g" : "%.0f", attribute.number);
    return text.data();
}
