#pragma once

#include "lib/base/error.h"
#include "lib/platform/input_file.h"
#include "lib/platform/printable.h"

#include <string>

namespace pt {

// Returns read(). Throws PT_ERROR_FILE with the name if an InputFile fails.
template <typename Read>
auto read_named(const std::string &name, const Read &read) {
    try {
        return read();
    } catch (const platform::InputError &error) {
        throw Error(PT_ERROR_FILE, "cannot read " + platform::printable(name) + ": " + error.what());
    }
}

template <typename Read>
auto read_file(const std::string &path, const Read &read) {
    return read_named(path, [&] {
        platform::InputFile file(path);
        return read(file);
    });
}

} // namespace pt
