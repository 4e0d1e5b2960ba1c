#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FrameConstants frame; };
layout(set = 0, binding = 2) writeonly buffer Output { vec4 values[]; };

void main()
{
    if (gl_GlobalInvocationID.x != 0u)
        return;
    values[0] = vec4(frame.camera.right, frame.camera.start_scale);
    values[1] = vec4(frame.camera.up, frame.camera.width);
    values[2] = vec4(frame.camera.forward, frame.camera.height);
    values[3] = vec4(frame.seed, frame.film_scale, frame.film_first_pixel);
    values[4] = vec4(frame.strip_first_pixel, frame.strip_pixel_count, frame.first_entry, frame.film_part);
    values[5] = vec4(frame.is_first, frame.first_sample, frame.sample_count, frame.share);
    values[6] = vec4(frame.camera.lens_radius, frame.camera.lens_blur, frame.camera.reserved[0], frame.camera.reserved[1]);
}
