from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from pt.figures._assembled import assembled
from pt.figures._elements import listed
from pt.figures._errors import DataError
from pt.figures._options import Columns
from pt.figures._particles import Particles
from pt.figures.readers import open_frames
from pt.figures.readers._frames import Frames, Listed, one_frame
from pt.figures.readers._numpy import frames_of_array, frames_of_arrays
from pt.figures.readers._objects import of_ase, of_mdanalysis, of_ovito

ROLES = ("x", "y", "z", "radius", "diameter", "element", "type", "red", "green", "blue")


def load(data: Any, *, frame: int | None = None, model_number: int | None = None, columns: Columns = None,
         format: str | None = None, topology: str | None = None, atom_style: str | None = None,
         drop_nonfinite: bool = False) -> Particles:
    """Returns the particles of one frame. Arrays of float32 and float64 are read in place. Raises DataError.

    data            name of a file, "-" for standard input; an array of shape (n, 3), (n, 2) or, with frames, (t, n, 3);
                    a dict of columns; a pandas or polars frame; ASE's Atoms or a list of them; an MDAnalysis universe or
                    group of atoms; an OVITO data collection; or Particles
    frame           index among frames with particles; negative numbers count from the end. None: the last frame, but
                    MDAnalysis' current frame, and the first of several models
    model_number    number of a model in a PDB or mmCIF file
    columns         names of columns, such as {"x": "lon", "y": "lat"} or "x=lon,y=lat", for
                    x, y, z, radius, diameter, element, type, red, green, blue
    format          format of a file, instead of the detected one
    topology        file with the atoms of a trajectory (XTC, TRR, DCD, ...)
    atom_style      of a LAMMPS data file, if it is neither stated nor clear from the columns
    drop_nonfinite  leaves out particles whose position or radius is not finite, which are refused otherwise
    """
    if isinstance(data, Particles):
        return data
    mapping = _mapping(columns)
    source = _opened(data, format, mapping, topology, atom_style)
    notes: list[str] = []
    if model_number is not None:
        frame = _of_model(source, model_number)
    elif frame is None and source.current is not None:
        frame = source.current
        if source.models is not None and source.count() > 1:
            notes.append(f"model {source.models[frame]} is shown of {source.count():,}: model_number chooses another")
    table = source.read(_index(source, -1 if frame is None else frame))
    table.notes += notes
    return assembled(source.name, table, mapping, drop_nonfinite)


def frames(data: Any, first: int = 0, last: int = -1, *, columns: Columns = None, format: str | None = None,
           topology: str | None = None, atom_style: str | None = None, drop_nonfinite: bool = False
           ) -> Iterator[Particles]:
    if isinstance(data, Particles):
        yield data
        return
    mapping = _mapping(columns)
    source = _opened(data, format, mapping, topology, atom_style)
    begin, end = _index(source, first), _index(source, last)
    if end < begin:
        raise DataError(f"{source.name}: frames {first} to {last}: the last one comes before the first one")
    for index in range(begin, end + 1):
        yield assembled(source.name, source.read(index), mapping, drop_nonfinite)


def _of_model(source: Frames, number: int) -> int:
    if source.models is None:
        raise DataError(f"{source.name}: model_number = {number}: these data have no models")
    if number not in source.models:
        raise DataError(f"{source.name}: model_number = {number}: must be one of "
                        f"{listed([str(each) for each in source.models], 20)}")
    return source.models.index(number)


def _index(source: Frames, frame: int) -> int:
    if frame >= 0 and source.has(frame):
        return frame
    count = source.count()
    if not -count <= frame < count:
        said = f"the data have {count} frames, from 0 or {-count} to {count - 1}"
        said = said if count else "the data have no frame with particles"
        raise DataError(f"{source.name}: frame {frame}: {said.replace('1 frames', '1 frame') if count == 1 else said}")
    return frame % count


def _mapping(columns: Columns) -> dict[str, str]:
    if isinstance(columns, str):
        pairs = [pair.partition("=")[::2] for pair in columns.split(",")]
        columns = {role.strip(): name.strip() for role, name in pairs}
    for role, name in (columns or {}).items():
        if role not in ROLES or not name:
            raise DataError(f"columns: {role}={name}: must be like x=pos_x, for one of {', '.join(ROLES)}")
    return dict(columns or {})


def _opened(data: Any, format: str | None, mapping: Mapping[str, str], topology: str | None, atom_style: str | None
            ) -> Frames:
    if isinstance(data, (str, os.PathLike)):
        return open_frames(os.fspath(data), format, mapping, topology, atom_style)
    package = type(data).__module__.partition(".")[0]
    name = f"{package}.{type(data).__name__}" if package not in ("builtins", "numpy") else "array"
    if package == "MDAnalysis":
        return of_mdanalysis(data, name)
    if package in ("ase", "ovito"):
        return one_frame(name, lambda: (of_ase if package == "ase" else of_ovito)(data))
    if package in ("pandas", "polars") and hasattr(data, "columns"):
        return frames_of_arrays(name, {str(key): data[key].to_numpy() for key in data.columns})
    if isinstance(data, Mapping):
        return frames_of_arrays("data", data)
    if isinstance(data, Sequence) and data and type(data[0]).__module__.startswith("ase."):
        return Listed(name, len(data), lambda index: of_ase(data[index]))
    return frames_of_array(name, np.asarray(data))
