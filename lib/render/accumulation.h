// Equal numbers of samples for all pixels on their way into the films of a context's devices, in ascending order.
#pragma once

#include "lib/film/sample_set.h"
#include "lib/render/sample_dealing.h"

#include <cstdint>
#include <optional>

namespace pt {

class Accumulation : public SampleDealing {
public:
    // Devices, cancellation and work must outlive it. samples: those that the films hold. wanted: how many are to be
    // added to them, at the most, which the progress is about.
    Accumulation(const Devices &devices, const SampleSet &samples, std::uint32_t first_sample, std::uint32_t wanted,
                 const Progress &progress, const Cancellation &cancellation, DeviceWork &work);

    // How many samples the films are to have, and whether their error is to be estimated then.
    struct Goal {
        std::uint64_t count;
        std::optional<double> unit_of_error; // of the films, if it is
    };

    // Takes samples until the films have as many, or fewer if it was stopped. False if that is still under way at a
    // time; it is to be called again then, with the same goal.
    bool run(const Goal &goal, Clock::time_point until);

    // Whether the error was estimated in the submission with the last samples, which saves one: on a device that is
    // alone and took them at once.
    bool has_estimate() const { return has_estimate_; }

    // The whole samples that the films hold. Nothing may be under way.
    SampleSet samples() const;

private:
    void deal() override;
    bool deal_to(RenderDevice &device);
    std::optional<ErrorQuery> estimate_after(const SampleRange &samples) const;

    std::uint32_t first_sample_;
    SampleSet dealt_; // those that the films hold or have begun
    Goal goal_{};
    bool has_estimate_ = false;
};

} // namespace pt
