// The growth of pt.h's structs: struct_size first, new fields at the end, zero means default.
#pragma once

#include "lib/base/error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace pt {

// Structs have tens of bytes; more than 65536 is an uninitialised field.
constexpr bool is_struct_size(std::uint32_t size) {
    return size >= sizeof size && size <= 65536;
}

inline void require_not_null(const void *pointer, const char *name) {
    if (!pointer)
        throw Error(PT_ERROR_INVALID_ARGUMENT,
                    BrokenRule{.subject = name, .value = "NULL", .rule = "must not be NULL"});
}

inline BrokenRule wrong_size(const char *name, std::int64_t index, std::uint32_t size, const std::string &rule) {
    return {.subject = name, .index = index, .member = "struct_size", .value = std::to_string(size), .rule = rule};
}

// name, index: for messages; index >= 0: of an array's element. Throws PT_ERROR_INVALID_ARGUMENT.
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

// Throws PT_ERROR_UNSUPPORTED for nonzero bytes beyond those known here.
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

// Copies like Linux' copy_struct_from_user: a shorter struct is extended by zeros; a longer one's unknown part must be
// zero.
template <typename T>
T copy_in(const T *user, const char *name, std::int64_t index = -1) {
    const std::uint32_t size = struct_size_of(user, name, index);
    require_known(user, size, sizeof(T), name, index);
    T copy{};
    std::memcpy(&copy, user, std::min<std::size_t>(size, sizeof(T)));
    copy.struct_size = sizeof(T);
    return copy;
}

// Writes what both sides know, except struct_size. size: the caller's.
template <typename T>
void copy_known(const T &result, T *user, std::uint32_t size) noexcept {
    constexpr std::size_t first = sizeof result.struct_size;
    const std::size_t end = std::min<std::size_t>(size, sizeof(T));
    std::memcpy(reinterpret_cast<unsigned char *>(user) + first,
                reinterpret_cast<const unsigned char *>(&result) + first, end - first);
}

// Also checks the caller's struct_size.
template <typename T>
void copy_out(const T &result, T *user, const char *name) {
    copy_known(result, user, struct_size_of(user, name));
}

} // namespace pt
