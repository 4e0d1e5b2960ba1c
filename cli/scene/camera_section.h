// The section `camera` of a scene file.
#pragma once

#include "cli/base/json_value.h"

#include <pt/pt.h>

#include <array>
#include <string_view>

namespace cli {

// Values of `projection`.
inline constexpr std::array<std::string_view, 2> projection_names{"perspective", "orthographic"};

class CameraSection {
public:
    // Sets the camera to the one of files without a section: it looks from (0, 0, 1) at the origin.
    explicit CameraSection(pt_camera &camera);

    void begin() { is_there_ = true; }
    bool is_there() const { return is_there_; }
    void item(const JsonPlace &place, const nlohmann::json &value);

    // At the end of the file: refuses a section that lacks what a camera has to have.
    void require_complete() const;

private:
    pt_camera &camera_;
    bool is_there_ = false;
    bool has_position_ = false;
    bool has_look_at_ = false;
};

} // namespace cli
