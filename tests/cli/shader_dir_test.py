import glob
import os
import shutil
import subprocess

from command_line import PT, SCENES, CommandLineTest, read_png
from watching import WatchTest, scene_text

SHADERS = os.path.join(SCENES, "..", "..", "shaders")
LIBRARIES = os.path.join(os.path.dirname(os.path.dirname(PT)), "lib")
MODULE = os.path.join(LIBRARIES, "pt", "libpt-glsl.so")
SRGB = {0.25: 137, 0.5: 188, 1.0: 255}  # IEC 61966-2-1, 8 bits


class ShaderDir(WatchTest):
    program = PT

    def setUp(self):
        super().setUp()
        shutil.copytree(SHADERS, self.path("shaders"))
        self.write("s.json", scene_text(3, 0.25))

    def edited(self, name, old, new):
        text = self.read(f"shaders/{name}")
        self.assertEqual(text.count(old), 1)
        return text.replace(old, new)

    def brighter(self, factor):
        with open(os.path.join(SHADERS, "pathtrace.comp"), encoding="utf-8") as file:
            return file.read().replace("* held.film_scale", f"* ({factor} * held.film_scale)")

    def expect_picture(self, radiance):
        self.assertEqual(read_png(self.path("a.png")), (3, 2, [[SRGB[radiance]] * 9] * 2))

    def test_edits(self):
        pt = self.watch("--shader-dir", "shaders")
        pt.line_with("wrote a.png")
        pt.line_with("watching s.json and the shaders in shaders; Ctrl-C ends")
        self.expect_picture(0.25)

        self.save("shaders/pathtrace.comp", self.brighter("4.0"))
        pt.line_with("changed: shaders/pathtrace.comp")
        pt.line_with("wrote a.png")
        self.expect_picture(1.0)

        film = self.read("shaders/film.glsl")
        self.save("shaders/film.glsl", self.edited("film.glsl", "FilmPixel empty_film_pixel()\n",
                                                   "FilmPixel empty_film_pixel(\n"))
        line = film[:film.index("FilmPixel empty_film_pixel()")].count("\n") + 2
        pt.line_with("pt: pathtrace.comp does not compile:")
        pt.line_with(f"pt: ERROR: shaders/film.glsl:{line}: '' :  syntax error")
        self.expect_picture(1.0)
        self.save("shaders/film.glsl", film + "\n// a remark\n")
        pt.line_with("pt: changed: shaders/film.glsl")
        pt.line_with("wrote a.png")
        self.expect_picture(1.0)

        os.rename(self.path("shaders"), self.path("aside"))
        pt.line_with("shaders/pathtrace.comp: No such file or directory")
        shutil.copytree(SHADERS, self.path("shaders"))
        pt.line_with("wrote a.png")
        self.expect_picture(0.25)
        self.write("shaders/pathtrace.comp", self.brighter("2.0"))
        pt.line_with("wrote a.png")
        self.save("s.json", scene_text(3, 0.5))
        pt.line_with("wrote a.png")
        self.expect_picture(1.0)
        self.assertEqual(pt.end(), 0)

    def test_shaders_that_do_not_compile_at_first(self):
        self.save("shaders/pathtrace.comp", "#version 450\n#extension GL_GOOGLE_include_directive : require\n"
                                            "#include \"gone.glsl\"\n")
        self.expect(3, "render", "s.json", "-o", "a.png", "--shader-dir", "shaders",
                    error="shaders/pathtrace.comp:3: '#include' : shaders/gone.glsl: No such file or directory")
        pt = self.watch("--shader-dir", "shaders")
        pt.line_with("shaders/gone.glsl: No such file or directory")
        pt.line_with("watching")
        self.save("shaders/gone.glsl", self.brighter("2.0").replace("#version 450\n", ""))
        pt.line_with("wrote a.png")
        self.expect_picture(0.5)
        self.assertEqual(pt.end(), 0)

    def test_lost_samples_are_waited_out(self):
        pt = self.watch("--shader-dir", "shaders")
        pt.line_with("watching")
        kernel = self.read("shaders/pathtrace.comp")
        for text in kernel.replace("void main()\n{\n", "void main()\n{\n    return;\n"), kernel.replace("local_size_x", "local_size_y"):
            self.assertNotEqual(text, kernel)
            self.save("shaders/pathtrace.comp", text)
            pt.line_with("an endless loop or another local_size in the shaders in shaders does this")
            pt.line_with("the likely cause: shaders/pathtrace.comp, edited since the last picture")
            self.save("shaders/pathtrace.comp", kernel)
            pt.line_with("wrote a.png")
            self.expect_picture(0.25)
        self.assertEqual(pt.end(), 0)

    def test_without_watching(self):
        self.write("shaders/phong.glsl", "\ufeff" + self.read("shaders/phong.glsl"))
        self.write("shaders/pathtrace.comp", self.brighter("2.0"))
        self.expect(0, "render", "s.json", "-o", "a.png", "--shader-dir", "shaders")
        self.expect_picture(0.5)
        self.expect(3, "render", "s.json", "-o", "a.png", "--shader-dir", "none", error="none/pathtrace.comp")
        kernel = self.edited("pathtrace.comp", "layout(local_size_x", "layout(set = 0, binding = 9) buffer Mine "
                             "{ vec4 mine[]; };\nlayout(local_size_x").replace("* held.film_scale", "* (held.film_scale + mine[0].x)")
        self.write("shaders/pathtrace.comp", kernel)
        self.expect(3, "render", "s.json", "-o", "a.png", "--shader-dir", "shaders",
                    error="building a kernel: binding 9 is not in its layout, which has the bindings 0, 1, 2, 4, 5, 6, 7 "
                          "of set 0")
        self.write("shaders/pathtrace.comp", kernel.replace("set = 0, binding = 9", "set = 1, binding = 0"))
        self.expect(3, "render", "s.json", "-o", "a.png", "--shader-dir", "shaders", error="set 1 is not in its layout")


class Module(CommandLineTest):
    program = PT

    def test_one_function_is_to_be_seen(self):
        done = subprocess.run(["nm", "-D", "--defined-only", MODULE], capture_output=True, text=True, check=True)
        self.assertEqual([line.split()[-1] for line in done.stdout.splitlines()], ["pt_glsl_compile"])

    def test_it_is_found_where_the_library_is(self):
        self.write("s.json", scene_text(3))
        arguments = ["render", "s.json", "-o", "a.png", "--shader-dir", SHADERS]
        os.makedirs(self.path("lib"))
        for path in glob.glob(os.path.join(LIBRARIES, "libpt.so*")):
            shutil.copy(path, self.path("lib"))
        environment = {"LD_LIBRARY_PATH": self.path("lib")}
        self.expect(6, *arguments, error=f"--shader-dir = \"{SHADERS}\": the compiler's module cannot be loaded: "
                    + self.path("lib/pt/libpt-glsl.so"), **environment)
        self.expect(0, "render", "s.json", "-o", "a.png", **environment)
        os.makedirs(self.path("lib/pt"))
        shutil.copy(MODULE, self.path("lib/pt"))
        self.expect(0, *arguments, **environment)
        self.expect(0, *arguments, LD_LIBRARY_PATH="lib")
