"""Measures what pt_set_scene costs where spheres have moved since the scene before: CPU seconds, medians of rounds.

    python3 tests/bench/scene_again.py --library pt=build/lib/libpt.so --counts 1e5,1e6

Clouds are those of scale.py. "new" is without a scene before; then every coordinate moves by a normal number times a share
of the spheres' spacing, which is the cube root of the space that each has: 0 leaves all as it is. Beside the seconds, how
many samples a CPU second are taken then, as a share of those with a new tree for the same places.
"""

import argparse
import random
import statistics

from scale import Library, cpu_seconds, structs
from sphere_cloud import EXTENT, SphereCloud, surroundings
from table import print_table

SHARES = (0, 0.05, 0.1, 0.2, 0.3, 0.5, 1)
LENGTH = 3  # of paths


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", required=True, metavar="NAME=FILE")
    parser.add_argument("--counts", default="1e5,1e6", help="of spheres (default: 1e5,1e6)")
    parser.add_argument("--rounds", type=int, default=3, help="(default: 3)")
    parser.add_argument("--samples", type=int, default=4, help="a picture of 256x128 (default: 4)")
    options = parser.parse_args()
    options.counts = [int(float(count)) for count in options.counts.split(",")]
    options.width, options.height, options.lengths = 256, 128, [LENGTH]
    return options


class MovingCloud:
    def __init__(self, count, options):
        self.cloud, self.scene, self.options = SphereCloud(count), surroundings(), options
        self.library = Library(*options.library.split("=", 1), self.cloud, options)
        self.places = self.cloud.centers[:]
        spacing, normal = (EXTENT[0] * EXTENT[1] * EXTENT[2] / count) ** (1 / 3), random.Random(7).gauss
        self.ways = [normal(0, spacing) for _ in self.places]

    def move(self, share):
        """From where the spheres were at first."""
        for i, place in enumerate(self.places):
            self.cloud.centers[i] = place + share * self.ways[i]

    def forget(self):
        """Another scene, so that the next one has a new tree."""
        self.library.renderer.set_scene([structs.pt_material()])

    def set_scene(self):
        before = cpu_seconds()
        self.library.set_scene(self.scene, self.cloud)
        return cpu_seconds() - before

    def picture_seconds(self):
        return statistics.median(self.library.render(LENGTH, self.options.samples)[1]
                                 for _ in range(self.options.rounds))

    def new_seconds(self, share):
        self.move(share)
        self.forget()
        return self.set_scene()

    def measure(self, share):
        """Seconds where the spheres have moved, and the rate of samples as a share of that with a new tree."""
        seconds = []
        for _ in range(self.options.rounds):
            self.new_seconds(0)
            self.move(share)
            seconds.append(self.set_scene())
        with_shape = self.picture_seconds()
        self.new_seconds(share)
        return statistics.median(seconds), self.picture_seconds() / with_shape


def main():
    options = parse_arguments()
    table = [["spheres", "", "CPU s", "rate"]]
    for count in options.counts:
        cloud = MovingCloud(count, options)
        seconds = statistics.median(cloud.new_seconds(0) for _ in range(options.rounds))
        table.append([f"{count:,}", "new", f"{seconds:.3f}", ""])
        for share in SHARES:
            seconds, rate = cloud.measure(share)
            table.append([f"{count:,}", f"moved by {share}", f"{seconds:.3f}", f"{rate:.2f}"])
        cloud.library.close()
    print_table(table)


if __name__ == "__main__":
    main()
