#include "cli/base/kernel_folder.h"

#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using cli::KernelFolder;

std::string kernel_key(std::size_t number) {
    const std::string digits = std::to_string(number);
    return std::string(32 - digits.size(), 'a') + digits;
}

void keep(const KernelFolder &folder, const std::string &key, std::string_view text) {
    folder.store(key, std::as_bytes(std::span(text)));
}

std::string kept(const KernelFolder &folder, const std::string &key) {
    std::string text(folder.load(key, {}), ' ');
    EXPECT_EQ(folder.load(key, std::as_writable_bytes(std::span(text))), text.size());
    return text;
}

TEST(KernelFolder, KeysLeadNowhereElse) {
    const TemporaryFolder temporary;
    const KernelFolder folder(temporary.file("kernels"));
    keep(folder, kernel_key(1), "one");
    temporary.write("secret", "text");
    for (const char *key : {"../secret", "", ".", "..", "/etc/passwd", "ABC"}) {
        keep(folder, key, "x");
        EXPECT_EQ(folder.load(key, {}), 0) << key;
    }
    EXPECT_EQ(temporary.read("secret"), "text");
    EXPECT_EQ(temporary.count(), 2);
}

// The test sets the times of files, because a file system's clock may be too coarse.
TEST(KernelFolder, WhatWasUsedLongestAgoMakesPlace) {
    const TemporaryFolder temporary;
    const KernelFolder folder(temporary.file("kernels"));
    const auto path = [&](std::size_t number) { return temporary.file("kernels/" + kernel_key(number)); };
    const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1000);
    for (std::size_t number = 0; number < KernelFolder::most_files; ++number) {
        keep(folder, kernel_key(number), "x");
        std::filesystem::last_write_time(path(number), long_ago + std::chrono::hours(number));
    }
    EXPECT_EQ(kept(folder, kernel_key(0)), "x");
    keep(folder, kernel_key(100), "x");
    EXPECT_TRUE(std::filesystem::exists(path(0)));
    EXPECT_FALSE(std::filesystem::exists(path(1)));
    EXPECT_TRUE(std::filesystem::exists(path(2)));
    EXPECT_TRUE(std::filesystem::exists(path(100)));
}

TEST(KernelFolder, HasABoundOfItsSize) {
    const TemporaryFolder temporary;
    const KernelFolder folder(temporary.file("kernels"));
    const auto path = [&](std::size_t number) { return temporary.file("kernels/" + kernel_key(number)); };
    keep(folder, kernel_key(1), "x");
    keep(folder, kernel_key(2), "x");
    std::filesystem::resize_file(path(1), KernelFolder::most_bytes);
    const auto now = std::filesystem::file_time_type::clock::now();
    std::filesystem::last_write_time(path(1), now - std::chrono::hours(1));
    std::filesystem::last_write_time(path(2), now - std::chrono::hours(2));
    keep(folder, kernel_key(3), "x");
    EXPECT_FALSE(std::filesystem::exists(path(1)));
    EXPECT_TRUE(std::filesystem::exists(path(3)));
    std::filesystem::resize_file(path(3), KernelFolder::most_bytes + 1);
    EXPECT_EQ(folder.load(kernel_key(3), {}), 0) << "none of ours is as large";
}

} // namespace
