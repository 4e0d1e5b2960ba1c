"""The relative error of images."""

import math


def relative_square(image, truth):
    """The mean over pixels and channels of (x - t)^2 / (t^2 + 0.01)."""
    return math.fsum((x - t) ** 2 / (t * t + 0.01) for x, t in zip(image, truth)) / len(truth)
