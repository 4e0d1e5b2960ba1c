#include "tests/api/api_fixture.h"
#include "tests/api/every_call.h"
#include "tests/support/scene_of.h"

#include <pt/errors.h>

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace api {

namespace {

const std::string from_callback = "called from a callback of its own context";
const std::string from_thread = "this context is in use by another thread";

class InUseTest : public ApiTest {
protected:
    static void expect_all_refused(const Outcomes &outcomes, const std::string &message) {
        expect_every_call(outcomes, "PT_ERROR_INVALID_STATE: " + message);
    }

    void accumulate_and(const std::function<void()> &action, pt_result expected = PT_OK) {
        struct Once {
            const std::function<void()> &action;
            bool done = false;
            static std::int32_t progress(void *user, double) {
                auto *once = static_cast<Once *>(user);
                if (!once->done) {
                    once->done = true;
                    once->action();
                }
                return 0;
            }
        } once{action};
        const pt_accumulate_info info = accumulate_info(1, 0.0, &Once::progress, &once);
        EXPECT_EQ(pt_accumulate(context(), &info), expected) << message();
        EXPECT_TRUE(once.done);
    }
};

TEST_F(InUseTest, CallsFromACallbackAreRefused) {
    set_all();
    Outcomes inside;
    accumulate_and([&] {
        inside = outcomes_of_every_call(context());
        EXPECT_EQ(pt_get_broken_rule(context(), 0, nullptr), 0U);
    });
    expect_all_refused(inside, from_callback);
    EXPECT_EQ(message(), from_callback) << "the last call that failed";
    expect_image(1);
    EXPECT_EQ(message(), "") << "that was refused before a call that was not";
}

TEST_F(InUseTest, CallsFromAnotherThreadAreRefused) {
    set_all();
    EXPECT_EQ(pt_set_scene(context(), nullptr), PT_ERROR_INVALID_ARGUMENT);
    const std::string own = message();
    Outcomes elsewhere;
    std::string before, after, here;
    accumulate_and([&] {
        std::thread([&] {
            before = pt_last_error(context());
            EXPECT_EQ(pt_get_broken_rule(context(), 0, nullptr), 0U);
            elsewhere = outcomes_of_every_call(context());
        }).join();
        here = message();
    });
    expect_all_refused(elsewhere, from_thread);
    EXPECT_EQ(before, from_thread) << "not even the message is to be had";
    EXPECT_EQ(here, own) << "this thread's calls have not failed since";
    expect_image(1);
    EXPECT_EQ(message(), own);
}

TEST_F(InUseTest, AnExceptionOfACallbackIsAnErrorThatKeepsTheFilmWhole) {
    set_all();
    std::string inside;
    const auto fail = [&] {
        EXPECT_EQ(pt_set_scene(context(), nullptr), PT_ERROR_INVALID_STATE);
        inside = message();
        throw std::runtime_error("thrown by a callback");
    };
    accumulate_and(fail, PT_ERROR_INTERNAL);
    EXPECT_EQ(inside, from_callback);
    EXPECT_EQ(message(), "thrown by a callback");
    std::thread([&] { EXPECT_EQ(message(), "thrown by a callback"); }).join();
    const uint32_t kept = stats().sample_count;
    accumulate(2);
    expect_image(kept + 2);
}

using Lines = std::vector<std::string>;

struct EagerLog {
    Lines lines;
    pt_context *context = nullptr;

    static void receive(void *user, int32_t level, const char *line) {
        auto *log = static_cast<EagerLog *>(user);
        if (level == PT_LOG_ERROR)
            log->lines.push_back(line);
        pt_destroy(log->context);
    }
};

TEST_F(InUseTest, AContextInUseIsNotDestroyed) {
    EagerLog log;
    Context other = create_context([&](pt_create_info &info) {
        info.flags = 0;
        info.log = &EagerLog::receive;
        info.log_user = &log;
    });
    ASSERT_NO_FATAL_FAILURE(api::set_all(other.get()));
    log.context = other.get();
    const auto destroy = [](void *user, double) -> std::int32_t {
        auto *context = static_cast<pt_context *>(user);
        pt_destroy(context);
        EXPECT_EQ(pt_last_error(context), from_callback);
        std::thread([&] { pt_destroy(context); }).join();
        return 1;
    };
    const pt_accumulate_info info = accumulate_info(1, 0.0, destroy, other.get());
    EXPECT_GE(pt_accumulate(other.get(), &info), PT_OK) << pt_last_error(other.get());
    log.context = nullptr;
    EXPECT_EQ(log.lines, (Lines{"pt_destroy: " + from_callback + "; it was not destroyed",
                                "pt_destroy: " + from_thread + "; it was not destroyed"}));
    const pt_accumulate_info more = accumulate_info(1);
    EXPECT_EQ(pt_accumulate(other.get(), &more), PT_OK) << pt_last_error(other.get());
}

} // namespace

} // namespace api
