#include "lib/api/context.h"
#include "lib/api/guard.h"
#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "lib/base/struct_size.h"
#include "lib/film/error_estimate.h"
#include "lib/film/film_bytes.h"
#include "lib/film/stopping.h"
#include "lib/kernel/accuracy.h"
#include "lib/render/image.h"
#include "lib/render/renderer.h"
#include "lib/view/camera_rules.h"

#include <pt/async.h>
#include <pt/errors.h>
#include <pt/film.h>
#include <pt/map.h>
#include <pt/shaders.h>
#include <pt/vulkan.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace pt {

namespace {

// This thread's last refused call. A call is refused if another call is running, or if the context belongs to another
// process. The message cannot be stored in the context, because the running call uses its last_error.
struct Refusal {
    const pt_context *context = nullptr;
    const char *message = nullptr;

    void forget(const pt_context *of) {
        if (context == of)
            *this = {};
    }
};
thread_local Refusal refusal;

// Runs a call that is also allowed while samples are being taken.
template <typename Call>
pt_result guard_any_time(pt_context *context, Call &&call) noexcept {
    if (!context)
        return guard(thread_last_error, [] { require_not_null(nullptr, "context"); });
    if (const char *reason = context->in_use.take()) {
        refusal = {context, reason};
        return PT_ERROR_INVALID_STATE;
    }
    refusal.forget(context);
    const pt_result result = guard(context->last_error, [&] { return call(context->renderer); });
    if (result < PT_OK)
        refusal.forget(context); // a callback of this call may have been refused
    context->in_use.release();
    return result;
}

// Runs a call that is refused while samples are being taken (pt/async.h).
template <typename Call>
pt_result guard_context(pt_context *context, Call &&call) noexcept {
    return guard_any_time(context, [&](Renderer &renderer) {
        if (renderer.is_under_way())
            throw Error(
                PT_ERROR_INVALID_STATE,
                "samples are under way: call pt_poll until it does not return PT_PENDING, or call pt_cancel first");
        return call(renderer);
    });
}

pt_accumulate_info validated_accumulate(const pt_accumulate_info *info, bool may_call_back) {
    const pt_accumulate_info accumulate = copy_in(info, "accumulate");
    Violations violations;
    const Subject subject(violations, "accumulate");
    const Stopping stopping{accumulate.stopping};
    const bool has_target = stopping.has_target();
    subject.require(accumulate.sample_count >= 1 || has_target, "sample_count", accumulate.sample_count,
                    "must be >= 1 without a target_error");
    stopping.check(violations);
    subject.require(accumulate.sampling <= PT_SAMPLING_ADAPTIVE, "sampling", accumulate.sampling,
                    "must be a PT_SAMPLING_* of pt.h");
    subject.require(accumulate.sampling != PT_SAMPLING_ADAPTIVE || has_target, "sampling", accumulate.sampling,
                    "must not be PT_SAMPLING_ADAPTIVE without a target_error");
    subject.require(accumulate.sample_limit == 0 || has_target, "sample_limit", accumulate.sample_limit,
                    "must be 0 without a target_error");
    subject.require(accumulate.reserved2 == 0, "reserved2", accumulate.reserved2, "must be 0");
    subject.require((accumulate.tile_samples == nullptr) == (accumulate.tile_count == 0), "tile_count",
                    accumulate.tile_count, "must be 0 if and only if tile_samples is NULL");
    Subject(violations, "stopping")
        .require(!accumulate.tile_samples || !has_target, "target_error", accumulate.stopping.target_error,
                 "must be 0 with tile_samples");
    for (std::uint32_t tile = 0; accumulate.tile_samples && tile < accumulate.tile_count; ++tile)
        if (accumulate.tile_samples[tile] > accumulate.sample_count) {
            subject.refuse("tile_samples", std::to_string(accumulate.tile_samples[tile]),
                           "must be at most sample_count (tile " + std::to_string(tile) + ")");
            break;
        }
    if (accumulate.progress && !may_call_back)
        subject.refuse("progress", "a function", "must be NULL for pt_start; pt_poll reports the progress");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return accumulate;
}

// Logs once that a context in use was not freed; the log function may call pt_destroy itself. Logs nothing in a forked
// child, where the log's lock may be held by a thread that the child lacks.
void refuse_to_destroy(pt_context &context, const char *reason) noexcept {
    const bool told = refusal.context == &context || context.in_use.not_of_this_process();
    refusal = {&context, reason};
    if (!told)
        guard(thread_last_error, [&] {
            context.renderer.log().write(PT_LOG_ERROR, "pt_destroy: " + std::string(reason) + "; it was not destroyed");
        });
}

// Calls read() with the last error. If this thread's call was refused or another thread is in a call, calls read() with
// NULL and a fixed message.
template <typename Read>
auto read_last_error(const pt_context *context, Read &&read) noexcept {
    if (!context)
        return read(&thread_last_error, nullptr);
    if (refusal.context == context)
        return read(nullptr, refusal.message);
    if (context->in_use.by_this_thread())
        return read(&context->last_error, nullptr);
    if (const char *reason = context->in_use.take())
        return read(nullptr, reason);
    const auto result = read(&context->last_error, nullptr);
    context->in_use.release();
    return result;
}

pt_broken_rule shown(const BrokenRule &rule) noexcept {
    return {.struct_size = sizeof(pt_broken_rule),
            .component = rule.component,
            .index = rule.index,
            .subject = rule.subject.c_str(),
            .member = rule.member.c_str(),
            .with = rule.with.c_str(),
            .value = rule.value.c_str(),
            .rule = rule.rule.c_str()};
}

} // namespace

} // namespace pt

