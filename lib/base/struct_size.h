// Reads and writes the caller's structs, which may be shorter or longer than this library's (pt.h, "Structs").
#pragma once

#include "lib/base/error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace pt {

template <typename Struct>
constexpr Struct sized() {
    Struct value{};
    value.struct_size = sizeof(Struct);
    return value;
}

// A size above 65536 means that the field is uninitialised.
constexpr bool is_struct_size(std::uint32_t size) {
    return size >= sizeof size && size <= 65536;
}

inline void require_not_null(const void *pointer, const char *name) {
    if (!pointer)
        refuse_argument(name, "", "NULL", "must not be NULL");
}

inline BrokenRule wrong_size(const char *name, std::int64_t index, std::uint32_t size, const std::string &rule) {
    return {.subject = name, .index = index, .member = "struct_size", .value = std::to_string(size), .rule = rule};
}

// Reads and checks struct_size. name and index are for messages; index is -1 outside arrays. Throws
// PT_ERROR_INVALID_ARGUMENT.
inline std::uint32_t struct_size_of(const void *user, const char *name, std::int64_t index = -1) {
    require_not_null(user, name);
    std::uint32_t size = 0;
    std::memcpy(&size, user, sizeof size);
    if (!is_struct_size(size))
        throw Error(PT_ERROR_INVALID_ARGUMENT,
                    wrong_size(name, index, size,
                               std::string("must be the size of the struct") +
                                   (size < sizeof size ? ", which holds this field" : " (<= 65536)")));
    return size;
}

// Throws PT_ERROR_UNSUPPORTED if a byte after the first `known` ones is not 0.
inline void require_known(const void *user, std::uint32_t size, std::size_t known, const char *name,
                          std::int64_t index) {
    const auto *bytes = static_cast<const unsigned char *>(user);
    for (std::size_t i = known; i < size; ++i)
        if (bytes[i] != 0)
            throw Error(PT_ERROR_UNSUPPORTED,
                        wrong_size(name, index, size,
                                   "byte " + std::to_string(i) + " is set, but this library knows only the first " +
                                       std::to_string(known) + " bytes of the struct"));
}

// Copies a struct, as copy_struct_from_user of Linux does. A shorter struct is extended by zeros. A longer one must
// have zeros in the unknown part.
template <typename T>
T copy_in(const T *user, const char *name, std::int64_t index = -1) {
    const std::uint32_t size = struct_size_of(user, name, index);
    require_known(user, size, sizeof(T), name, index);
    T copy{};
    std::memcpy(&copy, user, std::min<std::size_t>(size, sizeof(T)));
    copy.struct_size = sizeof(T);
    return copy;
}

// Writes the fields after struct_size that caller and library both have. size is the caller's struct_size.
template <typename T>
void copy_known(const T &result, T *user, std::uint32_t size) noexcept {
    constexpr std::size_t first = sizeof result.struct_size;
    const std::size_t end = std::min<std::size_t>(size, sizeof(T));
    std::memcpy(reinterpret_cast<unsigned char *>(user) + first,
                reinterpret_cast<const unsigned char *>(&result) + first, end - first);
}

template <typename T>
void copy_out(const T &result, T *user, const char *name) {
    copy_known(result, user, struct_size_of(user, name));
}

} // namespace pt
