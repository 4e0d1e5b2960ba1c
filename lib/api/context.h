#pragma once

#include "lib/api/guard.h"
#include "lib/api/in_use.h"
#include "lib/render/renderer.h"

#include <pt/pt.h>

struct pt_context {
    explicit pt_context(const pt::CreateSettings &settings) : renderer(settings) {}

    mutable pt::InUse in_use;
    pt::LastError last_error; // outlives the renderer, whose destructor may log
    pt::Renderer renderer;
};

namespace pt {

extern thread_local LastError thread_last_error;

CreateSettings validated_create(const pt_create_info &info);

} // namespace pt
