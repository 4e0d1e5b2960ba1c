// Replaces libpt, needs no device and fails on demand. Environment variables:
// FAKE_PT_FAIL=function:result  fails the function
// FAKE_PT_FAIL=create:-99       throws std::bad_alloc
// FAKE_PT_FAIL=name:1           the device's name is invalid UTF-8; name:2: it has an escape
// FAKE_PT_MESSAGE               message of failures
// FAKE_PT_SAMPLE_MS             least duration of a sample
// FAKE_PT_SIGNAL=number:n       signal at the start of submission n; a sample has four submissions
// FAKE_PT_SCENE_SIGNAL=number   signal during pt_set_scene
// FAKE_PT_RED=number            red of all pixels
// FAKE_PT_LOG=function          logs a line in the function
#include <pt/accuracy.h>
#include <pt/devices.h>
#include <pt/errors.h>
#include <pt/film.h>
#include <pt/pt.h>
#include <pt/shaders.h>
#include <pt/stats.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <thread>

struct pt_context {
    pt_create_info info{};
    pt_render render{};
    std::uint32_t sample_count = 0;
    std::uint32_t call_count = 0; // since pt_set_render
    bool has_too_many_rows = false;
    std::string error;
};

namespace {

thread_local std::string creation_error;

std::string setting(const char *name) {
    const char *value = std::getenv(name);
    return value == nullptr ? "" : value;
}

pt_result failure(const std::string &function) {
    const std::string wanted = setting("FAKE_PT_FAIL");
    const bool fails = wanted.rfind(function + ":", 0) == 0;
    return fails ? std::atoi(wanted.c_str() + function.size() + 1) : PT_OK;
}

pt_result call(pt_context *context, const std::string &function) {
    if (context->info.log != nullptr && setting("FAKE_PT_LOG") == function)
        context->info.log(context->info.log_user, PT_LOG_ERROR, "a message of the layer");
    const pt_result result = failure(function);
    if (result < 0)
        context->error = setting("FAKE_PT_MESSAGE");
    return result;
}

pt_device_info fake_device() {
    pt_device_info device{};
    device.kind = PT_DEVICE_CPU;
    device.suitable = failure("suitable") == PT_OK ? 1 : 0;
    device.memory_bytes = std::uint64_t{1} << 30;
    for (int i = 0; i < 16; ++i)
        device.uuid[i] = static_cast<std::uint8_t>(i * 17);
    constexpr const char *names[] = {"fake device", "d\xe9vice", "d\x1bvice"}; // Latin-1; an escape
    std::strcpy(device.name, names[failure("name")]);
    std::strcpy(device.driver, "fake driver 1.0");
    std::strcpy(device.reason, device.suitable != 0 ? "" : "it is not real");
    return device;
}

void raise_wanted_signal() {
    static std::uint64_t submission_count = 0;
    const std::string wanted = setting("FAKE_PT_SIGNAL");
    const std::size_t colon = wanted.find(':');
    if (colon != std::string::npos && std::stoull(wanted.substr(colon + 1)) == ++submission_count)
        std::raise(std::stoi(wanted));
}

double fake_error(std::uint32_t sample_count) {
    return sample_count < 16 ? std::numeric_limits<double>::infinity() : 1.0 / sample_count;
}

std::uint32_t rows_of(const pt_render &render) {
    return render.row_count == 0 ? render.height - render.first_row : render.row_count;
}

} // namespace

pt_result pt_get_devices(pt_device_info *devices, std::uint32_t *count) {
    const pt_result result = failure("devices");
    if (result < 0) {
        creation_error = "no Vulkan device";
        return result;
    }
    *count = 1;
    if (devices != nullptr)
        *devices = fake_device();
    return PT_OK;
}

pt_result pt_create(const pt_create_info *info, pt_context **context) {
    const pt_result result = failure("create");
    if (result < 0) {
        if (result == -99)
            throw std::bad_alloc();
        creation_error = setting("FAKE_PT_MESSAGE");
        *context = nullptr;
        return result;
    }
    *context = new pt_context;
    (*context)->info = *info;
    return PT_OK;
}

const char *pt_last_error(const pt_context *context) {
    return context == nullptr ? creation_error.c_str() : context->error.c_str();
}

uint64_t pt_get_broken_rule(const pt_context *context, std::uint32_t index, pt_broken_rule *rule) {
    if (context == nullptr || !context->has_too_many_rows)
        return 0;
    if (index == 0 && rule != nullptr)
        *rule = {sizeof(pt_broken_rule), -1, -1, "render", "width", "* rows", "40 * 33", "more than the device has"};
    return 1;
}

pt_result pt_get_warning(pt_context *context, pt_broken_rule *warning) {
    *warning = {};
    return call(context, "warning");
}

void pt_destroy(pt_context *context) {
    if (context != nullptr)
        call(context, "destroy");
    delete context;
}

pt_result pt_get_context_device(pt_context *context, pt_device_info *device) {
    *device = fake_device();
    return call(context, "context_device");
}

pt_result pt_set_scene(pt_context *context, const pt_scene *scene) {
    if (const std::string signal = setting("FAKE_PT_SCENE_SIGNAL"); !signal.empty())
        std::raise(std::stoi(signal));
    if (scene->progress != nullptr && scene->progress(scene->progress_user, 0.5) != 0)
        return PT_CANCELLED;
    return call(context, "set_scene");
}

