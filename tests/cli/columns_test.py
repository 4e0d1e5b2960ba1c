import json
import os

from command_line import PT, CommandLineTest, npy, read_png

CENTERS = [0.0, 0.5, -5.0, 1.25, 0.5, -6.0, -1.0, 0.25, -4.0]
RADII = [0.5, 1.0, 0.25]
COLORS = [255, 0, 128, 255, 255, 255, 30, 60, 90]  # the second is the default


class ColumnsTest(CommandLineTest):
    def scene(self, *items, kind="spheres"):
        scene = {"materials": {"a": {"diffuse": 0.75}, "sky": {"emission": 1}},
                 "spheres": [{"center": [0, 0, 0], "radius": 100, "material": "sky"}]}
        scene[kind] = [*scene.get(kind, ()), *items]
        self.write("s.json", json.dumps(scene, indent=1))

    def files_of(self):
        self.write("c.npy", npy("<f8", (3, 3), CENTERS))
        self.write("r.npy", npy("<f4", (3,), RADII))
        self.write("k.npy", npy("|u1", (3, 3), COLORS))


class Refusals(ColumnsTest):
    def refuse(self, data, error, key="radius", code=3):
        self.files_of()
        self.write("bad.npy", data)
        self.scene({"center": "c.npy", "radius": 1, "material": "a", key: "bad.npy"})
        self.expect(code, "render", "s.json", "-o", "a.png", "--size", "4x2", "--spp", "1",
                    error=f"pt: s.json: spheres[1].{key}: bad.npy: {error}")

    def test_files_that_do_not_fit(self):
        good = npy("<f4", (3,), RADII)
        for data, error in (
                (b"", "is not an NPY file"), (b"PK\3\4" + good, "is not an NPY file"), (good[:5], "is not an NPY file"),
                (good[:9], "ends within its header"), (good[:40], "ends within its header"),
                (good[:-1], "ends after 2 of 3 rows"), (good + b"\0", "goes on after its 3 rows"),
                (good[:6] + b"\3" + good[7:], "has NPY version 3, must be 1 or 2"),
                (good.replace(b"<f4", b">f4"), "has numbers of the type >f4, must be <f4, <f8 or |u1: save array"),
                (good.replace(b"<f4", b"<i4"), "has numbers of the type <i4"),
                (good.replace(b"'<f4'", b"[('x'"), "its header has no descr"),
                (good.replace(b"False", b"True "), "is in column order: save numpy.ascontiguousarray(array)"),
                (good.replace(b"(3,)", b"()  "), "has 0 dimensions, must have 1 or 2"),
                (good.replace(b"(3,)", b"(-1)"), "its header has an invalid shape"),
                (good.replace(b"'shape'", b"'shade'"), "its header has no shape"),
                (npy("<f4", (3, 1, 1), RADII), "has 3 dimensions"),
                (npy("<f4", (3, 1), RADII), "has the shape (3, 1), must be (N,)"),
                (npy("<f4", (2,), RADII[:2]), "has 2 rows, but the centers have 3"),
                (npy("<f4", (2**62, 2), RADII), "ends after 1 of 4611686018427387904 rows"),
                (npy("|u1", (3,), [1, 2, 3]), "has numbers of the type |u1, which only colors may have")):
            with self.subTest(error=error):
                self.refuse(data, error)
        self.refuse(npy("<f4", (3,), RADII), "has the shape (3,), must be (N, 3)", "color")
        self.refuse(npy("<f8", (3, 2), [0] * 6), "has the shape (3, 2), must be (N, 3)", "motion")

    def test_files_that_are_not_there_or_are_outputs(self):
        self.scene({"center": "c.npy", "radius": "no.npy", "material": "a"})
        self.files_of()
        arguments = "render", "s.json", "-o", "a.png", "--size", "4x2", "--spp", "1"
        self.expect(6, *arguments, error="spheres[1].radius: cannot read no.npy: No such file or directory")
        os.symlink("c.npy", self.path("same.json"))
        self.expect(2, *arguments, "--stats", "same.json", error="is the same file as a column of spheres c.npy")

    def test_sections_of_before_name_the_new_way(self):
        for section in '"figure": {}', '"particles": []':
            self.write("s.json", "{%s}" % section)
            self.expect(3, "render", "s.json", "-o", "a.png", error="--write-scene SCENE` writes a scene whose spheres")


