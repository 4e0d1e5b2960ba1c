// A user's namespace pt has names of the library's internals.
#include <pt/pt.h>

#include <stdexcept>
#include <string>

namespace pt {

const char *result_name(pt_result) {
    return "a name of the program's";
}

class Error : public std::runtime_error {
public:
    Error(pt_result code, const std::string &message);
};

Error::Error(pt_result, const std::string &) : std::runtime_error("an error of the program's") {}

} // namespace pt

int main() {
    pt_context *context = nullptr;
    const bool works = pt_create(nullptr, &context) == PT_OK &&
                       pt_set_camera(context, nullptr) == PT_ERROR_INVALID_ARGUMENT &&
                       pt_last_error(context) != std::string("an error of the program's") &&
                       pt_result_name(PT_OK) == std::string("PT_OK");
    pt_destroy(context);
    return works ? 0 : 1;
}
