#pragma once

#include "lib/base/error.h"
#include "lib/platform/input_file.h"
#include "lib/platform/printable.h"

#include <string>

namespace pt {

// Throws PT_ERROR_FILE.
template <typename Read>
auto read_file(const std::string &path, Read read) {
    try {
        platform::InputFile file(path);
        return read(file);
    } catch (const platform::InputError &error) {
        throw Error(PT_ERROR_FILE, "cannot read " + platform::printable(path) + ": " + error.what());
    }
}

} // namespace pt