class RealDevice(ColumnsTest):
    program = PT

    def picture(self, *items, kind="spheres"):
        self.scene(*items, kind=kind)
        self.expect(0, "render", "s.json", "-o", "a.png", "--size", "24x16", "--spp", "4", "-q")
        return read_png(self.path("a.png"))[2]

    def test_columns_are_what_they_list(self):
        def linear(byte):
            share = byte / 255
            return share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4

        ends, opacities, motion = [0.5, 0.5, -4.0, 1.25, -0.5, -6.5, -1.0, 0.75, -4.0], [0.5, 1, 0.25], [0.25, 0, 0]
        self.files_of()
        self.write("e.npy", npy("<f4", (3, 3), ends))
        self.write("m.npy", npy("<f4", (3, 3), motion * 3))
        self.write("o.npy", npy("<f8", (3,), opacities))
        for kind, key, values, columns, step in (
                ("spheres", "color", [[linear(byte) for byte in COLORS[3 * i:3 * i + 3]] for i in range(3)], ("k.npy",), 1),
                ("spheres", "motion", [motion] * 3, ("m.npy", motion), 0), ("spheres", "opacity", opacities, ("o.npy",), 0),
                ("capsules", "end", [ends[:3], ends[3:6], ends[6:]], ("e.npy",), 0)):
            plain = [{"center": CENTERS[3 * i:3 * i + 3], "radius": RADII[i], "material": "a"} for i in range(3)]
            expected = self.picture(*(one if value == [1, 1, 1] else {**one, key: value} for one, value in zip(plain, values)), kind=kind)
            self.assertNotEqual(self.picture(*plain), expected)
            for column in columns:
                for float_type, version in (("<f4", 1), ("<f8", 2)):
                    with self.subTest(key=key, column=column, type=float_type):
                        self.write("c.npy", npy(float_type, (3, 3), CENTERS, version))
                        self.write("r.npy", npy(float_type, (3,), RADII, version))
                        found = self.picture({"center": "c.npy", "radius": "r.npy", "material": "a", key: column}, kind=kind)
                        # The library decodes sRGB to float32, which may change the light by one ulp.
                        self.assertLessEqual(max(abs(a - b) for rows in zip(expected, found) for a, b in zip(*rows)), step)

    def test_what_does_not_fit_is_refused(self):
        self.files_of()
        self.write("e.npy", npy("<f4", (3, 3), [float("inf")] * 9))
        self.write("n.npy", npy("<f4", (3,), [1, -1, 1]))
        single = {"center": [0, 0, -5], "radius": 1, "material": "a"}
        columns = {**single, "center": "c.npy"}
        for kind, item, error in (
                ("capsules", {**columns, "end": "e.npy"}, ": capsules[0].end[0] = (inf, inf, inf): must be finite"),
                ("capsules", {**single, "end": [1, 0, -5], "material": "sky"},
                 ': capsules[0].material = "sky": must be a material without emission'),
                ("capsules", {**columns, "end": [1, 1, -5], "material": "sky"}, ': capsules[0].material = "sky": must be a material'),
                ("capsules", single, 'capsules[0]: "end" is missing'),
                ("spheres", {**columns, "opacity": 0.5, "material": "sky"},
                 'spheres[1].material = "sky": must be a material that neither'),
                ("spheres", {**columns, "radius": "n.npy"}, ": spheres[1].radius[1] = -1: must be > 0"),
                ("spheres", {**columns, "opacity": 1.5}, "spheres[1].opacity[0] = 1.5: must lie in [0, 1]")):
            with self.subTest(error=error):
                self.scene(item, kind=kind)
                self.expect(3, "render", "s.json", "-o", "a.png", error=error)
        self.scene(columns, {**single, "radius": -2})
        self.expect(3, "render", "s.json", "-o", "a.png", error="spheres[2].radius = -2: must be > 0")
