#include "cli/render/source_watch.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>

namespace cli {
namespace {

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

TEST(SourceWatch, ComparesContentsWithTheBeginning) {
    const TemporaryFolder folder;
    folder.write("scene", "1");
    SourceWatch sources(folder.file("scene"), "");
    // The third call, at the latest, looks at the files. The next call finds that they no longer change.
    const auto expect_nothing = [&] {
        for (int call = 0; call < 6; ++call)
            EXPECT_FALSE(sources.changed(std::chrono::milliseconds{100}));
    };
    std::filesystem::last_write_time(folder.file("scene"), std::filesystem::file_time_type::clock::now());
    expect_nothing();
    folder.write("scene", "2");
    folder.write("scene", "1");
    expect_nothing();
    folder.write("scene", "2");
    sources.begin();
    expect_nothing();
}

} // namespace
} // namespace cli
