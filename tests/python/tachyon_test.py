import json
import math
import pathlib
import random
import tempfile
import unittest
from dataclasses import replace
from unittest import mock

import numpy as np
import pt
from pt.tachyon import _command, _lights
from pt.tachyon._reader import parse, read
from rays import rays, to_ball

DATA = pathlib.Path(__file__).resolve().parents[2] / "tests/data/tachyon"
# VMD writes scenes like this. z is reversed.
SCENE = """# as VMD has it
Begin_Scene
Resolution 64 32
Shader_Mode Medium Trans_Max_Surfaces 4 End_Shader_Mode
Camera
  Zoom 0.5
  Aspectratio 1
  Antialiasing 0
  Raydepth 8
  Center 1 2 -3
  Viewdir 0 0 2
  Updir 0 1 0.5
End_Camera
Directional_Light Direction 0 -3 0 Color 1 0.5 0.25
Background 0.5 0.25 0.125
TexDef gold Ambient 0.2 Diffuse 0.5 Specular 0 Opacity 1 Phong Metal 0.5 Phong_size 18
  Color 1 0.5 0.25 TexFunc 0
TexAlias metal gold
Sphere Center 2 2 7 Rad 2 metal
Sphere Center 0 2 7 Rad 1 Texture Ambient 0 Diffuse 1 Specular 0.75 Opacity 1
  Phong Plastic 0.5 Phong_size 18 Color 0 0.5 1 TexFunc 0
Plane Center 0 -5 4 Normal 0 2 1 gold
Light Center 2 2 -6 Rad 0.5 Color 0.5 1 2
End_Scene
"""


def parsed(*changes, **options):
    text = SCENE
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return parse(text.splitlines(), "a.dat", **options)


