"""A camera's rays in double precision, for tests."""

import numpy as np


def rays(camera, width, height, x=0.5, y=0.5):
    """Returns starts and directions of the rays through the place (x, y) of each pixel."""
    right, above, back = camera.axes()
    columns, rows = (np.arange(width) + x) / width * 2 - 1, 1 - (np.arange(height) + y) / height * 2
    half = np.tan(camera.vertical_fov / 2) if camera.vertical_extent is None else camera.vertical_extent / 2
    offsets = half * (width / height * columns[None, :, None] * right + rows[:, None, None] * above)
    if camera.vertical_extent is not None:
        return camera.position + offsets, np.broadcast_to(-back, offsets.shape)
    ways = offsets - back
    return np.broadcast_to(camera.position, ways.shape), ways / np.linalg.norm(ways, axis=-1, keepdims=True)


def to_ball(start, way, radius):
    """Returns distances along unit vectors to a ball at the origin: from inside to its far side, and inf without a hit."""
    along = -(start * way).sum(axis=-1)
    square = radius**2 - ((start * start).sum(axis=-1) - along**2)
    half = np.sqrt(np.maximum(square, 0))
    return np.where((square >= 0) & (along + half > 0), np.where(along > half, along - half, along + half), np.inf)


def rims(camera, aspect, centers, radii):
    """For each edge of the picture, yields how far balls reach toward it: 0 is the picture's middle, and 1 the edge."""
    right, above, back = camera.axes()
    ways = centers - np.array(camera.position)
    depth = -(ways @ back)
    for axis, of_axis in ((right, aspect), (above, 1.0)):
        for sign in (-1, 1):
            x = sign * (ways @ axis)
            if camera.vertical_extent is not None:
                yield (x + radii) / (0.5 * of_axis * camera.vertical_extent)
            else:  # Seen from the pinhole, a ball at x and z reaches the angle atan(x / z) + asin(r / |x, z|).
                angle = np.arctan2(x, depth) + np.arcsin(radii / np.hypot(x, depth))
                yield np.tan(angle) / (of_axis * np.tan(camera.vertical_fov / 2))
