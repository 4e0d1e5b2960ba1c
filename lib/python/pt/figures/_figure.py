from __future__ import annotations

import functools
import inspect
import math
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from typing import Any, Concatenate, Final, ParamSpec

import numpy as np
import numpy.typing as npt

from pt._camera import RenderSettings
from pt._context import Context
from pt._display import automatic_exposure, linear, to_pixels
from pt._enums import Quantity
from pt._exr import encode_exr
from pt._files import Path, format_of
from pt._film import TILE_SIDE
from pt._fit import Array, Doubles
from pt._image import Image
from pt._scene import Scene, SphereArray
from pt.figures._accept import load
from pt.figures._colors import Legend
from pt.figures._compose import compose, lay_over, smoothed
from pt.figures._drawn import LEAST_LENGTH, Drawn, prepare
from pt.figures._files import write_scene
from pt.figures._framing import narrow_note
from pt.figures._layout import Layout, View
from pt.figures._noise import Noise, squares_of, until_invisible
from pt.figures._options import Options, described
from pt.figures._overlay import FINE, INK, ROUGH, Overlaid, Shares, line_width, pixels_per_length, rays_per_side, read_shares
from pt.figures._particles import Particles
from pt.figures._picture import PAGES, Picture, background_of, strip_of
from pt.figures._rods import cell_edges
from pt.figures._stage import EDGES, SURROUND_BRIGHTNESS
from pt.figures._styles import styled

STEPPED: Final = ("soft", "illustrative")
LEAST_WIDTH: Final = 16


def view_of(drawn: Drawn, options: Options, turns: bool = False, grid: tuple[int, int] = (1, 1)) -> View:
    """`grid` has the columns and rows of panels, which share the size."""
    size = options.size
    if options.pixel_width is not None:
        size = _printed_size(drawn, options, turns, grid)
    if size is not None:
        strip = strip_of(drawn.legend, size[1], options)
        if strip + LEAST_WIDTH * grid[0] > size[0] and (strip or grid != (1, 1)):
            raise ValueError(f"size = {options.size}: has no room for particles beside the color bar")
        size = (size[0] - strip) // grid[0], size[1] // grid[1]
    if options.camera is not None:
        return View.through(options.camera, options.up, size or (1024, 768), drawn.scale)
    return View.of(drawn.balls, options.view, options.up, options.projection, size, turns)


