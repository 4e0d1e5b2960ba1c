// Tests of cli/atomic_file.
#include "cli/base/atomic_file.h"

#include "cli/base/exit_code.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <string_view>
#include <sys/resource.h>
#include <sys/stat.h>

namespace {

using cli::AtomicFile;

std::span<const std::byte> bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

// The message, or nothing if the file can be written.
std::string refusal_of(const std::string &path) {
    try {
        AtomicFile::check_writable(path);
    } catch (const cli::Failure &failure) {
        EXPECT_EQ(failure.code(), cli::ExitCode::file);
        return failure.what();
    }
    return "";
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

TEST(AtomicFile, CheckLeavesNothing) {
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of(folder.file("a")), "");
    EXPECT_EQ(folder.count(), 0);
}

TEST(AtomicFile, RefusesWhatCannotBeReplaced) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("folder"));
    ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
    folder.write("plain", "");
    EXPECT_EQ(refusal_of(folder.file("folder")), "cannot write " + folder.file("folder") + ": Is a directory");
    EXPECT_EQ(refusal_of(folder.file("pipe")), "cannot write " + folder.file("pipe") + ": not a regular file");
    EXPECT_EQ(refusal_of(folder.file("none/a")),
              "cannot write " + folder.file("none/a") + ": No such file or directory");
    EXPECT_EQ(refusal_of(folder.file("plain/a")), "cannot write " + folder.file("plain/a") + ": Not a directory");
    EXPECT_NE(refusal_of("/proc/a"), "");
    EXPECT_NE(refusal_of("/dev/null"), "");
    EXPECT_EQ(refusal_of(folder.file("plain")), "");
}

// A full disk, as far as a test without a disk of its own can have one.
TEST(AtomicFile, SurvivesAFailedWrite) {
    const TemporaryFolder folder;
    folder.write("a", "old");
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const rlimit small{1000, old.rlim_max};
    std::string message;
    {
        AtomicFile file(folder.file("a"));
        setrlimit(RLIMIT_FSIZE, &small);
        try {
            file.write(bytes(std::string(4096, 'x')));
        } catch (const cli::Failure &failure) {
            message = failure.what();
        }
        setrlimit(RLIMIT_FSIZE, &old);
    }
    std::signal(SIGXFSZ, SIG_DFL);
    EXPECT_EQ(message, "cannot write " + folder.file("a") + ": File too large");
    EXPECT_EQ(folder.read("a"), "old");
    EXPECT_EQ(folder.count(), 1);
}

} // namespace
