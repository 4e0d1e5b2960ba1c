import math


def cost_of_error(points, error):
    """Returns the cost of this error, and whether the error lies in the measured range. `points` maps sample counts to
    (cost, error). Interpolates in logarithms, and extrapolates with the slope -1."""
    line = [(math.log(cost), math.log(value)) for cost, value in (points[spp] for spp in sorted(points))]
    wanted = math.log(error)
    if line[-1][1] > wanted:
        return math.exp(line[-1][0] + line[-1][1] - wanted), False
    for (cost, value), (next_cost, next_value) in reversed(list(zip(line, line[1:]))):
        if value >= wanted:
            share = (value - wanted) / (value - next_value) if value > next_value else 1
            return math.exp(cost + (next_cost - cost) * share), True
    return math.exp(line[0][0] + line[0][1] - wanted), False
