#include "cli/base/file.h"
#include "cli/base/kernel_folder.h"
#include "cli/render/source_watch.h"
#include "lib/platform/printable.h"
#include "tests/cli/refusal_of.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace {

using cli::AtomicFile;

std::span<const std::byte> bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

TEST(AtomicFile, KeepsPermissionsAndLinks) {
    const TemporaryFolder folder;
    folder.write("target", "old");
    chmod(folder.file("target").c_str(), 0640);
    std::filesystem::create_symlink("target", folder.file("link"));
    AtomicFile file(folder.file("link"));
    file.write(bytes("new"));
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
    EXPECT_EQ(folder.read("target"), "new");
    struct stat status {};
    ASSERT_EQ(stat(folder.file("target").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0640U);
}

// Covers the cases of protected_symlinks in proc_sys_fs(5). The test gives its links another owner.
TEST(AtomicFile, FollowsNoOneElsesLinksWhereEverybodyMayWrite) {
    if (geteuid() != 0)
        GTEST_SKIP() << "only root can make links that belong to others";
    constexpr uid_t another = 65534;
    constexpr uid_t third = 65533;
    struct Case {
        mode_t folder;
        uid_t folder_owner;
        uid_t link_owner;
        bool is_followed;
    };
    for (const Case &c : {Case{01777, 0, another, false}, Case{01777, third, another, false},
                          Case{01777, third, 0, true}, Case{01777, another, another, true},
                          Case{0777, 0, another, true}, Case{01755, 0, another, true}, Case{01775, 0, another, true}}) {
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder.file("of root"));
        std::filesystem::create_directory(folder.file("open"));
        folder.write("of root/target", "old");
        std::filesystem::create_symlink("../of root/target", folder.file("open/link"));
        std::filesystem::create_symlink("open/link", folder.file("own link"));
        ASSERT_EQ(lchown(folder.file("open/link").c_str(), c.link_owner, c.link_owner), 0);
        ASSERT_EQ(chown(folder.file("open").c_str(), c.folder_owner, c.folder_owner), 0);
        ASSERT_EQ(chmod(folder.file("open").c_str(), c.folder), 0);
        for (const char *path : {"open/link", "own link"}) {
            const Refusal refusal = refusal_of([&] { AtomicFile::check_writable(folder.file(path)); });
            EXPECT_EQ(refusal.message,
                      c.is_followed ? ""
                                    : "cannot write " + folder.file(path) + ": the link " + folder.file("open/link") +
                                          " belongs to another user, and everybody may write in its folder; use a "
                                          "link of your own or of the folder's owner")
                << path << ' ' << std::oct << c.folder << ' ' << std::dec << c.folder_owner << ' ' << c.link_owner;
        }
        EXPECT_EQ(folder.read("of root/target"), "old");
    }
}

TEST(AbandonedFiles, GoWhereNobodyWritesThem) {
    const TemporaryFolder folder;
    const std::filesystem::path of_folder = folder.file("");
    std::ofstream(of_folder / ".pt-123-0.tmp") << "half a picture";
    const char *const others[] = {".pt-123-0.tmp2", ".pt-123.tmp", ".pt-1a-0.tmp",
                                  ".pt-.tmp",       "pt-1-1.tmp",  ".pt--.tmp"};
    for (const char *name : others)
        std::ofstream(of_folder / name) << "not ours";
    cli::AtomicFile in_use(folder.file("a"));
    cli::AtomicFile::check_writable(folder.file("b"));
    EXPECT_FALSE(std::filesystem::exists(of_folder / ".pt-123-0.tmp"));
    for (const char *name : others)
        EXPECT_TRUE(std::filesystem::exists(of_folder / name)) << name;
    in_use.commit();
    EXPECT_TRUE(std::filesystem::exists(of_folder / "a"));
    EXPECT_EQ(folder.count(), 1 + static_cast<std::ptrdiff_t>(std::size(others)));
}

TEST(AbandonedFiles, AFileThatWasTakenForAbandonedIsNotUsed) {
    const TemporaryFolder folder;
    const int descriptor = open(folder.file("a").c_str(), O_WRONLY | O_CREAT, 0666);
    EXPECT_TRUE(platform::lock_created(descriptor));
    unlink(folder.file("a").c_str());
    EXPECT_FALSE(platform::lock_created(descriptor));
    close(descriptor);
}

// The test sets the times of files, because a file system's clock may be too coarse.
TEST(KernelFolder, WhatWasUsedLongestAgoMakesPlace) {
    using cli::KernelFolder;
    const TemporaryFolder temporary;
    const KernelFolder folder(temporary.file("kernels"));
    const auto key = [](std::size_t number) {
        return std::string(32 - std::to_string(number).size(), 'a') + std::to_string(number);
    };
    const auto path = [&](std::size_t number) {
        return std::filesystem::path(temporary.file("kernels/" + key(number)));
    };
    const auto keep = [&](std::size_t number) { folder.store(key(number), bytes("x")); };
    const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1000);
    for (std::size_t number = 0; number < KernelFolder::most_files; ++number) {
        keep(number);
        last_write_time(path(number), long_ago + std::chrono::hours(number));
    }
    std::byte used{};
    EXPECT_EQ(folder.load(key(0), {&used, 1}), 1U);
    keep(100);
    EXPECT_TRUE(exists(path(0)));
    EXPECT_FALSE(exists(path(1)));
    EXPECT_TRUE(exists(path(2)));
    EXPECT_TRUE(exists(path(100)));

    resize_file(path(2), KernelFolder::most_bytes);
    keep(101);
    EXPECT_FALSE(exists(path(2)));
    EXPECT_TRUE(exists(path(101)));
    resize_file(path(101), KernelFolder::most_bytes + 1);
    EXPECT_EQ(folder.load(key(101), {}), 0) << "no kernel of the program is as large";

    temporary.write("secret", "text");
    folder.store("../secret", bytes("x"));
    EXPECT_EQ(temporary.read("secret"), "text");
    EXPECT_EQ(folder.load("../secret", {}), 0) << "a key leads nowhere else";
}

TEST(Printable, ShowsWhatSteersTerminals) {
    using platform::printable;
    EXPECT_EQ(printable(std::string("a\0\x1b\n", 4)), "a<U+0000><U+001B><U+000A>");
    EXPECT_EQ(printable("\x9b!"), "<U+009B>!");
    EXPECT_EQ(printable("\xc0\x9b"), "<U+001B>"); // overlong
    EXPECT_EQ(printable("\xe2\x80"), "\xe2<U+0080>");
    EXPECT_EQ(printable("sc\xe8ne \u200d"), "sc\xe8ne \u200d");
    EXPECT_EQ(platform::printable_lines("a\n\x1b"), "a\n<U+001B>");
}

TEST(SourceFiles, AreShadersWithoutCopiesOfEditors) {
    const TemporaryFolder folder;
    EXPECT_TRUE(cli::shader_files("").empty());
    EXPECT_TRUE(cli::shader_files(folder.file("none")).empty());
    std::filesystem::create_directory(folder.file("sub"));
    for (const char *name : {"a.comp", "b.glsl", "c.h", "sub/d.glsl", "b.glsl~", ".b.glsl.swp", "README.md"})
        folder.write(name, "text");
    std::set<std::filesystem::path> shaders;
    for (const char *name : {"a.comp", "b.glsl", "c.h", "sub/d.glsl"})
        shaders.insert(folder.file(name));
    EXPECT_EQ(cli::shader_files(folder.file(".")), shaders);
}

} // namespace