pt_result pt_set_camera(pt_context *context, const pt_camera *) {
    return call(context, "set_camera");
}

pt_result pt_set_render(pt_context *context, const pt_render *render) {
    context->render = *render;
    context->sample_count = 0;
    context->call_count = 0;
    context->has_too_many_rows = false;
    const std::string max_rows = setting("FAKE_PT_MAX_ROWS");
    if (!max_rows.empty() && rows_of(*render) > std::stoul(max_rows)) {
        context->has_too_many_rows = true;
        return PT_ERROR_UNSUPPORTED;
    }
    return call(context, "set_render");
}

pt_result pt_reload_shaders(pt_context *context) {
    return call(context, "reload_shaders");
}

pt_result pt_prepare(pt_context *context) {
    return call(context, "prepare");
}

pt_result pt_accumulate(pt_context *context, const pt_accumulate_info *info) {
    const std::string milliseconds = setting("FAKE_PT_SAMPLE_MS");
    const pt_result result = call(context, "accumulate");
    if (result < 0)
        return result;
    constexpr std::uint32_t submissions_per_sample = 4;
    const auto pause = std::chrono::milliseconds(std::atoi(milliseconds.c_str())) / submissions_per_sample;
    const std::uint64_t submissions = std::uint64_t{info->sample_count} * submissions_per_sample;
    const std::uint32_t before = context->sample_count;
    const auto start = std::chrono::steady_clock::now();
    ++context->call_count;
    for (std::uint64_t done = 1; done <= submissions; ++done) {
        if (fake_error(context->sample_count) <= info->stopping.target_error)
            return PT_TARGET_REACHED;
        raise_wanted_signal();
        std::this_thread::sleep_for(pause);
        context->sample_count = before + static_cast<std::uint32_t>(done / submissions_per_sample);
        if (info->progress != nullptr &&
            info->progress(info->progress_user, static_cast<double>(done) / static_cast<double>(submissions)) != 0)
            return PT_CANCELLED;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        const bool is_over = info->stopping.time_limit > 0.0 && passed.count() >= info->stopping.time_limit;
        if (is_over && done % submissions_per_sample == 0 && done < submissions)
            return PT_LIMIT_REACHED;
    }
    return PT_OK;
}

// With FAKE_PT_FAIL=split:1 the number of calls changes blue.
pt_result pt_readback(pt_context *context, const pt_image *image) {
    const pt_render &render = context->render;
    auto *object = static_cast<std::uint32_t *>(image->data);
    const float wrong = failure("split") == PT_OK ? 0.0F : static_cast<float>(context->call_count);
    const std::string red = setting("FAKE_PT_RED");
    auto *value = static_cast<float *>(image->data);
    const bool is_whole = image->width == 0;
    const std::uint32_t width = is_whole ? render.width : image->width;
    const std::uint32_t height = is_whole ? rows_of(render) : image->height;
    for (std::uint32_t y = render.first_row + image->y; y < render.first_row + image->y + height; ++y) {
        for (std::uint32_t x = image->x; x < image->x + width; ++x) {
            if (image->quantity == PT_QUANTITY_OBJECT) {
                *object++ = y * render.width + x;
                continue;
            }
            *value++ = red.empty() ? static_cast<float>(x) / static_cast<float>(std::max(render.width, 2U) - 1)
                                   : std::stof(red);
            *value++ = static_cast<float>(y) / static_cast<float>(std::max(render.height, 2U) - 1);
            *value++ = 2.0F + wrong;
        }
    }
    return call(context, "readback");
}

pt_result pt_get_stats(pt_context *context, pt_stats *stats) {
    stats->sample_count = stats->max_sample_count = context->sample_count;
    stats->mean_sample_count = context->sample_count;
    stats->rejected_samples = failure("rejected") == PT_OK ? 0 : 3;
    stats->device_bytes = 4096;
    stats->submit_count = 4 * std::uint64_t{context->sample_count};
    stats->device_seconds = 0.25;
    stats->features = PT_FEATURE_LAMPS | PT_FEATURE_MOTION;
    return call(context, "stats");
}

pt_result pt_get_error_estimate(pt_context *context, pt_error_estimate *error) {
    const double high = fake_error(context->sample_count);
    const double low = std::isinf(high) ? 0.0 : 0.25 * high;
    *error = {sizeof *error, 0, high, 2.0 * low, 2.0 * high, 0.5 * high, low, high};
    return call(context, "error");
}

pt_result pt_save_film(pt_context *context, void *data, std::uint64_t *size_bytes) {
    *size_bytes = sizeof context->sample_count;
    if (data != nullptr)
        std::memcpy(data, &context->sample_count, *size_bytes);
    return call(context, "save_film");
}

pt_result pt_add_film(pt_context *context, const void *data, std::uint64_t size_bytes) {
    std::uint32_t more = 0;
    std::memcpy(&more, data, size_bytes);
    context->sample_count += more;
    return call(context, "add_film");
}

pt_result pt_get_accuracy(pt_context *context, pt_function_accuracy *rows, std::uint32_t *count) {
    if (rows != nullptr && *count > 0) {
        pt_function_accuracy row{};
        std::strcpy(row.name, "fake function");
        row.worst_error = failure("accuracy_bound") == PT_OK ? 0.5 : 5.0;
        row.bound = 2.5;
        row.worst_input = 0.125;
        *rows = row;
    }
    *count = rows == nullptr || *count > 0 ? 1 : 0;
    return call(context, "accuracy");
}
