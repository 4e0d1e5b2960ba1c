"""A farm of many workers in simulated time, by the coordinator's own rules for sizes of parts (Speed, Part) and with
costs that were recorded by measure.py: how busy the coordinator is, what it receives, how long it waits for the last.

    PYTHONPATH=lib/python python3 tests/farm/simulate.py tests/farm/costs.json [WORKERS...]

A GPU is taken as a hundred of the recorded processor cores, in parts of as many tiles as it needs. Not simulated: the
network's switches, and Dask's scheduler but for a constant for each part (its makers say 0.2 to 1 ms a task)."""

import heapq
import json
import pathlib
import random
import sys

import numpy as np
from pt.farm._part import Part
from pt.farm._speed import Speed, least_seconds

WIDTH, HEIGHT = 1920, 1080
TILES = (WIDTH // 8) * (HEIGHT // 8)
DASK, LINK = 0.001, 1.25e9  # seconds a part; bytes a second
SPREAD = 0.35  # of the logarithm of a worker's speed
GPU = 100  # times as fast as a core
RESULTS = ("ideal", "taken", "busy", "rate", "parts", "tail")


class Costs:
    """Of a part, by its tiles, between those that were recorded."""

    def __init__(self, rows):
        self.parts = [row for row in rows if "tiles" in row]
        self.adding = [row for row in rows if "add_tiles" in row]
        self.speed = max(row["speed"] for row in self.parts)

    def _at(self, tiles, name):
        return float(np.interp(tiles, [row["tiles"] for row in self.parts], [row[name] for row in self.parts]))

    def packed(self, tiles):
        return self._at(tiles, "bytes")

    def besides(self, tiles):
        """Of the worker, but for rendering."""
        return self._at(tiles, "least_seconds")

    def merge(self, tiles):
        """Of the coordinator: unpacking, opening, adding."""
        adding = np.interp(tiles, [row["add_tiles"] for row in self.adding],
                           [row["add_seconds_of_tile"] for row in self.adding])
        return DASK + tiles * float(adding)


def simulate(costs, workers, samples, part_seconds, least_tiles, times, seed=1):
    chance = random.Random(seed)
    true = [costs.speed * times * chance.lognormvariate(0, SPREAD) for _ in range(workers)]
    known = [Speed() for _ in true]
    left = [Part(0, samples, np.arange(TILES, dtype=np.uint32))]
    remaining, speeds = left[0].work, sum(speed.value for speed in known)
    events = [(0.0, worker, None, None) for worker in range(workers)]
    busy = free = received = parts = 0.0
    ends = [0.0] * workers
    while events:
        time, worker, part, begun = heapq.heappop(events)
        if part is not None:
            tiles = len(part.tiles)
            cost = costs.merge(tiles) + costs.packed(tiles) / LINK
            free = max(free, time) + cost  # one thing after the other
            busy, received, parts = busy + cost, received + costs.packed(tiles), parts + 1
            speeds -= known[worker].value
            known[worker].measure(part.work, time - begun)
            speeds += known[worker].value
            ends[worker] = time
            time = max(time, free - part_seconds)  # it has a second part meanwhile
        if left:
            least = least_seconds(workers, busy / max(parts, 1))
            share = known[worker].share(part_seconds, least, remaining, speeds)
            given, rest = left.pop().split(share, least_tiles)
            left += rest
            remaining -= given.work
            seconds = given.work / true[worker] + costs.besides(len(given.tiles))
            heapq.heappush(events, (time + seconds, worker, given, time))
    tail = max(ends) - sorted(ends)[workers // 2]
    return TILES * samples / sum(true), free, busy / free, received / free, parts, tail


def main():
    costs = Costs(json.loads(pathlib.Path(sys.argv[1]).read_text()))
    for workers in map(int, sys.argv[2:] or ("10", "100", "1000")):
        for kind, times, least in (("cores", 1, 64), ("GPUs", GPU, 4096)):
            for minutes, part_seconds in ((2, 5.0), (2, 30.0), (20, 30.0)):
                samples = int(minutes * 60 * workers * times * costs.speed / TILES)
                found = dict(zip(RESULTS, simulate(costs, workers, samples, part_seconds, least, times)))
                print(f"{workers} {kind}, {samples} spp, parts of {part_seconds:g} s: ideal {found['ideal']:.0f} s, "
                      f"taken {found['taken']:.0f} s, coordinator {found['busy']:.0%} busy, "
                      f"{found['rate'] / 1e6:.1f} MB/s, "
                      f"{found['parts']:.0f} parts, tail {found['tail']:.1f} s", flush=True)


if __name__ == "__main__":
    main()
