// Owns the taking of samples by `pt render`: until there are enough, the target error is reached or a signal comes.
// Called by render_command.
#pragma once

#include "context.h"
#include "image_file.h"
#include "progress.h"
#include "render_settings.h"

namespace cli {

// Also ends once the writer has failed, as nothing could be written.
void take_samples(const Context &context, const RenderSettings &settings, const ImageWriter &writer,
                  Progress &progress);

} // namespace cli
