// The command `pt devices`: which Vulkan devices there are and which can be used.
#pragma once

namespace cli {

// Returns the exit code: ExitCode::no_device if none is suitable. Throws Failure.
int run_devices(bool as_json);

} // namespace cli
