// A pt_context whose failed calls throw Failure. Messages name options and places in scene files.
#pragma once

#include "cli/base/environment.h"
#include "cli/base/exit_code.h"
#include "cli/base/interrupt.h"
#include "cli/base/kernel_folder.h"
#include "cli/base/vector_width.h"
#include "lib/base/error.h"
#include "lib/base/struct_size.h"

#include <pt/errors.h>
#include <pt/pt.h>
#include <pt/shaders.h>
#include <pt/stats.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cli {

using pt::BrokenRule;
using pt::sized;

// For example "--size: width". Returns nullptr if no option sets the field.
const char *find_option(const BrokenRule &rule);

struct LibraryError {
    std::string message;
    std::vector<BrokenRule> rules; // empty if the message concerns no field
    std::uint64_t left_out = 0;    // broken rules beyond `rules`

    std::string in_words(const std::function<std::string(const BrokenRule &)> &words) const;
};

std::optional<BrokenRule> broken_rule(const pt_broken_rule &rule);

std::string in_words_of_options(const BrokenRule &rule);

// Without a context, returns the thread's last error.
LibraryError last_error(const pt_context *context);

inline void require(pt_result result) {
    if (result < 0)
        throw Failure(exit_code_of(result), pt_last_error(nullptr));
}

// Calls list(elements, &count) twice: for the count, then for the elements.
template <typename Element, typename Count = std::uint32_t, typename List>
std::vector<Element> elements_of(const List &list) {
    Count count = 0;
    list(static_cast<Element *>(nullptr), &count);
    std::vector<Element> elements(count);
    list(elements.data(), &count);
    elements.resize(count);
    return elements;
}

// A pt_progress_fn whose `user` is a std::function<bool(double)>.
inline std::int32_t call_listener(void *user, double share) {
    return (*static_cast<const std::function<bool(double)> *>(user))(share) ? 0 : 1;
}

// The texts must outlive the result.
inline pt_create_info create_info(const std::string &device, const std::string &shader_dir) {
    auto info = sized<pt_create_info>();
    info.device = device.empty() ? nullptr : device.c_str();
    info.shader_dir = shader_dir.empty() ? nullptr : shader_dir.c_str();
    return info;
}

class Context {
public:
    // Keeps kernels in the user's cache. Sets environment variables, so no other thread may run.
    explicit Context(pt_create_info info, const KernelUse &use = {}) :
        shader_dir_(info.shader_dir == nullptr ? "" : info.shader_dir) {
        VectorWidth width(use);
        kernels_.serve(info);
        const EndAtOnce compiling; // compiling may take long
        create(info);
        pt_device_info device{};
        if (pt_get_context_device(context_, &device) >= 0 && width.should_measure(device)) {
            pt_destroy(std::exchange(context_, nullptr));
            width.measure(device);
            create(info);
        }
    }
    Context(const Context &) = delete;
    Context &operator=(const Context &) = delete;
    ~Context() { pt_destroy(context_); }

    pt_context *get() const { return context_; }
    LibraryError last_error() const { return cli::last_error(context_); }

    void reload_shaders() const {
        const EndAtOnce compiling;
        require(pt_reload_shaders(context_));
    }

    void require(pt_result result) const {
        if (result < 0)
            fail(result, last_error());
    }

    pt_stats stats() const {
        auto stats = sized<pt_stats>();
        require(pt_get_stats(context_, &stats));
        return stats;
    }

    std::optional<BrokenRule> warning() const {
        auto rule = sized<pt_broken_rule>();
        require(pt_get_warning(context_, &rule));
        return broken_rule(rule);
    }

    pt_error_estimate error_estimate() const {
        auto error = sized<pt_error_estimate>();
        require(pt_get_error_estimate(context_, &error));
        return error;
    }

    template <typename Number>
    void read(std::uint32_t first, std::uint32_t count, std::uint32_t rows, std::uint32_t quantity,
              Number *values) const {
        constexpr bool is_color = std::is_same_v<Number, float>;
        auto image = sized<pt_image>();
        image.quantity = quantity;
        image.format = is_color ? PT_FORMAT_RGB32F : PT_FORMAT_R32UI;
        image.data = values;
        image.size_bytes = (is_color ? 3 : 1) * sizeof(Number) * count * rows;
        image.x = first;
        image.width = count;
        image.height = rows;
        require(pt_readback(context_, &image));
    }

private:
    void create(const pt_create_info &info) {
        const pt_result result = pt_create(&info, &context_);
        if (result < 0)
            fail(result, cli::last_error(nullptr));
    }

    [[noreturn]] void fail(pt_result result, const LibraryError &error) const {
        const bool loses_work = result == PT_ERROR_INTERNAL || result == PT_ERROR_DEVICE_LOST;
        throw Failure(code_of(result, error), error.in_words(&in_words_of_options) +
                                                  (loses_work && !shader_dir_.empty()
                                                       ? "; an endless loop or another local_size in the shaders in " +
                                                             shader_dir_ + " does this"
                                                       : ""));
    }

    ExitCode code_of(pt_result result, const LibraryError &error) const {
        if (result == PT_ERROR_SHADER && !shader_dir_.empty())
            return ExitCode::scene;
        const bool lacks_compiler = !error.rules.empty() && error.rules.front().member == "shader_dir";
        return lacks_compiler ? ExitCode::file : exit_code_of(result);
    }

    static std::filesystem::path kernel_path() {
        const std::filesystem::path cache = user_cache();
        return cache.empty() ? cache : cache / "kernels";
    }

    std::string shader_dir_;
    KernelFolder kernels_{kernel_path()};
    pt_context *context_ = nullptr;
};

} // namespace cli
