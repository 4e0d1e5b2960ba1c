// Files of independent writers hold the particles of cloud.csv, or those of one state of LAMMPS in two ways.
#include "cli/data/particle_file.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {

using cli::Failure;
using cli::ParticleQuery;
using cli::Particles;
using cli::read_particles;

std::string stored(const std::string &name) {
    return std::string(PT_TEST_DATA_DIR "/particles/").append(name);
}

ParticleQuery query_of(std::vector<std::string> columns, std::vector<std::string> where = {}) {
    ParticleQuery query;
    query.columns = std::move(columns);
    query.where = std::move(where);
    return query;
}

std::string message_of(const std::string &name, const std::string &text, const ParticleQuery &query = {},
                       cli::ExitCode code = cli::ExitCode::scene) {
    const TemporaryFolder folder;
    folder.write(name, text);
    try {
        read_particles(folder.file(name), query);
    } catch (const Failure &failure) {
        EXPECT_EQ(failure.code(), code);
        std::string message = failure.what();
        const std::size_t path = message.find(folder.file(""));
        return path == std::string::npos ? message : message.erase(path, folder.file("").size());
    }
    return "no failure";
}

void expect_near(const std::vector<double> &found, const std::vector<double> &expected, double tolerance) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], tolerance) << i;
}

constexpr const char *dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n0 1\n0 2\n0 4\n"
                             "ITEM: ATOMS id type x y z\n1 1 0.5 1 2\n2 2 0.25 1e-1 +3\n";

TEST(ParticleFile, FilesOfAllWritersHoldTheSame) {
    const Particles expected = read_particles(stored("cloud.csv"), query_of({"charge"}));
    ASSERT_EQ(expected.count(), 24U);
    struct Case {
        const char *name;
        double tolerance; // of half a unit of the last digit, at 5
    };
    for (const Case &each :
         {Case{"cloud.csv.gz", 0.0}, Case{"cloud.csv.zst", 0.0}, Case{"cloud.tsv", 0.0},
          Case{"cloud.extxyz", 1.0 + 0.5e-8}, Case{"rows.npy", 0.0}, Case{"columns.npy", 0.0}, Case{"big.npy", 0x1p-22},
          Case{"records.npy", 0.0}, Case{"stored.npz", 0.0}, Case{"deflated.npz", 0.0}, Case{"text.ply", 0.0},
          Case{"little.ply", 0.0}, Case{"big.ply", 0.0}, Case{"lists.ply", 0.0}, Case{"text_lists.ply", 0.0}}) {
        SCOPED_TRACE(each.name);
        const std::string name = each.name;
        const bool is_plain_array = name == "rows.npy" || name == "columns.npy" || name == "big.npy";
        ParticleQuery query = query_of({is_plain_array ? "3" : "charge"});
        query.frame = name == "cloud.extxyz" ? 0 : -1;
        const double tolerance = name == "cloud.extxyz" ? 0.5e-8 : each.tolerance;
        const Particles found = read_particles(stored(name), query);
        expect_near(found.positions, expected.positions, tolerance);
        ASSERT_EQ(found.columns.size(), 1U);
        ASSERT_EQ(found.columns[0].values.size(), expected.count());
        for (std::size_t i = 0; i < expected.count(); ++i)
            EXPECT_NEAR(found.columns[0].values[i], expected.columns[0].values[i], 1e-7) << i; // %.8f, and float
    }
}

TEST(ParticleFile, FramesAndBoxOfExtendedXyz) {
    ParticleQuery query = query_of({"type", "forces[2]"});
    const Particles last = read_particles(stored("cloud.extxyz"), query);
    query.frame = -2;
    const Particles first = read_particles(stored("cloud.extxyz"), query);
    for (std::size_t i = 0; i < first.positions.size(); ++i)
        EXPECT_NEAR(last.positions[i], first.positions[i] + 1.0, 1.1e-8); // two numbers of 8 digits
    EXPECT_EQ(first.type_names, (std::vector<std::string>{"O", "H"}));
    EXPECT_EQ(first.columns[0].values[3], 0.0F);
    EXPECT_EQ(first.columns[0].values[4], 1.0F);
    ASSERT_TRUE(first.box);
    EXPECT_EQ(first.box->edges[2], (std::array<double, 3>{2, 3, 8}));
    EXPECT_EQ(first.box->periodic, (std::array<bool, 3>{true, false, true}));
    query.frame = -3;
    EXPECT_THROW(read_particles(stored("cloud.extxyz"), query), Failure);
}

