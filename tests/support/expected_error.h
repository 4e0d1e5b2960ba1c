// Catches what a call throws, for tests that expect an error. Used by the tests of lib/vulkan/.
#pragma once

#include "lib/base/error.h"

#include <gtest/gtest.h>

#include <string>

// The error that a function throws.
template <typename Function>
pt::Error error_of(Function &&function) {
    try {
        function();
    } catch (const pt::Error &error) {
        return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return pt::Error(PT_OK, "");
}

inline bool names(const pt::Error &error, const std::string &part) {
    return std::string(error.what()).find(part) != std::string::npos;
}
