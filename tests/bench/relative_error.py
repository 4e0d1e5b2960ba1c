import numpy


def relative_square(image, truth):
    image, truth = (numpy.asarray(values, numpy.float64) for values in (image, truth))
    return float(numpy.mean((image - truth) ** 2 / (truth * truth + 0.01)))
