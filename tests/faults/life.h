// The life of a context, call by call. Each call may fail once: then the contract of pt.h for failures is checked, and
// the call is made again. Used by the tests of host memory and of Vulkan calls.
#pragma once

#include <pt/pt.h>

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace faults {

// How the library is to use the device.
struct Setting {
    bool gpu;                     // see pose_as_gpu
    uint32_t device_count;        // to share the work, all of them the one device there is
    uint32_t submit_milliseconds; // of which a submission takes one by the clock
};

using Image = std::vector<float>;
using Film = std::vector<char>;

// Images of the life's scene by sample count, from a life in which nothing happens, and films.
struct ExpectedImages {
    std::map<uint32_t, Image> radiance;
    std::map<uint32_t, Image> standard_error;
    Film film;       // of all samples
    Film other_film; // of those that follow the first
};

ExpectedImages undisturbed_images();

// What may happen to a call.
class Injection {
public:
    virtual ~Injection() = default;

    // Before the first attempt at a call.
    virtual void arm() = 0;

    // After it. Judges its result; false if nothing has happened to it.
    virtual bool disarm(const std::string &step, pt_result result, const std::string &message) = 0;
};

using Steps = std::set<std::string>;

class Life {
public:
    // injected: the calls that something may happen to. The life is no longer than they take, and looks at nothing
    // else.
    Life(const Setting &setting, const ExpectedImages &expected, const Steps &injected);
    ~Life();
    Life(const Life &) = delete;
    Life &operator=(const Life &) = delete;

    static Steps all_steps();

    // From pt_get_devices to pt_destroy. It ends before its time if the device is lost.
    void live(Injection &injection);

    const Steps &attempted() const { return attempted_; }
    const Steps &met() const { return met_; } // those to which something has happened
    bool lost() const { return lost_; }

private:
    struct State {
        uint32_t sample_count;
        uint64_t rejected_samples;
    };
    struct End {};
    using Function = std::function<pt_result()>;

    void tell();
    pt_result run(const Function &function);
    void look(const std::string &step, const Function &function);
    void call(const std::string &step, const Function &function);
    void call(const std::string &step, const Function &function, const std::function<void()> &after_failure);
    using Accumulate = pt_result (*)(pt_context *, const pt_accumulate_info *);
    void accumulate_to(const std::string &step, uint32_t sample_count, double target_error,
                       Accumulate accumulate = &pt_accumulate);
    void readback(const std::string &step, uint32_t quantity);
    void map_image(const std::string &step);
    void read_of_scene(const std::string &step, uint32_t quantity);
    void save_film(const std::string &step);
    void add_film(const std::string &step);
    void destroy();
    void expect_lost();
    State state();
    void expect_image(const std::string &step, uint32_t sample_count);

    const Setting setting_;
    const ExpectedImages &expected_;
    Injection *injection_ = nullptr;
    Steps left_; // of those to be injected
    Steps attempted_;
    Steps met_;
    bool lost_ = false;
    pt_context *context_ = nullptr;
    uint32_t rows_ = 0; // of the image, from the top
};

} // namespace faults
