// Attributes of an image file, with the texts that they point to.
#pragma once

#include "cli/image/image_module.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace cli {

class ImageAttributes {
public:
    ImageAttributes() = default;
    ImageAttributes(const ImageAttributes &) = delete;
    ImageAttributes &operator=(const ImageAttributes &) = delete;

    const std::vector<pt_image_attribute> &attributes() const { return attributes_; }

    void add(const std::string &name, std::string text) {
        attributes_.push_back({kept(name), kept(std::move(text)), 0.0, 0, 0});
    }

    // OpenEXR's whole numbers are signed and have 32 bits: the largest of them stands for all beyond.
    void add_whole(const std::string &name, std::uint32_t number) {
        constexpr std::uint32_t largest = std::numeric_limits<std::int32_t>::max();
        attributes_.push_back({kept(name), nullptr, static_cast<double>(std::min(number, largest)), 0, 0});
    }

    void add_real(const std::string &name, double number) {
        attributes_.push_back({kept(name), nullptr, number, 1, 0});
    }

    void add_copy(const pt_image_attribute &attribute) {
        attributes_.push_back(attribute);
        attributes_.back().name = kept(attribute.name);
        attributes_.back().text = attribute.text == nullptr ? nullptr : kept(attribute.text);
    }

private:
    const char *kept(std::string text) { return texts_.emplace_back(std::move(text)).c_str(); }

    std::deque<std::string> texts_; // which do not move when others come
    std::vector<pt_image_attribute> attributes_;
};

} // namespace cli
