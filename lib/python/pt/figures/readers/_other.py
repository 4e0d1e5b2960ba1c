from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Callable
from typing import Any, Final

import numpy as np

from pt.figures._errors import DataError, module
from pt.figures._particles import Table
from pt.figures.readers._frames import Frames, Listed, one_frame
from pt.figures.readers._objects import of_ase, of_mdanalysis

_CENTRED: Final = ("dlp4", "dlp-history")  # ASE's names of DL_POLY's formats, whose cells are centered at 0
_UNKNOWN: Final = "neither its name nor its first lines say the format"


def read_ase(path: str, asked: str = "ASE", purpose: str = "this format") -> Frames:
    read = module("ase.io", f"{path}: {purpose}").read
    images = tried(path, asked, lambda: read(path, index=":"))
    if not images:
        raise DataError(f"{path}: {asked} finds no atoms in it")
    kind = tried(path, asked, lambda: module("ase.io.formats", path).filetype(path))

    def read_image(index: int) -> Table:
        table = of_ase(images[index])
        if kind in _CENTRED and table.cell is not None:
            table.cell = dataclasses.replace(table.cell, origin=-0.5 * table.cell.vectors.sum(axis=0))
        return table

    return Listed(path, len(images), read_image)


def read_unknown(path: str) -> Frames:
    return read_ase(path, f"{_UNKNOWN}, and ASE", f"{_UNKNOWN}; trying others")


def read_mdanalysis(path: str, *trajectory: str) -> Frames:
    mdanalysis = module("MDAnalysis", f"{path}: this format")
    return of_mdanalysis(tried(path, "MDAnalysis", lambda: mdanalysis.Universe(path, *trajectory)), path)


def read_pyvista(path: str) -> Frames:
    pyvista = module("pyvista", f"{path}: this format")
    mesh = tried(path, "pyvista", lambda: pyvista.read(path))
    while hasattr(mesh, "combine") and not hasattr(mesh, "points"):
        mesh = mesh.combine()
    columns = {key: np.asarray(mesh.point_data[key]) for key in mesh.point_data.keys()}
    faces = 0 if mesh.n_cells == mesh.n_points else mesh.n_cells
    return one_frame(path, lambda: _points(mesh.points, columns, faces))


def read_trimesh(path: str) -> Frames:
    trimesh = module("trimesh", f"{path}: this format")
    mesh = tried(path, "trimesh", lambda: trimesh.load(path, process=False))
    if hasattr(mesh, "to_mesh"):
        mesh = mesh.to_mesh()
    colors = getattr(getattr(mesh, "visual", None), "vertex_colors", getattr(mesh, "colors", None))
    columns = {} if colors is None or np.shape(colors)[:1] != np.shape(mesh.vertices)[:1] else {"colors": colors}
    return one_frame(path, lambda: _points(mesh.vertices, columns, len(getattr(mesh, "faces", ()))))


def read_laspy(path: str) -> Frames:
    laspy = module("laspy", f"{path}: this format")
    las = tried(path, "laspy", lambda: laspy.read(path))
    names = [name for name in las.point_format.dimension_names if name not in ("X", "Y", "Z")]
    columns = {name: np.asarray(las[name]) for name in names}
    if "red" in columns and max(columns[key].max(initial=0) for key in ("red", "green", "blue")) <= 255:
        columns.update((key, columns[key].astype(np.uint8)) for key in ("red", "green", "blue"))
    return one_frame(path, lambda: _points(las.xyz, columns, 0))


def _points(positions: Any, columns: dict[str, Any], faces: int) -> Table:
    notes = [f"the {faces:,} faces of the mesh are not drawn: only its vertices are"] if faces else []
    return Table({"positions": np.asarray(positions), **columns}, notes=notes)


def tried(path: str, package: str, read: Callable[[], Any]) -> Any:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return read()
    except (DataError, KeyboardInterrupt, SystemExit, MemoryError):
        raise
    except BaseException as error:  # packages have their own exceptions, and chemfiles' do not derive from Exception
        words = " ".join(str(error).split()) or type(error).__name__
        raise DataError(f"{path}: {package} cannot read it: {words}") from error
