// Tests of how samples are dealt out, and of the exit code of every way to end.
#include "cli/render/image_render.h"
#include "cli/render/render_command.h"

#include <gtest/gtest.h>

#include <csignal>
#include <limits>

namespace {

// Samples may be all there, the target may be reached as it happens, the time may have come, files may be missing.
TEST(Outcome, EveryCombinationHasItsExitCode) {
    for (int bits = 0; bits < 32; ++bits) {
        const bool has_target = (bits & 1) != 0;
        const bool target_reached = has_target && (bits & 2) != 0;
        const bool timed_out = (bits & 4) != 0;
        const bool has_checkpoint = (bits & 8) != 0;
        const bool all_written = (bits & 16) != 0;
        int expected = 0;
        if (!all_written) {
            expected = 6;
        } else if (timed_out && has_checkpoint) {
            expected = 75;
        } else if (has_target && !target_reached) {
            expected = 7;
        }
        const cli::ExitCode outcome =
            cli::outcome_of({has_target, target_reached, timed_out, has_checkpoint, all_written});
        EXPECT_EQ(cli::exit_code_of(outcome, 0), expected) << bits;
    }
}

TEST(Outcome, ASignalCountsWhereNothingElseWentWrong) {
    EXPECT_EQ(cli::exit_code_of(cli::ExitCode::signal, SIGINT), 130);
    EXPECT_EQ(cli::exit_code_of(cli::ExitCode::signal, SIGTERM), 143);
    EXPECT_EQ(cli::exit_code_of(cli::ExitCode::signal, SIGHUP), 129);
    EXPECT_EQ(cli::exit_code_of(cli::ExitCode::file, SIGINT), 6);
    EXPECT_EQ(cli::exit_code_of(cli::ExitCode::target_missed, 0), 7);
    EXPECT_EQ(cli::exit_code_of(cli::ExitCode::resumable, 0), 75);
    EXPECT_EQ(cli::exit_code_of(cli::ExitCode::signal, 0), 0);
}

constexpr std::uint32_t most = 65536;

TEST(SampleForecast, FallsWithTheRootOfTheNumber) {
    EXPECT_EQ(cli::forecast_sample_count(100, 0.03, 0.01, most), 900U);
    EXPECT_EQ(cli::forecast_sample_count(100, 1.0, 0.01, most), most);
    EXPECT_EQ(cli::forecast_sample_count(8, std::numeric_limits<double>::infinity(), 0.01, most), most);
}

TEST(SampleForecast, IsBeyondTheNextLookUnlessThatIsTheLast) {
    EXPECT_EQ(cli::forecast_sample_count(0, 0.01, 0.01, most), 17U);
    EXPECT_EQ(cli::forecast_sample_count(64, 0.01, 0.01, most), 81U);
    EXPECT_EQ(cli::forecast_sample_count(64, 0.01, 0.01, 70), 70U);
}

TEST(StepLength, AimsAtItsTimeAndHasALeast) {
    EXPECT_EQ(cli::next_step_length(16, 2.0 * cli::step_seconds), 16U);
    EXPECT_EQ(cli::next_step_length(100, 4.0 * cli::step_seconds), 25U);
    EXPECT_EQ(cli::next_step_length(100, 0.5 * cli::step_seconds), 200U);
    EXPECT_EQ(cli::next_step_length(1, 0.5 * cli::step_seconds), 16U);
    EXPECT_EQ(cli::next_step_length(100, 0.0), 1U << 30);
    EXPECT_EQ(cli::next_step_length(4000000000U, 1e-9), 1U << 30);
}

} // namespace
