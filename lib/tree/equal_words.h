// Finds out whether any two of many words are equal.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <span>

namespace pt {

// Takes up to 11 bytes per word; at most 2^26 words, each a unit of work. Also true if finding out would take long,
// which does not happen by chance.
bool has_equal_words(std::span<const glm::uvec4> words, WorkProgress &progress);

} // namespace pt
