// After the last byte all bytes are 0, so each prefix of an input is an input. A wild source also draws numbers that
// break rules.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace fuzz {

class Numbers {
public:
    explicit Numbers(std::span<const std::byte> bytes) : bytes_(bytes) {}

    void be_wild() { wild_ = true; }

    template <typename T>
    T raw() {
        T value{};
        const std::size_t size = std::min(sizeof(T), bytes_.size());
        if (size > 0)
            std::memcpy(&value, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
        return value;
    }

    std::uint32_t below(std::uint32_t count) { return raw<std::uint8_t>() % count; }

    // True for the largest of `count` values. Byte 0 gives false.
    bool one_in(std::uint32_t count) { return below(count) == count - 1; }

    template <typename T, std::size_t Count>
    T choice(const T (&values)[Count]) {
        static_assert(Count <= 256);
        return values[below(Count)];
    }

    double length();                        // 0 or in [1e-18, 1e18]
    double positive_length();               // in [1e-18, 1e18]
    double component();                     // finite
    double share();                         // in [0, 1]
    float color();                          // in [0, 1e18]
    float glossiness();                     // in [0, 1e9]
    std::uint32_t count(std::uint32_t end); // in [0, end), end <= 256

private:
    double any_magnitude(); // any sign, magnitude in [1e-18, 1e18]
    bool breaks_rule() { return wild_ && one_in(16); }
    double anything();

    std::span<const std::byte> bytes_;
    bool wild_ = false;
};

} // namespace fuzz
