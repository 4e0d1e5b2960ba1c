#include "lib/kernel/accuracy.h"
#include "tests/api/api_fixture.h"

#include <cstring>

namespace api {

namespace {

constexpr uint32_t more_than_all = 100;

uint32_t function_count(pt_context *context) {
    uint32_t count = 0;
    EXPECT_EQ(pt_get_accuracy(context, nullptr, &count), PT_OK) << pt_last_error(context);
    return count;
}

TEST_F(ApiTest, AccuracyNeedsNoScene) {
    std::vector<pt_function_accuracy> rows(more_than_all);
    uint32_t count = more_than_all;
    ASSERT_EQ(pt_get_accuracy(context(), rows.data(), &count), PT_OK) << message();
    ASSERT_EQ(count, function_count(context()));
    ASSERT_EQ(count, pt::elementary_functions().size());
    for (uint32_t i = 0; i < count; ++i) {
        EXPECT_NE(rows[i].name[0], '\0');
        EXPECT_NE(std::memchr(rows[i].name, '\0', sizeof rows[i].name), nullptr);
        EXPECT_GE(rows[i].worst_error, 0.0) << rows[i].name;
        EXPECT_LE(rows[i].worst_error, rows[i].bound) << rows[i].name;
        EXPECT_STREQ(rows[i].name, pt::elementary_functions()[i].name) << "a name too long is cut";
    }
}

TEST_F(ApiTest, AccuracyWritesAtMostCountRows) {
    const uint32_t available = function_count(context());
    for (const uint32_t room : {0U, 1U, available - 1, available, available + 1}) {
        std::vector<pt_function_accuracy> rows(available + 2);
        std::memset(static_cast<void *>(rows.data()), 0x55, rows.size() * sizeof(pt_function_accuracy));
        const pt_function_accuracy untouched = rows.back();
        uint32_t count = room;
        ASSERT_EQ(pt_get_accuracy(context(), rows.data(), &count), PT_OK) << message();
        EXPECT_EQ(count, std::min(room, available));
        for (std::size_t i = count; i < rows.size(); ++i)
            EXPECT_EQ(std::memcmp(&rows[i], &untouched, sizeof untouched), 0) << "room for " << room << ", row " << i;
        if (count > 0) {
            EXPECT_STREQ(rows[count - 1].name, pt::elementary_functions()[count - 1].name);
        }
    }
}

} // namespace

} // namespace api
