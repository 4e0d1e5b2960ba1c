// The bytes by which a picture is sent to the image viewer tev. Its protocol is published with it:
// github.com/Tom94/tev, include/tev/Ipc.h and src/Ipc.cpp, read at the commits 029022e4 and 023a0f2f of 2025. A packet
// is its own length in bytes (uint32), its kind (one byte), and the fields of that kind, all little-endian; texts end
// with a zero byte:
//   4, CreateImage:   whether to take the focus (byte), name, width, height, number of channels (int32), their names
//   6, UpdateImageV3: focus, name, number of channels (int32), their names, x, y, width, height (int32) of a rectangle,
//                     the first value and the stride of each channel (int64, counted in values), values (float32)
// An image is named by its packets; one that is created anew takes the place of another of its name.
#pragma once

#include "cli/image/image_window.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace cli {

// A picture, or as much of it as there is.
struct TevPicture {
    std::string name;
    ImageWindow window;
    std::uint32_t rows_done;           // of the window's part
    std::vector<float> radiance;       // three values a pixel of the part
    std::vector<float> standard_error; // the same, or empty
};

std::vector<std::byte> create_image_packet(const TevPicture &picture);

// Hands over the packets that put the pixels into the image, in tiles that are small beside the image: the viewer need
// not have room for two of them, and this program has none but one tile more.
void for_each_update_packet(const TevPicture &picture, const std::function<void(std::span<const std::byte>)> &send);

} // namespace cli
