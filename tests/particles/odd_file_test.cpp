// Files as editors, pipes, packers and hostile hands leave them.
#include "cli/data/particle_file.h"
#include "tests/cli/temporary_folder.h"
#include "tests/particles/packed_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fcntl.h>
#include <functional>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using cli::Particles;

std::string text_of(const std::string &name) {
    std::ostringstream text;
    text << std::ifstream(std::string(PT_TEST_DATA_DIR "/particles/").append(name), std::ios::binary).rdbuf();
    return text.str();
}

Particles particles_in(const std::string &name, const std::string &bytes, std::int64_t frame = -1) {
    const TemporaryFolder folder;
    folder.write(name, bytes);
    cli::ParticleQuery query;
    query.frame = frame;
    return cli::read_particles(folder.file(name), query);
}

std::string refusal(const std::function<void()> &read) {
    try {
        read();
    } catch (const cli::Failure &failure) {
        const std::string message = failure.what();
        return message.substr(message.rfind("/") + 1); // without the folder
    }
    return "no failure";
}

std::string refusal_of(const std::string &name, const std::string &bytes, std::int64_t frame = -1) {
    return refusal([&] { particles_in(name, bytes, frame); });
}

// Where lines do not end so already.
std::string with_returns(const std::string &text) {
    std::string changed;
    for (const char c : text) {
        if (c == '\n' && !changed.ends_with('\r'))
            changed += '\r';
        changed += c;
    }
    return changed;
}

// Lines of all lengths up to 100 or so, and several times as many as fit the buffer of a stream.
constexpr std::size_t long_count = 60000;

std::string long_rows(const std::string &separator) {
    std::string rows;
    for (std::size_t i = 0; i < long_count; ++i)
        rows += std::to_string(i) + separator + std::string(i % 67, ' ') + "-0.5" + separator +
                std::to_string(i % 1000) + ".25\n";
    return rows;
}

void expect_long(const Particles &particles) {
    ASSERT_EQ(particles.count(), long_count);
    for (std::size_t i = 0; i < long_count; ++i) {
        ASSERT_EQ(particles.positions[3 * i], static_cast<double>(i));
        ASSERT_EQ(particles.positions[3 * i + 1], -0.5);
        ASSERT_EQ(particles.positions[3 * i + 2], static_cast<double>(i % 1000) + 0.25);
    }
}

struct LongText {
    std::string name;
    std::string text;
};

std::vector<LongText> long_texts() {
    const std::string count = std::to_string(long_count);
    return {{"a.csv", "x,y,z\n" + long_rows(",")},
            {"a.dump", "ITEM: NUMBER OF ATOMS\n" + count + "\nITEM: ATOMS x y z\n" + long_rows(" ")},
            {"a.extxyz", count + "\nProperties=pos:R:3\n" + long_rows(" ")}};
}

// Frame i has one particle, at x = i.
std::string many_frames(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += "1\nframe\nH " + std::to_string(i) + " 0 0\n";
    return text;
}

// Reads of a pipe into which another thread writes, a few bytes at a time.
Particles particles_of_pipe(const std::string &bytes, const std::string &format, std::int64_t frame) {
    const TemporaryFolder folder;
    const std::string path = folder.file("pipe");
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    std::thread writer([&bytes, &path] {
        const int pipe = open(path.c_str(), O_WRONLY);
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = write(pipe, bytes.data() + done, std::min<std::size_t>(bytes.size() - done, 4099));
            if (count < 0)
                break; // nobody reads on
            done += static_cast<std::size_t>(count);
        }
        close(pipe);
    });
    cli::ParticleQuery query;
    query.format = format;
    query.frame = frame;
    try {
        Particles particles = cli::read_particles(path, query);
        writer.join();
        return particles;
    } catch (...) {
        writer.join();
        throw;
    }
}

