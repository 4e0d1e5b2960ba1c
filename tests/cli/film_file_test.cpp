#include "cli/film/film.h"

#include "tests/cli/refusal_of.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

namespace {

TEST(FilmFile, AnAbsurdSizeIsRefused) {
    const TemporaryFolder folder;
    std::string frame("\x28\xb5\x2f\xfd\xc0\x00", 6); // RFC 8878, 3.1.1.1: the size follows in eight bytes
    frame.append("\x00\x00\x00\x00\x00\x01\x00\x00", 8);
    frame.append(20, 'x');
    folder.write("a", frame);
    const Refusal refused = refusal_of([&] { cli::read_film_file(folder.file("a")); });
    EXPECT_EQ(refused.code, cli::ExitCode::usage);
    EXPECT_NE(refused.message.find(folder.file("a")), std::string::npos) << refused.message;
}

} // namespace
