// Whether any two of many words are equal. Used by SphereTree, to which twins must not come.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <span>

namespace pt {

// Takes up to 11 bytes a word for the time of the call; 2^26 words at the most. Each is a unit of work. Says so, too,
// where it would take long to tell, which does not happen by chance.
bool has_equal_words(std::span<const glm::uvec4> words, WorkProgress &progress);

} // namespace pt