TEST(OddFile, MarksAndReturnsDoNotMatter) {
    for (const std::string name : {"cloud.csv", "cloud.tsv", "cloud.xyz", "cloud.extxyz", "melt.dump", "text.ply"}) {
        SCOPED_TRACE(name);
        const std::string text = text_of(name);
        const std::vector<double> expected = particles_in(name, text).positions;
        EXPECT_FALSE(expected.empty());
        EXPECT_EQ(particles_in(name, with_returns(text)).positions, expected);
        EXPECT_EQ(particles_in(name, "\xef\xbb\xbf" + text).positions, expected);
        EXPECT_EQ(particles_in(name, packed::gzip("\xef\xbb\xbf" + with_returns(text))).positions, expected);
    }
    EXPECT_EQ(refusal_of("a.csv", std::string("\xff\xfex\0,\0", 6)), "a.csv: is UTF-16: save it as UTF-8");
    EXPECT_EQ(refusal_of("a.xyz", std::string("\xfe\xff\0"
                                              "1",
                                              4)),
              "a.xyz: is UTF-16: save it as UTF-8");
}

TEST(OddFile, LinesMayLieAcrossBuffers) {
    for (const LongText &each : long_texts()) {
        SCOPED_TRACE(each.name);
        expect_long(particles_in(each.name, each.text));
        expect_long(particles_in(each.name, packed::gzip(each.text)));
        expect_long(particles_in(each.name, packed::zstd(each.text)));
    }
}

TEST(OddFile, PiecesThatWerePackedApartAreOneFile) {
    const LongText text = long_texts()[0];
    expect_long(particles_in(text.name, packed::in_pieces(packed::gzip, text.text, 99991)));
    expect_long(particles_in(text.name, packed::in_pieces(packed::zstd, text.text, 99991)));
    // The last piece is longer than what is left of a buffer, and has been taken in as a whole.
    const std::string part = text.text.substr(0, text.text.find('\n', 1090000) + 1);
    const auto count = static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n')) - 1;
    EXPECT_EQ(particles_in(text.name, packed::in_pieces(packed::zstd, part, 99991)).count(), count);
    EXPECT_EQ(particles_in(text.name, packed::in_pieces(packed::gzip, part, 99991)).count(), count);
    const std::string gzip = packed::in_pieces(packed::gzip, text.text, 99991);
    EXPECT_EQ(refusal_of("a.csv", gzip.substr(0, gzip.size() - 1)),
              "a.csv: cut short: the compressed data end in the middle");
    EXPECT_EQ(refusal_of("a.csv", gzip + "more").substr(0, 15), "a.csv: damaged:");
}

TEST(OddFile, PipesAreReadOnce) {
    expect_long(particles_of_pipe(long_texts()[1].text, "lammps", -1));
    expect_long(particles_of_pipe(packed::gzip(long_texts()[0].text), "csv", 0));
    EXPECT_EQ(particles_of_pipe(many_frames(300), "xyz", -1).positions[0], 299.0);
    EXPECT_EQ(particles_of_pipe(many_frames(3), "xyz", 1).positions[0], 1.0);
    EXPECT_EQ(refusal([] { particles_of_pipe(many_frames(3), "xyz", -2); }),
              "pipe: frame -2: of what is no file that can be read twice, it must be -1 or at least 0");
}

TEST(OddFile, FramesAreCountedFromBothEnds) {
    constexpr std::int64_t count = 5000;
    const std::string text = many_frames(count);
    for (const std::string &bytes : {text, packed::gzip(text)}) {
        for (const std::int64_t frame : {std::int64_t{0}, std::int64_t{1}, count - 1, std::int64_t{-1},
                                         std::int64_t{-2}, std::int64_t{-1234}, -count}) {
            const auto expected = static_cast<double>(frame < 0 ? count + frame : frame);
            EXPECT_EQ(particles_in("a.xyz", bytes, frame).positions, (std::vector<double>{expected, 0, 0})) << frame;
        }
        for (const std::int64_t frame : {count, -count - 1, INT64_MIN, INT64_MAX})
            EXPECT_EQ(refusal_of("a.xyz", bytes, frame),
                      "a.xyz: frame " + std::to_string(frame) + ": the file has 5000 frames, from 0 or -5000 to 4999");
    }
    // What is wrong in another frame than the wanted one does not matter.
    const std::string second_is_good = "1\n\nH 0 zero 0\n" + many_frames(1);
    EXPECT_EQ(particles_in("a.xyz", second_is_good).count(), 1U);
    EXPECT_EQ(particles_in("a.xyz", packed::gzip(second_is_good)).count(), 1U);
    EXPECT_EQ(refusal_of("a.xyz", packed::gzip(second_is_good), 0), "a.xyz:3: y = \"zero\": must be a number");
    // Lines are counted from the begin of the file all the same.
    EXPECT_EQ(refusal_of("a.xyz", packed::zstd("1\n\nH 0 zero 0\n")), "a.xyz:3: y = \"zero\": must be a number");
    EXPECT_EQ(refusal_of("a.xyz", many_frames(7) + "1\n\nH 0 zero 0\n"), "a.xyz:24: y = \"zero\": must be a number");
}

