#pragma once

#include "tests/fuzz/byte_reader.h"

#include <pt/pt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace fuzz {

struct Input {
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera{};
    pt_render render{};
    std::uint32_t sample_count = 1;

    // Wrong values in place of the input's values. The library must refuse claims of more memory than exists.
    struct SceneClaims {
        bool has_materials = true;
        bool has_spheres = true;
        bool has_planes = true;
        std::uint32_t more_spheres = 0; // 2^30 or more
        std::uint32_t fewer_materials = 0;
    } claims;

    // Columns may hold the last spheres. The columns' pointers point into the structs of these spheres.
    struct Columns {
        std::uint32_t count = 0;
        bool has_colors = false;
        std::uint32_t claimed = none;   // index of the column that `claim` replaces
        pt_column claim{};              // `data` is NULL, or is replaced by the column's own pointer
        std::uint32_t more_spheres = 0; // 2^27 or more
        std::uint32_t struct_size = sizeof(pt_sphere_array);

        static constexpr std::uint32_t none = 5;
    } columns;
    mutable std::vector<std::uint8_t> array_bytes;
    std::array<std::uint32_t, 3> struct_sizes{sizeof(pt_scene), sizeof(pt_camera), sizeof(pt_render)};
    std::uint8_t tail_byte = 0;

    pt_scene scene() const;
};

Input decoded_input(ByteReader bytes);

// Keeps to the rules of pt.h. The kernel's features usually stay the same.
void change_one_number(Input &input, ByteReader &bytes);

// A struct in memory of exactly its size, so AddressSanitizer detects reads beyond its end.
class SizedStruct {
public:
    template <typename T>
    SizedStruct(T value, std::uint32_t size, std::uint8_t tail_byte) {
        value.struct_size = size;
        copy(&value, sizeof value, size, tail_byte);
    }

    template <typename T>
    const T *as() const {
        return reinterpret_cast<const T *>(bytes_.get());
    }

private:
    void copy(const void *value, std::size_t known_size, std::uint32_t size, std::uint8_t tail_byte);

    std::unique_ptr<std::uint8_t[]> bytes_;
};

} // namespace fuzz
