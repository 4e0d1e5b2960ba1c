// Tests of cli/render/outcome: the exit code of every combination.
#include "cli/render/render_picture.h"

#include <gtest/gtest.h>

#include <csignal>

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
        const cli::Outcome outcome =
            cli::outcome_of({has_target, target_reached, timed_out, has_checkpoint, all_written});
        EXPECT_EQ(cli::exit_code_of(outcome, 0), expected) << bits;
    }
}

TEST(Outcome, ASignalCountsWhereNothingElseWentWrong) {
    EXPECT_EQ(cli::exit_code_of(cli::Outcome::interrupted, SIGINT), 130);
    EXPECT_EQ(cli::exit_code_of(cli::Outcome::interrupted, SIGTERM), 143);
    EXPECT_EQ(cli::exit_code_of(cli::Outcome::interrupted, SIGHUP), 129);
    EXPECT_EQ(cli::exit_code_of(cli::Outcome::not_all_written, SIGINT), 6);
    EXPECT_EQ(cli::exit_code_of(cli::Outcome::target_missed, 0), 7);
    EXPECT_EQ(cli::exit_code_of(cli::Outcome::timed_out, 0), 75);
    EXPECT_EQ(cli::exit_code_of(cli::Outcome::superseded, 0), 0);
}

} // namespace
