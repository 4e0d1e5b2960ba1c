// Whether any two of many words are equal. SphereTree uses it to find twins, which it must not hold.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <span>

namespace pt {

// Takes up to 11 bytes for each word during the call; at most 2^26 words. Each word is a unit of work. Also true where
// finding out would take long, which does not happen by chance.
bool has_equal_words(std::span<const glm::uvec4> words, WorkProgress &progress);

} // namespace pt
