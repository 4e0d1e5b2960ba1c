// After the last byte all bytes are 0, so each prefix of an input is an input.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace fuzz {

class ByteReader {
public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    template <typename T>
    requires std::is_trivially_copyable_v<T> T raw() {
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

private:
    std::span<const std::uint8_t> bytes_;
};

} // namespace fuzz
