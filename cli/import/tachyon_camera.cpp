#include "cli/import/tachyon_camera.h"

#include "cli/data/text_number.h"

#include <array>
#include <cmath>
#include <numbers>

namespace cli {
namespace {

class TachyonCameraReader {
public:
    TachyonCameraReader(TachyonWords &words, double aspect, std::vector<std::string> &left_out) :
        words_(words),
        aspect_(aspect),
        left_out_(left_out) {}

    TachyonCamera read() {
        read_projection();
        const double zoom = positive("ZOOM");
        height_ = 1.0 / zoom; // of the picture in a plane at the distance 1
        words_.expect("ASPECTRATIO");
        if (words_.number("ASPECTRATIO") != 1.0) {
            words_.refuse("ASPECTRATIO: must be 1, pixels are square");
        }
        words_.expect("ANTIALIASING");
        words_.number("ANTIALIASING");
        words_.expect("RAYDEPTH");
        words_.number("RAYDEPTH");
        words_.expect("CENTER");
        camera_.camera.position = words_.mirrored("CENTER");
        words_.expect("VIEWDIR");
        camera_.view = words_.mirrored_direction("VIEWDIR");
        words_.expect("UPDIR");
        camera_.camera.up = words_.mirrored_direction("UPDIR");
        read_end();
        if (is_orthographic_) {
            camera_.camera.vertical_extent = height_;
        } else {
            camera_.camera.vertical_fov = 360.0 / std::numbers::pi * std::atan(0.5 * height_);
        }
        return camera_;
    }

private:
    double positive(std::string_view name) {
        words_.expect(name);
        const double value = words_.number(name);
        if (!(value > 0.0)) {
            words_.refuse(std::string(name).append(": must be above 0"));
        }
        return value;
    }

    // May be left out.
    void read_projection() {
        if (!words_.take_if("PROJECTION")) {
            return;
        }
        const std::string name = words_.keyword("the projection");
        if (name == "PERSPECTIVE_DOF") {
            positive("FOCALLENGTH");
            words_.expect("APERTURE");
            if (words_.number("APERTURE") != 0.0) {
                left_out_.push_back(words_.place() + ": PERSPECTIVE_DOF: depth of field is left out");
            }
        } else if (name != "PERSPECTIVE" && name != "ORTHOGRAPHIC") {
            words_.refuse("PROJECTION " + quoted_text(name) + ": must be PERSPECTIVE, PERSPECTIVE_DOF or ORTHOGRAPHIC");
        }
        is_orthographic_ = name == "ORTHOGRAPHIC";
    }

    // END_CAMERA, with the edges of the picture in the plane at the distance 1 before it if they are not as ZOOM has
    // them.
    void read_end() {
        if (words_.take_if("FRUSTUM")) {
            std::array<double, 4> edges{}; // left, right, bottom and top
            for (double &edge : edges) {
                edge = words_.number("FRUSTUM");
            }
            height_ = edges[3] - edges[2];
            const double width = edges[1] - edges[0];
            const double tolerance = 1e-4 * height_;
            if (!(height_ > 0.0) || !(std::abs(width - aspect_ * height_) <= aspect_ * tolerance) ||
                !(std::abs(edges[0] + edges[1]) <= tolerance) || !(std::abs(edges[2] + edges[3]) <= tolerance)) {
                words_.refuse("FRUSTUM: must be even about the middle, and of square pixels");
            }
        }
        words_.expect("END_CAMERA");
    }

    TachyonWords &words_;
    double aspect_;
    std::vector<std::string> &left_out_;
    TachyonCamera camera_;
    double height_ = 0.0;
    bool is_orthographic_ = false;
};

} // namespace

TachyonCamera read_tachyon_camera(TachyonWords &words, double aspect, std::vector<std::string> &left_out) {
    return TachyonCameraReader(words, aspect, left_out).read();
}

} // namespace cli
