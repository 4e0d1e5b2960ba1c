// Contexts like those of any program.
#include "tests/analytic/contexts.h"

namespace analytic {

pt_result create(const pt_create_info *info, pt_context **context) {
    return pt_create(info, context);
}

const bool always_tree = false;

const std::uint32_t samples_for_one = 1;

} // namespace analytic
