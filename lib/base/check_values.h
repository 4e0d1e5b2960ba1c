#pragma once

#include "lib/base/rules.h"

#include <cstddef>

namespace pt {

// `values` may be NULL if count is 0.
inline void check_values(const Subject &subject, const char *member, const float *values, std::size_t count,
                         Rule rule) {
    if (!values && count != 0) {
        subject.refuse(member, "NULL", "must not be NULL");
        return;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (const char *broken = rule(values[i]))
            subject.refuse_element(member, i, values[i], broken);
}

} // namespace pt
