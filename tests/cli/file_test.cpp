#include "cli/base/file.h"
#include "tests/cli/refusal_of.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fcntl.h>
#include <string_view>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

using cli::AtomicFile;

std::span<const std::byte> bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

std::string write_refusal(const std::string &path) {
    const Refusal refused = refusal_of([&] { AtomicFile::check_writable(path); });
    EXPECT_TRUE(refused.message.empty() || refused.code == cli::ExitCode::file);
    return refused.message;
}

TEST(AtomicFile, AppearsWhole) {
    const TemporaryFolder folder;
    AtomicFile file(folder.file("a"));
    file.write(bytes("one "));
    file.write(bytes("two"));
    EXPECT_FALSE(std::filesystem::exists(folder.file("a")));
    file.commit();
    EXPECT_EQ(folder.read("a"), "one two");
    EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, LeavesTheOldFileUnlessCommitted) {
    const TemporaryFolder folder;
    folder.write("a", "old");
    {
        AtomicFile file(folder.file("a"));
        file.write(bytes("new"));
        EXPECT_EQ(folder.count(), 2);
    }
    EXPECT_EQ(folder.read("a"), "old");
    EXPECT_EQ(folder.count(), 1);
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
            const std::string refusal = write_refusal(folder.file(path));
            EXPECT_EQ(refusal, c.is_followed
                                   ? ""
                                   : "cannot write " + folder.file(path) + ": the link " + folder.file("open/link") +
                                         " belongs to another user, and everybody may write in its folder; use a "
                                         "link of your own or of the folder's owner")
                << path << ' ' << std::oct << c.folder << ' ' << std::dec << c.folder_owner << ' ' << c.link_owner;
        }
        EXPECT_EQ(folder.read("of root/target"), "old");
    }
}

TEST(AtomicFile, RefusesWhatCannotBeReplaced) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("folder"));
    ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
    folder.write("plain", "");
    EXPECT_EQ(write_refusal(folder.file("folder")), "cannot write " + folder.file("folder") + ": Is a directory");
    EXPECT_EQ(write_refusal(folder.file("pipe")), "cannot write " + folder.file("pipe") + ": not a regular file");
    EXPECT_EQ(write_refusal(folder.file("none/a")),
              "cannot write " + folder.file("none/a") + ": No such file or directory");
    EXPECT_EQ(write_refusal(folder.file("plain/a")), "cannot write " + folder.file("plain/a") + ": Not a directory");
    EXPECT_NE(write_refusal("/proc/a"), "");
    EXPECT_NE(write_refusal("/dev/null"), "");
    EXPECT_EQ(write_refusal(folder.file("plain")), "");
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

} // namespace
