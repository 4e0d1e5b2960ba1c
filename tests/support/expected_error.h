#pragma once

#include "lib/base/error.h"

#include <gtest/gtest.h>

#include <string>

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