class Sections(unittest.TestCase):
    def test_projections(self):
        found = parsed()
        self.assertEqual(found.notes, [])
        # The target is the point on the view's axis nearest to the middle of both spheres, (1.5, 2, -7).
        self.assertEqual(found.camera.target, (1, 2, -7))
        self.assertEqual(parsed(("Zoom 0.5", "Projection Orthographic Zoom 0.5")).camera.vertical_extent, 2)
        framed = parsed(("End_Camera", "Frustum -1.5 1.5 -0.75 0.75 End_Camera"))
        self.assertAlmostEqual(math.tan(framed.camera.vertical_fov / 2), 0.75, 14)
        focused = parsed(("Zoom 0.5", "Projection Perspective_DoF FocalLength 3 Aperture 0.1 Zoom 0.5"))
        self.assertEqual(focused.notes, ["a.dat:6: PERSPECTIVE_DOF: depth of field is left out"])
        self.assertEqual(parsed(("Zoom 0.5", "Projection Perspective_DoF FocalDist 3 Aperture 0 Zoom 0.5")).notes, [])

    def test_materials(self):
        scene = parsed().scene
        gold, mirror = (scene.materials[index] for index in scene.sphere_arrays[0].material)
        self.assertEqual(scene.materials[scene.planes[0].material], gold)
        self.assertEqual(gold, pt.Material((0.5, 0.25, 0.125), (0.05, 0.025, 0.0125), glossiness=18))
        self.assertEqual(mirror, pt.Material((0, 0.5, 1), 0.75, glossiness=1e6))
        self.assertEqual(parsed(("Metal", "Plastic")).scene.materials[0].specular, (0.05, 0.05, 0.05))

    def test_cylinders_are_capsules(self):
        tube = "FCylinder\n  Base 1 2 3\n  Apex 4 5 6.5\n  Rad 0.25\n metal\n"
        caps = ("Ring\nCenter 1 2 3 \nNormal 0.6 0.6 0.5 \nInner 0.0  Outer 0.25 \n metal\n"
                "Ring\nCenter 4 5 6.5 \nNormal -0.6 -0.6 -0.5 \nInner 0.0  Outer 0.25 \n metal\n")
        chain = "PolyCylinder Points 3  0 0 1  0 2 1  3 2 1 Rad 0.5 gold\nPolyCylinder Points 1 7 8 9 Rad 2 gold\n"
        found = parsed(("Plane", tube + caps + chain + "Plane"))
        spheres, capsules = found.scene.sphere_arrays
        self.assertEqual((len(spheres), found.notes), (2, []))
        np.testing.assert_array_equal(capsules.center, [[1, 2, -3], [0, 0, -1], [0, 2, -1], [7, 8, -9]])
        np.testing.assert_array_equal(capsules.end, [[4, 5, -6.5], [0, 2, -1], [3, 2, -1], [7, 8, -9]])
        np.testing.assert_array_equal(capsules.radius, [0.25, 0.5, 0.5, 2])
        self.assertEqual(found.camera.target, (1, 2, -5.75))  # z is the middle of -0.5 and -11.
        for ring in ("Center 1 2 3 Normal 0 0 1 Inner 0.1 Outer 0.25", "Center 1 2 3 Normal 0 0 1 Inner 0 Outer 0.5",
                     "Center 1 2 4 Normal 0 0 1 Inner 0 Outer 0.25"):
            found = parsed(("Plane", f"Ring {ring} metal\n{tube}Ring {ring} metal\nPlane"), leave_out_others=True)
            self.assertEqual(found.notes, ["2 x RING, a ring: left out"])
            self.assertEqual(len(found.scene.sphere_arrays[1]), 1)

    def test_a_white_background_stays_white_and_shapes_stay_apart_from_it(self):
        found = parsed(("Background 0.5 0.25 0.125", "Background 1 1 1"))
        self.assertEqual(_command.scene_file(found)["film"], {"width": 64, "height": 32, "exposure": 0, "gamma": 1})
        with pt.Context() as context:
            image = context.render(found.scene, found.camera, found.settings, 1)
        self.assertEqual(image.to_srgb8(exposure=0)[0, 0].tolist(), [255, 255, 255])
        light = _lights.Light("", (1, 1, 1), (0, 1, 0), is_directional=True)
        self.assertAlmostEqual(_lights.dimmed([light], (1, 1, 1))[0].color[1], 1 / 3)
        self.assertEqual(_lights.dimmed([], (1, 1, 1)), [])

    def test_equal_textures_are_one_material(self):
        sphere = "Sphere Center 0 0 0 Rad 1 Texture Ambient 0 Diffuse 1 Specular 0 Opacity 1 Color 1 0 0 TexFunc 0\n"
        self.assertEqual(parsed(("Plane", f"{sphere}{sphere}Plane")).scene.sphere_arrays[0].material.tolist(), [0, 1, 2, 2])

    def test_lights_are_lamps(self):
        sun, lamp, sky = parsed().scene.spheres
        share = 1 - 0.5 / 2.25  # the background has up to 0.5, and both lights have up to 2.25
        np.testing.assert_allclose(sun.material.emission, share * np.array([2500, 1250, 625]), rtol=1e-12)
        self.assertTrue(sun.material.hidden_from_camera)
        self.assertEqual((lamp.center, lamp.radius), ((2, 2, 6), 0.5))
        self.assertFalse(lamp.material.hidden_from_camera)
        # The lamp is sqrt(1 + 13^2) from the target.
        np.testing.assert_allclose(lamp.material.emission, share * np.array([0.5, 1, 2]) * 170 / 0.25, rtol=1e-12)
        self.assertEqual(sky.material.emission, (0.5, 0.25, 0.125))
        faded = parsed(("Rad 0.5 Color", "Rad 0.5 Attenuation Constant 1 Linear 0 Quadratic 0.1 Color")).scene.spheres[1]
        np.testing.assert_allclose(faded.material.emission[0], share * 0.5 * 170 / 0.25 / 18, rtol=1e-12)

    def test_refusals_name_place_value_and_rule(self):
        for old, new, message in (
                ("Rad 2 metal", "Rad 2 silver", '19: "silver": must be TEXTURE or the name of a TEXDEF before it'),
                ("Rad 2 ", "Rad -2 ", "19: RAD = -2: must be above 0"),
                ("Rad 2 ", "Rad nan ", '19: RAD = "nan": must be a finite number'),
                ("Aspectratio 1", "Aspectratio 1.5", "7: ASPECTRATIO: must be 1, because pixels are square"),
                ("Zoom 0.5", "Projection Fisheye Zoom 0.5",
                 '6: PROJECTION "FISHEYE": must be PERSPECTIVE, PERSPECTIVE_DOF or ORTHOGRAPHIC'),
                ("End_Camera", "Frustum -1 1 -0.25 0.75 End_Camera",
                 "13: FRUSTUM: must be symmetric about the middle, with square pixels"),
                ("Normal 0 2 1", "Normal 0 0 0", "22: NORMAL: must not be 0 0 0"),
                ("TexFunc 0", "TexFunc 11", "17: TEXFUNC: must be a whole number from 0 to 10"),
                ("Resolution 64", "Resolution 6.5", "3: RESOLUTION = 6.5: must be a whole number from 1 to 2^32 - 1"),
                ("End_Scene", "", "23: the file ends where END_SCENE must be: it was cut short"),
                ("Sphere Center 0", "Cylinder Center 0", "20: CYLINDER is a cylinder without ends: only spheres, "),
                ("Sphere Center 0", "FCylinder Center 0", '20: "Center" must be BASE'),
                ("Background", "Fog Thick", '15: FOG "THICK": must be LINEAR, EXP, EXP2 or OFF'),
                ("Sphere Center 0", "Ball Center 0", '20: "BALL": must be CAMERA, ')):
            with self.subTest(new), self.assertRaises(ValueError) as caught:
                parsed((old, new))
            self.assertTrue(str(caught.exception).startswith("a.dat:" + message), caught.exception)

    def test_what_is_left_out_is_told_once(self):
        fog = "Fog {} Start 0.5 End 10 Density 0.4 Color 1 1 1 Background"
        self.assertEqual(parsed(("Background", fog.format("Off"))).notes, [])
        found = parsed(
            ("Background", fog.format("Exp2")),
            ("TexFunc 0", "TexFunc 9 wood.ppm Center 0 0 0 Rotate 0 0 0 Scale 1 1 1 UAxis 1 0 0 VAxis 0 1 0"),
            ("Opacity 1", "Opacity 0.5"), ("Opacity 1", "Opacity 0"),
            ("Trans_Max_Surfaces 4", "Ambient_Occlusion Ambient_Color 1 1 1 Rescale_Direct 0.3 Samples 12"))
        self.assertEqual(found.notes, [
            "a.dat:4: AMBIENT_OCCLUSION: its light from all sides is left out",
            "a.dat:15: FOG is left out, so far surfaces have their full colors",
            "a.dat:16: OPACITY: transparency is left out, so surfaces are opaque",
            "a.dat:17: TEXFUNC: patterns and images on surfaces are left out, so they have their plain color"])


