// The growth rule of structs: callers compiled with an older or a newer header.
#include "lib/base/struct_size.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>

namespace {

// What this library knows.
struct Options {
    std::uint32_t struct_size;
    std::uint32_t first;
    std::uint64_t second;
};

// What a caller with an older header knows.
struct OlderOptions {
    std::uint32_t struct_size;
    std::uint32_t first;
};

// What a caller with a newer header knows.
struct NewerOptions {
    Options known;
    std::uint64_t third;
};

// The code and message of the error, or "accepted".
std::string message(const void *user) {
    try {
        pt::copy_in(static_cast<const Options *>(user), "options");
    } catch (const pt::Error &error) {
        return std::to_string(error.code()) + " " + error.what();
    }
    return "accepted";
}

TEST(CopyIn, TakesTheSameStruct) {
    const Options user{sizeof user, 1, 2};
    const Options copy = pt::copy_in(&user, "options");
    EXPECT_EQ(copy.struct_size, sizeof(Options));
    EXPECT_EQ(copy.first, 1U);
    EXPECT_EQ(copy.second, 2U);
}

TEST(CopyIn, ReadsAShorterStructAsIfZerosFollowed) {
    // What lies behind it in memory is not read.
    std::array<unsigned char, sizeof(Options)> memory;
    memory.fill(0xff);
    const OlderOptions user{sizeof user, 1};
    std::memcpy(memory.data(), &user, sizeof user);
    const Options copy = pt::copy_in(reinterpret_cast<const Options *>(memory.data()), "options");
    EXPECT_EQ(copy.struct_size, sizeof(Options));
    EXPECT_EQ(copy.first, 1U);
    EXPECT_EQ(copy.second, 0U);
}

TEST(CopyIn, TakesAStructThatIsItsSizeAlone) {
    const std::uint32_t user = sizeof user;
    const Options copy = pt::copy_in(reinterpret_cast<const Options *>(&user), "options");
    EXPECT_EQ(copy.first, 0U);
    EXPECT_EQ(copy.second, 0U);
}

TEST(CopyIn, AcceptsALongerStructWithZeroTail) {
    const NewerOptions user{{sizeof user, 1, 2}, 0};
    EXPECT_EQ(pt::copy_in(&user.known, "options").second, 2U);
}

TEST(CopyIn, RefusesALongerStructThatAsksForMore) {
    NewerOptions user{{sizeof user, 1, 2}, 1};
    EXPECT_EQ(message(&user), std::to_string(PT_ERROR_UNSUPPORTED) +
                                  " options.struct_size = 24: byte 16 is set, but this library knows only the first 16 "
                                  "bytes of the struct");
    user.third = std::uint64_t{1} << 56; // the last byte, on little-endian machines
    EXPECT_EQ(message(&user), std::to_string(PT_ERROR_UNSUPPORTED) +
                                  " options.struct_size = 24: byte 23 is set, but this library knows only the first 16 "
                                  "bytes of the struct");
}

TEST(CopyIn, RefusesNull) {
    EXPECT_EQ(message(nullptr), std::to_string(PT_ERROR_INVALID_ARGUMENT) + " options = NULL: must not be NULL");
}

TEST(CopyIn, RefusesAForgottenSize) {
    for (const std::uint32_t size : {0U, 1U, 3U}) {
        const Options user{size, 1, 2};
        EXPECT_EQ(message(&user), std::to_string(PT_ERROR_INVALID_ARGUMENT) +
                                      " options.struct_size = " + std::to_string(size) +
                                      ": must be the size of the struct, which holds this field");
    }
}

// The bytes that it speaks of are not there, and must not be read.
TEST(CopyIn, RefusesAnAbsurdSize) {
    for (const std::uint32_t size : {65537U, 0xcdcdcdcdU}) {
        const Options user{size, 1, 2};
        EXPECT_EQ(message(&user), std::to_string(PT_ERROR_INVALID_ARGUMENT) + " options.struct_size = " +
                                      std::to_string(size) + ": must be the size of the struct (<= 65536)");
    }
}

TEST(CopyOut, WritesTheSameStruct) {
    Options user{sizeof user, 0, 0};
    pt::copy_out(Options{0, 1, 2}, &user, "options");
    EXPECT_EQ(user.struct_size, sizeof(Options));
    EXPECT_EQ(user.first, 1U);
    EXPECT_EQ(user.second, 2U);
}

TEST(CopyOut, WritesNoMoreThanAShorterStruct) {
    Options user{sizeof(OlderOptions), 0, 0x5555};
    pt::copy_out(Options{0, 1, 2}, &user, "options");
    EXPECT_EQ(user.struct_size, sizeof(OlderOptions));
    EXPECT_EQ(user.first, 1U);
    EXPECT_EQ(user.second, 0x5555U);
}

TEST(CopyOut, WritesNothingIntoAStructThatIsItsSizeAlone) {
    Options user{sizeof(std::uint32_t), 0x5555, 0x5555};
    pt::copy_out(Options{0, 1, 2}, &user, "options");
    EXPECT_EQ(user.struct_size, sizeof(std::uint32_t));
    EXPECT_EQ(user.first, 0x5555U);
    EXPECT_EQ(user.second, 0x5555U);
}

TEST(CopyOut, LeavesTheUnknownTailOfALongerStruct) {
    NewerOptions user{{sizeof user, 0, 0}, 0x5555};
    pt::copy_out(Options{0, 1, 2}, &user.known, "options");
    EXPECT_EQ(user.known.struct_size, sizeof(NewerOptions));
    EXPECT_EQ(user.known.second, 2U);
    EXPECT_EQ(user.third, 0x5555U);
}

TEST(CopyOut, RefusesNullAndForgottenSizes) {
    EXPECT_THROW(pt::copy_out(Options{}, static_cast<Options *>(nullptr), "options"), pt::Error);
    Options user{0, 0x5555, 0x5555};
    EXPECT_THROW(pt::copy_out(Options{}, &user, "options"), pt::Error);
    EXPECT_EQ(user.first, 0x5555U);
}

} // namespace
