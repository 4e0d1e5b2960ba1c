"""Files of particles: finds out the format of a file and its reader."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

from pt.figures._elements import listed
from pt.figures._errors import DataError
from pt.figures.readers import _other
from pt.figures.readers._frames import Frames, one_frame
from pt.figures.readers._lammps import LammpsDump
from pt.figures.readers._lines import Lines, ending
from pt.figures.readers._numpy import read_npy, read_npz
from pt.figures.readers._pcd import read_pcd
from pt.figures.readers._ply import read_ply
from pt.figures.readers._table import read_table
from pt.figures.readers._xyz import Xyz

FORMATS: Final[dict[str, Callable[[Lines], Frames]]] = {
    "lammps": LammpsDump, "xyz": Xyz, "npy": read_npy, "npz": read_npz,
    "ply": lambda lines: one_frame(lines.name, lambda: read_ply(lines)),
    "pcd": lambda lines: one_frame(lines.name, lambda: read_pcd(lines))}
"""Read by this package, by the name of their format, as "table" is."""

OTHERS: Final[dict[str, Callable[[str], Frames]]] = {
    "ase": _other.read_ase, "mdanalysis": _other.read_mdanalysis, "pyvista": _other.read_pyvista,
    "trimesh": _other.read_trimesh, "laspy": _other.read_laspy}
"""Other packages, by name, which read files by their own means."""

_FIRST_BYTES: Final = ((b"\x93NUMPY", "npy"), (b"PK\3\4", "npz"), (b"PK\5\6", "npz"), (b"ply\n", "ply"), (b"ply\r", "ply"),
                       (b"ITEM: ", "lammps"), (b"# .PCD", "pcd"), (b"VERSION ", "pcd"), (b"# vtk", "pyvista"),
                       (b"LASF", "laspy"))
_ENDINGS: Final = {".dump": "lammps", ".lammpstrj": "lammps", ".xyz": "xyz", ".extxyz": "xyz", ".ply": "ply",
                   ".pcd": "pcd", ".npy": "npy", ".npz": "npz",
                   **dict.fromkeys((".csv", ".tsv", ".txt", ".dat", ".asc", ".pts", ".xyzrgb", ".3d"), "table"),
                   **dict.fromkeys((".vtk", ".vtp", ".vtu", ".vti", ".vts", ".vtr", ".vtm", ".pvd"), "pyvista"),
                   **dict.fromkeys((".obj", ".stl", ".off", ".glb", ".gltf", ".3mf"), "trimesh"),
                   **dict.fromkeys((".las", ".laz"), "laspy"),
                   **dict.fromkeys((".mol2", ".pqr", ".pdbqt", ".mmtf", ".tpr", ".gsd"), "mdanalysis")}


def open_frames(path: str, format: str | None, mapping: Mapping[str, str]) -> Frames:
    """The frames of a file. mapping: as in read_table."""
    lines = Lines(path)
    format = format or _format_of(lines)
    if format == "table":
        return one_frame(lines.name, lambda: read_table(lines, mapping))
    if format in FORMATS:
        return FORMATS[format](lines)
    ours = ["table", *FORMATS]
    if format not in OTHERS:
        raise DataError(f"{lines.name}: format {format!r}: must be one of {listed([*ours, *OTHERS], 20)}")
    lines.close()
    if not lines.is_file:
        raise DataError(f"{lines.name}: {format} reads files: standard input must be one of {listed(ours)}")
    return OTHERS[format](path)


def _format_of(lines: Lines) -> str:
    """The format, by the first bytes, then by the name, then by what the first line looks like."""
    start = lines.peek(4096)
    for magic, format in _FIRST_BYTES:
        if start.startswith(magic):
            return format
    if not start:
        raise DataError(f"{lines.name}: is empty")
    name = ending(lines.path)
    first = start.split(b"\n", 1)[0].decode("utf-8", "replace").strip()
    if name in (".xyz", ".extxyz") and not first.isdecimal():
        return "table"  # points, without a line with their number
    if name in _ENDINGS:
        return _ENDINGS[name]
    if not lines.is_file or (name in ("", ".gz") and _is_table(start)):
        return "xyz" if first.isdecimal() and name != ".pts" else "table"
    return "ase"


def _is_table(start: bytes) -> bool:
    """Whether these bytes are text whose lines all have equally many words."""
    rows = [line.replace(b",", b" ").split() for line in start.split(b"\n")[:-1] if line[:1] != b"#"]
    return len(rows) > 1 and b"\0" not in start and len({len(row) for row in rows[1:]}) == 1
