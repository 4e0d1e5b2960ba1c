#include "lib/film/film_facts.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "shaders/gpu_layout.h"

#include <pt/pt.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace pt {

namespace {

// A limit that no film of this library exceeds: its unit exponents are those of radiance up to 2^60 times 10^18.
constexpr std::int64_t most_unit_exponent = 300;

std::optional<std::string> value_in(const FilmIdentity &identity, const std::string &name) {
    const auto fact = std::ranges::find(identity, name, &FilmFact::name);
    return fact == identity.end() ? std::nullopt : std::optional(fact->value);
}

template <typename Number>
std::optional<Number> number_in(const std::string &text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    return is_whole && std::to_string(number) == text ? std::optional(number) : std::nullopt;
}

// Collects what is wrong with the facts that are asked for.
class FactReader {
public:
    explicit FactReader(const FilmIdentity &identity) : identity_(identity) {}

    template <typename Number>
    Number read(const char *name, Number least, Number most) {
        const std::string text = value_in(identity_, name).value_or("nothing");
        const std::optional<Number> number = number_in<Number>(text);
        if (number && *number >= least && *number <= most)
            return *number;
        violations_.add({.subject = "film",
                         .member = name,
                         .value = text,
                         .rule = "must be from " + std::to_string(least) + " to " + std::to_string(most)});
        return least;
    }

    void throw_if_any() const { violations_.throw_if_any(PT_ERROR_INCOMPATIBLE); }

private:
    const FilmIdentity &identity_;
    Violations violations_;
};

} // namespace

FilmFacts facts_of(const FilmIdentity &identity) {
    FactReader reader(identity);
    FilmFacts facts{};
    facts.width = reader.read<std::uint32_t>("width", 1, UINT32_MAX);
    facts.height = reader.read<std::uint32_t>("height", 1, UINT32_MAX / facts.width);
    facts.max_path_length = reader.read<std::uint32_t>("max_path_length", 1, 1024);
    facts.seed = reader.read<std::uint64_t>("seed", 0, UINT64_MAX);
    facts.estimator = reader.read<std::uint32_t>("estimator", 1, gpu::LAST_ESTIMATOR);
    facts.sampler = reader.read<std::uint32_t>("sampler", 1, gpu::LAST_SAMPLER);
    facts.unit_exponent =
        static_cast<int>(reader.read<std::int64_t>("unit_exponent", -most_unit_exponent, most_unit_exponent));
    reader.throw_if_any();
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
            violations.add({.subject = "film", .member = fact.name, .value = fact.value, .rule = "must not be there"});
    violations.throw_if_any(PT_ERROR_INCOMPATIBLE);
    if (film != other)
        throw Error(PT_ERROR_INCOMPATIBLE, "film: lines of its header are repeated, or in another order");
}

} // namespace pt
