// What a film knows of the rendering that made it.
#pragma once

#include "cli/film/film.h"
#include "cli/render/render_report.h"

namespace cli {

// Without times, and without the scene's name.
RenderReport film_report(const FilmHandle &film);

} // namespace cli
