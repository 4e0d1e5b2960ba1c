// Files that were cut short or changed: they are refused, or read as what they say.
#include "cli/data/particle_file.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using cli::Particles;

const std::array<const char *, 19> damaged_names{
    "cloud.csv",   "cloud.csv.gz", "cloud.csv.zst", "cloud.tsv",   "cloud.xyz",     "cloud.extxyz", "melt.dump",
    "tilted.dump", "rows.npy",     "columns.npy",   "records.npy", "stored.npz",    "deflated.npz", "text.ply",
    "little.ply",  "big.ply",      "big.npy",       "lists.ply",   "text_lists.ply"};

std::size_t damage_count() {
    return std::getenv("PT_TEST_MANY") != nullptr ? 5000 : 200;
}

std::string bytes_of(const std::string &name) {
    std::ostringstream bytes;
    bytes << std::ifstream(std::string(PT_TEST_DATA_DIR "/particles/").append(name), std::ios::binary).rdbuf();
    return bytes.str();
}

// What is read of such bytes; nothing if they are refused.
std::optional<Particles> particles_of(const TemporaryFolder &folder, const std::string &name,
                                      const std::string &bytes) {
    std::filesystem::remove(folder.file(name)); // what is written over an old file waits for the disk on ext4
    folder.write(name, bytes);
    cli::ParticleQuery query;
    query.if_present = {"charge", "type"};
    try {
        return cli::read_particles(folder.file(name), query);
    } catch (const cli::Failure &failure) {
        EXPECT_EQ(failure.code(), cli::ExitCode::scene) << failure.what();
        EXPECT_NE(std::string(failure.what()).find(folder.file(name)), std::string::npos) << failure.what();
        return std::nullopt;
    }
}

// Text without a number of particles can be cut at a line's end, and the last number of a line that has no end may have
// lost digits: it holds the first particles then.
bool is_begin(const Particles &part, const Particles &whole) {
    const std::size_t certain = part.positions.size() - std::min<std::size_t>(part.positions.size(), 3);
    return part.positions.size() <= whole.positions.size() &&
           std::equal(part.positions.begin(), part.positions.begin() + static_cast<std::ptrdiff_t>(certain),
                      whole.positions.begin());
}

TEST(DamagedFile, CutShortIsRefusedOrABegin) {
    const TemporaryFolder folder;
    std::mt19937 random(1);
    for (const std::string name : damaged_names) {
        SCOPED_TRACE(name);
        const std::string bytes = bytes_of(name);
        const auto whole = particles_of(folder, name, bytes);
        ASSERT_TRUE(whole);
        const bool has_frames = name == "melt.dump" || name == "cloud.extxyz";
        const bool may_be_shorter = name == "cloud.csv" || name == "cloud.tsv";
        std::size_t refused = 0;
        for (std::size_t i = 0; i < damage_count(); ++i) {
            const std::size_t size = std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random);
            const auto part = particles_of(folder, name, bytes.substr(0, size));
            refused += part ? 0 : 1;
            if (part && !has_frames) {
                EXPECT_TRUE(is_begin(*part, *whole)) << size;
                EXPECT_TRUE(may_be_shorter || part->count() == whole->count()) << size;
            }
        }
        EXPECT_GT(refused, may_be_shorter ? damage_count() / 4 : damage_count() / 2);
    }
}

TEST(DamagedFile, ChangedBytesDoNoHarm) {
    const TemporaryFolder folder;
    std::mt19937 random(2);
    for (const std::string name : damaged_names) {
        SCOPED_TRACE(name);
        const std::string bytes = bytes_of(name);
        const auto below = [&random](std::size_t end) {
            return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
        };
        std::size_t refused = 0;
        for (std::size_t i = 0; i < damage_count(); ++i) {
            std::string changed = bytes;
            // Half of them in the head, where sizes and types stand.
            const std::size_t end = i % 2 == 0 ? changed.size() : std::min<std::size_t>(changed.size(), 300);
            for (std::size_t change = 0; change <= i % 3; ++change)
                changed[below(end)] = static_cast<char>(below(256));
            const auto particles = particles_of(folder, name, changed);
            refused += particles ? 0 : 1;
            const std::vector<double> positions = particles ? particles->positions : std::vector<double>();
            EXPECT_TRUE(std::all_of(positions.begin(), positions.end(), [](double x) { return std::isfinite(x); }));
        }
        EXPECT_GT(refused, 0U);
    }
}

} // namespace
