import json
import os
import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import numpy as np
import pt
from exr import read_exr_channels
from pictures import CAMERA, SCENE, SCENE_FILE, cloud, settings
from png import parse_png

PROGRAM, FAKE_DENOISER = os.environ["PT_PROGRAM"], os.environ["OPEN_IMAGE_DENOISE"]


def decode_png(data):
    width, height, rows = parse_png(data)
    return np.array(rows, np.uint8).reshape(height, width, 3)


def rendered(**fields):
    with pt.Context() as context:
        return context.render(SCENE, CAMERA, settings(**fields), 16)


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.image = rendered()
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))

    def picture_of_the_program(self, *options):
        (self.folder / "scene.json").write_text(json.dumps(SCENE_FILE))
        subprocess.run([PROGRAM, "render", self.folder / "scene.json", *(() if "--spp" in options else ("--spp", "16")), "-o", self.folder / "x.png",
                        *options], check=True, capture_output=True)
        return decode_png((self.folder / "x.png").read_bytes())

    def test_its_bytes_are_the_program_s(self):
        expected = self.picture_of_the_program()
        self.assertGreater(len(np.unique(expected)), 50)
        np.testing.assert_array_equal(self.image.to_srgb8(), expected)
        np.testing.assert_array_equal(decode_png(self.image._repr_png_()), expected)
        self.image.save(self.folder / "mine.png")
        self.assertEqual((self.folder / "mine.png").read_bytes(), self.image._repr_png_())

    def test_denoised_bits_are_the_program_s(self):
        with pt.Context() as context, mock.patch("pt._denoise.find_library", lambda: FAKE_DENOISER):
            image = context.render(SCENE, CAMERA, settings(seed=7), 17, denoise=True)
        paths = [self.folder / name for name in ("denoised.exr", "denoised.json")]
        expected = self.picture_of_the_program(f"--denoise={FAKE_DENOISER}", "--seed", "7", "--spp", "17", "-o", paths[0],
                                               "--stats", paths[1])
        np.testing.assert_array_equal(image.to_srgb8(), expected)
        channels = read_exr_channels(paths[0])
        for layer, pixels in ("", image.radiance), ("raw.", image.raw):
            np.testing.assert_array_equal(pixels, np.stack([channels[layer + name] for name in "RGB"], axis=2))
        stats = json.loads(paths[1].read_text())
        error = image.error_estimate
        self.assertEqual([stats["rmse"], stats["rmse_high"], stats["relative_rmse_low"], stats["spp"]],
                         [error.rmse, error.rmse_high, error.relative_rmse_low, image.stats.sample_count])

    def test_an_exposure_that_is_asked_for(self):
        expected = self.picture_of_the_program("--exposure", "-1.5")
        np.testing.assert_array_equal(self.image.to_srgb8(-1.5), expected)
        fixed = rendered()
        fixed.exposure = -1.5
        fixed.save(self.folder / "fixed.PNG")
        np.testing.assert_array_equal(decode_png((self.folder / "fixed.PNG").read_bytes()), expected)
        self.assertFalse(np.array_equal(self.image.to_srgb8(), expected))
        with self.assertRaisesRegex(TypeError, "pt_display_info has no field gama"):
            self.image.to_srgb8(gama=2.2)

    def test_radiance_in_files(self):
        self.image.save(self.folder / "x.npy")
        kept = np.load(self.folder / "x.npy")
        self.assertEqual(kept.dtype, np.float32)
        np.testing.assert_array_equal(kept, self.image.radiance)
        with self.assertRaisesRegex(ValueError, "must end in .png or .npy"):
            self.image.save(self.folder / "x.exr")
        self.assertFalse((self.folder / "x.exr").exists())

    def test_numpy_takes_it_as_its_radiance(self):
        radiance = self.image.radiance
        self.assertIs(np.asarray(self.image), radiance)
        self.assertIsNot(np.array(self.image), radiance)
        self.assertEqual(np.asarray(self.image, np.float64).dtype, np.float64)
        np.testing.assert_array_equal(self.image[3, 4], radiance[3, 4])
        self.assertEqual((len(self.image), self.image.shape), (16, (16, 24, 3)))

    def test_how_good_it_is(self):
        low, high = self.image.error_bounds
        self.assertTrue(0 < low < self.image.error < high < 1)
        self.assertIn("24x16, 16 samples", repr(self.image))
        positions, _ = cloud(3)
        few = pt.render(positions, 0.1, size=(4, 4), samples=1)
        self.assertEqual((few.error, few.error_bounds), (np.inf, (0.0, np.inf)))
