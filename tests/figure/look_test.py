import unittest

import numpy as np
from pt.figures import _elements as elements
from pt.figures._colors import Swatches, colors_of, distinct_colors
from pt.figures._compose import compose, lay_over
from pt.figures._drawn import prepare
from pt.figures._options import Options
from pt.figures._overlay import Shares
from pt.figures._particles import Particles
from pt.figures._radii import radii_of

try:
    import matplotlib
    from matplotlib.colors import LogNorm, Normalize
except ImportError:
    matplotlib = None

COUNT = 500
POSITIONS = np.random.default_rng(5).normal(size=(COUNT, 3))
VALUES = np.random.default_rng(6).uniform(-2, 5, COUNT)


def colored(color, particles=None, **options):
    notes = []
    rgb, legend = colors_of(particles or Particles(POSITIONS, {"v": VALUES}), Options(color=color, **options), notes)
    return rgb, legend, " ".join(notes)


@unittest.skipIf(matplotlib is None, "matplotlib is not installed")
class Numbers(unittest.TestCase):
    def test_colors_are_those_of_matplotlib(self):
        beyond = np.concatenate([VALUES, [-9, 9, -2, 5]])
        for colormap in ("viridis", "magma_r", "tab10", "coolwarm"):
            for values, norm, options in (
                    (beyond, Normalize(-2, 5), {"range": (-2, 5)}),
                    (VALUES, Normalize(VALUES.min(), VALUES.max()), {}),
                    (VALUES, Normalize(-np.abs(VALUES).max(), np.abs(VALUES).max()), {"scale": "symmetric"}),
                    (np.exp(VALUES), LogNorm(0.5, 20), {"scale": "log", "range": (0.5, 20)})):
                rgb, legend, _ = colored(values, Particles(np.zeros((len(values), 3))), colormap=colormap, **options)
                shares = np.clip(np.asarray(norm(values)), 0, 1)
                expected = matplotlib.colormaps[colormap](shares, bytes=True)[:, :3]
                # Rounding decides at the border of two colors.
                differ = (rgb != expected).any(axis=1)
                border = np.abs(shares * legend.colormap.N - np.round(shares * legend.colormap.N)) < 1e-9
                self.assertFalse((differ & ~border).any(), (colormap, options))
                self.assertEqual((legend.low, legend.high), (norm.vmin, norm.vmax))

    def test_what_is_no_number_has_a_color_of_its_own(self):
        values = VALUES.copy()
        values[7] = np.nan
        rgb, legend, notes = colored(values, nan_color="#102030")
        np.testing.assert_array_equal(rgb[7], (16, 32, 48))
        self.assertEqual((legend.no_value, legend.low), ((16, 32, 48), values[np.arange(COUNT) != 7].min()))
        self.assertIn("1 particles have no", notes)
        rgb, legend, notes = colored(values, scale="log")
        self.assertEqual(legend.low, values[values > 0].min())
        self.assertTrue((rgb[values <= 0] == 191).all())

    def test_few_that_are_far_from_all_others_do_not_decide_the_range(self):
        skewed = VALUES.copy()
        skewed[:2] = 1000
        _, legend, notes = colored(skewed)
        np.testing.assert_allclose((legend.low, legend.high), np.quantile(skewed, (0.01, 0.99)))
        self.assertIn("1% to 99% of all, which go from", notes)
        symmetric = colored(skewed, scale="symmetric")[1]
        self.assertTrue(symmetric.high < 6 and symmetric.colormap == matplotlib.colormaps["coolwarm"])
        rgb, legend, _ = colored(np.full(COUNT, 3.0))
        self.assertEqual((legend.low, legend.high), (3.0, 3.0))
        np.testing.assert_array_equal(rgb[0], legend.colormap(128, bytes=True)[:3])

    def test_magnitudes(self):
        parts = np.random.default_rng(8).normal(size=(COUNT, 3))
        for names in ("vx,vy,vz", "v[0],v[1],v[2]", "v_x,v_y,v_z"):
            particles = Particles(POSITIONS, dict(zip(names.split(","), parts.T)))
            for color in ("|v|", f"|{names}|"):
                _, legend, _ = colored(color, particles)
                lengths = np.linalg.norm(parts, axis=1)
                np.testing.assert_allclose((legend.low, legend.high), (lengths.min(), lengths.max()))

    def test_ranges_are_those_of_all_particles_whichever_are_shown(self):
        drawn = prepare(Particles(POSITIONS, {"v": VALUES}), Options(color="v", where="v > 1", radius=1))
        self.assertEqual((len(drawn.centers), drawn.legend.low), (int((VALUES > 1).sum()), VALUES.min()))
        whole = prepare(Particles(POSITIONS, {"v": VALUES}), Options(color="v", radius=1))
        np.testing.assert_array_equal(drawn.colors, whole.colors[VALUES > 1])


