"""A program of somebody else, in Python, with the definitions of the example smallest.py: inside a ball that shines, every
pixel has the ball's radiance, exactly. Arguments: the examples' folder and the red that is expected."""

import array
import signal
import sys

sys.path.insert(0, sys.argv[1])
import smallest  # noqa: E402


def raised_by(renderer, progress):
    try:
        renderer.accumulate(1_000_000, progress)
    except (LookupError, KeyboardInterrupt) as error:
        return type(error)
    return None


def fail(_):
    raise LookupError


def column(values, stride_bytes, type):
    return smallest.pt_column(values.buffer_info()[0], stride_bytes, type)


def main():
    expected = [float(sys.argv[2]), 1.0, 0.5] * (8 * 4)
    materials = [smallest.pt_material(emission=(2, 1, 0.5))]
    center, radius = array.array("d", [0, 0, 0]), array.array("f", [3])
    by_columns = smallest.pt_sphere_array(count=1, center=column(center, 24, smallest.PT_TYPE_FLOAT64),
                                          radius=column(radius, 0, smallest.PT_TYPE_FLOAT32))
    with smallest.Renderer() as renderer:
        renderer.set_scene(materials, [smallest.pt_sphere(radius=3)])
        renderer.set_camera(target=(0, 0, -1))
        renderer.set_render(8, 4)
        if raised_by(renderer, fail) != LookupError:
            sys.exit("what a callback raised was lost")
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell starts jobs in the background with it ignored
        if raised_by(renderer, lambda _: signal.raise_signal(signal.SIGINT)) != KeyboardInterrupt:
            sys.exit("an interrupt was lost")
        renderer.accumulate(3)
        pixels = renderer.image()
        renderer.set_scene(materials, sphere_arrays=[by_columns])
        renderer.accumulate(3)
        if renderer.image() != pixels:
            sys.exit("the ball is another one by columns")
        try:
            renderer.set_render(0, 4)
        except RuntimeError as error:
            refused = str(error)
    if refused != "PT_ERROR_INVALID_ARGUMENT: render.width = 0: must be >= 1":
        sys.exit(f"an image without width was refused with: {refused}")
    if list(pixels) != expected:
        sys.exit(f"the image is {list(pixels)}")


main()
