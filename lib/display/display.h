#pragma once

#include <pt/display.h>

#include <span>

namespace pt {

// Throws PT_ERROR_INVALID_ARGUMENT.
pt_display_info validated_display(const pt_display_info *user);
void check_radiance(std::span<const float> radiance);

void display(const pt_display_info &info);
double automatic_exposure(std::span<const float> radiance);

} // namespace pt
