// A printed table of what was tried and what happened.
#pragma once

#include <cstdio>
#include <map>
#include <string>

namespace faults {

class Table {
public:
    explicit Table(const std::string &title) : title_(title) {}

    void add(const std::string &kind, const std::string &outcome) { ++counts_[kind][outcome]; }

    void print() const {
        std::printf("%-40s %6s  outcomes\n", title_.c_str(), "tried");
        for (const auto &[kind, outcomes] : counts_) {
            std::size_t tried = 0;
            std::string text;
            for (const auto &[outcome, count] : outcomes) {
                tried += count;
                text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + outcome;
            }
            std::printf("%-40s %6zu  %s\n", kind.c_str(), tried, text.c_str());
        }
    }

private:
    std::string title_;
    std::map<std::string, std::map<std::string, std::size_t>> counts_;
};

} // namespace faults
