// Contexts with a tree from the first sphere on. To make them takes the library's internals.
#include "tests/analytic/contexts.h"
#include "tests/support/shared_context.h"

namespace analytic {

pt_result create(const pt_create_info *info, pt_context **context) {
    return create_with_tree(info, context);
}

const bool always_tree = true;

const std::uint32_t samples_for_one = 8;

} // namespace analytic
