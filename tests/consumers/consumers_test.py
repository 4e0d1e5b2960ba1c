"""Builds users' programs with the installed library: consumers_test.py STEP. The first step, `install`, moves the installation before its
use."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from png import parse_png

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
EXAMPLES = SOURCE / "lib" / "examples"


class Failed(Exception):
    pass


def run(*command, expect=0, cwd=None, **environment):
    done = subprocess.run([str(word) for word in command], cwd=cwd, env={**os.environ, **environment},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != expect:
        raise Failed(f"{' '.join(map(str, command))}\nexit status {done.returncode}, not {expect}:\n{done.stdout}")
    return done.stdout


def require(holds, message):
    if not holds:
        raise Failed(message)


def check_enclosure(*command, **environment):
    run(*command, **environment)
    run(*command, "2.5", expect=1, **environment)


def files_with(tree, *texts):
    found = []
    for path in sorted(tree.rglob("*")):
        if path.is_file() and not path.is_symlink():
            data = path.read_bytes()
            found += [f"{path}: {text}" for text in texts if str(text).encode() in data]
    return found


def needed(program):
    return [line.split("[")[1].rstrip("]") for line in run("readelf", "--dynamic", program).splitlines()
            if "(NEEDED)" in line]


def check_linkage(program, shared):
    names = [name for name in needed(program) if name.startswith("libpt")]
    require(names == (["libpt.so.0.4"] if shared else []), f"{program} needs {names}")


class Steps:
    def __init__(self, options):
        self.options = options
        self.work = options.work
        self.prefix = self.work / "moved"
        self.library = self.prefix / options.libdir
        self.small = [SOURCE / "cli/scenes/coursework.json", "--size", "16x8", "--spp", "1"]
        self.strict = [options.c_compiler, "-std=c99", "-pedantic-errors", "-Wall", "-Wextra", "-Werror"]
        self.pc = {"PKG_CONFIG_PATH": str(self.library / "pkgconfig")}

    def folder(self, name):
        path = self.work / name
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def pkg_config(self, *arguments, package="pt"):
        return run("pkg-config", *arguments, package, **self.pc).split()

    def install(self):
        shutil.rmtree(self.work, ignore_errors=True)
        first = self.work / "installed"
        run(self.options.cmake, "--install", self.options.build, "--prefix", first)
        require(files_with(first, first) == [], f"the prefix is in installed files: {files_with(first, first)}")
        trace = first / "trace"
        trace.write_text(f"prefix={first}")
        require(files_with(first, first) == [f"{trace}: {first}"], "a file that names the prefix went unnoticed")
        trace.unlink()
        first.rename(self.prefix)
        for kind in "*.cmake", "*.pc", "*.h":
            for path in self.prefix.rglob(kind):
                text = path.read_text()
                for place in self.options.build, SOURCE:
                    require(f"{place}/" not in text, f"{path} names {place}")

    def check_copyrights(self, share, packages):
        for package in packages:
            text = (share / "doc" / package / "copyright").read_text()
            holders = re.findall(r"^Files: .*\nCopyright: .*\nLicense: (.*)$", text, re.MULTILINE)
            texts = re.findall(r"^License: (\S+)\n +\S", text, re.MULTILINE)
            require(len(holders) > 1, f"{package} has only {holders}")
            require(sorted(texts) == sorted(set(" and ".join(holders).split(" and "))), f"{package} has {holders}, {texts}")

    def check_manual(self, share):
        text = (share / "man/man1/pt.1").read_text()
        commands = re.findall(r"^  (\w+) ", text.split("Commands:\n")[1].split("\n\n")[0], re.MULTILINE)
        require("render" in commands, f"pt.1 refers to {commands}")
        require("\\-\\-checkpoint\\-every" in (share / "man/man1/pt-render.1").read_text(), "pt-render.1 lacks options")
        pages = sorted(path.name for path in (share / "man/man1").iterdir())
        require(pages == sorted(["pt.1", *(f"pt-{command}.1" for command in commands)]), f"the pages are {pages}")
        self.check_completion(share / "bash-completion/completions/pt")

    def check_completion(self, script):
        for words, expected in ((["pt", "re"], "render"), (["pt", "render", "--check"], "--checkpoint --checkpoint-every"),
                                (["pt", "render", "sc"], "")):
            ask = f'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD={len(words) - 1}; _pt; echo "${{COMPREPLY[*]}}"'
            said = run("bash", "-c", ask, "bash", script, *words, PATH=f"{self.prefix / 'bin'}:{os.environ['PATH']}").strip()
            require(said == expected, f"completion of {words} is {said}")

    def c99(self):
        folder = self.folder("c99")
        enclosure = HERE / "c99" / "enclosure.c"
        run(*self.strict, enclosure, *self.pkg_config("--cflags", "--libs"), "-o", folder / "shared")
        check_linkage(folder / "shared", shared=True)
        check_enclosure(folder / "shared", LD_LIBRARY_PATH=str(self.library))

        run(*self.strict, enclosure, *self.pkg_config("--cflags", "--libs", package="pt-static"), "-o", folder / "static")
        check_linkage(folder / "static", shared=False)
        check_enclosure(folder / "static")

        plugin = folder / "plugin"
        run(*self.strict, HERE / "c99" / "plugin.c", *self.pkg_config("--cflags"), "-ldl", "-o", plugin)
        for unload in [], ["unload"]:
            run(plugin, self.library / "libpt.so.0.4", *unload)
        run(plugin, self.library / "missing.so", expect=1)

        program, = re.findall(r"```c\n(.*?)```", (SOURCE / "README.md").read_text(encoding="utf-8"), re.DOTALL)
        (folder / "ball.c").write_text(program)
        run(*self.strict, folder / "ball.c", *self.pkg_config("--cflags", "--libs"), "-o", folder / "ball")
        said = run(folder / "ball", LD_LIBRARY_PATH=str(self.library))
        require(said == "radiance in the middle: 1\n", f"the README's program says {said}")

        room = SOURCE / "cli/scenes/first.json"
        for name, packages in (("scene", ("pt", "pt-scene")), ("scene_static", ("pt-static", "pt-scene-static"))):
            flags = [flag for package in packages for flag in self.pkg_config("--cflags", "--libs", package=package)]
            run(*self.strict, EXAMPLES / "scene_file.c", *flags, "-o", folder / name)
            run(folder / name, room, "film.width=8", "film.height=4", "render.spp=1", cwd=folder,
                LD_LIBRARY_PATH=str(self.library))
            require((folder / "scene_file.pfm").stat().st_size == len("PF\n8 4\n-1.0\n") + 8 * 4 * 12, f"{name}: another size")
            (folder / "scene_file.pfm").unlink()
        for package in "pt", "pt-static", "pt-scene", "pt-scene-static":
            require(self.pkg_config("--modversion", package=package) == [self.options.version],
                    f"{package}.pc has another version")
        if (self.library / "pt" / "libpt-glsl.so").exists():
            shaders, = self.pkg_config("--variable=shaderdir")
            require((pathlib.Path(shaders) / "pathtrace.comp").is_file(), f"there are no shaders in {shaders}")

    def package(self):
        folder = self.folder("package")
        for project in "package", "package_c":
            build = folder / project
            run(self.options.cmake, "-G", "Ninja", "-S", HERE / project, "-B", build, "-DCMAKE_BUILD_TYPE=Debug",
                f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DCMAKE_C_COMPILER={self.options.c_compiler}",
                f"-DCMAKE_CXX_COMPILER={self.options.cxx_compiler}")
            cache = (build / "CMakeCache.txt").read_text()
            require(f"pt_DIR:PATH={self.library}/cmake/pt\n" in cache, "another pt was found than the one installed")
            run(self.options.cmake, "--build", build)
        check_linkage(folder / "package/own_names_shared", shared=True)
        check_linkage(folder / "package/own_names_static", shared=False)
        run(folder / "package/own_names_shared")
        run(folder / "package/own_names_static")
        check_enclosure(folder / "package_c/enclosure_static")
        for name, shared in (("scene", ["libpt-scene.so.0.4"]), ("scene_static", [])):
            run(folder / "package_c" / f"uses_{name}")
            names = [each for each in needed(folder / "package_c" / f"uses_{name}") if each.startswith(("libpt", "libvulkan"))]
            require(names == shared, f"uses_{name} needs {names}")

    def configure_subproject(self, build, *settings):
        run(self.options.cmake, "-S", HERE / "subproject", "-B", build, "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
            f"-DPT_DIRECTORY={SOURCE}", f"-DCMAKE_C_COMPILER={self.options.c_compiler}",
            f"-DCMAKE_CXX_COMPILER={self.options.cxx_compiler}", "-G", "Ninja", *settings)
        fast, slow = set(), set()
        for entry in json.loads((build / "compile_commands.json").read_text()):
            path = pathlib.Path(entry["file"])
            if path.is_relative_to(SOURCE) and not path.is_relative_to(build):
                last = [word for word in entry["command"].split() if word.startswith("-O")][-1:]
                (fast if last in (["-O2"], ["-O3"]) else slow).add(path.relative_to(SOURCE).parts[0])
        return fast, slow

    def subproject(self):
        """Objects come from the library's own build (reuse.py)."""
        folder = self.folder("subproject")
        # The library sets optimization only for itself, and only if the outer project has no build type.
        for number, (settings, expected) in enumerate((
                ([], ({"lib"}, {"tests"})),
                (["-DCMAKE_BUILD_TYPE=Debug"], (set(), {"lib", "tests"})),
                (["-DCMAKE_CXX_FLAGS=-O0"], (set(), {"lib", "tests"})),
                (["-G", "Ninja Multi-Config", "-DCMAKE_CONFIGURATION_TYPES=Debug"], (set(), {"lib", "tests"})))):
            found = self.configure_subproject(folder / str(number), *settings)
            require(found == expected, f"with {settings}, (optimised, not optimised) are {found}")
        build = folder / "build"
        own = (self.options.build / "CMakeCache.txt").read_text()
        settings = re.findall(r"^((?:PT_UNITY|CMAKE_BUILD_TYPE):\w+=.*)$", own, re.MULTILINE)
        commands = folder / "commands.json"
        commands.write_text(run("ninja", "-C", self.options.build, "-t", "compdb") if "CMAKE_GENERATOR:INTERNAL=Ninja\n" in own
                            else "[]")
        reuse = ";".join(map(str, (sys.executable, "-B", HERE / "reuse.py", commands, self.options.build, build / "pt")))
        self.configure_subproject(build, f"-DCMAKE_CXX_COMPILER_LAUNCHER={reuse}", *(f"-D{each}" for each in settings),
                                  "-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON", "-DCMAKE_CXX_FLAGS=-flto=auto")
        said = run(self.options.cmake, "--build", build, "-j1")
        require("warning" not in said, said)
        symbols = run("nm", "--defined-only", "--extern-only", "--format=posix", build / "pt" / "lib" / "libpt.a")
        exported = re.findall(r"(pt_\w+)\(", (SOURCE / "tests/abi/exported_symbols.txt").read_text())
        require(sorted(re.findall(r"^(\w+) ", symbols, re.MULTILINE)) == sorted(exported), f"libpt.a exports {symbols}")
        check_enclosure(build / "enclosure_shared")
        check_enclosure(build / "enclosure_static")
        run(build / "own_names")
        run(self.options.cmake, "--install", build, "--prefix", folder / "installed")
        installed = [path.name for path in (folder / "installed").rglob("*") if path.is_file()]
        require(installed == ["enclosure_static"], f"the project's installation has {installed}")

    def python(self):
        folder = self.folder("python")
        library = {"PT_LIBRARY": str(self.library / "libpt.so.0.4"), "PYTHONPATH": str(SOURCE / "lib" / "python")}
        run(sys.executable, "-B", EXAMPLES / "smallest.py", cwd=folder, **library)
        width, height, rows = parse_png((folder / "smallest.png").read_bytes())
        run(*self.strict, EXAMPLES / "smallest.c", *self.pkg_config("--cflags", "--libs"), "-o", folder / "c")
        run(folder / "c", cwd=folder, LD_LIBRARY_PATH=str(self.library))
        require((folder / "smallest.ppm").read_bytes() == b"P6\n%d %d\n255\n" % (width, height) + b"".join(map(bytes, rows)),
                "smallest.c and smallest.py differ")

    def check_program(self, program, folder, *options, **environment):
        outputs = [folder / name for name in ("x.exr", "x.jpg", "x.png")]
        written = [word for output in outputs for word in ("-o", output)]
        run(program, "render", *self.small, *options, *written, **environment)
        for output, magic in zip(outputs, (b"\x76\x2f\x31\x01", b"\xff\xd8\xff", b"\x89PNG")):
            require(output.read_bytes().startswith(magic), f"{output} is of another format")

    def program(self):
        folder = self.folder("program")
        self.check_copyrights(self.prefix / "share", [path.name for path in (self.prefix / "share/doc").iterdir()])
        self.check_manual(self.prefix / "share")
        self.check_program(self.prefix / "bin" / "pt", folder)
        shutil.copytree(self.prefix, folder / "without", symlinks=True)
        (folder / "without" / self.options.libdir / "pt" / "libpt-image-file.so").unlink()
        program, small = folder / "without/bin/pt", ["render", *self.small]
        run(program, *small, "-o", folder / "only.png")
        run(program, "compare", folder / "only.png", folder / "only.png", "--max-difference", "0")
        for name in "only.exr", "only.jpg":
            said = run(program, *small, "--progress", "json", "-o", folder / name, expect=6)
            require("pt-image-formats" in said and "libopenimageio-dev" in said, f"without the module: {said}")
            require("fraction" not in said, f"rendered before the module was missed: {said}")
            require(not (folder / name).exists(), f"{name} was written without the module")
        said = run(program, "compare", folder / "only.exr", folder / "other.exr", expect=6)
        require("pt-image-formats" in said, f"without the module: {said}")

    def without_openimageio(self):
        build = self.folder("without_openimageio")
        said = run(self.options.cmake, "-G", "Ninja", "-S", SOURCE, "-B", build, "-DPT_BUILD_TESTS=OFF",
                   "-DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON", f"-DCMAKE_C_COMPILER={self.options.c_compiler}",
                   f"-DCMAKE_CXX_COMPILER={self.options.cxx_compiler}")
        require(said.count("libopenimageio-dev is not there") == 1, f"CMake says\n{said}")
        targets = run(self.options.cmake, "--build", build, "--target", "help")
        require("pt-cli:" in targets and "pt-image-file" not in targets, f"the targets are\n{targets}")
        packages = (build / "CPackConfig.cmake").read_text()
        require("pt_program" in packages and "pt_image_formats;" not in packages, "the packages are others")

    @staticmethod
    def field(package, name):
        return run("dpkg-deb", "--field", package, name).strip().split(", ")

    def debian(self):
        folder = self.folder("debian")
        run(self.options.cpack, "-G", "DEB", "-B", folder, cwd=self.options.build)
        packages = {path.name.split("_")[0]: path for path in folder.glob("*.deb")}
        compiler = "libpt0.4-glsl"
        expected = ["libpt0.4", "libpt0.4-dev", *([compiler] if compiler in packages else []), "pt", "pt-image-formats"]
        require(sorted(packages) == expected, f"the packages are {sorted(packages)}")
        exact = f"libpt0.4 (= {self.options.version})"
        for name, wanted in {
            "libpt0.4": ["libc6", "libstdc++6", "libvulkan1"],
            "libpt0.4-dev": [exact, "libvulkan-dev"],
            "pt": [exact, "libpng16-16", "libstdc++6"],
            "pt-image-formats": [f"pt (= {self.options.version})", "libopenimageio2."]
        }.items():
            depends = self.field(packages[name], "Depends")
            for start in wanted:
                require(any(entry.startswith(start) for entry in depends), f"{name} depends on {depends}")
            other = [entry for entry in depends if entry.startswith("libopenimageio")]
            require(name == "pt-image-formats" or not other, f"{name} depends on {other}")
        recommends = self.field(packages["pt"], "Recommends")
        require(recommends == [f"pt-image-formats (= {self.options.version})"], f"pt recommends {recommends}")

        root = folder / "root"
        for path in packages.values():
            run("dpkg-deb", "--extract", path, root)
        self.check_copyrights(root / "usr/share", packages)
        self.check_manual(root / "usr/share")
        libraries = {"LD_LIBRARY_PATH": str(root / "usr" / self.options.libdir)}
        self.check_program(root / "usr/bin/pt", folder, **libraries)
        if compiler in packages:
            self.check_program(root / "usr/bin/pt", folder, "--shader-dir", root / "usr/share/pt/shaders", **libraries)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("step")
    for name in "build", "work":
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    for name in "cmake", "cpack", "c-compiler", "cxx-compiler", "libdir", "version":
        parser.add_argument(f"--{name}", required=True)
    options = parser.parse_args()
    try:
        getattr(Steps(options), options.step)()
    except Failed as failure:
        sys.exit(str(failure))


main()