TEST(OddFile, FramesWithoutParticlesAreEmpty) {
    EXPECT_EQ(particles_in("a.xyz", "0\nnothing\n" + many_frames(1), 0).count(), 0U);
    EXPECT_EQ(particles_in("a.xyz", many_frames(1) + "0\n\n").count(), 0U);
    EXPECT_EQ(particles_in("a.dump", "ITEM: NUMBER OF ATOMS\n0\nITEM: ATOMS x y z\n").count(), 0U);
    EXPECT_EQ(particles_in("a.csv", "x,y,z\n\n").count(), 0U);
    EXPECT_EQ(particles_in("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                                    "property float z\nend_header\n")
                  .count(),
              0U);
}

TEST(OddFile, SizesInHeadsAreNotTrusted) {
    const std::string most = "18446744073709551615";
    EXPECT_EQ(refusal_of("a.dump", "ITEM: NUMBER OF ATOMS\n" + most + "\nITEM: ATOMS x y z\n1 2 3\n"),
              "a.dump:4: the file ends after 1 of " + most + " particles: it was cut short");
    EXPECT_EQ(refusal_of("a.xyz", most + "\n\nH 1 2 3\n", 0),
              "a.xyz:3: the file ends after 1 of " + most + " particles: it was cut short");
    const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " + most +
                            "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    EXPECT_EQ(refusal_of("a.ply", ply + std::string(30, '\0')), "a.ply: byte " + std::to_string(ply.size() + 30) +
                                                                    ": the file ends after 2 of " + most +
                                                                    " particles: it was cut short");
    EXPECT_EQ(refusal_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int l\n"
                                  "property float x\nproperty float y\nproperty float z\nend_header\n" +
                                      most + " 1 2 3\n"),
              "a.ply:9: \"" + most + " 1 2 3\" has no x");
    std::string properties = "Properties=pos:R:3";
    for (int i = 0; i < 65; ++i)
        properties += ":a:R:1024";
    EXPECT_EQ(refusal_of("a.xyz", "1\n" + properties + "\n1 2 3\n"),
              "a.xyz:2: Properties: there are more than 65536 columns");
}

TEST(OddFile, ColumnsThatAreThereTwiceAreNotGuessed) {
    EXPECT_EQ(refusal_of("a.csv", "x,y,x,z\n1,2,3,4\n"), "a.csv:1: there are two columns \"x\"");
    EXPECT_EQ(refusal_of("a.dump", "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x y z z\n1 2 3 4\n"),
              "a.dump:3: there are two columns \"z\"");
    EXPECT_EQ(particles_in("a.csv", "x,y,z,,\n1,2,3,,\n").count(), 1U); // nobody asks for them
    EXPECT_EQ(particles_in("a.csv", "x,X,y,z\n1,2,3,4\n").positions[0], 1.0);
}

TEST(OddFile, DecimalCommasAreNamed) {
    EXPECT_EQ(refusal_of("a.csv", "x;y;z\n1;2,5;3\n"), "a.csv:2: y = \"2,5\": must be a number, with a decimal point");
    EXPECT_EQ(particles_in("a.csv", "x;y;z\n1;2.5;3\n").positions[1], 2.5);
}

} // namespace
