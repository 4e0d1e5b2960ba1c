#pragma once

#include "lib/film/film_header.h"

#include <cstdint>
#include <string>

namespace pt {

struct FilmFacts {
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t max_path_length;
    std::uint64_t seed;
    std::uint32_t estimator;
    std::uint32_t sampler;
    bool has_coverage;
    int unit_exponent;
    std::string device;
};

// Throws PT_ERROR_INCOMPATIBLE if a fact is missing or invalid.
FilmFacts facts_of(const FilmIdentity &identity);

// Throws PT_ERROR_INCOMPATIBLE with all facts that differ. `place` ends each message.
void require_same(const FilmIdentity &film, const FilmIdentity &other, const std::string &place);

// Throws PT_ERROR_INCOMPATIBLE if the sets overlap or have too many samples together. `where` names the pixels and may
// be empty.
void require_apart(const SampleSet &added, const SampleSet &present, const std::string &where);

[[noreturn]] void refuse_film(const std::string &member, const std::string &value, const std::string &rule);

} // namespace pt
