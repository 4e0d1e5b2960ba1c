#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace accuracy {

using Real = long double;
using Direction = glm::vec<3, Real>;

constexpr Real half_ulp = 0x1p-24L;

class Comparison {
public:
    Comparison(std::string function, std::string unit) : function_(std::move(function)), unit_(std::move(unit)) {}

    void add(Real value, Real exact, Real bound, const std::vector<float> &input);
    void add(const glm::vec3 &value, const Direction &exact, Real bound, const std::vector<float> &input);

    // Prints the largest error, the error nearest to its bound, and the input of the latter. The test fails if an error
    // exceeds its bound, or if exact values shifted by 1.01 bounds would pass.
    void finish() const;

private:
    void add_error(Real error, Real error_of_control, Real bound, const std::vector<float> &input);

    std::string function_;
    std::string unit_;
    std::size_t count_ = 0;
    Real largest_error_ = 0;
    Real worst_share_ = -1;
    Real worst_error_ = 0;
    Real worst_bound_ = 0;
    std::vector<float> worst_input_;
    Real worst_share_of_control_ = 0;
};

// Values below `negligible` count as 0.
void add_in_ulp(Comparison &comparison, float value, Real exact, Real bound_in_ulp, Real negligible,
                const std::vector<float> &input);

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
