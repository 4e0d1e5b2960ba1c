// Typed reading of JSON values: each function checks one value, and names its place if the type is wrong.
#pragma once

#include "cli/base/json_path.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace cli {

// Where a value stands, as a chain towards the root, so that a path is made only for messages: a scene may have
// millions of values.
struct JsonPlace {
    const JsonPlace *parent = nullptr;
    std::string_view key; // empty at the root and in arrays
    std::size_t index = 0;
    bool in_array = false;

    JsonPlace member(std::string_view name) const { return {this, name, 0, false}; }
    JsonPlace element(std::size_t number) const { return {this, {}, number, true}; }

    JsonPath path() const; // from the root
};

// A value that breaks a rule. The caller that has the text adds file and line.
struct JsonRefusal : std::runtime_error {
    JsonRefusal(JsonPath place, const std::string &rule, std::size_t time = 1) :
        std::runtime_error(rule),
        path(std::move(place)),
        occurrence(time) {}

    JsonPath path;
    std::size_t occurrence; // of a key that is given several times
};

// Throws JsonRefusal, as all below do.
[[noreturn]] void refuse(const JsonPlace &place, const std::string &rule);

// `a number`, `an array` and so on, for messages.
std::string json_kind(nlohmann::json::value_t kind);

double read_number(const nlohmann::json &value, const JsonPlace &place);
float read_float(const nlohmann::json &value, const JsonPlace &place);
std::uint64_t read_whole_number(const nlohmann::json &value, const JsonPlace &place, std::uint64_t smallest,
                                std::uint64_t largest);
bool read_truth(const nlohmann::json &value, const JsonPlace &place);
std::string_view read_text(const nlohmann::json &value, const JsonPlace &place);
std::array<double, 3> read_vector(const nlohmann::json &value, const JsonPlace &place);
std::array<double, 2> read_pair(const nlohmann::json &value, const JsonPlace &place);
std::array<float, 3> read_colour(const nlohmann::json &value, const JsonPlace &place); // a number is a grey

[[noreturn]] void refuse_unknown_key(const JsonPlace &object, std::string_view key,
                                     std::span<const std::string_view> known);

// An object whose every key is known.
class JsonObject {
public:
    JsonObject(const nlohmann::json &value, const JsonPlace &place, std::initializer_list<std::string_view> known);

    const nlohmann::json *find(const char *key) const;    // nullptr if absent
    const nlohmann::json &require(const char *key) const; // refused if absent

private:
    const nlohmann::json &value_;
    const JsonPlace &place_;
};

} // namespace cli
