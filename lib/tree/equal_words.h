// Whether any two of many words are equal. SphereTree uses it to find twins, which it must not hold.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <span>

namespace pt {

// Takes up to 11 bytes a word for the time of the call; 2^26 words at the most. Each is a unit of work. Also true where
// it would take long to tell, which does not happen by chance.
bool has_equal_words(std::span<const glm::uvec4> words, WorkProgress &progress);

} // namespace pt
