#include "cli/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cli {

std::vector<double> AnimatedValue::at(double time) const {
    const auto next = std::find_if(keys.begin(), keys.end(), [time](const KeyFrame &key) { return key.frame > time; });
    if (next == keys.begin() || next == keys.end())
        return next == keys.begin() ? keys.front().numbers : keys.back().numbers;
    const KeyFrame &before = *(next - 1);
    const double share = (time - before.frame) / (next->frame - before.frame);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < before.numbers.size(); ++i)
        numbers.push_back(std::lerp(before.numbers[i], next->numbers[i], share));
    return numbers;
}

} // namespace cli
