// The identity of a film as numbers, for callers that have nothing but the film, and what films must have in common, or
// not, to be added.
#pragma once

#include "lib/film/film_header.h"

#include <cstdint>
#include <string>

namespace pt {

struct FilmFacts {
    std::uint32_t width; // of the whole image
    std::uint32_t height;
    std::uint32_t max_path_length;
    std::uint64_t seed;
    std::uint32_t estimator;
    std::uint32_t sampler;
    int unit_exponent;
    std::string device;
};

// Throws PT_ERROR_INCOMPATIBLE if a fact is missing, or is something that pt_save_film cannot have written.
FilmFacts facts_of(const FilmIdentity &identity);

// Throws PT_ERROR_INCOMPATIBLE with a rule for each fact in which two identities differ: a film's, and that of what it
// is to be added to. place: what that is, "as in this context".
void require_same(const FilmIdentity &film, const FilmIdentity &other, const std::string &place);

// Throws PT_ERROR_INCOMPATIBLE if samples cannot be added to those of the same pixels: they have some in common, or are
// too many together. where: " in" which pixels, for the message, or nothing.
void require_apart(const SampleSet &added, const SampleSet &present, const std::string &where);

// Throws PT_ERROR_INCOMPATIBLE: a film breaks a rule.
[[noreturn]] void refuse_film(const std::string &member, const std::string &value, const std::string &rule);

} // namespace pt
