// XXH3 digests. They detect accidental changes, but not deliberate ones.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace pt {

// Digests a sequence of numbers and texts. -0 counts as 0.
class Digest {
public:
    Digest();
    ~Digest();
    Digest(const Digest &) = delete;
    Digest &operator=(const Digest &) = delete;

    void add(double value);
    void add(std::uint64_t value);
    void add(const glm::dvec3 &vector);
    void add(std::span<const std::uint32_t> words);
    void add(std::string_view text);

    void add_bytes(std::span<const std::byte> bytes);

    // If only add_bytes() was called, this is the XXH3 of the concatenated bytes.
    std::uint64_t checksum() const;

    std::string text() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

std::uint64_t checksum(std::span<const std::byte> bytes);

} // namespace pt