class Categories(unittest.TestCase):
    def test_no_two_colors_are_alike(self):
        many = distinct_colors(600)
        self.assertEqual(len(set(many)), 600)
        self.assertEqual(many[:20], distinct_colors(20))
        names = np.array([f"t{k % 40:02}" for k in range(COUNT)])
        rgb, legend, _ = colored(names)
        self.assertEqual(len(np.unique(rgb, axis=0)), 40)
        self.assertEqual(legend.names, tuple(sorted(set(names))))

    def test_words_types_elements_and_ids(self):
        types = Particles(POSITIONS[:3], types=np.array([1, 3, 1]))
        self.assertEqual(colored(None, types)[0].tolist(), [[0, 114, 178], [0, 158, 115], [0, 114, 178]])
        oxygen = tuple(elements.COLORS[8].tolist())
        water = Particles(POSITIONS[:3], elements=np.array([8, 1, 0], np.uint8))
        self.assertEqual([tuple(each) for each in colored(None, water)[0].tolist()[:2]], [oxygen, (230, 230, 230)])
        self.assertEqual(colored({"O": "#0a0b0c"}, water)[0][0].tolist(), [10, 11, 12])
        self.assertEqual(colored("O=#0a0b0c,H=#010203", water)[0][:2].tolist(), [[10, 11, 12], [1, 2, 3]])
        self.assertIsInstance(colored("id", Particles(POSITIONS[:3], {"id": np.array([5, 7, 5])}), categories=True)[1], Swatches)

    def test_colors_that_are_given(self):
        given = np.random.default_rng(9).integers(0, 256, (COUNT, 3)).astype(np.uint8)
        for colors, expected, note in (
                (given, given, "^$"), (given / 255.0, given, "^$"), ((given / 255.0).astype(np.float32), given, "^$"),
                (given.astype(np.uint16) * 257, given, "^$"), (np.column_stack([given, np.full(COUNT, 255, np.uint8)]), given, "^$"),
                (np.column_stack([given / 255.0, np.full(COUNT, 0.5)]), given, "alpha is not drawn"), ("#ff8000", (255, 128, 0), "^$"),
                ((1.0, 0.5, 0.0), (255, 128, 0), "^$"), (np.full((COUNT, 3), 1.5), (255, 255, 255), "clipped"),
                (np.full((COUNT, 3), 1.0000001), (255, 255, 255), "^$")):
            rgb, legend, notes = colored(colors)
            self.assertTrue((rgb == expected).all() and legend is None)
            self.assertRegex(notes, note)

    def test_what_is_refused(self):
        particles = Particles(POSITIONS, {"v": VALUES, "w": np.array(["a"] * COUNT)}, name="data.csv")
        for words, color, options in (
                ("there is no column 'u': the columns are v, w", "|u|", {}), ("scale = .ln.: must be linear, log", "v", {"scale": "ln"}),
                ("'X' is none of the types, 1", {"X": "red"}, {}), ("must be .500,., numbers or words", np.zeros(7), {}),
                ("must be two numbers, the second larger", "v", {"range": (3, 1)}),
                ("above 0 on a log scale", "v", {"range": (0, 1), "scale": "log"}),
                ("nan_color = '#zzzzzz'", VALUES, {"nan_color": "#zzzzzz"}),
                ("colormap = 'virids': must be one of matplotlib's, like viridis", "v", {"colormap": "virids"})):
            particles.types = np.ones(COUNT, int) if isinstance(color, dict) else None
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                colored(color, particles, **options)


