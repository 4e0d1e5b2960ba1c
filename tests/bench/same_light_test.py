import unittest

from same_light import KINDS, Images, pt, scenes_of

SCENES = ["coursework", "caustic-small", "corner-ball"]
PAIRS = 6
RATE = 0.05
MOST = 14  # P(more false alarms in 90 pairs at the stated rate) < 10^-4


def blocks(image):
    """Replaces each pixel by the mean of its 4x4 block. Errors of neighbors are then correlated."""
    height, width = image.shape[:2]
    means = image.radiance.reshape(height // 4, 4, width // 4, 4, 3).mean(axis=(1, 3))
    return means.repeat(4, axis=0).repeat(4, axis=1)


class SameLight(unittest.TestCase):
    def test_false_alarms(self):
        alarms = of_blocks = 0
        for scene in scenes_of(SCENES).values():
            images = Images(scene)
            for fields in KINDS.values():
                for _ in range(PAIRS):
                    first, second = images.one(), images.one(**fields)
                    alarms += pt.compare(first, second).probability <= RATE
                    of_blocks += pt.compare(blocks(first), blocks(second)).probability <= RATE
        self.assertLessEqual(alarms, MOST)
        self.assertGreater(of_blocks, MOST)


if __name__ == "__main__":
    unittest.main()
