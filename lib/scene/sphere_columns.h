// The columns of pt_sphere_array. Rules, reader, scene files and Python (generate.py) follow from this list. The field
// in pt.h, the key in lib/scene_file/scene_keys.cpp and the keyword in lib/python/pt/_scene.py are written by hand. A
// column that changes the material also needs a row in material.h, a constant in shaders/specialization.h and code in
// shaders/scene.glsl.
#pragma once

// X(name, component, components, types, rule, is_needed, initial, set): `component` is the type in scene files, `types`
// the types of callers (column.h). The rule of a material index is nullptr. `set` puts a value into a Sphere that
// already has the values of earlier columns.
#define PT_SPHERE_COLUMNS(X)                                                                                           \
    X(center, double, 3, real, length_rule, true, 0, sphere.center = value)                                            \
    X(radius, double, 1, real, positive_length_rule, true, 0, sphere.radius = value)                                   \
    X(motion, double, 3, real, length_rule, false, 0, sphere.motion = value)                                           \
    X(material, std::uint32_t, 1, index, nullptr, false, 0, sphere.material = value)                                   \
    X(color, float, 3, color, share_rule, false, 1, sphere.look.color = value)                                         \
    X(end, double, 3, real, length_rule, false, 0, sphere.make_capsule(value))                                         \
    X(opacity, float, 1, real, share_rule, false, 1, sphere.opacity = opacity_steps(value))