class Radii(unittest.TestCase):
    def test_where_they_come_from(self):
        labels = np.array([8, 1, 0], np.uint8)
        water = Particles(np.eye(3), {"diameter": np.array([2.0, 4, 6])}, elements=labels)
        covalent = elements.COVALENT_RADII[[8, 1]]
        for radius, expected in ((2, 2), ("0.5", 0.5), ("0.5*diameter", (1, 2, 3)), (np.arange(1, 4), (1, 2, 3)),
                                 ("covalent", (*covalent, covalent.mean())), ("0.4*covalent", 0.4 * np.array(
                                     (*covalent, covalent.mean()))), (None, (*covalent, covalent.mean())),
                                 ({"O": 3, "H": 2, "?": 1}, (3, 2, 1)), ("O=3,H=2,?=1", (3, 2, 1))):
            with self.subTest(radius=radius):
                np.testing.assert_allclose(radii_of(water, radius, []), expected, rtol=1e-6)
        apart = Particles(1e4 * np.eye(3), elements=labels)  # The distances are not in angstroms.
        self.assertAlmostEqual(radii_of(apart, None, [])[0], 1e4 / 2**0.5, places=6)

    def test_what_is_refused(self):
        particles = Particles(np.eye(3), {"r": np.array([1, 0, np.nan]), "w": np.array(["a", "b", "c"])}, name="data.csv",
                              types=np.array(["A", "B", "A"]))
        for words, radius in (("data.csv: particle 2: radius = 0.0: must be > 0", "r"), ("has no elements", "covalent"),
                              ("radius has shape .3,. of <U1", "w"), ("no column 'q'", "q"), ("no column 'q'", "2*q"),
                              ("the type B has no radius, unlike A", "A=1"), ("like O=0.7,H=0.3", "A=x"),
                              ("radius = -1", -1)):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                prepare(particles, Options(radius=radius))
        for words, where in (("position 3, '!': no word begins so", "r ! 1"), ("holds", "r > 9")):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                prepare(particles, Options(radius=1, where=where))
        self.assertEqual(len(prepare(particles, Options(radius=1, where=["w != a", "type == A"])).centers), 1)


class Background(unittest.TestCase):
    def test_light_before_a_background(self):
        """The stage's radiance is 0.5. Of four pixels, one is half covered by a ball of radiance 0.75, one is in
        shadow, one is empty, and one is fully covered."""
        stage, particles = 0.5, np.array([[0.5, 0, 0, 1]])
        radiance = np.float32([[0.5 * 0.75 + 0.5 * 0.5, 0.25, 0.5, 0.75]])[:, :, None].repeat(3, axis=2)
        shares = Shares(particles, np.zeros((1, 4)))
        light, alpha = compose(radiance, stage, shares, 0.0)
        np.testing.assert_allclose(alpha, [[0.5, 0.25, 0, 1]], atol=1e-15)
        np.testing.assert_allclose(light[..., 0], [[0.375, 0, 0, 0.75]], atol=1e-15)
        np.testing.assert_allclose(lay_over(light, alpha, np.ones(3))[..., 0], [[0.875, 0.75, 1, 0.75]], atol=1e-15)
        np.testing.assert_allclose(lay_over(light, alpha, np.zeros(3))[..., 0], [[0.375, 0, 0, 0.75]], atol=1e-15)
        brighter, _ = compose(radiance, stage, shares, 1.0)
        np.testing.assert_allclose(brighter[0, 3], 1.0)
