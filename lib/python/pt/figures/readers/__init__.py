from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from typing import Final

from pt.figures._elements import listed
from pt.figures._errors import DataError
from pt.figures._particles import Table
from pt.figures.readers import _other
from pt.figures.readers._crystals import read_cif
from pt.figures.readers._frames import Frames, one_frame
from pt.figures.readers._gro import Gro
from pt.figures.readers._gsd import read_gsd
from pt.figures.readers._lammps import LammpsDump
from pt.figures.readers._lammps_data import CONTENT as LAMMPS_DATA, read_lammps_data
from pt.figures.readers._lines import Lines, ending
from pt.figures.readers._molecules import MOLECULES, TRAJECTORIES, read_molecules, read_trajectory
from pt.figures.readers._numpy import read_npy, read_npz
from pt.figures.readers._pcd import read_pcd
from pt.figures.readers._ply import read_ply
from pt.figures.readers._poscar import read_poscar
from pt.figures.readers._psf import read_psf
from pt.figures.readers._rows import is_number
from pt.figures.readers._structures import read_pdb
from pt.figures.readers._table import read_table
from pt.figures.readers._xyz import Xyz


def _one(read: Callable[[Lines], Table]) -> Callable[[Lines], Frames]:
    return lambda lines: one_frame(lines.name, lambda: read(lines))


def _molecules(format: str) -> Callable[[Lines], Frames]:
    return lambda lines: read_molecules(lines, format)


FORMATS: Final[dict[str, Callable[[Lines], Frames]]] = {
    "lammps": LammpsDump, "xyz": Xyz, "gro": Gro, "pdb": read_pdb,
    "pdbqt": lambda lines: read_pdb(lines, True), "cif": read_cif,
    **{format: _molecules(format) for format in MOLECULES}, "poscar": _one(read_poscar),
    "npy": read_npy, "npz": read_npz, "ply": _one(read_ply), "pcd": _one(read_pcd)}
"""Readers of lines or bytes, also for "table" and "lammps-data". Files may be packed, or standard input."""

OTHERS: Final[dict[str, Callable[[str], Frames]]] = {
    "gsd": read_gsd, "ase": _other.read_ase, "mdanalysis": _other.read_mdanalysis, "pyvista": _other.read_pyvista,
    "trimesh": _other.read_trimesh, "laspy": _other.read_laspy}
"""Readers that need a path. Keys are formats, or packages that read several formats."""

_FIRST_BYTES: Final = ((b"\x93NUMPY", "npy"), (b"PK\3\4", "npz"), (b"PK\5\6", "npz"), (b"ply\n", "ply"), (b"ply\r", "ply"),
                       (b"ITEM: ", "lammps"), (b"# .PCD", "pcd"), (b"VERSION ", "pcd"), (b"# vtk", "pyvista"),
                       (b"LASF", "laspy"), (b"\xdf\x85\xa8\x43", "gsd"))
_ENDINGS: Final = {".dump": "lammps", ".lammpstrj": "lammps", ".xyz": "xyz", ".extxyz": "xyz", ".ply": "ply",
                   ".pcd": "pcd", ".npy": "npy", ".npz": "npz", ".gro": "gro", ".pdb": "pdb",
                   ".ent": "pdb", ".pdbqt": "pdbqt", ".cif": "cif", ".mmcif": "cif", ".pdbx": "cif", ".sdf": "sdf",
                   ".sd": "sdf", ".mol": "sdf", ".mol2": "mol2", ".cml": "cml", ".poscar": "poscar", ".vasp": "poscar",
                   ".xsf": "ase", ".axsf": "ase", ".gsd": "gsd", ".xtc": "xtc", ".trr": "trr", ".dcd": "dcd", ".tng": "tng",
                   ".nc": "netcdf", ".ncdf": "netcdf", ".psf": "psf",
                   **dict.fromkeys((".csv", ".tsv", ".txt", ".dat", ".asc", ".pts", ".xyzrgb", ".3d"), "table"),
                   **dict.fromkeys((".vtk", ".vtp", ".vtu", ".vti", ".vts", ".vtr", ".vtm", ".pvd"), "pyvista"),
                   **dict.fromkeys((".obj", ".stl", ".off", ".glb", ".gltf", ".3mf"), "trimesh"),
                   **dict.fromkeys((".las", ".laz"), "laspy"),
                   **dict.fromkeys((".pqr", ".mmtf", ".tpr", ".prmtop", ".parm7"), "mdanalysis")}