def _printed_size(drawn: Drawn, options: Options, turns: bool, grid: tuple[int, int]) -> tuple[int, int]:
    assert options.pixel_width is not None
    shape = (1024, 768) if options.camera else View.of(drawn.balls, options.view, options.up, options.projection, None, turns).size
    height = 0
    for _ in range(4):
        strip = strip_of(drawn.legend, height, options) if height else 0
        height = max(round((options.pixel_width - strip) // grid[0] * shape[1] / shape[0]), LEAST_WIDTH) * grid[1]
    return options.pixel_width, height


@dataclass(frozen=True)
class Staged:
    drawn: Drawn
    layout: Layout
    options: Options

    @staticmethod
    def of(particles: Particles, options: Options) -> Staged:
        notes: list[str] = []
        options = styled(particles, options, notes)
        drawn = prepare(particles, options)
        drawn.notes.extend(notes)
        return Staged.seen(drawn, view_of(drawn, options), options)

    @staticmethod
    def seen(drawn: Drawn, view: View, options: Options) -> Staged:
        return Staged(drawn, Layout.of(view, view.reaches(drawn.balls), options.style, options.floor), options)

    @property
    def legend(self) -> Legend:
        return self.drawn.legend

    @functools.cached_property
    def notes(self) -> list[str]:
        pixels = pixels_per_length(self.layout.camera, self.layout.size[1], self.layout.distance)
        narrow = narrow_note(self.drawn.radii, pixels, self.layout.size, self.drawn.scale)
        return [*self.drawn.notes, *([narrow] if narrow else [])]

    @functools.cached_property
    def scene(self) -> Scene:
        return self._scene_of(self.drawn)

    def _scene_of(self, drawn: Drawn) -> Scene:
        stage = self.layout.stage
        material = self.options.material or stage.material
        colors: Array | None = drawn.colors
        if drawn.colors.ndim == 1:
            material = replace(material, diffuse=linear(drawn.colors / 255.0) * np.array(material.diffuse))
            colors = None
        arrays = [SphereArray(drawn.centers, drawn.radii, material, color=colors, opacity=drawn.opacities)]
        for each in (rods for rods in drawn.rods if len(rods.atoms)):
            arrays.append(SphereArray(drawn.begins(each), each.radius, material, end=drawn.ends(each),
                                      color=None if colors is None else colors[each.atoms],
                                      opacity=None if drawn.opacities is None else drawn.opacities[each.atoms]))
        if drawn.cell is not None:
            begins, ends = cell_edges(drawn.cell)
            pixels = pixels_per_length(self.layout.camera, self.layout.size[1], self.layout.distance)
            arrays.append(SphereArray(begins, 0.5 * line_width(self.layout.size) / pixels, EDGES, end=ends))
        return Scene(stage.lamps, [stage.floor] if stage.floor else [], arrays)

    def save_scene(self, path: Path) -> None:
        write_scene(path, self.scene, self.layout.camera, self.layout.size, self.options)

    def _with_look(self, context: Context, settings: RenderSettings, shares: Shares) -> Shares:
        layout, options = self.layout, self.options
        if options.style == "illustrative":
            context.set_render(settings)
            albedo = context.readback(Quantity.ALBEDO)
            around = np.max([np.roll(albedo, (k // 3 - 1, k % 3 - 1), (0, 1)) for k in range(9)], axis=0)
            shares = replace(shares, flat=albedo, ink=INK * around)
        if shares.depths is not None:
            near, deep = layout.distance - 0.5 * layout.deep, max(layout.deep, LEAST_LENGTH)
            fade = options.depth_cue * np.clip((shares.depths - near) / deep, 0.0, 1.0) * (shares.shapes > 0.0)
            shares = replace(shares, fade=fade)
        return shares

    def draw(self, context: Context) -> Figure:
        camera, scene, options = self.layout.camera, self.scene, self.options
        lamps, count = self.layout.stage.lamps, sum(map(len, scene.sphere_arrays))
        settings = RenderSettings(*self.layout.size, max_path_length=options.max_path_length, seed=options.seed)
        overlaid = Overlaid(len(lamps), count, self.drawn.all_radii, options.outlines, options.depth_cue > 0.0,
                            options.style in STEPPED, self.drawn.all_groups if options.style == "illustrative" else None)
        opacities, marks = self.drawn.opacities, self.drawn.marks
        solid = None
        if opacities is not None and (options.outlines or marks.words):
            solid = self._scene_of(replace(self.drawn, opacities=1.0 * (opacities >= 0.5)))
        context.set_scene(solid or scene)
        context.set_camera(camera)
        shares = read_shares(context, camera, settings, overlaid)
        context.set_render(settings)
        seen = marks.seen(camera, context.readback(Quantity.DEPTH)[:, :, 0]) if marks.words else np.zeros(0, bool)
        overlaid = replace(overlaid, outlines=False)
        if solid is not None:
            context.set_scene(scene)
        if opacities is not None or np.square(shares.error).sum() > ROUGH**2 * np.count_nonzero(shares.shapes):
            shares = replace(read_shares(context, camera, settings, overlaid, FINE), outlines=shares.outlines)
        shares = replace(shares, seen=seen)
        shares = self._with_look(context, settings, shares)
        stage: Any = SURROUND_BRIGHTNESS if len(lamps) > 1 else 1.0
        if options.stops_by_noise:
            show = functools.partial(_sixteen_bits, options, stage, shares)
            image = until_invisible(context, scene, camera, settings, show, shares.shapes > 0.0, options.progress)
        else:
            image = context.render(scene, camera, settings, options.most_samples, target_error=options.error or 0.0,
                                   progress=options.progress, denoise=options.denoise)
        per_side = rays_per_side(image.stats.mean_sample_count, settings.width * settings.height)
        if opacities is not None and per_side > FINE:
            fine = read_shares(context, camera, settings, overlaid, per_side)
            shares = replace(shares, shapes=fine.shapes, error=fine.error)
        if not shares.shapes.any():
            self.notes.append("the picture is blank: no ball is in view")
        if scene.planes:
            context.set_scene(Scene(lamps, scene.planes))
            context.set_render(settings)
            context.accumulate_tiles(image.sample_count[::TILE_SIDE, ::TILE_SIDE])
            stage = context.readback()
            shadow = smoothed(stage - image.radiance, image.standard_error, shares.shapes == 0.0)
            shares = replace(shares, floor=stage - shadow)
        return Figure(image, self, stage, shares)


class Figure(Picture, Image):
    """An Image whose picture also has a background, lines and words, which its radiance lacks.

    notes   choices made from the data, and parts that are not shown
    noise   None if the image is denoised
    """

    formats = (*PAGES, "exr", "npy")

    def __init__(self, image: Image, staged: Staged, stage: Any, shares: Shares) -> None:
        vars(self).update(vars(image))
        self.exposure = staged.options.exposure
        self.scene, self.camera = staged.scene, staged.layout.camera
        self.legend, self.notes = staged.drawn.legend, list(staged.notes)
        self._staged, self._stage, self._shares = staged, stage, shares
        self.figures = (self,)

    @functools.cached_property
    def noise(self) -> Noise | None:
        if self.raw is not None:
            return None
        if not np.isfinite(self.standard_error).all():
            return Noise(math.inf, 0.0, math.inf)
        show = functools.partial(_sixteen_bits, self._staged.options, self._stage, self._shares)
        squares = squares_of(show, self.radiance, self.standard_error) + squares_of(show, self.radiance, 0.0, 1.0)
        return Noise.of(squares[self._shares.shapes > 0.0])

    def _pixels(self, dtype: Any, exposure: float | None, background: Doubles | None, **display: Any) -> npt.NDArray[Any]:
        exposure = self.exposure if exposure is None else exposure
        exposure = automatic_exposure(self.radiance) if exposure is None else exposure
        return _pixels(self.radiance, self._stage, self._shares, exposure, background, dtype, **display)

    def __repr__(self) -> str:
        return super().__repr__()[:-1] + (f", {self.noise}>" if self.noise else ">")

    def encode(self, format: str, *, exposure: float | None = None, bits: int = 8) -> bytes:
        return encode_exr(self.radiance) if format == "exr" else super().encode(format, exposure=exposure, bits=bits)

    def save(self, path: Path, *, exposure: float | None = None, bits: int = 8) -> None:
        if format_of(path, self.formats) == "npy":
            Image.save(self, path)
        else:
            super().save(path, exposure=exposure, bits=bits)

    def save_scene(self, path: Path) -> None:
        """Writes a scene file for `pt render` and NPY files of the particles, without background, outlines, color bar and seed."""
        self._staged.save_scene(path)


def _pixels(radiance: Array, stage: Any, shares: Shares, exposure: float, background: Doubles | None, dtype: Any, **display: Any
            ) -> npt.NDArray[Any]:
    light, alpha = compose(radiance, stage, shares, exposure)
    if background is None:
        return to_pixels(light, 0.0, dtype, alpha=alpha, **display)
    return to_pixels(lay_over(light, alpha, linear(background)), 0.0, dtype, **display)


def _sixteen_bits(options: Options, stage: Any, shares: Shares, light: Array, radiance: Array, way: float
                  ) -> npt.NDArray[Any]:
    """Automatic exposure depends on `radiance`. Instead of a transparent background, white is shown."""
    shares = replace(shares, shapes=np.clip(shares.shapes + way * shares.error, 0.0, 1.0))
    exposure = automatic_exposure(radiance) if options.exposure is None else options.exposure
    background, _ = background_of(options)
    return _pixels(light, stage, shares, exposure, np.ones(3) if background is None else background, np.uint16)


def context_of(options: Options) -> AbstractContextManager[Context]:
    if options.context is None:
        return Context(options.device)
    return nullcontext(options.context)


P = ParamSpec("P")


def _with_keywords(make: Callable[P, Options]) -> Callable[Concatenate[Any, P], Figure]:
    def figure(data: Any, /, *args: P.args, **keywords: P.kwargs) -> Figure:
        options = make(*args, **keywords)
        axes = options.ax
        if axes is not None:
            box = axes.get_window_extent()
            options = replace(options, size=(round(box.width), round(box.height)), dpi=axes.figure.dpi)
        staged = Staged.of(load(data, frame=options.frame, model_number=options.model_number, **options.reading), options)
        with context_of(options) as context:
            result = staged.draw(context)
        if axes is not None:
            axes.imshow(result.to_srgb8(), aspect="auto")
            axes.set_axis_off()
        return result

    figure.__doc__ = f"""Renders particles. Camera, light, sizes and colors follow from the data unless options set them.

    data             name of a file, array of shape (n, 3), dict or frame of columns, or other data of load()
{described()}

    Raises ValueError for bad data or options, with name, value and rule.
    """
    first = inspect.Parameter("data", inspect.Parameter.POSITIONAL_ONLY, annotation=Any)
    keywords = inspect.signature(make)
    vars(figure)["__signature__"] = keywords.replace(parameters=[first, *keywords.parameters.values()], return_annotation=Figure)
    figure.__qualname__ = "figure"
    return figure


figure = _with_keywords(Options)
