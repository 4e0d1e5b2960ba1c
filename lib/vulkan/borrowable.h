// A Vulkan object that is either the library's own or the caller's.
#pragma once

#include "lib/vulkan/api.h"

#include <utility>

namespace pt::vulkan {

// Destroys its object in its destructor if it owns it, and leaves it alone if it has borrowed it.
template <typename Object>
class Borrowable {
public:
    static Borrowable owned(Object object) { return {std::move(object), true}; }
    static Borrowable borrowed(Object object) { return {std::move(object), false}; }

    Borrowable(Borrowable &&) noexcept = default;
    Borrowable &operator=(Borrowable &&) = delete;
    ~Borrowable() {
        if (!owned_)
            object_.release();
    }

    const Object &operator*() const { return object_; }
    const Object *operator->() const { return &object_; }

    bool is_owned() const { return owned_; }

    // Gives up ownership: from now on the object is left alone.
    void disown() { owned_ = false; }

private:
    Borrowable(Object object, bool owned) : object_(std::move(object)), owned_(owned) {}

    Object object_;
    bool owned_;
};

} // namespace pt::vulkan
