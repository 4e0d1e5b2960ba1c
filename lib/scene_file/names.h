#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pt {

template <typename Value>
struct Named {
    std::string_view name;
    Value value;
};

template <std::size_t Count, typename Value = std::uint32_t>
class ValueNames {
public:
    constexpr explicit ValueNames(const Named<Value> (&named)[Count]) {
        std::ranges::transform(named, names_.begin(), &Named<Value>::name);
        std::ranges::transform(named, values_.begin(), &Named<Value>::value);
    }

    constexpr std::span<const std::string_view> names() const { return names_; }
    constexpr std::span<const Value> values() const { return values_; }

    constexpr std::optional<Value> find(std::string_view name) const {
        const auto found = std::ranges::find(names_, name);
        return found == names_.end() ? std::nullopt : std::optional(values_[std::size_t(found - names_.begin())]);
    }

    constexpr std::string_view name(Value value) const {
        return names_.at(std::size_t(std::ranges::find(values_, value) - values_.begin()));
    }

private:
    std::array<std::string_view, Count> names_{};
    std::array<Value, Count> values_{};
};

template <std::size_t Count>
ValueNames(const Named<std::uint32_t> (&)[Count]) -> ValueNames<Count>;

// Returns an empty string if no name is similar.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

// Returns `unknown key "raduis", did you mean "radius"?`, or a short list of all names.
std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known);

} // namespace pt
