import unittest
from dataclasses import replace

import numpy as np
import pt
from pt._display import linear
from pt.figures import _elements as elements
from pt.figures._cell import Cell
from pt.figures._colors import colors_of
from pt.figures._compose import compose, lay_over, smoothed
from pt.figures._drawn import prepare
from pt.figures._figure import Staged
from pt.figures._options import STYLES, Options
from pt.figures._overlay import Shares
from pt.figures._particles import Particles
from pt.figures._series import frames, turntable
from pt.figures._styles import completed, kind_of, styled

WATER = np.array([[0.0, 0, 0], [0.76, 0.59, 0], [-0.76, 0.59, 0]])
SALT = np.array([[0.0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]) * 2.82
BYTES = np.array([8, 1, 1], np.uint8)


def salt():
    return Particles(SALT, elements=np.repeat(np.uint8([11, 17]), 4), cell=Cell.of((5.64, 5.64, 5.64)))


def peptide():
    count = 40
    columns = {"resname": np.array(["ALA"] * 36 + ["HOH", "HOH", "XK2", "XK2"]), "chain": np.array(["A"] * 18 + ["B"] * 22),
               "resid": np.arange(count)}
    return Particles(np.arange(count)[:, None] * (1.5, 0.2, 0.1), columns, elements=np.resize(np.uint8([6, 8]), count))


class Kinds(unittest.TestCase):
    def test_the_kind_follows_from_the_data(self):
        cloud = np.random.default_rng(1).normal(size=(2000, 3))
        colored = Particles(cloud, colors=np.zeros((2000, 3)))
        for expected, particles in (
                ("molecule", Particles(WATER, elements=BYTES)), ("crystal", salt()), ("protein", peptide()), ("point-cloud", colored),
                ("galaxy", Particles(cloud, {"age": cloud[:, 0]})), ("particles", Particles(cloud)),
                ("particles", Particles(WATER, elements=BYTES, cell=Cell.of((90, 90, 90)))),
                ("particles", Particles(WATER * 9, elements=BYTES)), ("particles", Particles(WATER, types=np.arange(3)))):
            notes = []
            options = styled(particles, Options(), notes)
            self.assertEqual((kind_of(particles, Options()), options.style), (expected, expected))
            self.assertEqual((options.depth_cue, options.colormap), (0.0, "coolwarm" if expected == "galaxy" else None))
            self.assertEqual([note[:len(expected) + 10] for note in notes],
                             [f"style is {expected}:"] if expected != "particles" else [])

    def test_given_options_win(self):
        options = styled(peptide(), Options(radius=0.5, where="chain A", color="resid"), [])
        self.assertEqual((options.radius, options.where, options.color, options.box), (0.5, "chain A", "resid", "none"))
        options = styled(peptide(), Options(where=[]), [])
        self.assertEqual((options.radius, options.where, options.color), ("van-der-waals", ("not water",), "chain+element"))
        plain = Options(style="matte")
        self.assertEqual(styled(peptide(), plain, []), plain)
        self.assertEqual(styled(Particles(WATER, elements=BYTES), Options(model="space-filling"), []).bonds, None)
        self.assertEqual(next(turntable(Particles(WATER, elements=BYTES), 2, Options(size=(48, 32)))).options.style, "molecule")

    def test_every_style_draws(self):
        with pt.Context() as context:
            pictures = [pt.figure(peptide(), style=style, size=(32, 24), samples=2, context=context).to_srgb8() for style in STYLES]
        self.assertGreaterEqual(len({picture.tobytes() for picture in pictures}), 8)
        layout = Staged.of(peptide(), Options(style="cover")).layout
        self.assertTrue(layout.camera.aperture > 0.0 and layout.stage.material.glossiness > 0.0 and layout.stage.floor)


class Crystals(unittest.TestCase):
    def test_the_cell_has_all_its_corners(self):
        """Rock salt fills a grid of 3 x 3 x 3 places, with 54 bonds between neighbours."""
        full = completed(salt(), Options())
        places = np.array(list(np.ndindex(3, 3, 3))) * 2.82
        np.testing.assert_allclose(sorted(full.positions.tolist()), sorted(places.tolist()), atol=1e-9)
        self.assertEqual(np.bincount(full.elements)[[11, 17]].tolist(), [14, 13])
        for style in ("auto", "cover"):
            options = Options(style=style, size=(40, 30))
            for drawn in (prepare(salt(), styled(salt(), options, [])), *(each.drawn for each in frames(lambda: iter([salt()] * 2), options))):
                self.assertEqual((len(drawn.centers), len(drawn.rods[0].atoms)), (27, 108))
        self.assertEqual(len(prepare(salt(), styled(salt(), Options(style="cover", radius=1.0), [])).centers), 8)
        away = Particles(SALT + 0.7, elements=np.full(8, 6, np.uint8), cell=Cell.of((5.64, 5.64, 5.64)))
        self.assertIs(completed(away, Options()), away)
        self.assertEqual(len(prepare(salt(), Options(style="crystal", color=np.arange(8.0), radius=1.0)).centers), 8)

    def test_cells_are_repeated(self):
        drawn = prepare(salt(), Options(style="matte", repeat=(2, 1, 3), box="lines"))
        steps = np.array(list(np.ndindex(2, 1, 3)))
        np.testing.assert_allclose(sorted(drawn.centers.tolist()), sorted((SALT + 5.64 * steps[:, None]).reshape(-1, 3).tolist()), atol=1e-9)
        np.testing.assert_allclose(drawn.cell.vectors, np.diag([11.28, 5.64, 16.92]))
        with self.assertRaisesRegex(ValueError, "repeat: color, radius, .* must not be arrays"):
            prepare(salt(), Options(repeat=(2, 1, 1), radius=np.ones(8)))


class Colors(unittest.TestCase):
    def test_chains_are_tinted_by_elements(self):
        colors, legend = colors_of(peptide(), Options(color="chain+element"), [])
        self.assertEqual(legend.names, ("A", "B"))
        np.testing.assert_array_equal(np.unique(colors[:18:2], axis=0), legend.colors[:1])
        own = 255 + 0.75 * (elements.COLORS[8].astype(float) - 255)
        np.testing.assert_allclose(colors[1], 0.4 * legend.colors[0] + 0.6 * own, atol=1)
        np.testing.assert_array_equal(colors[38:], elements.COLORS[[6, 8]])

    def test_flat_colors_and_fading(self):
        shares = Shares(np.array([[1.0, 0.5]]), np.zeros((1, 2)), fade=np.array([[0.25, 0.0]]))
        light, alpha = compose(np.full((1, 2, 3), 0.4, np.float32), 0.4375, shares, 0.0)
        np.testing.assert_allclose(lay_over(light, alpha, np.ones(3))[0, 0], 0.75 * 0.4 + 0.25, rtol=1e-6)
        np.testing.assert_allclose(lay_over(light, alpha, np.zeros(3))[0, 0], 0.75 * 0.4, rtol=1e-6)
        flat = Shares(np.ones((1, 1)), np.zeros((1, 1)), flat=np.full((1, 1, 3), 0.8, np.float32))
        np.testing.assert_allclose(compose(np.full((1, 1, 3), 0.4, np.float32), 1.0, flat, 0.0)[0], 0.7, rtol=1e-6)

    def test_the_depth_cue_follows_the_depth(self):
        """Three equal balls side by side, at the near end, in the middle and at the far end, seen by parallel rays."""
        balls = np.array([[-2.0, -3, 0], [0, 0, 0], [2, 3, 0]])
        figure = pt.figure(balls, radius=0.5, view="front", projection="orthographic", size=(90, 30), samples=16, depth_cue=1.0)
        fades = [float(figure._shares.fade[15, column]) for column in (45 - round(36.9), 45, 45 + round(36.9))]
        np.testing.assert_allclose(fades, (0.0, 0.43, 0.86), atol=0.06)


class Floors(unittest.TestCase):
    def test_noise_of_shadows_is_smoothed_and_edges_stay(self):
        """A mean of 81 pixels has a ninth of their noise. A step of 20 times the noise stays."""
        noise = np.random.default_rng(4).normal(size=(60, 80, 3)) * 0.01
        error, floor = np.full(noise.shape, 0.01), np.ones((60, 80), bool)
        floor[:, :10] = False
        edge = np.where(np.arange(80) < 40, 0.1, 0.3)[None, :, None]
        found = smoothed(edge + noise, error, floor)
        left, right = found[5:-5, 15:35] - 0.1, found[5:-5, 45:-5] - 0.3
        self.assertLess(max(left.std(), right.std()), 0.01 * 0.3)
        self.assertLess(np.abs(found - edge - noise)[:, 38:42].max(), 0.01)
        np.testing.assert_array_equal(found[:, :10], (edge + noise)[:, :10])
        self.assertGreater(smoothed(edge + noise, 0.1 * error, floor)[5:-5, 15:35].std(), 0.008)

    def test_pictures_have_the_smoothed_floor(self):
        figure = pt.figure(np.random.default_rng(2).normal(size=(200, 3)), radius=0.1, floor=True, size=(96, 64), samples=16)
        floor = figure._shares.shapes == 0.0
        plain = replace(figure._shares, floor=None)
        rough, smooth = (compose(figure.radiance, figure._stage, each, 0.0)[0] for each in (plain, figure._shares))
        apart = [np.abs(np.diff(each, axis=1))[floor[:, 1:] & floor[:, :-1]].mean() for each in (rough, smooth)]
        self.assertLess(apart[1], 0.6 * apart[0])
        np.testing.assert_array_equal(rough[~floor], smooth[~floor])


class Outlines(unittest.TestCase):
    def drawn(self, balls, **options):
        figure = pt.figure(balls, radius=1.0, view="front", projection="orthographic", size=(96, 64), samples=2, outlines=True, **options)
        return figure._shares.outlines

    def test_larger_steps_have_wider_lines(self):
        """The step between the balls, 0.4 of a radius, has a line in matte, and none in soft."""
        pair = np.array([[-0.9, -1.0, 0], [0.9, 0, 0]])
        plain, stepped = (self.drawn(pair, style=style) for style in ("matte", "soft"))
        middle = slice(28, 36), slice(40, 56)
        self.assertGreater(plain[middle].max(), 0.5)
        self.assertEqual(stepped[middle].max(), 0.0)
        self.assertGreater(stepped.sum(), 1.2 * plain.sum())
        near, far = (self.drawn(np.array([[-0.5, -away, 0], [0.5, 0, 0]]), style="soft") for away in (4.0, 40.0))
        self.assertGreater(far[20:44, 44:72].sum(), 1.3 * near[20:44, 44:72].sum())

    def test_chains_have_borders(self):
        pair = np.array([[-0.7, 0.0, 0], [0.7, 0, 0]])
        for chains, is_there in ((["A", "A"], False), (["A", "B"], True)):
            outlines = self.drawn(Particles(pair, {"chain": np.array(chains)}), style="illustrative")
            self.assertEqual(bool(outlines[28:36, 44:52].max() > 0.5), is_there)
            self.assertGreater(outlines.max(), 0.9)

    def test_translucent_balls_have_none(self):
        outlines = self.drawn(np.array([[-2.0, 0, 0], [2.0, 0, 0]]), opacity=np.array([1.0, 0.3]))
        self.assertGreater(outlines[:, :48].max(), 0.5)
        self.assertEqual(outlines[:, 48:].max(), 0.0)

    def test_ink_is_the_darkened_color(self):
        figure = pt.figure(np.zeros((1, 3)), radius=1.0, size=(64, 64), samples=2, style="illustrative", color="#c04020")
        ink = figure._shares.ink[32, 32]
        np.testing.assert_allclose(ink, 0.2 * linear(np.array([0xc0, 0x40, 0x20]) / 255), rtol=0.02)
