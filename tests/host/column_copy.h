// A column of numbers at any address and with any stride. Used by the tests of spheres that are given by columns.
#pragma once

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace sphere_arrays {

// A column in memory of its own that ends with its last element, at a distance from each other and at any address.
class ColumnCopy {
public:
    template <typename Number>
    ColumnCopy(const std::vector<Number> &numbers, std::uint32_t components, std::uint32_t type, std::uint32_t stride,
               std::size_t offset) {
        const std::size_t size = components * sizeof(Number);
        const std::size_t count = stride == 0 ? 1 : numbers.size() / components;
        const std::size_t end = offset + (count - 1) * stride + size;
        bytes_ = std::make_unique<unsigned char[]>(end);
        std::memset(bytes_.get(), 0xff, end);
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(bytes_.get() + offset + i * stride, numbers.data() + i * components, size);
        column_ = {bytes_.get() + offset, stride, type};
    }

    const pt_column &column() const { return column_; }

private:
    std::unique_ptr<unsigned char[]> bytes_;
    pt_column column_;
};

template <typename To, typename From>
std::vector<To> converted(const std::vector<From> &from) {
    return {from.begin(), from.end()};
}

} // namespace sphere_arrays
