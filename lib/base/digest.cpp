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
    XXH3_128bits_reset(&state_->hash);
}

Digest::~Digest() = default;

void Digest::add(double value) {
    const double canonical = value + 0.0; // -0 + 0 = +0
    XXH3_128bits_update(&state_->hash, &canonical, sizeof canonical);
}

void Digest::add(std::uint64_t value) {
    XXH3_128bits_update(&state_->hash, &value, sizeof value);
}

void Digest::add(const glm::dvec3 &vector) {
    for (int i = 0; i < 3; ++i)
        add(vector[i]);
}

void Digest::add(std::span<const std::uint32_t> words) {
    add(std::uint64_t{words.size()});
    XXH3_128bits_update(&state_->hash, words.data(), words.size_bytes());
}

void Digest::add(std::string_view text) {
    add(std::uint64_t{text.size()});
    XXH3_128bits_update(&state_->hash, text.data(), text.size());
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

struct RunningChecksum::State {
    XXH3_state_t hash;
};

RunningChecksum::RunningChecksum() : state_(std::make_unique<State>()) {
    XXH3_64bits_reset(&state_->hash);
}

RunningChecksum::~RunningChecksum() = default;

void RunningChecksum::add(std::span<const std::byte> bytes) {
    XXH3_64bits_update(&state_->hash, bytes.data(), bytes.size());
}

std::uint64_t RunningChecksum::value() const {
    return XXH3_64bits_digest(&state_->hash);
}

} // namespace pt
