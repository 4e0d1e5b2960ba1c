#include "cli/figure/figure_picture.h"

#include "cli/scene/scene_setup.h"

#include <algorithm>

namespace cli {
namespace {

// In sixteen rows of the picture there are 64 of hits: what the device allocates for them is less than for the picture.
constexpr std::uint32_t band_rows = 16;

FirstHits band_of(std::uint32_t wanted_first, std::uint32_t margin, const pt_render &render) {
    FirstHits hits{};
    hits.width = render.width;
    const std::uint32_t before = std::min(margin, wanted_first);
    hits.first_row = wanted_first - before;
    hits.wanted_first = before;
    hits.wanted_count = std::min(band_rows, render.height - wanted_first);
    hits.row_count = std::min(before + hits.wanted_count + margin, render.height - hits.first_row);
    return hits;
}

void read_hits(const Context &context, const pt_render &render, FirstHits &hits) {
    pt_render fine = render;
    fine.width *= hits_per_side;
    fine.height *= hits_per_side;
    fine.first_row = hits.first_row * hits_per_side;
    fine.row_count = hits.row_count * hits_per_side;
    context.require(pt_set_render(context.get(), &fine));
    hits.objects.resize(hits.rows() * hits.columns());
    hits.depths.resize(hits.objects.size());
    context.read_objects(0, fine.width, fine.row_count, hits.objects.data());
    std::vector<float> alike(3 * hits.depths.size());
    context.read_columns(0, fine.width, fine.row_count, PT_QUANTITY_DEPTH, alike.data());
    for (std::size_t hit = 0; hit < hits.depths.size(); ++hit) {
        hits.depths[hit] = alike[3 * hit];
    }
}

} // namespace

Overlay read_overlay(const Context &context, const FigureContents &contents, const RenderSettings &settings) {
    const pt_render &render = settings.render;
    Overlay overlay(std::size_t{render.width} * render.height);
    const Screen screen(contents.camera, render.width, render.height);
    const std::uint32_t margin = contents.has_outlines ? outline_margin(contents.line_width) : 0;
    for (std::uint32_t row = 0; row < render.height; row += band_rows) {
        FirstHits hits = band_of(row, margin, render);
        read_hits(context, render, hits);
        add_particles(hits, contents.objects, overlay);
        add_lines(hits, screen, contents.lines, contents.line_width, overlay);
        if (contents.has_outlines) {
            add_outlines(hits, screen, contents.balls, contents.objects, contents.line_width, overlay);
        }
    }
    return overlay;
}

std::vector<float> render_stage(const Context &context, const SceneFile &scene, const RenderSettings &settings,
                                const Stage &stage, std::uint32_t sample_count) {
    if (!stage.floor) {
        return std::vector<float>(3, static_cast<float>(stage.surround.emission));
    }
    describe(context, scene, settings);
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = sample_count;
    context.require(pt_accumulate(context.get(), &info));
    return context.read_image(settings.render);
}

} // namespace cli
