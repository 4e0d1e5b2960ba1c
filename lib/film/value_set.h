// Values >= 0 of which one asks for the mean of the others.
#pragma once

#include "lib/film/min_max.h"

#include <cstddef>

namespace pt {

class ValueSet {
public:
    ValueSet() = default;

    // Of so many values with this sum, the largest of which add_largest_of() adds.
    ValueSet(double sum, std::size_t count) : sum_(sum), count_(static_cast<double>(count)) {}

    // One after the other, since the last bits depend on their order.
    void add(double value) {
        sum_ += value;
        add_to_largest(value);
    }

    void add_largest_of(const ValueSet &values) {
        add_to_largest(values.largest_);
        add_to_largest(values.second_);
    }

    void set_count(std::size_t count) { count_ = static_cast<double>(count); }

    double mean_besides(double value) const { return more_of(sum_ - value, 0.0) / more_of(count_ - 1.0, 1.0); }

    // The largest of the others may be a firefly too.
    double mean_besides_and_without_largest(double value) const {
        const double largest_of_others = value < largest_ ? largest_ : second_;
        return more_of(sum_ - value - largest_of_others, 0.0) / more_of(count_ - 2.0, 1.0);
    }

private:
    void add_to_largest(double value) {
        second_ = more_of(second_, less_of(value, largest_));
        largest_ = more_of(largest_, value);
    }

    double sum_ = 0.0;
    double count_ = 0.0;
    double largest_ = 0.0;
    double second_ = 0.0;
};

} // namespace pt
