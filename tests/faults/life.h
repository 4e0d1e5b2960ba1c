// After a fault, each call is checked against pt.h and repeated.
#pragma once

#include <pt/pt.h>

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

struct ExpectedImages {
    std::map<uint32_t, Image> radiance;
    std::map<uint32_t, Image> standard_error;
    Film film;
    Film other_film;
};

ExpectedImages undisturbed_images();

class Injection {
public:
    virtual ~Injection() = default;

    virtual void arm() = 0;

    virtual bool disarm(const std::string &step, pt_result result, const std::string &message) = 0;
};

using Steps = std::set<std::string>;

class Life {
public:
    Life(const Setting &setting, const ExpectedImages &expected, const Steps &injected);
    ~Life();
    Life(const Life &) = delete;
    Life &operator=(const Life &) = delete;

    static Steps all_steps();

    void live(Injection &injection);

    const Steps &attempted() const { return attempted_; }
    const Steps &met() const { return met_; }
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
    Steps left_;
    Steps attempted_;
    Steps met_;
    bool lost_ = false;
    pt_context *context_ = nullptr;
    uint32_t rows_ = 0;
};

} // namespace faults
