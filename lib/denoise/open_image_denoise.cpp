#include "lib/denoise/open_image_denoise.h"

#include "lib/base/error.h"
#include "lib/platform/file.h"
#include "lib/platform/module.h"

#include <memory>
#include <string>
#include <utility>

namespace pt {

namespace {

// The C interface of Open Image Denoise 2 (openimagedenoise.org, "Open Image Denoise API").
constexpr int oidn_device_type_default = 0;
constexpr int oidn_device_type_cpu = 1;
constexpr int oidn_format_float3 = 3;
constexpr int oidn_error_none = 0;
constexpr int oidn_error_out_of_memory = 4;
constexpr int oidn_error_unsupported_hardware = 5;

class Library {
public:
    // The library is never unloaded, since its threads may outlast this object.
    explicit Library(const std::string &path) : path_(path), handle_(platform::load_module(platform::path_of(path))) {
        find("oidnNewDevice", new_device);
        find("oidnCommitDevice", commit_device);
        find("oidnReleaseDevice", release_device);
        find("oidnGetDeviceError", get_device_error);
        find("oidnNewFilter", new_filter);
        find("oidnNewBuffer", new_buffer);
        find("oidnWriteBuffer", write_buffer);
        find("oidnReadBuffer", read_buffer);
        find("oidnReleaseBuffer", release_buffer);
        find("oidnSetFilterImage", set_image);
        find("oidnSetFilterBool", set_bool);
        find("oidnCommitFilter", commit_filter);
        find("oidnExecuteFilter", execute_filter);
        find("oidnReleaseFilter", release_filter);
    }

    void *(*new_device)(int type);
    void (*commit_device)(void *device);
    void (*release_device)(void *device);
    int (*get_device_error)(void *device, const char **message); // clears the error
    void *(*new_filter)(void *device, const char *type);
    void *(*new_buffer)(void *device, std::size_t size);
    void (*write_buffer)(void *buffer, std::size_t offset, std::size_t size, const void *from);
    void (*read_buffer)(void *buffer, std::size_t offset, std::size_t size, void *to);
    void (*release_buffer)(void *buffer);
    void (*set_image)(void *filter, const char *name, void *buffer, int format, std::size_t width, std::size_t height,
                      std::size_t byte_offset, std::size_t pixel_stride, std::size_t row_stride); // 0: no gaps
    void (*set_bool)(void *filter, const char *name, bool value);
    void (*commit_filter)(void *filter);
    void (*execute_filter)(void *filter);
    void (*release_filter)(void *filter);

private:
    template <typename Function>
    void find(const char *name, Function &function) {
        function = handle_ ? reinterpret_cast<Function>(platform::find_function(handle_, name)) : nullptr;
        if (function)
            return;
        const std::string rule = std::string("Open Image Denoise 2 cannot be loaded: ") + platform::module_error() +
                                 "; pip install pyoidn installs it as pyoidn/oidn/lib/" + platform::denoiser_file;
        refuse_argument("denoise", "library", '"' + path_ + '"', rule, PT_ERROR_UNSUPPORTED);
    }

    std::string path_;
    void *handle_;
};

pt_result result_of(int error) {
    switch (error) {
    case oidn_error_out_of_memory:
        return PT_ERROR_OUT_OF_HOST_MEMORY;
    case oidn_error_unsupported_hardware:
        return PT_ERROR_UNSUPPORTED;
    default:
        return PT_ERROR_INTERNAL;
    }
}

// Reports errors of device creation if `device` is NULL.
void require_success(const Library &library, void *device) {
    const char *message = nullptr;
    const int error = library.get_device_error(device, &message);
    if (error != oidn_error_none)
        throw Error(result_of(error), std::string("Open Image Denoise: ") + (message ? message : "no message"));
}

using Handle = std::unique_ptr<void, void (*)(void *)>;

// Copies images to device buffers, since a GPU may be unable to read host memory.
void filter(const Library &library, void *device, const pt_denoise_info &info, float *first_filtered,
            float *second_filtered) {
    const std::size_t size = std::size_t{info.width} * info.height * 3 * sizeof(float);
    const Handle filter(library.new_filter(device, "RT"), library.release_filter);
    require_success(library, device);
    const auto new_image = [&](const char *name) {
        Handle image(library.new_buffer(device, size), library.release_buffer);
        require_success(library, device);
        library.set_image(filter.get(), name, image.get(), oidn_format_float3, info.width, info.height, 0, 0, 0);
        return image;
    };
    const Handle radiance = new_image("color");
    const Handle albedo = new_image("albedo");
    const Handle normal = new_image("normal");
    const Handle filtered = new_image("output");
    library.write_buffer(albedo.get(), 0, size, info.albedo);
    library.write_buffer(normal.get(), 0, size, info.normal);
    library.set_bool(filter.get(), "hdr", true);
    library.set_bool(filter.get(), "cleanAux", true);
    library.commit_filter(filter.get());
    for (const auto &[from, to] : {std::pair(info.first, first_filtered), {info.second, second_filtered}}) {
        library.write_buffer(radiance.get(), 0, size, from);
        library.execute_filter(filter.get());
        library.read_buffer(filtered.get(), 0, size, to);
    }
    require_success(library, device);
}

} // namespace

void run_open_image_denoise(const pt_denoise_info &info, float *first_filtered, float *second_filtered) {
    const Library library(info.library ? info.library : platform::denoiser_file);
    const int device_type = info.any_device != 0 ? oidn_device_type_default : oidn_device_type_cpu;
    const Handle device(library.new_device(device_type), library.release_device);
    if (!device)
        require_success(library, nullptr);
    library.commit_device(device.get());
    require_success(library, device.get());
    filter(library, device.get(), info, first_filtered, second_filtered);
}

} // namespace pt
