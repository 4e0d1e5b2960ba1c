// Tests of cli/base/abandoned_files: what killed programs have left goes, and nothing else.
#include "cli/base/atomic_file.h"

#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <string_view>
#include <unistd.h>

namespace {

TEST(AbandonedFiles, GoWhereNobodyWritesThem) {
    const TemporaryFolder folder;
    const std::filesystem::path of_folder = folder.file("");
    std::ofstream(of_folder / ".pt-123-0.tmp") << "half a picture";
    const char *const others[] = {".pt-123-0.tmp2", ".pt-123.tmp", ".pt-1a-0.tmp",
                                  ".pt-.tmp",       "pt-1-1.tmp",  ".pt--.tmp"};
    for (const char *name : others) {
        std::ofstream(of_folder / name) << "not ours";
    }
    cli::AtomicFile in_use(folder.file("a"));
    cli::AtomicFile::check_writable(folder.file("b"));
    EXPECT_FALSE(std::filesystem::exists(of_folder / ".pt-123-0.tmp"));
    for (const char *name : others) {
        EXPECT_TRUE(std::filesystem::exists(of_folder / name)) << name;
    }
    in_use.commit();
    EXPECT_TRUE(std::filesystem::exists(of_folder / "a"));
    EXPECT_EQ(folder.count(), 1 + static_cast<std::ptrdiff_t>(std::size(others)));
}

TEST(AbandonedFiles, AFileThatWasTakenForAbandonedIsNotUsed) {
    const TemporaryFolder folder;
    const int descriptor = open(folder.file("a").c_str(), O_WRONLY | O_CREAT, 0666);
    EXPECT_TRUE(cli::lock_temporary(descriptor));
    unlink(folder.file("a").c_str());
    EXPECT_FALSE(cli::lock_temporary(descriptor));
    close(descriptor);
}

TEST(AbandonedFiles, AFolderThatIsNotThereIsNoMatter) {
    const TemporaryFolder folder;
    cli::remove_abandoned(folder.file("none"));
    EXPECT_EQ(folder.count(), 0);
}

} // namespace
