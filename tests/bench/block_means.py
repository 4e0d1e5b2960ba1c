import math
import statistics

BLOCK = 16
ROUNDING = 1e-5  # relative error of a mean: Mitsuba sums a pixel's samples as floats


def block_means(pixels, width, height):
    means = []
    for top in range(0, height, BLOCK):
        for left in range(0, width, BLOCK):
            places = [3 * (y * width + x) for y in range(top, min(top + BLOCK, height))
                      for x in range(left, min(left + BLOCK, width))]
            means += [math.fsum(pixels[place + channel] for place in places) / len(places) for channel in range(3)]
    return means


def whole_means(blocks):
    return [statistics.fmean(blocks[channel::3]) for channel in range(3)]


def mean_and_error(runs):
    return [(statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values))) for values in zip(*runs)]


def compare(runs, expected_runs):
    largest_z, relative = 0, []
    for (mean, error), (expected, expected_error) in zip(mean_and_error(runs), mean_and_error(expected_runs)):
        noise = math.hypot(error, expected_error, ROUNDING * expected)
        if noise > 0:
            largest_z = max(largest_z, abs(mean - expected) / noise)
        elif mean != expected:
            largest_z = math.inf
        if expected > 0:
            relative.append(noise / expected)
    return {"largest_z": largest_z, "median_standard_error": statistics.median(relative)}
