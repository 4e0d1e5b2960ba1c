#include "tests/denoise/denoising.h"

#include <chrono>
#include <string>
#include <thread>

namespace {

struct Rounds {
    explicit Rounds(std::uint32_t sample_count) {
        info.sample_count = sample_count;
        info.render = [](void *user, std::uint32_t end) { return static_cast<Rounds *>(user)->add(end); };
        info.render_user = this;
    }

    std::int32_t add(std::uint32_t end) {
        std::this_thread::sleep_for(duration);
        ends.push_back(end);
        return 0;
    }

    pt_result run() {
        setenv("FAKE_OIDN", "identity", 1);
        return pt_denoise_rounds(&info, &denoising.info, &denoising.error);
    }

    Denoising denoising{0, much_noise};
    pt_rounds_info info = sized<pt_rounds_info>();
    std::chrono::milliseconds duration{0};
    std::vector<std::uint32_t> ends;
};

TEST(DenoiseRounds, AreHalfAsLargeAgain) {
    using Ends = std::vector<std::uint32_t>;
    const auto ends = [](std::uint32_t sample_count, double target_error, double time_limit, pt_result ended = PT_OK) {
        Rounds rounds(sample_count);
        rounds.info.stopping.target_error = target_error;
        rounds.info.stopping.time_limit = time_limit;
        EXPECT_EQ(rounds.run(), ended);
        return rounds.ends;
    };
    EXPECT_EQ(ends(100, 1e-9, 0.0), (Ends{16, 24, 36, 54, 81, 100}));
    EXPECT_EQ(ends(100, 1e-9, 1e9), (Ends{16, 24, 36, 54, 81, 100}));
    EXPECT_EQ(ends(16, 1e-9, 0.0), Ends{16});
    EXPECT_EQ(ends(10, 1e-9, 0.0), Ends{10});
    EXPECT_EQ(ends(100, 0.0, 0.0), Ends{100});
    EXPECT_EQ(ends(100, 0.0, 1e-9, PT_LIMIT_REACHED), Ends{16});
    EXPECT_EQ(ends(100, 1e9, 0.0, PT_TARGET_REACHED), Ends{16});
    EXPECT_EQ(ends(16, 1e9, 0.0, PT_TARGET_REACHED), Ends{16}) << "by the last round";
}

// The first round takes at least 5/6 of the time.
TEST(DenoiseRounds, FitTheTime) {
    Rounds rounds(100);
    rounds.info.stopping.time_limit = 0.3;
    rounds.duration = std::chrono::milliseconds(250);
    EXPECT_EQ(rounds.run(), PT_LIMIT_REACHED);
    EXPECT_LE(rounds.ends.back(), 19U);
}

TEST(DenoiseRounds, RefuseWhatBreaksARule) {
    const auto refused = [](const std::function<void(Rounds &)> &change, const std::string &message) {
        Rounds rounds(100);
        change(rounds);
        EXPECT_EQ(rounds.run(), PT_ERROR_INVALID_ARGUMENT) << message;
        EXPECT_EQ(pt_last_error(nullptr), message);
    };
    refused([](Rounds &r) { r.info.sample_count = 0; }, "rounds.sample_count = 0: must be >= 1");
    refused([](Rounds &r) { r.info.stopping.target_error = NAN; },
            "stopping.target_error = nan: must be finite and >= 0");
    refused([](Rounds &r) { r.info.stopping.time_limit = -1.0; }, "stopping.time_limit = -1: must be finite and >= 0");
    refused([](Rounds &r) { r.info.render = nullptr; }, "rounds.render = NULL: must not be NULL");
    refused([](Rounds &r) { r.denoising.info.albedo = nullptr; }, "denoise.albedo = NULL: must not be NULL");
}

} // namespace