class Lamps(unittest.TestCase):
    def around(self, spheres=(), planes=(), way=(0, 0, 0)):
        table = np.array(spheres, float).reshape(-1, 4)
        return _lights.Surroundings(table[:, :3], table[:, :3] + way, table[:, 3], list(planes), np.array([0.0, 0, 8]), np.zeros(3))

    def only_lamp(self, light, *surfaces):
        lamps, warnings = _lights.lamps_of([light], self.around(*surfaces))
        self.assertEqual((len(lamps), warnings), (1, []))
        return lamps[0]

    def test_they_touch_nothing(self):
        light = _lights.Light("", (1, 1, 1), (3, 4, 0))
        self.assertAlmostEqual(self.only_lamp(light, [(3, 4, 2, 2.125)]).radius, 0.0625, 12)
        along = self.around([(0, 0, 0, 0.5)], way=(4, 4, 0))
        for point, gap in (((3, 1, 0), math.sqrt(2)), ((2, 2, 3), 3), ((-3, 0, 4), 5), ((7, 8, 0), 5), ((1, 1, 0), 0)):
            self.assertAlmostEqual(along.clearance(np.array(point)), abs(gap - 0.5), 12)
        plane = pt.Plane((0, 2, 0), -7.9375, 0)
        self.assertAlmostEqual(self.only_lamp(light, [], [plane]).radius, 0.03125 / 2, 12)
        seen = _lights.Light("", (1, 1, 1), (0, 0, 7.875), radius=0.125)
        self.assertEqual(self.only_lamp(seen).radius, 0.0625)
        lamps, warnings = _lights.lamps_of([_lights.Light("a:7", (1, 1, 1), (3, 4, 0))],
                                           self.around(planes=[pt.Plane((0, 1, 0), -4, 0)]))
        self.assertEqual((lamps, warnings), ([], ["a:7: the light lies on a surface, and is left out"]))

    def test_distances_and_radii(self):
        self.assertEqual(self.only_lamp(_lights.Light("", (1, 0.5, 0), (3, 4, 0))).radius, 5 / 50)
        self.assertEqual(self.only_lamp(_lights.Light("", (1, 0.5, 0), (3, 4, 0), radius=2)).radius, 2)
        self.assertEqual(self.only_lamp(_lights.Light("", (1, 0.5, 0), (0, 2, 0), is_directional=True)).center[1], 800)
        # A light at the target is measured from the camera.
        self.assertEqual(self.only_lamp(_lights.Light("", (1, 1, 1), (0, 0, 0))).radius, 8 / 50)

    def test_the_target_is_among_what_is_seen(self):
        planes = [pt.Plane((0, 0, 2), -8, 0), pt.Plane((0, 0, 1), 7, 0), pt.Plane((0, 1, 0), 0, 0)]
        for balls, some, z in (([], [], 2), ([], planes, -7), ([(0, 0, 10, 1)], planes, -7),
                               ([(0, 0, -4, 1), (0, 9, -1, 2)], planes, -2)):
            table = np.array(balls, float).reshape(-1, 4)
            target = _lights.view_target(table[:, :3], table[:, 3], some, (1, 2, 3), (0, 0, -5))
            np.testing.assert_array_equal(target, [1, 2, z])


