// Numbers of the headers in lib/include/pt by the names that options and scene files have for them, as
// lib/python/generate.py writes them: PT_SAMPLER_HALTON_CP is halton-cp.
#pragma once

#include "cli/base/names.h"

#include <pt/pt.h>

namespace cli {

inline constexpr ValueNames samplers({
    {"best", PT_SAMPLER_BEST},
    {"random", PT_SAMPLER_RANDOM},
    {"halton", PT_SAMPLER_HALTON},
    {"halton-cp", PT_SAMPLER_HALTON_CP},
    {"sobol", PT_SAMPLER_SOBOL},
});

inline constexpr ValueNames samplings({
    {"best", PT_SAMPLING_BEST},
    {"uniform", PT_SAMPLING_UNIFORM},
    {"adaptive", PT_SAMPLING_ADAPTIVE},
});

inline constexpr ValueNames estimators({
    {"best", PT_ESTIMATOR_BEST},
    {"uniform", PT_ESTIMATOR_UNIFORM},
    {"cosine", PT_ESTIMATOR_COSINE},
    {"bsdf", PT_ESTIMATOR_BSDF},
    {"light", PT_ESTIMATOR_LIGHT},
    {"mis", PT_ESTIMATOR_MIS},
});

} // namespace cli
