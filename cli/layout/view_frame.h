// From where a figure is seen: the option --view and --up, and the axes of the picture that follow from them.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace cli {

// Unit vectors at right angles, right-handed as right x up = -forward: the picture's axes, and where the camera looks.
struct ViewFrame {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;
};

inline constexpr std::array<std::string_view, 7> view_names{"three-quarter", "front", "back",  "left",
                                                            "right",         "top",   "bottom"};

// A direction from the data to the camera: a name, or numbers in the data's coordinates.
struct ViewDirection {
    std::string_view name; // one of view_names; empty: the vector counts
    glm::dvec3 vector;     // not 0
};

// "front", or "1,-2,0.5". Nothing for what is neither, and for 0,0,0.
std::optional<ViewDirection> parse_view(std::string_view text);

// Nothing for 0.
std::optional<glm::dvec3> unit_vector(const glm::dvec3 &vector);

// "z" or "-y".
std::optional<glm::dvec3> parse_axis(std::string_view text);

// The same, or "0,1,1".
std::optional<glm::dvec3> parse_up(std::string_view text);

// How large the data are along up, as a share of how large they are across it: 0 for a flat layer, 1 for a cube.
//
// By taste the three-quarter view is 30 degrees from the front towards the right, so that neither an edge of a box nor
// its diagonal is in the line of sight, and from 22 degrees above. Flat data are seen from higher, up to 50 degrees for
// a disc, as they would hide themselves; what has no thickness at all is seen from the top.
ViewFrame view_frame(const ViewDirection &view, const glm::dvec3 &up, double relative_height);

// The directions in the data's coordinates that front and right are seen from. Right is x, or y where up is nearest to
// x; front is right x up: with up = z that is -y, with up = y it is z, as simulations and molecules have it.
struct Compass {
    glm::dvec3 right;
    glm::dvec3 front;
    glm::dvec3 up;
};
Compass compass_of(const glm::dvec3 &up);

} // namespace cli