uint32_t pt_version(void) {
    return PT_VERSION;
}

const char *pt_result_name(pt_result result) {
    return pt::result_name(result);
}

uint32_t pt_next_check(uint32_t sample_count) {
    return static_cast<uint32_t>(std::min<std::uint64_t>(pt::next_check(sample_count), UINT32_MAX));
}

pt_result pt_get_devices(pt_device_info *devices, uint32_t *count) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::require_not_null(count, "count");
        const std::vector<pt_device_info> all = pt::list_devices();
        const auto available = static_cast<std::uint32_t>(all.size());
        *count = devices ? std::min(*count, available) : available;
        if (devices)
            std::copy_n(all.begin(), *count, devices);
    });
}

pt_result pt_create(const pt_create_info *info, pt_context **context) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::require_not_null(context, "context");
        *context = nullptr;
        const pt_create_info create = info ? pt::copy_in(info, "create") : pt_create_info{};
        *context = std::make_unique<pt_context>(pt::validated_create(create)).release();
    });
}

const char *pt_last_error(const pt_context *context) {
    return pt::read_last_error(
        context, [](const pt::LastError *error, const char *reason) { return error ? error->c_str() : reason; });
}

uint64_t pt_get_broken_rule(const pt_context *context, uint32_t index, pt_broken_rule *rule) {
    return pt::read_last_error(context, [&](const pt::LastError *error, const char *) -> std::uint64_t {
        const pt::Violations *rules = error ? error->broken_rules() : nullptr;
        const bool known = rules && index < rules->first().size();
        if (rule && pt::is_struct_size(rule->struct_size))
            pt::copy_known(known ? pt::shown(rules->first()[index]) : pt_broken_rule{}, rule, rule->struct_size);
        return rules ? rules->count() : 0;
    });
}

void pt_destroy(pt_context *context) {
    if (!context)
        return;
    if (const char *reason = context->in_use.take()) {
        pt::refuse_to_destroy(*context, reason);
        return;
    }
    pt::refusal.forget(context);
    const pt::DefaultRounding rounding;
    delete context; // still marked as in use, so that calls from its callbacks are refused
}

pt_result pt_get_context_device(pt_context *context, pt_device_info *device) {
    return pt::guard_any_time(context, [&](const pt::Renderer &renderer) {
        pt::require_not_null(device, "device");
        *device = renderer.device();
    });
}

pt_result pt_set_scene(pt_context *context, const pt_scene *scene) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) -> pt_result {
        const pt_scene description = pt::copy_in(scene, "scene");
        pt::WorkProgress progress(description.progress, description.progress_user);
        try {
            renderer.set_scene(pt::checked_scene(description, progress), progress);
            return PT_OK;
        } catch (const pt::Cancelled &) {
            return PT_CANCELLED;
        }
    });
}

pt_result pt_set_camera(pt_context *context, const pt_camera *camera) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        renderer.set_camera(pt::validated_camera(pt::copy_in(camera, "camera")));
    });
}

pt_result pt_set_render(pt_context *context, const pt_render *render) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        renderer.set_render(pt::validated_render(pt::copy_in(render, "render")));
    });
}

pt_result pt_reload_shaders(pt_context *context) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) { renderer.reload_shaders(); });
}

pt_result pt_prepare(pt_context *context) {
    return pt::guard_context(context, [](pt::Renderer &renderer) { renderer.prepare(); });
}

