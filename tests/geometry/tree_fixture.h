#pragma once

#include "tests/support/context_fixture.h"
#include "tests/support/shared_context.h"

class TreeFixture : public ContextFixture {
protected:
    Context create_fixtures_context() override {
        return create_context([](pt_create_info &) {}, &create_with_tree);
    }

    void SetUp() override {
        ContextFixture::SetUp();
        without_tree_ = create_context([](pt_create_info &) {}, &create_without_tree);
    }

    void TearDown() override {
        without_tree_.reset();
        ContextFixture::TearDown();
    }

    pt_context *without_tree() const { return without_tree_.get(); }

private:
    Context without_tree_;
};
