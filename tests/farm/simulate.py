"""A farm of many workers in simulated time, with the coordinator's own rules for sizes of parts (Speed, Part) and with
measured costs of its steps: how busy it is, what it receives, and how long it waits for the last ones.

    PYTHONPATH=lib/python python3 tests/farm/simulate.py [WORKERS [SECONDS_OF_PARTS]]

Not simulated: the network between workers and scheduler, and Dask's own work, which is taken as a constant for each part."""

import heapq
import random
import sys

import numpy as np
from pt.farm._part import Part
from pt.farm._speed import Speed

WIDTH, HEIGHT, SAMPLES = 1920, 1080, 16384
TILES = (WIDTH // 8) * (HEIGHT // 8)
BYTES_OF_TILE = 112 * 64 * 0.35  # packed
SUBMIT, MERGE_OF_BYTE, LINK = 0.001, 1 / 150e6, 1.25e9  # seconds a part; a byte, unpacked and added; bytes a second
SPEED, SPREAD = 40_000, 0.35  # samples of tiles a second: 2.6 M samples; of its logarithm


def simulate(workers, part_seconds, least_tiles, seed=1):
    chance = random.Random(seed)
    true = [SPEED * chance.lognormvariate(0, SPREAD) for _ in range(workers)]
    known = [Speed() for _ in true]
    left = [Part(0, SAMPLES, np.arange(TILES, dtype=np.uint32))]
    events = [(0.0, worker, None, None) for worker in range(workers)]
    busy = free = received = parts = 0.0
    idle = [0.0] * workers
    while events:
        time, worker, part, begun = heapq.heappop(events)
        if part is not None:
            cost = SUBMIT + len(part.tiles) * BYTES_OF_TILE * (MERGE_OF_BYTE + 1 / LINK)
            free = max(free, time) + cost  # one thing after the other
            busy, received, parts = busy + cost, received + len(part.tiles) * BYTES_OF_TILE, parts + 1
            known[worker].measure(part.work, time - begun)
            idle[worker] = time
            time = free
        if left:
            share = known[worker].share(part_seconds, sum(p.work for p in left), sum(s.value for s in known))
            given, rest = left.pop().split(share, least_tiles)
            left += rest
            heapq.heappush(events, (time + given.work / true[worker], worker, given, time))
    ideal = TILES * SAMPLES / sum(true)
    return ideal, free, busy / free, received / free, parts, max(idle) - min(idle)


if __name__ == "__main__":
    counts = [int(sys.argv[1])] if sys.argv[1:] else [10, 100, 1000]
    for workers in counts:
        for seconds in ([float(sys.argv[2])] if sys.argv[2:] else [5.0, 30.0]):
            for least in (64, 4096):
                ideal, taken, load, rate, parts, tail = simulate(workers, seconds, least)
                print(f"{workers} workers, parts of {seconds:g} s and {least} tiles or more: ideal {ideal:.0f} s, taken "
                      f"{taken:.0f} s, coordinator {load:.0%} busy, {rate / 1e6:.0f} MB/s, {parts:.0f} parts, tail {tail:.1f} s")
