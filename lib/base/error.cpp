// The library's exception and the names of results; see error.h.
#include "lib/base/error.h"

#include <utility>

namespace pt {

namespace {

BrokenRules only(BrokenRule rule) {
    BrokenRules rules;
    rules.add(std::move(rule));
    return rules;
}

} // namespace

Error::Error(pt_result code, const std::string &message) : std::runtime_error(message), code_(code) {}

Error::Error(pt_result code, BrokenRules rules) :
    std::runtime_error(rules.text()),
    code_(code),
    broken_rules_(std::make_shared<const BrokenRules>(std::move(rules))) {}

Error::Error(pt_result code, BrokenRule rule) : Error(code, only(std::move(rule))) {}

const char *result_name(pt_result result) noexcept {
    switch (result) {
    case PT_OK:
        return "PT_OK";
    case PT_CANCELLED:
        return "PT_CANCELLED";
    case PT_TARGET_REACHED:
        return "PT_TARGET_REACHED";
    case PT_PENDING:
        return "PT_PENDING";
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