class Pictures(unittest.TestCase):
    def test_the_first_surfaces_are_those_that_tachyon_shows(self):
        """In Tachyon's pictures, ball i has the red 10 (i + 1), and plane i has the green 10 (i + 1). Tachyon samples
        the upper right corners of pixels."""
        for name in ("perspective", "parallel"):
            with self.subTest(name):
                found = read(DATA / f"{name}.dat")
                self.assertEqual(self.differences(found), (0, True))
                found.camera = replace(found.camera, up=tuple(np.multiply(found.camera.up, (-1, 1, 1))))
                self.assertGreater(self.differences(found)[0], 300)

    def differences(self, found):
        width, height = found.settings.width, found.settings.height
        name = "perspective" if found.camera.vertical_extent is None else "parallel"
        shown = np.frombuffer((DATA / f"{name}.ppm").read_bytes()[-3 * width * height:], np.uint8)
        red, green = shown.reshape(height, width, 3)[..., 0] // 10, shown.reshape(height, width, 3)[..., 1] // 10
        spheres = found.scene.sphere_arrays[0]
        shown = np.where(red > 0, red - 1, len(spheres) + green.astype(int) - 1)
        starts, ways = rays(found.camera, width, height, 1, 0)
        distances = [to_ball(starts - center, ways, radius) for center, radius in zip(spheres.center, spheres.radius)]
        with np.errstate(divide="ignore"):
            distances += [-(starts @ plane.normal + plane.offset) / (ways @ plane.normal) for plane in found.scene.planes]
        distances = np.array(distances)
        distances[~(distances > 0)] = np.inf
        nearest, second = np.partition(distances, 1, axis=0)[:2]
        certain = second - nearest > 1e-3
        for center, radius in zip(spheres.center, spheres.radius):  # Edges are uncertain.
            toward = center - starts
            miss = np.linalg.norm(toward - np.sum(toward * ways, -1)[..., None] * ways, axis=-1)
            certain &= np.abs(miss - radius) > 1e-3
        return int(np.sum(certain & (distances.argmin(axis=0) != shown))), np.mean(certain) > 0.95


class Damage(unittest.TestCase):
    def outcome(self, text):
        try:
            found = parse(text.splitlines(), "a.dat")
        except ValueError as error:
            self.assertRegex(str(error), r"\A(a\.dat:\d+: |center|radius|materials|camera)")
            return None
        return len(found.scene.sphere_arrays[0]) if found.scene.sphere_arrays else 0

    def test_cut_or_changed_files_do_no_harm(self):
        text, chance, refused = (DATA / "perspective.dat").read_text(), random.Random(2), 0
        end = text.upper().index("END_SCENE") + len("END_SCENE")
        for index in range(200):
            size = chance.randrange(len(text))
            self.assertEqual(self.outcome(text[:size]) is None, size < end, size)
            changed = list(text)
            for _ in range(1 + index % 3):
                changed[chance.randrange(len(text) if index % 2 else 250)] = chance.choice("0123456789.-+eE# \nvbfls\xff")
            refused += self.outcome("".join(changed)) is None
        self.assertTrue(50 < refused < 200, refused)


class Command(unittest.TestCase):
    def test_it_writes_the_scene_that_was_read(self):
        with tempfile.TemporaryDirectory() as folder:
            given, written = pathlib.Path(folder, "a.dat"), pathlib.Path(folder, "a.json")
            given.write_text(SCENE.replace("Plane", "FCylinder Base 1 2 3 Apex 4 5 6 Rad 0.5 gold\nPlane"))
            self.assertEqual(_command.main([str(given), "-o", str(written)]), 0)
            scene = json.loads(written.read_text())
            given.write_text(SCENE.replace("Sphere", "Ball"))
            with mock.patch("sys.stderr") as stderr:
                self.assertEqual(_command.main([str(given), "-o", str(written)]), 3)
            self.assertIn("a.dat:19", stderr.write.call_args_list[0].args[0])
        self.assertEqual(scene["capsules"], [{"center": [1, 2, -3], "end": [4, 5, -6], "radius": 0.5, "material": "texture 0"}])
        self.assertEqual(scene["spheres"][1], {"center": [0, 2, -7], "radius": 1, "material": "texture 1"})
        self.assertEqual(scene["materials"]["texture 1"], {"diffuse": [0, 0.5, 1], "specular": 0.75, "glossiness": 1e6})
        self.assertEqual([each["material"] for each in scene["spheres"]], [
            "texture 0", "texture 1", "light 1", "light 2", "light 3"])
        self.assertTrue(scene["materials"]["light 1"]["hidden_from_camera"])
        self.assertEqual(scene["planes"], [{"normal": [0, 2, -1], "offset": 6, "material": "texture 0"}])
