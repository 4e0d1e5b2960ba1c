from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from pt._camera import Camera, RenderSettings
from pt._files import regular
from pt._scene import Material, Plane, Scene, Sphere, SphereArray
from pt._vectors import Triple
from pt.tachyon._lights import Light, Surroundings, dimmed, lamps_of, view_target
from pt.tachyon._textures import Textures
from pt.tachyon._words import Words

OTHERS = {
    "TRI": "a triangle", "STRI": "a smooth triangle", "VCSTRI": "a smooth triangle",
    "VERTEXARRAY": "a mesh of triangles", "CYLINDER": "a cylinder without ends", "RING": "a ring", "BOX": "a box",
    "QUADRIC": "a quadric surface", "SCAPE": "a landscape", "SCALARVOL": "a volume", "TPOLYFILE": "a file of triangles",
    "MGFFILE": "a file of shapes", "IMAGEDEF": "an image", "SPOTLIGHT": "a spotlight",
    "SKY_LIGHT": "light from all sides", "BACKGROUND_GRADIENT": "a background of two colors",
    "START_CLIPGROUP": "a cut through shapes", "INCLUDE": "another file"}
SECTIONS = ("CAMERA", "BACKGROUND", "FOG", "LIGHT", "DIRECTIONAL_LIGHT", "TEXDEF", "TEXALIAS", "SPHERE", "FCYLINDER",
            "POLYCYLINDER", "PLANE", "SHADER_MODE", "END_SCENE")
SKY_RADIUS = 1e6  # relative to the extent, so that a floor ends less than a pixel below the horizon


@dataclass
class TachyonScene:
    """scene      one SphereArray of spheres and one of cylinders, each in the order of the file
    settings   the file's resolution, otherwise defaults
    notes      omitted parts, with line numbers
    """

    scene: Scene
    camera: Camera
    settings: RenderSettings
    notes: list[str]


def read(path: str | os.PathLike[str], *, leave_out_others: bool = False) -> TachyonScene:
    """Reads a Tachyon scene file and converts its values:

    lengths, colors            unchanged; exposure 0 and gamma 1 show linear colors as Tachyon does
    left-handed axes           z changes its sign
    ZOOM                       half of the height has the tangent 0.5 / ZOOM; ORTHOGRAPHIC: vertical_extent 1 / ZOOM
    DIFFUSE, SPECULAR > 0      diffuse, and a mirror: specular with the glossiness 1e6
    PHONG p, PHONG_SIZE n,     glossiness n, specular 2 p / (n + 2), which gives the highlight the same brightness
      without SPECULAR
    FCYLINDER, POLYCYLINDER    capsules with round ends; VMD's flat caps (RING) are inside them
    BACKGROUND                 a ball of this color that lights the scene, unless black. Lights are dimmed by as much, at
                               most to a third
    point light                a lamp that gives the camera's target the same light; visible if it has a radius (RAD),
                               else hidden from the camera, with a radius of a 50th of its distance
    FOG                        left out, with a note

    leave_out_others   leaves out sections of other kinds and counts them in `notes`; otherwise the file is refused

    Raises ValueError with the line, OSError for an unreadable file.
    """
    with open(path, encoding="utf-8", errors="replace", opener=regular) as lines:
        return parse(lines, os.fspath(path), leave_out_others=leave_out_others)


def parse(lines: Iterable[str], name: str, *, leave_out_others: bool = False) -> TachyonScene:
    return _Reader(Words(lines, name), leave_out_others).read()


