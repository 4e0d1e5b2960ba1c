#!/usr/bin/env python3
"""Plots the JSON of error_and_time.py: relative MSE against seconds, a line for every sampler and estimator.

Lower and further left is better. A hollow mark is within 3 times the reference's own error, which bounds what can be
told. Writes OUT.png and OUT.svg. Needs matplotlib.
"""

import argparse
import json
import os

import matplotlib

matplotlib.use("Agg")  # no window, no display needed
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

# Okabe and Ito's palette without its yellow, which is too light for lines (Wong 2011, "Color blindness").
COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9", "#E69F00"]
DASHES = ["-", "--", ":", "-."]


def read_lines(bench):
    """(sampler, estimator) -> its cells with an error above 0, in the order of the file."""
    lines = {}
    for cell in bench["cells"]:
        if cell["rel_mse"] > 0:
            lines.setdefault((cell["sampler"], cell["estimator"]), []).append(cell)
    return lines


def spread_labels(axes, labels, gap=13):
    """Writes the labels right of the axes, each at its line's end or above the label below it (gap in points)."""
    points_per_pixel = 72 / axes.figure.dpi
    bottom = axes.transAxes.transform((0, 0))[1]
    height = axes.transAxes.transform((0, 1))[1] - bottom
    free_above = float("-inf")
    for text, cell, color in sorted(labels, key=lambda label: label[1]["rel_mse"]):
        end = (cell["seconds"], cell["rel_mse"])
        place = max(axes.transData.transform(end)[1], free_above)
        free_above = place + gap / points_per_pixel
        axes.annotate(text, end, (1.02, (place - bottom) / height), textcoords="axes fraction", color=color,
                      va="center", fontsize=9, annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": color, "alpha": 0.4, "linewidth": 0.7})


def plot(bench):
    lines = read_lines(bench)
    samplers = list(dict.fromkeys(sampler for sampler, _ in lines))
    estimators = list(dict.fromkeys(estimator for _, estimator in lines))
    figure, axes = plt.subplots(figsize=(9, 5))
    axes.set(xscale="log", yscale="log", xlabel="seconds of sampling", ylabel="relative MSE")
    labels = []
    for (sampler, estimator), cells in lines.items():
        color = COLORS[samplers.index(sampler) % len(COLORS)]
        dash = DASHES[estimators.index(estimator) % len(DASHES)]
        points = [(cell["seconds"], cell["rel_mse"]) for cell in cells]
        axes.plot(*zip(*points), dash, color=color, linewidth=1.5)
        for cell in cells:
            face = "white" if cell["near_reference_noise"] else color
            axes.plot(cell["seconds"], cell["rel_mse"], "o", color=color, markerfacecolor=face, markersize=5)
        labels.append((f"{sampler}, {estimator}", cells[-1], color))
    own_error = bench["reference"].get("own_error")
    if own_error and own_error["rel_mse"] > 0:
        axes.axhline(own_error["rel_mse"], color="#888888", linewidth=0.8)
        axes.annotate("the reference's own error", (0.01, own_error["rel_mse"]), (0, 3), color="#666666", fontsize=8,
                      xycoords=("axes fraction", "data"), textcoords="offset points")
    scene = os.path.basename(bench["scene"])
    axes.set_title(f"{scene}, {bench['width']}x{bench['height']}, {bench['device']['name']}", fontsize=10)
    axes.grid(which="major", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())  # a decade's labels would overlap
    axes.spines[["top", "right"]].set_visible(False)
    figure.subplots_adjust(left=0.09, right=0.8, bottom=0.11, top=0.92)  # room for the labels
    axes.autoscale_view()  # settles the scales that the labels' places depend on
    spread_labels(axes, labels)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", help="file that error_and_time.py --json wrote")
    parser.add_argument("output", metavar="OUT", help="name of the plots, without extension")
    arguments = parser.parse_args()
    with open(arguments.json, encoding="utf-8") as file:
        figure = plot(json.load(file))
    for extension in ("png", "svg"):
        figure.savefig(f"{arguments.output}.{extension}", dpi=150)


if __name__ == "__main__":
    main()
