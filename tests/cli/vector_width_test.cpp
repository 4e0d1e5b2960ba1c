// Tests of cli/vector_width: which variables are added to which environment.
#include "cli/base/vector_width.h"

#include <gtest/gtest.h>

namespace {

using cli::Environment;
using cli::wide_vectors;

const Environment home{{"HOME", "/home/someone"}, {"LANG", "C"}};

Environment with(Environment environment, const std::string &name, const std::string &value) {
    environment[name] = value;
    return environment;
}

TEST(VectorWidth, IsWideWithACacheOfItsOwn) {
    EXPECT_EQ(wide_vectors(home), (Environment{{"LP_NATIVE_VECTOR_WIDTH", "512"},
                                               {"MESA_SHADER_CACHE_DIR", "/home/someone/.cache/pt/shaders-512"}}));
}

TEST(VectorWidth, CacheIsWhereTheUserKeepsCaches) {
    const auto folder = [](const Environment &environment) {
        return wide_vectors(environment).at("MESA_SHADER_CACHE_DIR");
    };
    EXPECT_EQ(folder(with(home, "XDG_CACHE_HOME", "/var/x")), "/var/x/pt/shaders-512");
    EXPECT_EQ(folder({{"XDG_CACHE_HOME", "/var/x"}}), "/var/x/pt/shaders-512");
    EXPECT_EQ(folder(with(home, "XDG_CACHE_HOME", "")), "/home/someone/.cache/pt/shaders-512");
    EXPECT_EQ(folder(with(home, "XDG_CACHE_HOME", "x")), "/home/someone/.cache/pt/shaders-512");
}

TEST(VectorWidth, IsWideWithoutAPlaceForACache) {
    const Environment without_cache{{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"MESA_SHADER_CACHE_DISABLE", "true"}};
    EXPECT_EQ(wide_vectors({}), without_cache);
    EXPECT_EQ(wide_vectors({{"HOME", ""}}), without_cache);
}

TEST(VectorWidth, IsTheUsersChoiceAndThePlaceOfTheCacheIs) {
    for (const char *value : {"256", "512", ""}) {
        EXPECT_EQ(wide_vectors(with(home, "LP_NATIVE_VECTOR_WIDTH", value)), Environment()) << value;
    }
    EXPECT_EQ(wide_vectors(with(home, "MESA_SHADER_CACHE_DIR", "/mine")),
              (Environment{{"LP_NATIVE_VECTOR_WIDTH", "512"}, {"MESA_SHADER_CACHE_DIR", "/mine/shaders-512"}}));
    for (const char *name : {"MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DISABLE", "MESA_GLSL_CACHE_DIR"}) {
        EXPECT_EQ(wide_vectors(with(home, name, "true")), wide_vectors(home)) << name;
    }
}

} // namespace