class _Reader:
    def __init__(self, words: Words, leaves_out_others: bool) -> None:
        self.words = words
        self.leaves_out_others = leaves_out_others
        self.left_out: dict[str, str] = {}
        self.others: Counter[str] = Counter()
        self.textures = Textures(words, self.left_out)
        self.background: Triple = (0.0, 0.0, 0.0)
        self.spheres: list[tuple[float, float, float, float]] = []
        self.sphere_materials: list[int] = []
        self.capsules: list[tuple[float, ...]] = []
        self.capsule_materials: list[int] = []
        self.planes: list[Plane] = []
        self.lights: list[Light] = []
        self.camera: dict[str, Triple] = {}
        self.vertical_fov: float | None = None
        self.vertical_extent: float | None = None

    def read(self) -> TachyonScene:
        self.words.expect("BEGIN_SCENE", "RESOLUTION")
        width, height = self.words.size("RESOLUTION"), self.words.size("RESOLUTION")
        self.aspect = width / height
        while (keyword := self.words.keyword("END_SCENE")) != "END_SCENE":
            self.section(keyword)
        if not self.camera:
            self.words.refuse("there is no CAMERA")
        balls = np.array(self.spheres, np.float64).reshape(-1, 4)
        capsules = np.array(self.capsules, np.float64).reshape(-1, 7)
        centers, ends = np.vstack([balls[:, :3], capsules[:, :3]]), np.vstack([balls[:, :3], capsules[:, 3:6]])
        radii = np.concatenate([balls[:, 3], capsules[:, 6]])
        position = self.camera["CENTER"]
        target = view_target(np.vstack([centers, ends]), np.tile(radii, 2), self.planes, position,
                             self.camera["VIEWDIR"])
        around = Surroundings(centers, ends, radii, self.planes, np.array(position), target)
        lamps, warnings = lamps_of(dimmed(self.lights, self.background), around)
        if any(self.background):
            lamps.append(Sphere(target, SKY_RADIUS * around.extent(self.lights), Material(emission=self.background)))
        arrays = []
        if self.spheres:
            arrays.append(SphereArray(balls[:, :3], balls[:, 3], np.array(self.sphere_materials, np.uint32)))
        if self.capsules:
            arrays.append(SphereArray(capsules[:, :3], capsules[:, 6], np.array(self.capsule_materials, np.uint32),
                                      end=capsules[:, 3:6]))
        scene = Scene(lamps, self.planes, arrays, materials=self.textures.materials)
        camera = Camera(position, target, self.camera["UPDIR"], self.vertical_fov,
                        vertical_extent=self.vertical_extent)
        notes = [*self.left_out.values(), *warnings]
        notes += [f"{count} x {keyword}, {OTHERS[keyword]}: left out" for keyword, count in self.others.items()]
        return TachyonScene(scene, camera, RenderSettings(width, height), notes)

    def section(self, keyword: str) -> None:
        words = self.words
        if keyword == "SPHERE":
            center = words.vector("CENTER")
            self.spheres.append((*center, words.named("RAD", positive=True)))
            self.sphere_materials.append(self.textures.reference())
        elif keyword == "FCYLINDER":
            self.chain([words.vector("BASE"), words.vector("APEX")])
        elif keyword == "POLYCYLINDER":
            words.expect("POINTS")
            self.chain([words.point("POINTS") for _ in range(words.size("POINTS"))])
        elif keyword == "RING":
            self.ring()
        elif keyword == "PLANE":
            point, normal = words.vector("CENTER"), words.direction("NORMAL")
            offset = -(normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2])
            self.planes.append(Plane(normal, offset, self.textures.reference()))
        elif keyword == "TEXDEF":
            self.textures.define()
        elif keyword == "TEXALIAS":
            self.textures.define_alias()
        elif keyword == "LIGHT":
            self.lights.append(self.light())
        elif keyword == "DIRECTIONAL_LIGHT":
            place, (x, y, z) = words.place(), words.direction("DIRECTION")
            words.expect("COLOR")
            self.lights.append(Light(place, words.color("COLOR"), (-x, -y, -z), is_directional=True))
        elif keyword == "CAMERA":
            self.read_camera()
        elif keyword == "BACKGROUND":
            self.background = words.color("BACKGROUND")
        elif keyword == "FOG":
            self.fog()
        elif keyword == "SHADER_MODE":
            while (word := words.keyword("END_SHADER_MODE")) != "END_SHADER_MODE":
                if word == "AMBIENT_OCCLUSION":
                    self.left_out[word] = f"{words.place()}: {word}: its light from all sides is left out"
        else:
            self.other(keyword)

    def chain(self, points: list[Triple]) -> None:
        radius, material = self.words.named("RAD", positive=True), self.textures.reference()
        ends = points[1:] or points
        self.capsules += [(*begin, *end, radius) for begin, end in zip(points, ends)]
        self.capsule_materials += [material] * len(ends)

    def fog(self) -> None:
        words = self.words
        place, kind = words.place(), words.keyword("the kind of fog")
        if kind not in ("LINEAR", "EXP", "EXP2", "OFF"):
            words.refuse(f'FOG "{kind}": must be LINEAR, EXP, EXP2 or OFF')
        for name in ("START", "END", "DENSITY"):
            words.named(name)
        words.expect("COLOR")
        words.color("COLOR")
        if kind != "OFF":
            self.left_out["FOG"] = f"{place}: FOG is left out, so far surfaces have their full colors"

    def ring(self) -> None:
        words = self.words
        center, _ = words.vector("CENTER"), words.direction("NORMAL")
        inner, outer = words.named("INNER"), words.named("OUTER")
        before = self.capsules[-1] if self.capsules else ()
        if inner == 0.0 and (*center, outer) in ((*before[:3], *before[6:]), before[3:]):
            self.textures.reference()
        else:
            self.other("RING")

    def other(self, keyword: str) -> None:
        if keyword not in OTHERS:
            self.words.refuse(f'"{keyword}": must be {", ".join(SECTIONS[:-1])} or {SECTIONS[-1]}')
        if not self.leaves_out_others:
            self.words.refuse(f"{keyword} is {OTHERS[keyword]}: only spheres, cylinders with ends, planes, lights and a camera "
                              "can be rendered. leave_out_others (pt-tachyon --leave-out-others) goes on without it")
        self.others[keyword] += 1
        while (word := (self.words.peek() or "").upper()) and word not in SECTIONS and word not in OTHERS:
            self.words.word(keyword)

    def light(self) -> Light:
        words = self.words
        place, center = words.place(), words.vector("CENTER")
        radius = words.named("RAD", least=0.0)
        attenuation = (1.0, 0.0, 0.0)
        if words.take_if("ATTENUATION"):
            attenuation = (words.named("CONSTANT", least=0.0), words.named("LINEAR", least=0.0),
                           words.named("QUADRATIC", least=0.0))
            if not any(attenuation):
                words.refuse("ATTENUATION: must not be 0 0 0")
        words.expect("COLOR")
        return Light(place, words.color("COLOR"), center, attenuation=attenuation, radius=radius)

    def read_camera(self) -> None:
        words = self.words
        if self.camera:
            words.refuse("there is a second CAMERA")
        projection = words.keyword("the projection") if words.take_if("PROJECTION") else "PERSPECTIVE"
        if projection == "PERSPECTIVE_DOF":
            if not words.take_if("FOCALDIST"):
                words.expect("FOCALLENGTH")
            words.number("the focus", positive=True)
            if words.named("APERTURE") != 0.0:
                self.left_out[projection] = f"{words.place()}: {projection}: depth of field is left out"
        elif projection not in ("PERSPECTIVE", "ORTHOGRAPHIC"):
            words.refuse(f'PROJECTION "{projection}": must be PERSPECTIVE, PERSPECTIVE_DOF or ORTHOGRAPHIC')
        height = 1.0 / words.named("ZOOM", positive=True)
        if words.named("ASPECTRATIO") != 1.0:
            words.refuse("ASPECTRATIO: must be 1, because pixels are square")
        words.named("ANTIALIASING")
        words.named("RAYDEPTH")
        self.camera = {"CENTER": words.vector("CENTER"), "VIEWDIR": words.direction("VIEWDIR"),
                       "UPDIR": words.direction("UPDIR")}
        if words.take_if("FRUSTUM"):
            height = self.frustum_height()
        words.expect("END_CAMERA")
        if projection == "ORTHOGRAPHIC":
            self.vertical_extent = height
        else:
            self.vertical_fov = 2.0 * math.atan(0.5 * height)

    def frustum_height(self) -> float:
        left, right, bottom, top = (self.words.number("FRUSTUM") for _ in range(4))
        height, width = top - bottom, right - left
        tolerance = 1e-4 * height
        if not (height > 0.0 and abs(width - self.aspect * height) <= self.aspect * tolerance and
                abs(left + right) <= tolerance and abs(bottom + top) <= tolerance):
            self.words.refuse("FRUSTUM: must be symmetric about the middle, with square pixels")
        return height
