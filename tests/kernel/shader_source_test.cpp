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
    const KernelCode embedded = pt::embedded_code();
    EXPECT_TRUE(std::ranges::equal(code.pathtrace, embedded.pathtrace));
    EXPECT_TRUE(std::ranges::equal(code.fold, embedded.fold));
    EXPECT_TRUE(std::ranges::equal(code.add, embedded.add));
    EXPECT_TRUE(std::ranges::equal(code.accuracy, embedded.accuracy));
    EXPECT_TRUE(code == embedded);
    EXPECT_NE(code.pathtrace.data(), embedded.pathtrace.data());
}

TEST_F(ShaderSourceTest, EachKernelCounts) {
    const KernelCode embedded = pt::embedded_code();
    shaders.replace("pathtrace.comp", "* held.film_scale", "* (2.0 * held.film_scale)");
    KernelCode code = compiled();
    EXPECT_FALSE(std::ranges::equal(code.pathtrace, embedded.pathtrace));
    EXPECT_TRUE(std::ranges::equal(code.fold, embedded.fold));
    EXPECT_TRUE(std::ranges::equal(code.add, embedded.add));
    EXPECT_FALSE(code == embedded);

    shaders.replace("pathtrace.comp", "* (2.0 * held.film_scale)", "* held.film_scale");
    shaders.replace("fold.comp", "uvec4 moved;", "uvec4 moved = uvec4(1u);");
    code = compiled();
    EXPECT_FALSE(std::ranges::equal(code.fold, embedded.fold));
    EXPECT_FALSE(code == embedded);

    shaders.replace("fold.comp", "uvec4 moved = uvec4(1u);", "uvec4 moved;");
    shaders.replace("accuracy.comp", "return sqrt(x)", "return x");
    code = compiled();
    EXPECT_FALSE(std::ranges::equal(code.accuracy, embedded.accuracy));
    EXPECT_FALSE(code == embedded);
}

TEST_F(ShaderSourceTest, CommentsDoNotCount) {
    shaders.replace("pathtrace.comp", "void main()", "// a remark\n\nvoid main()");
    EXPECT_TRUE(compiled() == pt::embedded_code());
}

TEST_F(ShaderSourceTest, TheEmbeddedCodeIsNotCopied) {
    EXPECT_EQ(ShaderSource("").read().pathtrace.data(), pt::embedded_code().pathtrace.data());
}

TEST_F(ShaderSourceTest, AnErrorNamesTheIncludedFileAndTheLine) {
    const std::string place = shaders.break_film();
    expect_complaint("pathtrace.comp does not compile:\nERROR: " + place);
    EXPECT_EQ(count_of("undeclared identifier", complaint()), 1U);
}

TEST_F(ShaderSourceTest, TheLogIsWhole) {
    const std::string first = shaders.break_film();
    shaders.replace("pathtrace.comp", "film_add(gathered, ", "film_add(gathered, gathered, ");
    expect_complaint(first);
    expect_complaint("'film_add' : no matching overloaded function found");
}

TEST_F(ShaderSourceTest, AMissingFileIsNamed) {
    shaders.replace("path.glsl", "\"phong.glsl\"", "\"gone/phong.glsl\"");
    expect_complaint(shaders.file("path.glsl") + ":");
    expect_complaint(shaders.file("gone/phong.glsl") + ": No such file or directory");
    std::filesystem::remove(shaders.file("pathtrace.comp"));
    expect_complaint(shaders.file("pathtrace.comp") + ": No such file or directory");
    std::filesystem::remove_all(shaders.path());
    expect_complaint(shaders.file("pathtrace.comp") + ": No such file or directory");
    std::filesystem::create_directory(shaders.path());
}

TEST_F(ShaderSourceTest, AFolderIsNoFile) {
    shaders.replace("path.glsl", "\"phong.glsl\"", "\"folder\"");
    std::filesystem::create_directory(shaders.file("folder"));
    expect_complaint(shaders.file("folder") + ": Is a directory");
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

TEST_F(ShaderSourceTest, AngleBracketsAreRefused) {
    shaders.replace("pathtrace.comp", "#include \"film.glsl\"", "#include <film.glsl>");
    expect_complaint("only #include \"name\" is supported");
}

TEST_F(ShaderSourceTest, AShaderWithoutMainIsRefused) {
    shaders.replace("fold.comp", "void main()", "void other()");
    expect_complaint(shaders.file("fold.comp") + ": ");
    expect_complaint("Missing entry point");
}

TEST_F(ShaderSourceTest, ThreadsMayCompileAtTheSameTime) {
    auto other = std::async(std::launch::async, [] { return ShaderSource(PT_TEST_SHADER_DIR).read(); });
    const KernelCode own = compiled();
    EXPECT_TRUE(own == other.get());
    EXPECT_TRUE(own == pt::embedded_code());
}

} // namespace
