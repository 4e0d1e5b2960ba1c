// The command `pt compare`: two images, in numbers and in a picture of their difference.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace cli {

struct CompareOptions {
    std::string image;
    std::string reference;
    std::string layer;      // of both; empty: the main one
    std::string difference; // path of the picture of the differences; empty: none
    std::string json;
    bool quiet = false;

    // Limits; nothing: none.
    std::optional<double> mse;
    std::optional<double> relative_mse;
    std::optional<double> maximum;
};

extern const char *const compare_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_compare_options(CLI::App &command, CompareOptions &options);

// Returns the exit code; throws Failure.
int run_compare(const CompareOptions &options);

} // namespace cli
