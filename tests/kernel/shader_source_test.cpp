#include "lib/code/shader_source.h"

#include "lib/base/error.h"
#include "tests/api/shader_folder.h"
#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <future>
#include <string>

namespace {

using pt::KernelCode;
using pt::ShaderSource;

std::size_t count_of(const std::string &part, const std::string &text) {
    std::size_t count = 0;
    for (std::size_t place = text.find(part); place != std::string::npos; place = text.find(part, place + 1))
        ++count;
    return count;
}

class ShaderSourceTest : public testing::Test {
protected:
    KernelCode compiled() const { return ShaderSource(shaders.path()).read(); }

    std::string complaint() const {
        const pt::Error error = error_of([&] { compiled(); });
        EXPECT_EQ(pt::result_name(error.code()), std::string("PT_ERROR_SHADER"));
        return error.what();
    }

    void expect_complaint(const std::string &part) const {
        const std::string message = complaint();
        EXPECT_NE(message.find(part), std::string::npos) << message << "\nmust contain\n" << part;
    }

    ShaderFolder shaders;
};

TEST_F(ShaderSourceTest, CompilesToTheEmbeddedWords) {
    const KernelCode code = compiled();
    EXPECT_TRUE(code == pt::embedded_code());
    EXPECT_NE(code.pathtrace.data(), pt::embedded_code().pathtrace.data());
    EXPECT_EQ(ShaderSource("").read().pathtrace.data(), pt::embedded_code().pathtrace.data()) << "not copied";
    shaders.replace("fold.comp", "uvec4 moved;", "uvec4 moved = uvec4(1u);");
    EXPECT_FALSE(compiled() == pt::embedded_code());
}

TEST_F(ShaderSourceTest, TheLogIsWholeAndNamesTheIncludedFileAndTheLine) {
    const std::string place = shaders.break_film();
    expect_complaint("pathtrace.comp does not compile:\nERROR: " + place);
    EXPECT_EQ(count_of("undeclared identifier", complaint()), 1U);
    shaders.replace("pathtrace.comp", "film_add(gathered, ", "film_add(gathered, gathered, ");
    expect_complaint(place);
    expect_complaint("'film_add' : no matching overloaded function found");
}

TEST_F(ShaderSourceTest, RefusalsNameTheFileAndTheReason) {
    std::filesystem::create_directory(shaders.file("folder"));
    const struct {
        const char *file, *part, *instead;
        std::string reason;
    } cases[] = {{"path.glsl", "\"phong.glsl\"", "\"gone/phong.glsl\"",
                  shaders.file("gone/phong.glsl") + ": No such file or directory"},
                 {"path.glsl", "\"phong.glsl\"", "\"folder\"", shaders.file("folder") + ": Is a directory"},
                 {"pathtrace.comp", "\"film.glsl\"", "<film.glsl>", "only #include \"name\" is supported"},
                 {"fold.comp", "void main()", "void other()", "Missing entry point"}};
    for (const auto &[file, part, instead, reason] : cases) {
        shaders.replace(file, part, instead);
        const std::string message = complaint();
        EXPECT_NE(message.find(shaders.file(file) + ":"), std::string::npos) << message;
        EXPECT_NE(message.find(reason), std::string::npos) << message;
        shaders.replace(file, instead, part);
    }
}

// Include guards do not end this recursion, so the compiler must.
TEST_F(ShaderSourceTest, AnEndlessIncludeIsRefused) {
    shaders.write("circle.glsl", "#ifndef CIRCLE\n#define CIRCLE\n#include \"arc.glsl\"\n#endif\n");
    shaders.write("arc.glsl", "#include \"circle.glsl\"\n#include \"circle.glsl\"\n");
    shaders.replace("pathtrace.comp", "#include \"film.glsl\"", "#include \"circle.glsl\"\n#include \"film.glsl\"");
    EXPECT_TRUE(compiled() == pt::embedded_code());
    shaders.write("circle.glsl", "#include \"arc.glsl\"\n#include \"arc.glsl\"\n");
    expect_complaint("the file includes itself, without an include guard");
    expect_complaint(shaders.file("arc.glsl") + ":1: ");
    EXPECT_EQ(count_of("includes itself", complaint()), 1U);
}

TEST_F(ShaderSourceTest, IncludedFilesAreFoundInTwoPlaces) {
    std::filesystem::create_directory(shaders.file("parts"));
    std::filesystem::rename(shaders.file("path.glsl"), shaders.file("parts/path.glsl"));
    for (const char *including : {"pathtrace.comp", "tree_path.glsl"})
        shaders.replace(including, "\"path.glsl\"", "\"parts/path.glsl\"");
    EXPECT_TRUE(compiled() == pt::embedded_code());
    shaders.write("parts/phong.glsl", "#error beside it\n");
    expect_complaint(shaders.file("parts/phong.glsl") + ":1: '#error' : beside it");
}

TEST_F(ShaderSourceTest, ThreadsMayCompileAtTheSameTime) {
    auto other = std::async(std::launch::async, [] { return ShaderSource(PT_TEST_SHADER_DIR).read(); });
    const KernelCode own = compiled();
    EXPECT_TRUE(own == other.get());
    EXPECT_TRUE(own == pt::embedded_code());
}

} // namespace
