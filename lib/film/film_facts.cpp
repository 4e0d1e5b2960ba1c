#include "lib/film/film_facts.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "shaders/gpu_layout.h"

#include <pt/pt.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace pt {

namespace {

constexpr int most_unit_exponent = 300;

std::optional<std::string> value_in(const FilmIdentity &identity, const std::string &name) {
    const auto fact = std::ranges::find(identity, name, &FilmFact::name);
    return fact == identity.end() ? std::nullopt : std::optional(fact->value);
}

// Reads a number that has no leading zeros or signs. On failure records a violation and returns `least`.
template <typename Number>
Number number_in(const FilmIdentity &identity, const char *name, Number least, Number most, Violations &violations) {
    const std::string text = value_in(identity, name).value_or("nothing");
    Number number{};
    std::from_chars(text.data(), text.data() + text.size(), number);
    if (std::to_string(number) == text && number >= least && number <= most)
        return number;
    violations.add({.subject = "film",
                    .member = name,
                    .value = text,
                    .rule = "must be from " + std::to_string(least) + " to " + std::to_string(most)});
    return least;
}

} // namespace

FilmFacts facts_of(const FilmIdentity &identity) {
    Violations violations;
    const auto read = [&]<typename Number>(const char *name, Number least, Number most) {
        return number_in(identity, name, least, most, violations);
    };
    FilmFacts facts{};
    facts.width = read("width", 1U, UINT32_MAX);
    facts.height = read("height", 1U, UINT32_MAX / facts.width);
    facts.max_path_length = read("max_path_length", 1U, 1024U);
    facts.seed = read("seed", std::uint64_t{0}, UINT64_MAX);
    facts.estimator = read("estimator", 1U, gpu::LAST_ESTIMATOR);
    facts.sampler = read("sampler", 1U, gpu::LAST_SAMPLER);
    facts.unit_exponent = read("unit_exponent", -most_unit_exponent, most_unit_exponent);
    violations.throw_if_any(PT_ERROR_INCOMPATIBLE);
    facts.has_coverage = has_coverage(identity);
    facts.device = value_in(identity, "device").value_or("");
    return facts;
}

void require_same(const FilmIdentity &film, const FilmIdentity &other, const std::string &place) {
    Violations violations;
    for (const FilmFact &fact : other)
        if (const std::string value = value_in(film, fact.name).value_or("nothing"); value != fact.value)
            violations.add({.subject = "film",
                            .member = fact.name,
                            .value = value,
                            .rule = "must be " + fact.value + ", " + place});
    for (const FilmFact &fact : film)
        if (!value_in(other, fact.name))
            violations.add({.subject = "film", .member = fact.name, .value = fact.value, .rule = "must be absent"});
    violations.throw_if_any(PT_ERROR_INCOMPATIBLE);
    if (film != other)
        throw Error(PT_ERROR_INCOMPATIBLE, "film: lines of its header are repeated, or in another order");
}

void require_apart(const SampleSet &added, const SampleSet &present, const std::string &where) {
    if (const auto overlap = added.overlap(present))
        refuse_film("samples", text_of(added) + where, text_of(*overlap) + " are already in the film");
    if (present.count() + added.count() > UINT32_MAX)
        refuse_film("samples", text_of(added), "a pixel holds at most 2^32 - 1");
}

void refuse_film(const std::string &member, const std::string &value, const std::string &rule) {
    refuse_argument("film", member, value, rule, PT_ERROR_INCOMPATIBLE);
}

} // namespace pt
