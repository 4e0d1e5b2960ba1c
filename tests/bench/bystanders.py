"""What checkpoints cost a rendering, which they must not hold up: CPU and wall seconds of the same picture with and
without, in turn, so that a disturbed machine is so for all alike.

    python3 tests/bench/bystanders.py --pt build/bin/pt --size 1920x1080 --spp 24

plain        nothing beside the rendering
checkpoints  one every --every seconds, and one at the end"""

import argparse
import os
import resource
import statistics
import subprocess
import tempfile
import time

from table import print_table

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pt", required=True)
    parser.add_argument("--scene", default=os.path.join(ROOT, "cli/scenes/coursework.json"))
    parser.add_argument("--size", default="1920x1080", metavar="WxH")
    parser.add_argument("--spp", default="24", metavar="N")
    parser.add_argument("--every", type=float, default=2.0, help="seconds between checkpoints; default 2")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--device", help="as of pt render")
    return parser.parse_args()


def run(arguments, folder, extra):
    """CPU and wall seconds."""
    command = [arguments.pt, "render", arguments.scene, "-o", os.path.join(folder, "a.exr"), "--size", arguments.size,
               "--spp", arguments.spp, "--quiet", *extra]
    if arguments.device:
        command += ["--device", arguments.device]
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.monotonic() - begin)


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory() as folder:
        checkpoint = os.path.join(folder, "kept.ptfilm")
        variants = {"plain": [],
                    "checkpoints": ["--checkpoint", checkpoint, "--checkpoint-every", str(arguments.every)]}
        runs = {name: [] for name in variants}
        run(arguments, folder, [])  # with kernels to compile
        for _ in range(arguments.rounds):
            for name, extra in variants.items():
                runs[name].append(run(arguments, folder, extra))
                if os.path.exists(checkpoint):
                    os.remove(checkpoint)
    plain_cpu, plain_wall = (statistics.median(column) for column in zip(*runs["plain"]))
    rows = []
    for name, seconds in runs.items():
        cpu, wall = (statistics.median(column) for column in zip(*seconds))
        rows.append([name, f"{cpu:.2f}", f"{wall:.2f}", f"{cpu / plain_cpu:.3f}", f"{wall / plain_wall:.3f}"])
        if name == "checkpoints":
            each = (cpu - plain_cpu) / (wall // arguments.every + 1)
            rows[-1].append(f"{each:.2f} CPU s each, {each / 30:.2%} of a core at one in 30 s")
    heading = ["", "CPU s", "wall s", "CPU / plain", "wall / plain", ""]
    print_table([heading, *(row + [""] * (len(heading) - len(row)) for row in rows)])


if __name__ == "__main__":
    main()
