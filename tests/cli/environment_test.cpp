#include "cli/base/environment.h"
#include "cli/base/exit_code.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

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
        cli::widen_vectors();
        Variables more = present();
        std::erase_if(more, [&](const auto &each) {
            const auto found = variables.find(each.first);
            return found != variables.end() && found->second == each.second;
        });
        return more;
    }

    static Variables wide(const std::string &cache) {
        return {{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"MESA_SHADER_CACHE_DIR", cache}};
    }

    TemporaryFolder folder;
    Variables before;
};

TEST_F(VectorWidth, IsWideWithACacheOfItsOwn) {
    const std::string home = folder.file("home");
    const std::string other = folder.file("x");
    EXPECT_EQ(added({{"HOME", home}}), wide(home + "/.cache/pt/shaders-512"));
    EXPECT_EQ(added({{"HOME", home}, {"XDG_CACHE_HOME", other}}), wide(other + "/pt/shaders-512"));
    EXPECT_EQ(added({{"XDG_CACHE_HOME", other}}), wide(other + "/pt/shaders-512"));
    for (const char *no_path : {"", "x"})
        EXPECT_EQ(added({{"HOME", home}, {"XDG_CACHE_HOME", no_path}}), wide(home + "/.cache/pt/shaders-512"));
    EXPECT_EQ(added({{"HOME", home}, {"MESA_SHADER_CACHE_DIR", other}}), wide(other + "/shaders-512"));
}

TEST_F(VectorWidth, IsWideWithoutAPlaceForACache) {
    const Variables without_cache{{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"MESA_SHADER_CACHE_DISABLE", "true"}};
    folder.write("file", "");
    EXPECT_EQ(added({}), without_cache);
    EXPECT_EQ(added({{"HOME", ""}}), without_cache);
    EXPECT_EQ(added({{"HOME", folder.file("file")}}), without_cache);
}

TEST_F(VectorWidth, IsTheUsersChoice) {
    for (const char *value : {"256", "512", ""})
        EXPECT_EQ(added({{"HOME", folder.file("home")}, {"LP_NATIVE_VECTOR_WIDTH", value}}), Variables()) << value;
}

} // namespace
