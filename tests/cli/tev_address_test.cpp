// Where tev listens: what is taken, and what is not.
#include "cli/tev/tev_address.h"

#include <gtest/gtest.h>

namespace {

std::string read(const char *text) {
    const auto address = cli::parse_tev_address(text);
    return address ? address->host + " " + address->port : "nothing";
}

TEST(TevAddress, HostAndPort) {
    EXPECT_EQ(read("127.0.0.1:14158"), "127.0.0.1 14158");
    EXPECT_EQ(read("viewer:1"), "viewer 1");
    EXPECT_EQ(read("[::1]:65535"), "::1 65535");
    for (const char *wrong : {"", ":", "viewer", "viewer:", ":1", "viewer:0", "viewer:65536", "viewer:-1", "viewer:x",
                              "::1", "::1:5", "[]:1"})
        EXPECT_EQ(read(wrong), "nothing") << wrong;
}

TEST(TevAddress, IsWrittenAsItIsRead) {
    EXPECT_EQ(cli::tev_address_text({}), "127.0.0.1:14158");
    EXPECT_EQ(cli::tev_address_text({"::1", "7"}), "[::1]:7");
}

} // namespace
