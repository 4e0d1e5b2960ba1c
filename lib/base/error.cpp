// The library's exception and the names of results; see error.h.
#include "lib/base/error.h"

namespace pt {

Error::Error(pt_result code, const std::string &message) : std::runtime_error(message), code_(code) {}

const char *result_name(pt_result result) noexcept {
    switch (result) {
    case PT_OK:
        return "PT_OK";
    case PT_CANCELLED:
        return "PT_CANCELLED";
    case PT_TARGET_REACHED:
        return "PT_TARGET_REACHED";
    case PT_ERROR_INVALID_ARGUMENT:
        return "PT_ERROR_INVALID_ARGUMENT";
    case PT_ERROR_INVALID_SCENE:
        return "PT_ERROR_INVALID_SCENE";
    case PT_ERROR_INVALID_STATE:
        return "PT_ERROR_INVALID_STATE";
    case PT_ERROR_UNSUPPORTED:
        return "PT_ERROR_UNSUPPORTED";
    case PT_ERROR_NO_DEVICE:
        return "PT_ERROR_NO_DEVICE";
    case PT_ERROR_OUT_OF_HOST_MEMORY:
        return "PT_ERROR_OUT_OF_HOST_MEMORY";
    case PT_ERROR_OUT_OF_DEVICE_MEMORY:
        return "PT_ERROR_OUT_OF_DEVICE_MEMORY";
    case PT_ERROR_DEVICE_LOST:
        return "PT_ERROR_DEVICE_LOST";
    case PT_ERROR_SHADER:
        return "PT_ERROR_SHADER";
    case PT_ERROR_INTERNAL:
        return "PT_ERROR_INTERNAL";
    case PT_ERROR_INCOMPATIBLE:
        return "PT_ERROR_INCOMPATIBLE";
    default:
        return "unknown result";
    }
}

} // namespace pt
