#include "cli/tev/tev_packets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

namespace cli {
namespace {

static_assert(std::endian::native == std::endian::little, "values are sent as they lie in memory");

enum class PacketKind : std::uint8_t { create_image = 4, update_image_v3 = 6 };

constexpr std::size_t channel_count = 3;
constexpr std::uint32_t tile_side = 256;
// A layer of tev is what stands before the dot; the main one has no name.
constexpr std::array<std::string_view, 2> layers{"", "standard_error."};

class Packet {
public:
    explicit Packet(PacketKind kind) {
        add(std::uint32_t{0}); // the length, once it is known
        add(kind);
        add(std::uint8_t{0}); // no focus: it would be taken with every picture
    }

    template <typename Value>
    void add(Value value) {
        add_bytes(&value, sizeof value);
    }

    void add_text(std::string_view text) {
        add_bytes(text.data(), text.size());
        add(std::uint8_t{0});
    }

    void add_channel_names(std::string_view layer) {
        for (const char *const channel : {"R", "G", "B"}) {
            add_text(std::string(layer) + channel);
        }
    }

    void add_values(std::span<const float> values) { add_bytes(values.data(), values.size_bytes()); }

    std::vector<std::byte> finish() {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return std::move(bytes_);
    }

private:
    void add_bytes(const void *data, std::size_t size) {
        const auto *first = static_cast<const std::byte *>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }

    std::vector<std::byte> bytes_;
};

// tile: within the part.
std::vector<std::byte> update_packet(const TevPicture &picture, std::string_view layer, std::span<const float> values,
                                     const Rectangle &tile) {
    Packet packet(PacketKind::update_image_v3);
    packet.add_text(picture.name);
    packet.add(static_cast<std::int32_t>(channel_count));
    packet.add_channel_names(layer);
    const Rectangle &part = picture.window.part;
    for (const std::uint32_t number : {part.x + tile.x, part.y + tile.y, tile.width, tile.height}) {
        packet.add(static_cast<std::int32_t>(number));
    }
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        packet.add(static_cast<std::int64_t>(channel));
    }
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        packet.add(static_cast<std::int64_t>(channel_count));
    }
    for (std::uint32_t row = tile.y; row < tile.y + tile.height; ++row) {
        const std::size_t first = std::size_t{row} * part.width + tile.x;
        packet.add_values(values.subspan(channel_count * first, channel_count * tile.width));
    }
    return packet.finish();
}

} // namespace

std::vector<std::byte> create_image_packet(const TevPicture &picture) {
    const std::size_t layer_count = picture.standard_error.empty() ? 1 : 2;
    Packet packet(PacketKind::create_image);
    packet.add_text(picture.name);
    packet.add(static_cast<std::int32_t>(picture.window.full_width));
    packet.add(static_cast<std::int32_t>(picture.window.full_height));
    packet.add(static_cast<std::int32_t>(layer_count * channel_count));
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        packet.add_channel_names(layers[layer]);
    }
    return packet.finish();
}

void for_each_update_packet(const TevPicture &picture, const std::function<void(std::span<const std::byte>)> &send) {
    const std::uint32_t width = picture.window.part.width;
    for (std::uint32_t y = 0; y < picture.rows_done; y += tile_side) {
        for (std::uint32_t x = 0; x < width; x += tile_side) {
            const Rectangle tile{x, y, std::min(tile_side, width - x), std::min(tile_side, picture.rows_done - y)};
            send(update_packet(picture, layers[0], picture.radiance, tile));
            if (!picture.standard_error.empty()) {
                send(update_packet(picture, layers[1], picture.standard_error, tile));
            }
        }
    }
}

} // namespace cli
