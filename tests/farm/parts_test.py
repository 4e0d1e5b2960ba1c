import unittest

import numpy as np
import pt
from pictures import ready
from pt.farm._part import Part, cells_of, further_parts, has_only, missing_parts


class Parts(unittest.TestCase):
    def test_what_is_missing(self):
        goals = np.full((13, 17), 24, np.uint32)
        one = missing_parts(cells_of(None, goals.shape), 8, goals)
        self.assertEqual([(part.first, part.end, len(part.tiles)) for part in one], [(8, 32, 221)])
        with ready(pt.Context(), width=136, height=100, first_sample=10) as context:
            counts = np.zeros((13, 17), np.uint32)
            counts[12, 3:] = 5
            context.accumulate_tiles(counts)
            film = context.film()
        left = missing_parts(cells_of(film, goals.shape), 8, goals)
        self.assertEqual(sum(part.work for part in left), 221 * 24 - 14 * 5)
        self.assertEqual([(part.first, part.end, len(part.tiles)) for part in left],
                         [(8, 10, 14), (8, 32, 207), (15, 32, 14)])

    def test_what_goes_on(self):
        random = np.random.default_rng(1)
        before = random.integers(1, 4, (13, 17), np.uint32) * 8
        after = before + random.integers(0, 3, (13, 17), np.uint32) * 8
        cells = [((range(5, 5 + have),), np.flatnonzero(before == have).astype(np.uint32)) for have in (8, 16, 24)]
        self.assertTrue(has_only(cells, 5, before))
        self.assertFalse(has_only(cells, 4, before))
        self.assertFalse(has_only(cells, 5, after))
        self.assertFalse(has_only([((), cells[0][1]), *cells[1:]], 5, before))
        expected = missing_parts(cells, 5, after)
        found = further_parts(before, after, 5)
        self.assertEqual([(part.first, part.end) for part in found], [(part.first, part.end) for part in expected])
        for one, other in zip(found, expected):
            self.assertTrue((one.tiles == other.tiles).all())

    def test_cuts(self):
        part = Part(0, 100, np.arange(50, dtype=np.uint32))
        for work, least in ((1, 1), (700, 1), (700, 40), (99, 50), (10**9, 1)):
            pieces, rest = [], [part]
            while rest:
                piece, others = rest.pop().split(work, least)
                self.assertLessEqual(piece.work, max(work, least))
                pieces.append(piece)
                rest += others
            taken = np.zeros((50, 100), int)
            for piece in pieces:
                taken[piece.tiles, piece.first:piece.end] += 1
            self.assertTrue((taken == 1).all())


if __name__ == "__main__":
    unittest.main()