_BOX: Final = re.compile(rb"(?m)^.*\b(xlo\s+xhi|avec)\b|^\s*\d+\s+atom types")
_UNKNOWN: Final = ""
_TEXTS: Final = ("table", "lammps-data", *FORMATS)


def open_frames(path: str, format: str | None, mapping: Mapping[str, str], topology: str | None = None,
                atom_style: str | None = None) -> Frames:
    lines = Lines(path)
    format = format or _format_of(lines)
    if format in TRAJECTORIES:
        return _trajectory(path, format, topology)
    if topology is not None:
        raise DataError(f"{lines.name}: topology = {topology}: only trajectories ({listed(list(TRAJECTORIES))}) take one")
    if atom_style is not None and format != "lammps-data":
        raise DataError(f"{lines.name}: atom_style = {atom_style}: only a LAMMPS data file has one")
    if format == "table":
        return one_frame(lines.name, lambda: read_table(lines, mapping))
    if format == "lammps-data":
        return one_frame(lines.name, lambda: read_lammps_data(lines, atom_style))
    if format in FORMATS:
        return FORMATS[format](lines)
    if format == "psf":
        raise DataError(f"{lines.name}: has no positions: give it as the topology of a trajectory")
    if format not in (*OTHERS, _UNKNOWN):
        raise DataError(f"{lines.name}: format {format!r}: must be one of {listed([*_TEXTS, *TRAJECTORIES, *OTHERS], 40)}")
    lines.close()
    if format == _UNKNOWN:
        return _other.read_unknown(path)
    if not lines.is_file:
        raise DataError(f"{lines.name}: {format} reads files: standard input must be one of {listed(list(_TEXTS), 40)}")
    return OTHERS[format](path)


def _trajectory(path: str, format: str, topology: str | None) -> Frames:
    if topology is None:
        raise DataError(f"{path}: has positions alone: topology must name a file that says what the atoms are, such as "
                        "PDB, GRO or PSF")
    lines = Lines(topology)
    kind = _format_of(lines)
    if OTHERS.get(kind) is _other.read_mdanalysis:
        return _other.read_mdanalysis(topology, path)
    if kind == "psf":
        return read_trajectory(path, format, lambda: read_psf(lines))
    frames = open_frames(topology, kind, {})
    return read_trajectory(path, format, lambda: frames.read(frames.current or 0))


def _format_of(lines: Lines) -> str:
    start = lines.peek(4096)
    for magic, format in _FIRST_BYTES:
        if start.startswith(magic):
            return format
    if not start:
        raise DataError(f"{lines.name}: is empty")
    name = ending(lines.path)
    first = start.split(b"\n", 1)[0].decode("utf-8", "replace").strip()
    if name in (".xyz", ".extxyz") and not first.isdecimal():
        return "table"
    known = _ENDINGS.get(name, "table")
    if known == "table" and (content := _of_content(start, lines)):
        return content
    if name in _ENDINGS:
        return known
    if not lines.is_file or (name in ("", ".gz") and _is_table(start)):
        return "xyz" if first.isdecimal() and name != ".pts" else "table"
    return _UNKNOWN


def _of_content(start: bytes, lines: Lines) -> str | None:
    if LAMMPS_DATA.search(start) and _BOX.search(start):
        return "lammps-data"
    is_record = re.match(rb"(HEADER|TITLE |REMARK|CRYST1|MODEL |ATOM  |HETATM)", start)
    if is_record and re.search(rb"(?m)^(ATOM  |HETATM)", lines.peek(1 << 20)):
        return "pdb"
    if re.match(rb"(#.*\n|\s)*data_\S", start):
        return "cif"
    is_named = re.match(r"(POSCAR|CONTCAR)", os.path.basename(lines.path))
    return "poscar" if is_named or _is_poscar(start.split(b"\n")[1:6]) else None


def _is_poscar(rows: list[bytes]) -> bool:
    words = [row.decode("utf-8", "replace").split() for row in rows]
    return ([len(row) for row in words[:4]] == [1, 3, 3, 3] and all(is_number(word) for row in words[:4] for word in row)
            and bool(words[4:] and words[4]) and all(re.fullmatch(r"[A-Z][a-z]?\S*|\d+", word) for word in words[4]))


def _is_table(start: bytes) -> bool:
    rows = [line.replace(b",", b" ").split() for line in start.split(b"\n")[:-1] if line[:1] != b"#"]
    return len(rows) > 1 and b"\0" not in start and len({len(row) for row in rows[1:]}) == 1
