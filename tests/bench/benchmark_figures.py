import statistics

from cost_of_error import cost_of_error
from table import print_table

DEFAULT = ("sobol", "mis")
SAMPLERS = ("sobol", "random", "halton", "halton-cp")
ESTIMATORS = ("uniform", "cosine", "bsdf", "light")
OPTIONS = (*SAMPLERS[1:], *ESTIMATORS, "Mitsuba")
COARSE = 0.01  # limit for a reference's error, divided by the smallest measured error


def points_of(cells, unit):
    by_count = {}
    for cell in cells:
        by_count.setdefault(cell["spp"], []).append(cell)
    return {spp: (statistics.median(cell[unit] for cell in of_count),
                  statistics.fmean(cell["rel_mse"] for cell in of_count)) for spp, of_count in by_count.items()}


def ratios_of_round(cells, option, targets, unit):
    default, other = (points_of(cells[name], unit) for name in ("default", option))
    return [cost_of_error(other, target)[0] / cost_of_error(default, target)[0] for target in targets]


def scene_figures(rounds, unit):
    points, wall = ({option: points_of([cell for cells in rounds for cell in cells[option]], key)
                     for option in rounds[0]} for key in (unit, "seconds"))
    aims = sorted(points["default"])[-2:]
    targets, costs = ([points["default"][spp][i] for spp in aims] for i in (1, 0))
    figures = {"targets": [{"spp": spp, "rel_mse": target, "cost": cost, "seconds": wall["default"][spp][0]}
                           for spp, target, cost in zip(aims, targets, costs)], "options": {}}
    for option, of_option in points.items():
        figures["options"][option] = {
            "points": [{"spp": spp, "cost": cost, "rel_mse": error, "seconds": wall[option][spp][0]}
                       for spp, (cost, error) in sorted(of_option.items())]}
        if option != "default":
            reached = [cost_of_error(of_option, target) for target in targets]
            each = [ratios_of_round(cells, option, targets, unit) for cells in rounds]
            figures["options"][option]["ratios"] = [
                {"ratio": cost / of_default, "within": within, "rounds_behind": sum(one[i] < 1 for one in each)}
                for i, ((cost, within), of_default) in enumerate(zip(reached, costs))]
    return figures


def ratio_text(figures):
    def text(one):
        ratio = one["ratio"]
        if ratio > 1000:
            return ">1000"
        return ("" if one["within"] else "~") + (f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.2f}")
    return " / ".join(map(text, figures["ratios"])) if figures else "-"


def behind(report):
    found = []
    for name, scene in report["scenes"].items():
        for option, figures in scene["options"].items():
            least = min((one["ratio"] for one in figures.get("ratios", [])), default=1)
            if least < 1:
                rounds = " and ".join(str(one["rounds_behind"]) for one in figures["ratios"])
                found.append((least, f"{name}: {option} takes {ratio_text(figures)} of what the default takes (it is "
                              f"ahead in {rounds} of {report['rounds']} rounds)"))
    return [line for _, line in sorted(found)]


def coarse_references(report):
    lines = []
    for name, scene in report["scenes"].items():
        least = min(point["rel_mse"] for figures in scene["options"].values() for point in figures["points"])
        if scene["own_error"] > COARSE * least:
            share = scene["own_error"] / least
            lines.append(f"{name}: the reference's own error is {share:.1%} of the smallest measured")
    return lines


def table_rows(report):
    rows = [["scene", "relMSE", report["unit"], "wall", *OPTIONS]]
    for name, scene in report["scenes"].items():
        texts = [" / ".join(f"{target[key]:.2g}" for target in scene["targets"])
                 for key in ("rel_mse", "cost", "seconds")]
        rows.append([name, *texts, *(ratio_text(scene["options"].get(option)) for option in OPTIONS)])
    return rows


def print_report(report):
    lines = behind(report)
    print("What is ahead of the default:" if lines else "Nothing is ahead of the default.")
    for line in lines + coarse_references(report):
        print(f"- {line}")
    for name, scene in report["scenes"].items():
        if scene["obstacle"]:
            print(f"- {name}: not by Mitsuba: {scene['obstacle']}")
    peer = f", Mitsuba {report['mitsuba']} with multijitter" if report["mitsuba"] else ""
    devices = ", ".join(dict.fromkeys(scene["device"]["name"] for scene in report["scenes"].values()))
    print(f"\n{devices}{peer}, {report['rounds']} rounds: what the default takes to reach two errors, "
          "and how many times as much the others take")
    print_table(table_rows(report))
