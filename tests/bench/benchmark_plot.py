import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker

COLUMNS = 4
MOST = 100
# Okabe and Ito's palette (Wong 2011, "Color blindness"). Samplers have solid lines, estimators dashed ones.
STYLES = {
    "random": ("#56B4E9", "-"),
    "halton": ("#0072B2", "-"),
    "halton-cp": ("#009E73", "-"),
    "uniform": ("#999999", ":"),
    "cosine": ("#999999", "-."),
    "bsdf": ("#CC79A7", "--"),
    "light": ("#E69F00", "--"),
    "Mitsuba": ("#D55E00", "-."),
    "Mitsuba, filtered": ("#D55E00", "--"),
    "filtered": ("#0072B2", "--"),
    "combined": ("#009E73", "-"),
    "default": ("#000000", "-"),
}
LABELS = {"default": "default: sobol, mis", "combined": "combined: what is shown", "Mitsuba": "Mitsuba, multijitter"}


def draw_scene(axes, name, scene):
    for option, (color, dash) in STYLES.items():
        if option in scene["options"]:
            points = [(point["cost"], point["rel_mse"]) for point in scene["options"][option]["points"]]
            strong = option in LABELS
            axes.plot(*zip(*points), dash, color=color, linewidth=2.2 if strong else 1.3, marker="o",
                      markersize=4 if strong else 2.5, label=LABELS.get(option, option))
    axes.set(xscale="log", yscale="log")
    largest = max(point["rel_mse"] for point in scene["options"]["default"]["points"])
    axes.set_ylim(top=min(axes.get_ylim()[1], MOST * largest))
    costs = [point["cost"] for figures in scene["options"].values() for point in figures["points"]]
    axes.set_xlim(*(10 ** round_off(math.log10(cost)) for round_off, cost in ((math.floor, min(costs)),
                                                                              (math.ceil, max(costs)))))
    axes.set_title(name, fontsize=10)
    axes.grid(which="major", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=8)
    for axis in axes.xaxis, axes.yaxis:
        axis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes.spines[["top", "right"]].set_visible(False)


def plot(report):
    scenes = report["scenes"]
    rows = math.ceil((len(scenes) + 1) / COLUMNS)
    figure, panels = plt.subplots(rows, COLUMNS, figsize=(3.2 * COLUMNS, 2.8 * rows), squeeze=False,
                                  constrained_layout=True)
    panels = list(panels.flat)
    for axes, (name, scene) in zip(panels, scenes.items()):
        draw_scene(axes, name, scene)
    for axes in panels[len(scenes):]:
        axes.axis("off")
    handles = {label: handle for axes in panels[:len(scenes)]
               for handle, label in zip(*axes.get_legend_handles_labels())}
    order = [LABELS.get(option, option) for option in reversed(STYLES)]
    labels = [label for label in order if label in handles]
    panels[len(scenes)].legend([handles[label] for label in labels], labels, loc="center left", fontsize=9,
                               frameon=False)
    figure.supxlabel(report["unit"], fontsize=10)
    figure.supylabel("relative MSE", fontsize=10)
    return figure