pt_result pt_accumulate(pt_context *context, const pt_accumulate_info *info) {
    return pt::guard_context(
        context, [&](pt::Renderer &renderer) { return renderer.accumulate(pt::validated_accumulate(info, true)); });
}

pt_result pt_start(pt_context *context, const pt_accumulate_info *info) {
    return pt::guard_context(
        context, [&](pt::Renderer &renderer) { return renderer.start(pt::validated_accumulate(info, false)); });
}

pt_result pt_poll(pt_context *context, uint64_t nanoseconds, double *fraction) {
    return pt::guard_any_time(context, [&](pt::Renderer &renderer) {
        const pt::Renderer::Advance advance = renderer.poll(nanoseconds);
        if (fraction)
            *fraction = advance.fraction;
        return advance.result;
    });
}

// Another thread may be in a call, so this uses only in_use and Cancellation.
pt_result pt_cancel(pt_context *context) {
    if (!context)
        return pt::guard(pt::thread_last_error, [] { pt::require_not_null(nullptr, "context"); });
    const char *reason = context->in_use.not_of_this_process();
    if (!reason && !context->renderer.cancel())
        reason = pt::Renderer::nothing_under_way;
    if (reason) {
        pt::refusal = {context, reason};
        return PT_ERROR_INVALID_STATE;
    }
    pt::refusal.forget(context);
    return PT_OK;
}

pt_result pt_readback(pt_context *context, const pt_image *image) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        const pt_image target = pt::copy_in(image, "image");
        const bool sized = renderer.width() > 0;
        renderer.readback(
            sized ? pt::validated_image(target, renderer.width(), renderer.row_count(), pt::ImageSource::Context)
                  : pt::Image{});
    });
}

pt_result pt_map_image(pt_context *context, const pt_image *image, void **data, uint64_t *size_bytes) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        const pt_image source = pt::copy_in(image, "image");
        pt::require_not_null(data, "data");
        const bool sized = renderer.width() > 0;
        const std::span<std::byte> pixels = renderer.map(
            sized ? pt::validated_mapped_layout(source, renderer.width(), renderer.row_count()) : pt::ImageLayout{});
        *data = pixels.data();
        if (size_bytes)
            *size_bytes = pixels.size();
    });
}

pt_result pt_readback_to_buffer(pt_context *context, const pt_buffer_image *image) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        const pt_buffer_image target = pt::copy_in(image, "image");
        // Without the caller's device or pt_set_render the renderer refuses the call.
        const bool sized = renderer.is_on_lent_device() && renderer.width() > 0;
        renderer.readback(sized ? pt::validated_image(target, renderer.width(), renderer.row_count())
                                : pt::BufferImage{});
    });
}

pt_result pt_save_film(pt_context *context, void *data, uint64_t *size_bytes) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        pt::require_not_null(size_bytes, "size_bytes");
        const pt::FilmHeader header = renderer.film_header();
        const std::uint64_t needed = pt::FilmLayout(header).size_bytes();
        if (data) {
            pt::require_room(*size_bytes, needed);
            renderer.save_film(header, {static_cast<std::byte *>(data), needed});
        }
        *size_bytes = needed;
    });
}

pt_result pt_add_film(pt_context *context, const void *data, uint64_t size_bytes) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        pt::require_not_null(data, "data");
        renderer.add_film({static_cast<const std::byte *>(data), size_bytes});
    });
}

pt_result pt_get_stats(pt_context *context, pt_stats *stats) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) { pt::copy_out(renderer.stats(), stats, "stats"); });
}

pt_result pt_get_warning(pt_context *context, pt_broken_rule *warning) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        pt::struct_size_of(warning, "warning");
        const pt::BrokenRule *rule = renderer.warning();
        pt::copy_out(rule ? pt::shown(*rule) : pt_broken_rule{}, warning, "warning");
    });
}

pt_result pt_get_error_estimate(pt_context *context, pt_error_estimate *error) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        pt::struct_size_of(error, "error");
        pt::copy_out(pt::stated(renderer.error_with_lamps()), error, "error");
    });
}

pt_result pt_get_accuracy(pt_context *context, pt_function_accuracy *rows, uint32_t *count) {
    return pt::guard_context(context, [&](pt::Renderer &renderer) {
        pt::require_not_null(count, "count");
        const auto available = static_cast<std::uint32_t>(pt::elementary_functions().size());
        if (rows) {
            const std::vector<pt_function_accuracy> all = renderer.accuracy();
            std::copy_n(all.begin(), std::min(*count, available), rows);
        }
        *count = rows ? std::min(*count, available) : available;
    });
}
