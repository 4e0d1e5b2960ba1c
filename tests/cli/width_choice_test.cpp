#include "cli/base/exit_code.h"
#include "cli/base/kept_width.h"
#include "cli/base/vector_width.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

namespace {

using Variables = std::map<std::string, std::string>;

constexpr const char *names[] = {"HOME", "XDG_CACHE_HOME", "LP_NATIVE_VECTOR_WIDTH", "MESA_SHADER_CACHE_DIR",
                                 "MESA_SHADER_CACHE_DISABLE"};

class VectorWidth : public testing::Test {
protected:
    VectorWidth() { before = present(); }
    ~VectorWidth() override { set(before); }

    static Variables present() {
        Variables variables;
        for (const char *name : names)
            if (const char *value = std::getenv(name))
                variables.emplace(name, value);
        return variables;
    }

    static void set(const Variables &variables) {
        for (const char *name : names)
            unsetenv(name);
        for (const auto &[name, value] : variables)
            setenv(name.c_str(), value.c_str(), 1);
    }

    static Variables added(const Variables &variables) {
        set(variables);
        const cli::VectorWidth width({}, true);
        Variables more = present();
        std::erase_if(more, [&](const auto &each) {
            const auto found = variables.find(each.first);
            return found != variables.end() && found->second == each.second;
        });
        return more;
    }

    TemporaryFolder folder;
    Variables before;
};

TEST_F(VectorWidth, IsWideUnlessTheUserChoseAndHasACacheOfItsOwn) {
    const std::string home = folder.file("home");
    const std::string other = folder.file("x");
    folder.write("file", "");
    const std::pair<Variables, std::string> caches[] = {
        {{{"HOME", home}}, home + "/.cache/pt/shaders-512"},
        {{{"HOME", home}, {"XDG_CACHE_HOME", other}}, other + "/pt/shaders-512"},
        {{{"XDG_CACHE_HOME", other}}, other + "/pt/shaders-512"},
        {{{"HOME", home}, {"XDG_CACHE_HOME", ""}}, home + "/.cache/pt/shaders-512"},
        {{{"HOME", home}, {"XDG_CACHE_HOME", "x"}}, home + "/.cache/pt/shaders-512"},
        {{{"HOME", home}, {"MESA_SHADER_CACHE_DIR", other}}, other + "/shaders-512"}};
    for (const auto &[variables, cache] : caches)
        EXPECT_EQ(added(variables), (Variables{{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"MESA_SHADER_CACHE_DIR", cache}}));
    const Variables without_cache{{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"MESA_SHADER_CACHE_DISABLE", "true"}};
    for (const Variables &variables : {Variables{}, Variables{{"HOME", ""}}, Variables{{"HOME", folder.file("file")}}})
        EXPECT_EQ(added(variables), without_cache);
    for (const char *value : {"256", "512", ""})
        EXPECT_EQ(added({{"HOME", home}, {"LP_NATIVE_VECTOR_WIDTH", value}}), Variables()) << value;
}

TEST_F(VectorWidth, ComesFromUndamagedFilesOfThisProcessor) {
    const std::string file = folder.file("width");
    cli::write_width(file, {512, "driver 1"});
    const std::string good = folder.read("width");
    const auto read = [&](const std::string &text) {
        folder.write("width", text);
        return cli::read_width(file);
    };
    ASSERT_TRUE(read(good));
    EXPECT_EQ(read(good)->bits, 512U);
    EXPECT_EQ(read(good)->driver, "driver 1");
    const std::string rest = good.substr(3);
    for (const std::string &bad : {std::string(), "1024" + rest, "-512" + rest, "x" + good, "512\nanother" + rest,
                                   good.substr(0, good.size() - 1), good.substr(0, 4), std::string(5000, '5'),
                                   "512\n" + std::string(1 << 20, 'x') + good})
        EXPECT_FALSE(read(bad)) << bad.substr(0, 80);
    EXPECT_FALSE(cli::read_width(folder.file("none")));
    EXPECT_FALSE(cli::read_width(folder.file(".")));
    EXPECT_FALSE(cli::read_width("/dev/zero"));
}

TEST_F(VectorWidth, IsMeasuredForLongRenderingsOnLlvmpipe) {
    set({{"HOME", folder.file("home")}});
    const auto device = [](const std::string &name) {
        pt_device_info info{};
        name.copy(info.name, sizeof info.name);
        std::string("driver 1").copy(info.driver, sizeof info.driver);
        return info;
    };
    constexpr cli::KernelUse use{true, UINT64_MAX};
    const auto should_measure = [&](const cli::KernelUse &of, const std::string &name, bool is_free = true) {
        unsetenv("LP_NATIVE_VECTOR_WIDTH");
        return cli::VectorWidth(of, is_free).should_measure(device(name));
    };
    EXPECT_TRUE(should_measure(use, "llvmpipe (LLVM 15)"));
    EXPECT_FALSE(should_measure({true, 1000}, "llvmpipe (LLVM 15)"));
    EXPECT_FALSE(should_measure(use, "NVIDIA H200"));
    EXPECT_FALSE(should_measure(use, "llvmpipe (LLVM 15)", false));
    cli::write_width(folder.file("home/.cache/pt/vector-width-tree"), {512, "driver 1"});
    EXPECT_FALSE(should_measure(use, "llvmpipe (LLVM 15)"));
    EXPECT_STREQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), "512");
    cli::write_width(folder.file("home/.cache/pt/vector-width-tree"), {512, "driver 2"});
    EXPECT_TRUE(should_measure(use, "llvmpipe (LLVM 15)"));
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
    EXPECT_FALSE(cli::VectorWidth(use, true).should_measure(device("llvmpipe (LLVM 15)")));
}

} // namespace
