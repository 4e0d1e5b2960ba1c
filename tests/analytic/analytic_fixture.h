#pragma once

#include "tests/support/batch_fixture.h"
#include "tests/support/shared_context.h"

#include <cstdlib>

namespace analytic {

// PT_TEST_TREE puts all spheres into trees.
inline bool always_tree() {
    return std::getenv("PT_TEST_TREE") != nullptr;
}

class AnalyticFixture : public BatchFixture {
protected:
    Context create_fixtures_context() override {
        return create_context([](pt_create_info &) {}, always_tree() ? &create_with_tree : &pt_create);
    }

    void TearDown() override {
        const bool has_tree = (stats().features & PT_FEATURE_TREE) != 0;
        EXPECT_TRUE(has_tree || !always_tree());
        BatchFixture::TearDown();
    }
};

} // namespace analytic