// LAMMPS wrote shares with 7 digits; the edges are no longer than 8, and a coordinate is the sum of three.
TEST(ParticleFile, ScaledPositionsAreThoseThatLammpsHas) {
    for (const char *name : {"melt", "tilted"}) {
        SCOPED_TRACE(name);
        const Particles scaled = read_particles(stored(std::string(name) + ".dump"), query_of({"id"}));
        const Particles plain = read_particles(stored(std::string(name) + "_plain.dump"), query_of({"id"}));
        EXPECT_EQ(scaled.columns[0].values, plain.columns[0].values);
        expect_near(scaled.positions, plain.positions, 3 * 8 * 0.5e-7);
    }
}

// tilted.dump was made of a box that reached from 0 by the edges, with xy 1.5, xz -0.7 and yz 0.9.
TEST(ParticleFile, TiltedBoxIsThatWithinItsBounds) {
    const auto box = read_particles(stored("tilted.dump"), {}).box;
    ASSERT_TRUE(box);
    for (const double component : box->origin)
        EXPECT_NEAR(component, 0.0, 1e-14);
    EXPECT_NEAR(box->edges[1][0], 1.5, 1e-14);
    EXPECT_NEAR(box->edges[2][0], -0.7, 1e-14);
    EXPECT_NEAR(box->edges[2][1], 0.9, 1e-14);
    const auto straight = read_particles(stored("melt.dump"), {}).box;
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(box->edges[i][i], straight->edges[i][i], 1e-14);
}

// What a box has, and where shares of it are, for boxes that do not begin at 0.
TEST(ParticleFile, BoxesOfTextAreThoseThatItSays) {
    const TemporaryFolder folder;
    const auto particles = [&folder](const std::string &name, const std::string &text) {
        folder.write(name, text);
        return read_particles(folder.file(name), {});
    };
    const std::string head = "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ";
    const std::string atoms = "ITEM: ATOMS id xs ys zs\n1 0.5 0.25 0.125\n";
    const Particles straight = particles("a.dump", head + "pp ff ps\n1 3\n-2 2\n10 18\n" + atoms);
    EXPECT_EQ(straight.positions, (std::vector<double>{2, -1, 11}));
    EXPECT_EQ(straight.box->origin, (std::array<double, 3>{1, -2, 10}));
    EXPECT_EQ(straight.box->periodic, (std::array<bool, 3>{true, false, false}));
    // The edges (2, 0, 0), (1, 4, 0) and (1, -2, 8) from (1, -2, 10) are within 1 to 5, -4 to 2 and 10 to 18.
    const Particles tilted = particles("a.dump", head + "xy xz yz pp pp pp\n1 5 1\n-4 2 1\n10 18 -2\n" + atoms);
    EXPECT_EQ(tilted.box->origin, (std::array<double, 3>{1, -2, 10}));
    EXPECT_EQ(tilted.box->edges[0], (std::array<double, 3>{2, 0, 0}));
    EXPECT_EQ(tilted.positions, (std::vector<double>{2.375, -1.25, 11}));
    const Particles general = particles("a.dump", head + "abc origin pp pp pp\n2 0 1 1\n0 4 0 -2\n1 0 8 10\n" + atoms);
    EXPECT_EQ(general.box->origin, (std::array<double, 3>{1, -2, 10}));
    EXPECT_EQ(general.box->edges[2], (std::array<double, 3>{1, 0, 8}));
    EXPECT_EQ(general.positions, (std::vector<double>{2.125, -1, 11.5}));
    const Particles xyz =
        particles("a.xyz", "1\nLattice=\"1 2 3 4 5 6 7 8 9\" Origin='-1 0 1' pbc={F T F} Properties=pos:R:3\n0 0 0\n");
    EXPECT_EQ(xyz.box->edges[1], (std::array<double, 3>{4, 5, 6}));
    EXPECT_EQ(xyz.box->origin, (std::array<double, 3>{-1, 0, 1}));
    EXPECT_EQ(xyz.box->periodic, (std::array<bool, 3>{false, true, false}));
    const Particles plain = particles("a.xyz", "1\nLattice=\"1 2 3 4 5 6 7 8 9\"\nH 0 0 0\n");
    EXPECT_EQ(plain.box->periodic, (std::array<bool, 3>{true, true, true}));
}

