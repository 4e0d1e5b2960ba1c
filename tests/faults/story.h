// The life of a context, call by call, in which calls may fail: each that does is judged and then made again. Told by the
// tests of host memory and of Vulkan calls.
#pragma once

#include <pt/pt.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace faults {

// How the library is to use the device, which is the default one.
struct Setting {
    bool gpu;              // see pose_as_gpu
    uint32_t device_count; // contexts in this many devices, which are the same one
    uint32_t milliseconds; // of a submission: the clock takes one for each
};

using Image = std::vector<float>;

// What undisturbed lives of a setting show, by sample count: radiance and its standard error.
struct Expected {
    std::map<uint32_t, Image> radiance;
    std::map<uint32_t, Image> standard_error;
};

// What happens in a life.
class Teller {
public:
    virtual ~Teller() = default;

    // Before each call but pt_destroy, until one is not to fail: arms the fault.
    virtual void before(const std::string &step) = 0;

    // After it. Whether a fault was met: then the call is made again.
    virtual bool after(const std::string &step, pt_result result, const std::string &message) = 0;
};

// Tells a life from pt_get_devices to pt_destroy, and expects the contract of pt.h of it: failed calls have changed nothing,
// and images have the bits expected. It ends early when the device is lost. Returns the name of the call in which that
// happened, or nothing.
std::string tell(const Setting &setting, const Expected &expected, Teller &teller);

// Of lives in which nothing happens.
Expected expected_images(const Setting &setting);

} // namespace faults
