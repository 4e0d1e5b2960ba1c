// Owns one pt_context and turns its failures into Failure.
// Called by render_command.
#pragma once

#include "exit_code.h"

#include <pt/pt.h>

#include <string>

namespace cli {

class Context {
public:
    explicit Context(const pt_create_info &info) {
        const pt_result result = pt_create(&info, &context_);
        if (result < 0) {
            throw Failure(exit_code_of(result), pt_last_error(nullptr));
        }
    }
    Context(const Context &) = delete;
    Context &operator=(const Context &) = delete;
    ~Context() { pt_destroy(context_); }

    pt_context *get() const { return context_; }
    std::string last_error() const { return pt_last_error(context_); }

    // For calls whose arguments the user has no part in, or named on the command line.
    void require(pt_result result) const {
        if (result < 0) {
            throw Failure(exit_code_of(result), last_error());
        }
    }

private:
    pt_context *context_ = nullptr;
};

} // namespace cli