// On both sides of every bound, and on it.
TEST(ParticleFile, ConditionsEndWhereTheySay) {
    const TemporaryFolder folder;
    folder.write("a.csv", "x,y,z\n1,0,0\n2,0,0\n3,0,0\n");
    const auto kept = [&folder](const std::string &condition) {
        std::string xs;
        const Particles particles = read_particles(folder.file("a.csv"), query_of({}, {condition}));
        for (std::size_t i = 0; i < particles.count(); ++i)
            xs += std::to_string(static_cast<int>(particles.positions[3 * i]));
        return xs;
    };
    EXPECT_EQ(kept("x < 2"), "1");
    EXPECT_EQ(kept("x <= 2"), "12");
    EXPECT_EQ(kept("x > 2"), "3");
    EXPECT_EQ(kept("x >= 2"), "23");
    EXPECT_EQ(kept("x == 2"), "2");
    EXPECT_EQ(kept("x != 2"), "13");
}

TEST(ParticleFile, ArraysOfOtherLengthsAreNoColumns) {
    EXPECT_EQ(read_particles(stored("lengths.npz"), {}).positions, read_particles(stored("stored.npz"), {}).positions);
    for (const char *name : {"steps", "few", "name"})
        EXPECT_THROW(read_particles(stored("lengths.npz"), query_of({name})), Failure) << name;
}

TEST(ParticleFile, NumbersOfZipFilesHaveAChecksum) {
    std::ostringstream bytes;
    bytes << std::ifstream(stored("stored.npz"), std::ios::binary).rdbuf();
    std::string text = bytes.str();
    const std::size_t head = text.find("\x93NUMPY");
    EXPECT_EQ(message_of("a.npz", text), "no failure");
    text[head + 128 + 9 * 8] ^= 1; // the last bit of one of the first numbers
    EXPECT_NE(message_of("a.npz", text).find("damaged: its size or its checksum is not that of the directory"),
              std::string::npos);
}

