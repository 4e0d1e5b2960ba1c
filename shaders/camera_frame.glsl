// The camera's part of FrameConstants, for kernels with other push constants. Uses their block, called view.
#ifndef CAMERA_FRAME_GLSL
#define CAMERA_FRAME_GLSL

FrameConstants camera_frame()
{
    FrameConstants frame;
    frame.camera_right = view.camera_right;
    frame.camera_up = view.camera_up;
    frame.camera_forward = view.camera_forward;
    frame.start_scale = view.start_scale;
    frame.width = view.width;
    frame.height = view.height;
    return frame;
}

#endif
