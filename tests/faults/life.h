// After a fault, each call is checked against pt.h and repeated.
#pragma once

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace faults {

struct Setting {
    bool gpu; // whether the CPU is used like a GPU
    uint32_t device_count;
    uint32_t submit_milliseconds;
};

using Image = std::vector<float>;
using Film = std::vector<char>;

struct Expected {
    std::map<uint32_t, Image> images; // by number of samples
    Film film;
    Film uneven_film;
    Film other_film;
};

Expected undisturbed();

// Returns the number of the allocation or Vulkan call that fails. Adaptive sampling has thousands, so most are left
// out.
std::size_t call_number(const std::string &step, std::size_t number);

struct Injection {
    std::function<void(const std::string &step, std::size_t number)> arm;
    // Returns whether the place was reached.
    std::function<bool(const std::string &step, pt_result result, const std::string &message)> disarm;
};

using Steps = std::set<std::string>;

// Puts a fault into each step in `left`, until a device is lost. Moves steps that reach the fault's place to `met`, and
// removes the others.
class Life {
public:
    Life(const Setting &setting, const Expected &expected, const Injection &injection, std::size_t number, Steps &left,
         Steps &met);
    ~Life();
    Life(const Life &) = delete;
    Life &operator=(const Life &) = delete;

    void live();

private:
    struct End {};
    using Function = std::function<pt_result()>;
    using Accumulate = pt_result (*)(pt_context *, const pt_accumulate_info *);

    void tell();
    void look(const std::string &step, const Function &function);
    void call(const std::string &step, const Function &function, const std::function<void()> &after_failure = nullptr);
    void accumulate_to(const std::string &step, uint32_t goal, Accumulate accumulate = &pt_accumulate);
    void accumulate_unevenly();
    void read(const std::string &step, uint32_t quantity);
    void map_image();
    void save_film();
    void destroy();
    void expect_lost();
    void expect_image(const std::string &step);
    uint32_t samples();

    const Setting setting_;
    const Expected &expected_;
    const Injection &injection_;
    const std::size_t number_;
    Steps &left_;
    Steps &met_;
    bool lost_ = false;
    pt_context *context_ = nullptr;
    uint32_t rows_ = 0;
};

// Makes one round for each place. Each round has the steps that reached the place of the previous round. After a round,
// no Vulkan objects or memory may remain.
void sweep(const Setting &setting, const Expected &expected, const Injection &injection);

} // namespace faults
