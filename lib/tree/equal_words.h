#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <span>

namespace pt {

// Returns true if two words are equal, and also if the search would take too long, which does not happen with random
// hashes. Takes at most 2^26 words. Each word is a unit of work.
bool has_equal_words(std::span<const glm::uvec4> words, WorkProgress &progress);

} // namespace pt
