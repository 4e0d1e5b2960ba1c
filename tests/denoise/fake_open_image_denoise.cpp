// Replaces Open Image Denoise by a mean over 5 x 5 pixels with planted faults. Values of FAKE_OIDN:
// identity  filters nothing
// shift     moves the image by a pixel
// darken    removes a twentieth
// cut       removes all light above 4
// (number)  causes the error of this number
// gpu       offers no CPU
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr int invalid_argument = 2;
constexpr int unsupported_hardware = 5;

using Buffer = std::vector<float>;

struct Device {
    int error = 0;
    bool is_committed = false;
};

struct Filter {
    Device &device;
    std::map<std::string, Buffer *> images{};
    std::map<std::string, bool> flags{};
    std::size_t width = 0;
    std::size_t height = 0;
};

std::string wish() {
    const char *const text = std::getenv("FAKE_OIDN");
    return text ? text : "";
}

void run(const Filter &filter) {
    const int radius = wish() == "identity" ? 0 : 2;
    const int shift = wish() == "shift" ? 1 : 0;
    const double factor = wish() == "darken" ? 0.95 : 1.0;
    const float most = wish() == "cut" ? 4.0F : std::numeric_limits<float>::infinity();
    const Buffer &color = *filter.images.at("color");
    Buffer &output = *filter.images.at("output");
    const auto width = static_cast<int>(filter.width);
    const auto height = static_cast<int>(filter.height);
    for (std::size_t i = 0; i < 3 * filter.width * filter.height; ++i) {
        const auto pixel = static_cast<int>(i / 3);
        const int x = std::min(pixel % width + shift, width - 1);
        const int y = pixel / width;
        double sum = 0.0;
        int count = 0;
        for (int row = std::max(y - radius, 0); row <= std::min(y + radius, height - 1); ++row)
            for (int column = std::max(x - radius, 0); column <= std::min(x + radius, width - 1); ++column, ++count)
                sum += std::min(color[static_cast<std::size_t>(row * width + column) * 3 + i % 3], most);
        output[i] = static_cast<float>(factor * sum / count);
    }
}

} // namespace

extern "C" {

void *oidnNewDevice(int type) {
    constexpr int cpu = 1;
    return type == cpu && wish() == "gpu" ? nullptr : new Device;
}

void oidnCommitDevice(void *device) {
    static_cast<Device *>(device)->is_committed = true;
}

void oidnReleaseDevice(void *device) {
    delete static_cast<Device *>(device);
}

int oidnGetDeviceError(void *device, const char **message) {
    const int error = device ? std::exchange(static_cast<Device *>(device)->error, 0) : unsupported_hardware;
    *message = error != 0 ? "as planted" : nullptr;
    return error;
}

void *oidnNewFilter(void *device, const char *type) {
    auto &of = *static_cast<Device *>(device);
    if (!of.is_committed || std::string(type) != "RT")
        of.error = invalid_argument;
    return new Filter{of};
}

void *oidnNewBuffer(void *, std::size_t size) {
    return new Buffer(size / sizeof(float));
}

void oidnWriteBuffer(void *buffer, std::size_t offset, std::size_t size, const void *from) {
    std::memcpy(static_cast<Buffer *>(buffer)->data() + offset, from, size);
}

void oidnReadBuffer(void *buffer, std::size_t offset, std::size_t size, void *to) {
    std::memcpy(to, static_cast<Buffer *>(buffer)->data() + offset, size);
}

void oidnReleaseBuffer(void *buffer) {
    delete static_cast<Buffer *>(buffer);
}

void oidnSetFilterImage(void *filter, const char *name, void *buffer, int format, std::size_t width, std::size_t height,
                        std::size_t offset, std::size_t pixel_stride, std::size_t row_stride) {
    constexpr int float3 = 3;
    auto &of = *static_cast<Filter *>(filter);
    if (format != float3 || offset != 0 || pixel_stride != 0 || row_stride != 0)
        of.device.error = invalid_argument;
    of.images[name] = static_cast<Buffer *>(buffer);
    of.width = width;
    of.height = height;
}

void oidnSetFilterBool(void *filter, const char *name, bool value) {
    static_cast<Filter *>(filter)->flags[name] = value;
}

void oidnCommitFilter(void *filter) {
    auto &of = *static_cast<Filter *>(filter);
    const bool is_whole = of.images["color"] && of.images["albedo"] && of.images["normal"] && of.images["output"];
    if (!is_whole || !of.flags["hdr"] || !of.flags["cleanAux"])
        of.device.error = invalid_argument;
}

void oidnExecuteFilter(void *filter) {
    const auto &of = *static_cast<Filter *>(filter);
    if (of.device.error == 0)
        of.device.error = std::atoi(wish().c_str());
    if (of.device.error == 0)
        run(of);
}

void oidnReleaseFilter(void *filter) {
    delete static_cast<Filter *>(filter);
}
}
