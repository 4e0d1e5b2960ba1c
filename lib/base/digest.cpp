#include "lib/base/digest.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cinttypes>
#include <cstdio>

namespace pt {

struct Digest::State {
    XXH3_state_t hash;
};

Digest::Digest() : state_(std::make_unique<State>()) {
    XXH3_64bits_reset(&state_->hash);
}

Digest::~Digest() = default;

void Digest::add(double value) {
    const double canonical = value + 0.0; // -0 + 0 = +0
    add_bytes(std::as_bytes(std::span(&canonical, 1)));
}

void Digest::add(std::uint64_t value) {
    add_bytes(std::as_bytes(std::span(&value, 1)));
}

void Digest::add(const glm::dvec3 &vector) {
    for (int i = 0; i < 3; ++i)
        add(vector[i]);
}

void Digest::add(std::span<const std::uint32_t> words) {
    add(std::uint64_t{words.size()});
    add_bytes(std::as_bytes(words));
}

void Digest::add(std::string_view text) {
    add(std::uint64_t{text.size()});
    add_bytes(std::as_bytes(std::span(text)));
}

void Digest::add_bytes(std::span<const std::byte> bytes) {
    XXH3_64bits_update(&state_->hash, bytes.data(), bytes.size());
}

std::uint64_t Digest::checksum() const {
    return XXH3_64bits_digest(&state_->hash);
}

std::string Digest::text() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(&state_->hash);
    std::array<char, 33> text{};
    std::snprintf(text.data(), text.size(), "%016" PRIx64 "%016" PRIx64, hash.high64, hash.low64);
    return text.data();
}

std::uint64_t checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

} // namespace pt
