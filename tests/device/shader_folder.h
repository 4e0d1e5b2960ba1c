// An editable copy of the kernels' GLSL, removed with the test.
#pragma once

#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

class ShaderFolder : public TemporaryFolder {
public:
    ShaderFolder() { std::filesystem::copy(PT_TEST_SHADER_DIR, path(), std::filesystem::copy_options::recursive); }

    std::string path() const { return std::filesystem::path(file("x")).parent_path(); }

    // The part must occur exactly once.
    void replace(const std::string &name, const std::string &old_part, const std::string &new_part) const {
        std::string text = read(name);
        const std::size_t place = text.find(old_part);
        ASSERT_NE(place, std::string::npos) << old_part << " is not in " << name;
        ASSERT_EQ(text.find(old_part, place + 1), std::string::npos) << old_part << " is in " << name << " again";
        write(name, text.replace(place, old_part.size(), new_part));
    }

    // Returns the place as the compiler names it.
    std::string break_after_line(const std::string &name, int line) const {
        std::string text = read(name);
        std::size_t place = 0;
        for (int i = 0; i < line; ++i)
            place = text.find('\n', place) + 1;
        write(name, text.insert(place, "float broken = nothing_like_it;\n"));
        return file(name) + ":" + std::to_string(line + 1) + ": 'nothing_like_it' : undeclared identifier";
    }
};
