// Numbers of the headers in lib/include/pt by the names that options, scene files and reports have for them, as
// lib/python/generate.py writes them: PT_SAMPLER_HALTON_CP is halton-cp.
#pragma once

#include "cli/base/names.h"

#include <pt/pt.h>
#include <pt/stats.h>

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

inline constexpr ValueNames projections({
    {"perspective", PT_PROJECTION_PERSPECTIVE},
    {"orthographic", PT_PROJECTION_ORTHOGRAPHIC},
});

inline constexpr ValueNames features({
    {"lamps", PT_FEATURE_LAMPS},
    {"gloss", PT_FEATURE_GLOSS},
    {"motion", PT_FEATURE_MOTION},
    {"large", PT_FEATURE_LARGE},
    {"tree", PT_FEATURE_TREE},
    {"orthographic", PT_FEATURE_ORTHOGRAPHIC},
    {"hidden", PT_FEATURE_HIDDEN},
    {"lens", PT_FEATURE_LENS},
    {"capsules", PT_FEATURE_CAPSULES},
    {"opacity", PT_FEATURE_OPACITY},
});

inline constexpr ValueNames uncertainties({
    {"rmse", PT_UNCERTAIN_RMSE},
    {"relative_rmse", PT_UNCERTAIN_RELATIVE_RMSE},
    {"unseen", PT_UNCERTAIN_UNSEEN},
    {"unmet", PT_UNCERTAIN_UNMET},
});

} // namespace cli
