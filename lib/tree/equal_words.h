// Finds out whether any two of many words are equal.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <span>

namespace pt {

// Uses up to 11 bytes per word. Takes at most 2^26 words, each a unit of work. Also returns true if the search would
// take long, which random hashes do not cause.
bool has_equal_words(std::span<const glm::uvec4> words, WorkProgress &progress);

} // namespace pt
