#include "cli/render/source_watch.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds long_enough = std::chrono::minutes{10};

TEST(SourceFiles, AreTheSceneAndTheShaders) {
    const TemporaryFolder folder;
    folder.write("scene", "{}");
    EXPECT_EQ(shader_files(""), std::set<std::filesystem::path>());
    EXPECT_EQ(shader_files(folder.file("none")), std::set<std::filesystem::path>());

    std::filesystem::create_directory(folder.file("sub"));
    for (const char *name : {"a.comp", "b.glsl", "c.h", "sub/d.glsl", "b.glsl~", ".b.glsl.swp", "README.md"})
        folder.write(name, "text");
    EXPECT_EQ(shader_files(folder.file(".")),
              (std::set<std::filesystem::path>{folder.file("a.comp"), folder.file("b.glsl"), folder.file("c.h"),
                                               folder.file("sub/d.glsl")}));
}

class SourceWatchTest : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder.file("shaders"));
        folder.write("scene", "1");
        folder.write("shaders/pathtrace.comp", "#include \"part.glsl\"\n");
    }

    SourceWatch watch() const { return {folder.file("scene"), folder.file("shaders")}; }

    static void expect_change(SourceWatch &watch, const std::vector<std::string> &names) {
        const auto end = std::chrono::steady_clock::now() + long_enough;
        while (!watch.changed(long_enough))
            ASSERT_LT(std::chrono::steady_clock::now(), end);
        EXPECT_EQ(watch.changed_names(), names);
        watch.begin();
        EXPECT_FALSE(watch.changed(milliseconds{0}));
    }

    // The third call, at the latest, looks at the files. The next call finds that they no longer change.
    static void expect_nothing(SourceWatch &watch) {
        for (int call = 0; call < 6; ++call)
            EXPECT_FALSE(watch.changed(milliseconds{100}));
    }

    TemporaryFolder folder;
};

TEST_F(SourceWatchTest, PassesOverWhatIsNoChange) {
    SourceWatch sources = watch();
    folder.write("scene", "1");
    folder.write("shaders/other", "text");
    std::filesystem::last_write_time(folder.file("scene"), std::filesystem::file_time_type::clock::now());
    expect_nothing(sources);
    folder.write("scene", "2");
    expect_change(sources, {folder.file("scene")});
}

TEST_F(SourceWatchTest, ComparesWithTheBeginning) {
    SourceWatch sources = watch();
    folder.write("scene", "2");
    folder.write("scene", "1");
    expect_nothing(sources);
    folder.write("scene", "2");
    sources.begin();
    expect_nothing(sources);
}

} // namespace
} // namespace cli