TEST(ParticleFile, QuotesOfCsvMayHoldAnything) {
    const TemporaryFolder folder;
    folder.write("a.csv", "\"x\",y , z,name\n1, 2 ,\"3\",\"a \"\"b\"\", c\"\n4,5,6,d\n");
    const Particles particles = read_particles(folder.file("a.csv"), query_of({"name"}));
    EXPECT_EQ(particles.positions, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(particles.type_names, (std::vector<std::string>{"a \"b\", c", "d"}));
}

TEST(ParticleFile, ConditionsHoldTogether) {
    const Particles all = read_particles(stored("cloud.csv"), query_of({"element", "charge"}));
    const Particles some =
        read_particles(stored("cloud.csv"), query_of({"element", "charge"}, {"species == H", "z<1", "charge >= -0.5"}));
    std::vector<double> expected;
    for (std::size_t i = 0; i < all.count(); ++i)
        if (all.columns[0].values[i] == 1.0F && all.positions[3 * i + 2] < 1 && all.columns[1].values[i] >= -0.5F)
            expected.insert(expected.end(), &all.positions[3 * i], &all.positions[3 * i] + 3);
    ASSERT_FALSE(expected.empty());
    EXPECT_LT(expected.size(), all.positions.size() / 2);
    EXPECT_EQ(some.positions, expected);
    EXPECT_EQ(some.type_names, std::vector<std::string>{"H"}); // of what is kept
    // Words are numbered as they come in what is kept, also where a condition has named another one before.
    const Particles others = read_particles(stored("cloud.csv"), query_of({"element"}, {"species != O"}));
    EXPECT_EQ(others.type_names, std::vector<std::string>{"H"});
    EXPECT_EQ(others.columns[0].values, std::vector<float>(others.count(), 0.0F));
}

TEST(ParticleFile, MessagesNamePlaceValueAndRule) {
    const std::string text = dump;
    const auto changed = [&text](const std::string &from, const std::string &to) {
        return std::string(text).replace(text.find(from), from.size(), to);
    };
    EXPECT_EQ(message_of("a", text), "no failure");
    EXPECT_EQ(message_of("a", changed("+3", "nan")), "a:11: z = \"nan\": must be finite");
    EXPECT_EQ(message_of("a", changed("+3", "1e999")), "a:11: z = \"1e999\": must fit a 64-bit floating point number");
    EXPECT_EQ(message_of("a", changed("+3", "3x")), "a:11: z = \"3x\": must be a number");
    EXPECT_EQ(message_of("a", changed(" +3", "")), "a:11: \"2 2 0.25 1e-1\" has 4 values, must have 5");
    EXPECT_EQ(message_of("a", changed("+3", "3 4")), "a:11: \"2 2 0.25 1e-1 3 4\" has 6 values, must have 5");
    EXPECT_EQ(message_of("a", changed("+3\n", "3")), "a:11: the file ends after 1 of 2 particles: it was cut short");
    EXPECT_EQ(message_of("a", changed("\n2\n", "\n-2\n")),
              "a:4: the number of atoms = \"-2\": must be a whole number from 0");
    EXPECT_EQ(
        message_of("a", changed(" x y", " vx y")),
        "a:9: there is no position: the columns must have x, y, z, or xu, yu, zu, or xs, ys, zs, or xsu, ysu, zsu");
    EXPECT_EQ(message_of("a.csv", "x,y,z\n1,2\n"), "a.csv:2: has 2 fields, must have 3 like the first line");
    for (const char *number : {"nan", "inf", "-inf"})
        EXPECT_EQ(message_of("a.csv", std::string("x,y,z\n1,").append(number).append(",3\n")),
                  std::string("a.csv:2: y = \"").append(number).append("\": must be finite"));
    EXPECT_EQ(message_of("a.csv", "x,y,z\n1,2,\"3\n"),
              "a.csv:2: a quoted field must end in the line that it begins in");
    EXPECT_EQ(message_of("a.what", "x,y,z\n"), "a.what: neither its first bytes nor its name say which of lammps, xyz, "
                                               "ply, csv, tsv, npy, npz it is");
    EXPECT_EQ(message_of("a.csv", "x,y,z,c\n1,2,3,1e39\n", query_of({"c"})),
              "a.csv:2: c = 1e+39: must fit a 32-bit floating point number");
    EXPECT_EQ(message_of("a", text, query_of({"tipe"}), cli::ExitCode::usage),
              "a: unknown column \"tipe\", did you mean \"type\"?");
    EXPECT_EQ(message_of("a", text, query_of({}, {"type == Ar"}), cli::ExitCode::usage),
              "a: \"type == Ar\": the column type has numbers");
    EXPECT_EQ(message_of("a", text, query_of({}, {"type ="}), cli::ExitCode::usage).substr(0, 8), "\"type =\"");
}

TEST(ParticleFile, BinaryMessagesNameTheByte) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n";
    const std::size_t first = bytes.size();
    bytes.append(16, '\0').append("\0\0\x80\x7f", 4).append(4, '\0'); // the second y is infinite
    EXPECT_EQ(message_of("a", bytes), "a: byte " + std::to_string(first + 16) + ": y = inf: must be finite");
    EXPECT_EQ(message_of("a", bytes.substr(0, first + 23)),
              "a: byte " + std::to_string(first + 23) + ": the file ends after 1 of 2 particles: it was cut short");
}

TEST(ParticleFile, NumbersTooSmallAreZero) {
    const TemporaryFolder folder;
    folder.write("a.csv", "x,y,z\n1e-400,-.5,5e-324\n");
    EXPECT_EQ(read_particles(folder.file("a.csv"), {}).positions, (std::vector<double>{0.0, -0.5, 5e-324}));
}

} // namespace
