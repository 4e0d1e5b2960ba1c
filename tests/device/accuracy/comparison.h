// The errors of a function over many inputs: compared with their bounds, and printed as a row of the table of accuracy.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace accuracy {

using Real = long double;
using Direction = glm::vec<3, Real>;

constexpr Real half_ulp = 0x1p-24L; // of 1: the most that rounding changes a number by, as a share of it

// Of one result of a function.
class Comparison {
public:
    // unit: what the errors are in, for the table.
    Comparison(std::string function, std::string unit) : function_(std::move(function)), unit_(std::move(unit)) {}

    // The error of a value may be bound at the most, a number that is derived for its input.
    void add(Real value, Real exact, Real bound, const std::vector<float> &input);
    void add(const glm::vec3 &value, const Direction &exact, Real bound, const std::vector<float> &input);

    // Prints the row: the largest error, and the worst, which is that nearest to its bound, with its input. Fails the
    // running test if an error is beyond its bound, or if that would not show: exact values that are off by 1.01 bounds
    // must make some error too large.
    void finish() const;

private:
    void add_error(Real error, Real error_of_control, Real bound, const std::vector<float> &input);

    std::string function_;
    std::string unit_;
    std::size_t count_ = 0;
    Real largest_error_ = 0;
    Real worst_share_ = -1; // of its bound
    Real worst_error_ = 0;
    Real worst_bound_ = 0;
    std::vector<float> worst_input_;
    Real worst_share_of_control_ = 0;
};

// A value of any size, compared in ulp of the exact one; bound_in_ulp of those at the most. Exact values below
// negligible, and what the device gives for them, count as 0.
void add_in_ulp(Comparison &comparison, float value, Real exact, Real bound_in_ulp, Real negligible,
                const std::vector<float> &input);

// The components of vectors as a list, for the table.
template <typename... Vectors>
std::vector<float> list(const Vectors &...vectors) {
    std::vector<float> numbers;
    const auto append = [&](const auto &vector) {
        std::vector<float> part(sizeof vector / sizeof(float));
        std::memcpy(part.data(), &vector, sizeof vector);
        numbers.insert(numbers.end(), part.begin(), part.end());
    };
    (append(vectors), ...);
    return numbers;
}

} // namespace accuracy
