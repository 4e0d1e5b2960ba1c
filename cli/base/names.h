// The names of pt.h's samplers, estimators and ways to spread samples, of which a new one is one more line here:
// options, scene files and reports follow. And which known name a misspelt one was probably meant to be.
#pragma once

#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cli {

struct Method {
    std::string_view name;
    std::uint32_t value;
};

template <std::size_t Count>
class MethodNames {
public:
    constexpr explicit MethodNames(const Method (&methods)[Count]) {
        std::ranges::transform(methods, names_.begin(), &Method::name);
        std::ranges::transform(methods, values_.begin(), &Method::value);
    }

    constexpr std::span<const std::string_view> names() const { return names_; }

    constexpr std::optional<std::uint32_t> find(std::string_view name) const {
        const auto found = std::ranges::find(names_, name);
        return found == names_.end() ? std::nullopt : std::optional(values_[std::size_t(found - names_.begin())]);
    }

    // Throws std::out_of_range for a value that the table lacks.
    constexpr std::string_view name(std::uint32_t value) const {
        return names_.at(std::size_t(std::ranges::find(values_, value) - values_.begin()));
    }

private:
    std::array<std::string_view, Count> names_{};
    std::array<std::uint32_t, Count> values_{};
};

inline constexpr MethodNames samplers({
    {"best", PT_SAMPLER_BEST},
    {"random", PT_SAMPLER_RANDOM},
    {"halton", PT_SAMPLER_HALTON},
    {"halton-cp", PT_SAMPLER_HALTON_CP},
    {"sobol", PT_SAMPLER_SOBOL},
});

inline constexpr MethodNames samplings({
    {"best", PT_SAMPLING_BEST},
    {"uniform", PT_SAMPLING_UNIFORM},
    {"adaptive", PT_SAMPLING_ADAPTIVE},
});

inline constexpr MethodNames estimators({
    {"best", PT_ESTIMATOR_BEST},
    {"uniform", PT_ESTIMATOR_UNIFORM},
    {"cosine", PT_ESTIMATOR_COSINE},
    {"bsdf", PT_ESTIMATOR_BSDF},
    {"light", PT_ESTIMATOR_LIGHT},
    {"mis", PT_ESTIMATOR_MIS},
});

// The known name that is fewest edits away; empty if none is close enough to be meant.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

// `unknown key "raduis", did you mean "radius"?` Without a near name, a short list of known ones is given whole.
std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known);

} // namespace cli
