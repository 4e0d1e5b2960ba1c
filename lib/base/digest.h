// Digests of numbers and bytes by XXH3: they detect changes, not forgeries. Used for films and kept kernels.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace pt {

// The digest of a sequence of numbers and texts, which need not be contiguous in memory. -0 counts as 0.
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

    // Adds bytes as they are. If nothing else is added, checksum() is that of all these bytes in a row.
    void add_bytes(std::span<const std::byte> bytes);
    std::uint64_t checksum() const;

    // 128 bits as 32 hexadecimal digits.
    std::string text() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

std::uint64_t checksum(std::span<const std::byte> bytes);

} // namespace pt
