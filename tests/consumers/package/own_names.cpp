// A user's namespace pt has names of the library's internals.
#include <pt/pt.h>

#include <iostream>
#include <stdexcept>
#include <string>

namespace pt {

const char *result_name(pt_result) {
    return "a name of the program's";
}

class Error : public std::runtime_error {
public:
    Error(pt_result code, const std::string &message);
    pt_result code;
};

Error::Error(pt_result failure, const std::string &message) : std::runtime_error(message), code(failure) {}

} // namespace pt

namespace {

void check(bool holds, const std::string &message) {
    if (!holds)
        throw pt::Error(PT_ERROR_INTERNAL, message);
}

void check_own_names(pt_context *context) {
    check(pt_set_camera(context, nullptr) == PT_ERROR_INVALID_ARGUMENT, "no camera was not refused as it should be");
    check(pt_result_name(PT_OK) == std::string("PT_OK"), "the library's function is the program's");
    check(pt::result_name(PT_OK) != std::string("PT_OK"), "the program's function is the library's");
}

} // namespace

int main() {
    pt_context *context = nullptr;
    int status = 0;
    try {
        check(pt_create(nullptr, &context) == PT_OK, "there is no context");
        check_own_names(context);
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        status = 1;
    }
    pt_destroy(context);
    return status;
}
