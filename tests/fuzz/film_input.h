#pragma once

#include "lib/base/digest.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace fuzz {

// The first byte decides whether a valid checksum is written. Without a valid one, almost no changed film is accepted.
inline std::vector<std::byte> film_input(std::span<const std::byte> before, std::span<const std::byte> bytes) {
    std::vector<std::byte> film(before.begin(), before.end());
    if (bytes.empty())
        return film;
    film.insert(film.end(), bytes.begin() + 1, bytes.end());
    std::uint64_t checksum = 0;
    if ((bytes.front() & std::byte{1}) == std::byte{0} || film.size() < sizeof checksum)
        return film;
    const auto end = std::span(film).last(sizeof checksum);
    checksum = pt::checksum(std::span(film).first(film.size() - sizeof checksum));
    std::memcpy(end.data(), &checksum, sizeof checksum);
    return film;
}

} // namespace fuzz
