// Tests of film files (cli/film/film.h), beside those of the program (checkpoint_test.py): unpacked films, and an
// absurd size.
#include "cli/film/film.h"

#include "cli/base/exit_code.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

namespace {

using Bytes = std::vector<std::byte>;

// The exit code of the refusal, or nothing if the bytes are those.
std::optional<cli::ExitCode> refusal_of(const std::string &path, const Bytes &expected) {
    try {
        EXPECT_TRUE(cli::read_film_file(path) == expected);
        return std::nullopt;
    } catch (const cli::Failure &failure) {
        EXPECT_TRUE(std::string(failure.what()).find(path) != std::string::npos) << failure.what();
        return failure.code();
    }
}

TEST(FilmFile, IsReadUnpacked) {
    const TemporaryFolder folder;
    folder.write("a", std::string(1000, 'x'));
    EXPECT_EQ(refusal_of(folder.file("a"), Bytes(1000, std::byte{'x'})), std::nullopt);
}

// A frame says its own size: no memory is taken for what it cannot hold.
TEST(FilmFile, AnAbsurdSizeIsRefused) {
    const TemporaryFolder folder;
    std::string frame("\x28\xb5\x2f\xfd\xc0\x00", 6); // RFC 8878, 3.1.1.1: eight bytes of content size follow
    frame.append("\x00\x00\x00\x00\x00\x01\x00\x00", 8);
    frame.append(20, 'x');
    folder.write("a", frame);
    EXPECT_EQ(refusal_of(folder.file("a"), {}), cli::ExitCode::usage);
}

} // namespace
