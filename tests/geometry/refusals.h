#pragma once

#include "lib/base/error.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

template <typename Call>
std::string outcome_of(pt_result code, const Call &call) {
    try {
        call();
    } catch (const pt::Error &error) {
        EXPECT_EQ(error.code(), code);
        return error.what();
    }
    return "accepted";
}

template <typename Draft>
struct Refusal {
    void (*spoil)(Draft &draft);
    std::string message;
};

template <typename Draft, typename Outcome>
void expect_refusals(const Draft &valid, const Outcome &outcome, const std::vector<Refusal<Draft>> &refusals) {
    EXPECT_EQ(outcome(valid), "accepted");
    for (const Refusal<Draft> &refusal : refusals) {
        Draft draft = valid;
        refusal.spoil(draft);
        EXPECT_EQ(outcome(draft), refusal.message);
    }
}
