// Owns one pt_context and turns its failures into Failure.
// Called by render_command and bench_command.
#pragma once

#include "exit_code.h"

#include <pt/pt.h>

#include <cstddef>
#include <string>
#include <vector>

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

    // Three components to a pixel.
    std::vector<float> read_image(const pt_render &render) const {
        std::vector<float> radiance(std::size_t{3} * render.width * render.height);
        pt_image image{};
        image.struct_size = sizeof(pt_image);
        image.data = radiance.data();
        image.size_bytes = radiance.size() * sizeof(float);
        require(pt_readback(context_, &image));
        return radiance;
    }

private:
    pt_context *context_ = nullptr;
};

} // namespace cli
