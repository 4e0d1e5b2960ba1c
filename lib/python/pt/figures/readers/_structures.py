"""Macromolecules in PDB, PDBQT and mmCIF files, read by gemmi."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

from pt._fit import Array
from pt.figures._cell import Cell
from pt.figures._elements import SYMBOLS
from pt.figures._errors import DataError, module
from pt.figures._particles import Bonds, Table
from pt.figures._residues import AMINO_ACIDS, NUCLEOTIDES, VIRTUAL, autodock_element
from pt.figures.readers._atoms import atoms_table
from pt.figures.readers._frames import Listed
from pt.figures.readers._lines import Lines
from pt.figures.readers._other import tried

_ATOMS: Final = frozenset((b"ATOM  ", b"HETATM"))
_OTHERS: Final = frozenset((b"HEADER", b"EXPDTA", b"SSBOND", b"LINK  ", b"CONECT"))
_ELEMENT_AND_CHARGE: Final = re.compile(rb"( [A-Za-z]|[A-Za-z][A-Za-z]|[A-Za-z] )( *|[1-9][+-])")
_DEUTERIUM: Final = 119
PART: Final = 5000
_OTHER_PART: Final = "\x7f"


def read_pdb(lines: Lines, is_pdbqt: bool = False) -> Listed:
    """gemmi reads each model alone, because cells may differ and model numbers may repeat."""
    gemmi = module("gemmi", f"{lines.name}: PDB")
    rows = lines.text().replace(b"\r", b"").split(b"\n")
    others, models = _split(rows, _with_autodock_element if is_pdbqt else _with_element)
    if not models:
        raise DataError(f"{lines.name}: has no atoms: no line begins with ATOM or HETATM")

    def read(index: int) -> Table:
        text = b"\n".join([*others, *models[index][1]])
        return frames_of(lines.name, tried(lines.name, "gemmi", lambda: gemmi.read_pdb_string(text))).read(0)

    return Listed(lines.name, len(models), read, current=0, models=[number for number, _ in models])


def _split(lines: list[bytes], completed: Callable[[bytes], bytes]) -> tuple[list[bytes], list[tuple[int, list[bytes]]]]:
    others: list[bytes] = []
    models: list[tuple[int, list[bytes]]] = []
    number, cell, atoms = 1, b"", []
    whole: set[bytes] = set()
    for line in (*lines, b"END"):
        kind = line[:6]
        if kind in _ATOMS:
            if line[76:] not in whole:
                line = completed(line)
                whole.add(line[76:])
            atoms.append(line)
        elif kind == b"TER" or kind == b"TER   ":
            atoms.append(line)
        elif kind == b"CRYST1":
            cell = _in_columns(line)
        elif kind in _OTHERS:
            others.append(line)
        elif kind.rstrip() in (b"MODEL", b"ENDMDL", b"END"):
            if any(each[:6] in _ATOMS for each in atoms):
                models.append((number, [cell, *atoms]))
                number += 1
            atoms = []
            if kind.rstrip() == b"MODEL" and line[6:].strip().isdigit():
                number = int(line[6:])
    cells = [model[0] for _, model in models if model[0]]
    for _, model in models:
        model[0] = model[0] or next(iter(cells), b"")
    return others, models


def _in_columns(line: bytes) -> bytes:
    try:
        a, b, c, alpha, beta, gamma = map(float, line[6:].split()[:6])
        return f"CRYST1{a:9.3f}{b:9.3f}{c:9.3f}{alpha:7.2f}{beta:7.2f}{gamma:7.2f}".encode() + line.rstrip()[54:]
    except ValueError:
        return line


def _with_element(line: bytes) -> bytes:
    """Writes X for a missing element, so that gemmi does not guess it, and removes bad charges (columns 77 to 80)."""
    end = _ELEMENT_AND_CHARGE.match(line[76:80].ljust(2))
    return line[:76].ljust(76) + (b" X" if end is None else end[0])


def _with_autodock_element(line: bytes) -> bytes:
    number = autodock_element(line.split()[-1].decode("utf-8", "replace"))
    symbol = SYMBOLS[number] if 0 < number < VIRTUAL else "X"
    return line[:76].ljust(76) + f"{symbol:>2}".encode()


def frames_of(name: str, structure: Any) -> Listed:
    gemmi = module("gemmi", name)
    ends = np.cumsum([model.count_atom_sites() for model in structure])
    if not len(ends) or not ends[-1]:
        raise DataError(f"{name}: has no atoms")
    chains = _named_by_number(structure)
    flat = tried(name, "gemmi", lambda: _flat(structure))
    kept = [index for index, model in enumerate(structure) if model.count_atom_sites()]

    def read(index: int) -> Table:
        model = kept[index]
        return _table(structure, flat, chains, slice(int(ends[model - 1]) if model else 0, int(ends[model])))

    numbers = [getattr(structure[index], "num", index + 1) for index in kept]
    return Listed(name, len(kept), read, current=0, models=numbers)


def divide_chains(block: Any) -> None:
    """gemmi searches a chain's residues linearly, so long chains of mmCIF are divided into parts with different names."""
    gemmi = module("gemmi", block.name)
    chains = block.find_values("_atom_site.auth_asym_id") or block.find_values("_atom_site.label_asym_id")
    names: dict[str, str] = {}
    for start in range(PART, len(chains), 2 * PART):
        for row in range(start, min(start + PART, len(chains))):
            word = chains[row]
            if word not in names:
                names[word] = gemmi.cif.quote(gemmi.cif.as_string(word) + _OTHER_PART)
            chains[row] = names[word]


def _named_by_number(structure: Any) -> Array:
    """A FlatStructure requires short chain names."""
    chains = [chain for model in structure for chain in model]
    names = [chain.name.removesuffix(_OTHER_PART) for chain in chains]
    for number, chain in enumerate(chains):
        chain.name = str(number)
    each: Array = np.repeat(np.array(names, str), [chain.count_atom_sites() for chain in chains])
    return each


def _flat(structure: Any) -> Any:
    gemmi = module("gemmi", structure.name)
    try:
        return gemmi.FlatStructure(structure)
    except RuntimeError:
        for residue in (residue for model in structure for chain in model for residue in chain):
            residue.subchain = ""  # FlatStructure refuses long names, and figures do not show this name
        return gemmi.FlatStructure(structure)


def _table(structure: Any, flat: Any, chains: Array, rows: slice) -> Table:
    columns = {"name": _words(flat.atom_names[rows]), "resname": _words(flat.residue_names[rows]), "resid": flat.resnums[rows],
               "icode": _words(flat.icodes[rows, None]), "chain": chains[rows],
               "altloc": _words(flat.altlocs[rows, None]), "occupancy": flat.occ[rows], "b_factor": flat.b_iso[rows],
               "charge": flat.charge[rows], "id": flat.serials[rows]}
    elements, positions = np.where(flat.elements[rows] == _DEUTERIUM, 1, flat.elements[rows]), flat.pos[rows]
    notes: list[str] = []
    bonds = _bonds(structure, columns, notes)
    kept = _likeliest(columns)
    if not kept.all():
        notes.append(f"{int((~kept).sum()):,} atoms are not drawn: their alternative places have a higher occupancy")
    return atoms_table(np.ascontiguousarray(positions), {key: np.ascontiguousarray(values) for key, values in columns.items()},
                       elements, _cell(structure, columns["resname"]), bonds, notes, kept)


def _words(letters: Array) -> Array:
    rows = np.ascontiguousarray(letters).view(np.uint8)
    width = max(1, int((rows != 0).any(axis=0).sum()))
    packed = np.ascontiguousarray(rows[:, :width]).view(f"S{width}").reshape(-1)
    is_plain = rows.max(initial=0) < 128
    words: Array = np.char.strip(packed.astype(f"U{width}") if is_plain else np.char.decode(packed, "utf-8", "replace"))
    return words


def _likeliest(columns: dict[str, Array]) -> Array:
    kept = np.ones(len(columns["altloc"]), bool)
    alternatives: dict[tuple[Any, ...], dict[str, list[int]]] = {}
    for row in np.flatnonzero(columns["altloc"] != ""):
        residue = columns["chain"][row], columns["resid"][row], columns["icode"][row]
        alternatives.setdefault(residue, {}).setdefault(columns["altloc"][row], []).append(row)
    for places in alternatives.values():
        best = max(places, key=lambda label: float(columns["occupancy"][places[label]].mean()))
        for label, rows in places.items():
            kept[rows] = label == best
    return kept


def _cell(structure: Any, residues: Array) -> Cell | None:
    cell, group = structure.cell, structure.find_spacegroup()
    if not cell.is_crystal():
        return None
    lengths, angles = cell.parameters[:3], cell.parameters[3:]
    if lengths == (1, 1, 1) or min(lengths) <= 0:
        return None
    is_measured = "DIFFRACTION" in structure.info["_exptl.method"] if "_exptl.method" in structure.info else False
    is_crystal = is_measured or (group is not None and len(group.operations()) > 1)
    is_of_polymer = not (AMINO_ACIDS | NUCLEOTIDES).isdisjoint(np.unique(residues).tolist())
    return Cell.of_lengths(lengths, angles, is_crystal_of_macromolecule=bool(is_crystal and is_of_polymer))


def _bonds(structure: Any, columns: dict[str, Array], notes: list[str]) -> Bonds | None:
    pairs = [*_connections(structure, columns), *_conect(structure, columns["id"], notes)]
    return Bonds.of(pairs, is_complete=False) if pairs else None


def _connections(structure: Any, columns: dict[str, Array]) -> Iterator[tuple[int, int]]:
    """Reads bonds within the asymmetric unit, except hydrogen bonds, from struct_conn, or from LINK and SSBOND."""
    gemmi = module("gemmi", structure.name)
    wanted = [each for each in structure.connections if each.type != gemmi.ConnectionType.Hydrog and each.asu != gemmi.Asu.Different]
    if not wanted:
        return
    keys = zip(*(columns[key].tolist() for key in ("chain", "resid", "icode", "name", "altloc")))
    index = {key: row for row, key in enumerate(keys)}
    for each in wanted:
        ends = [index.get((end.chain_name, end.res_id.seqid.num, end.res_id.seqid.icode.strip(), end.atom_name,
                           end.altloc.strip("\0 "))) for end in (each.partner1, each.partner2)]
        if ends[0] is not None and ends[1] is not None and ends[0] != ends[1]:
            yield ends[0], ends[1]


def _conect(structure: Any, serials: Array, notes: list[str]) -> Iterator[tuple[int, int]]:
    table = structure.conect_map
    if not table:
        return
    numbers, rows, counts = np.unique(serials, return_index=True, return_counts=True)
    index = dict(zip(numbers[counts == 1].tolist(), rows[counts == 1].tolist()))
    ambiguous = set(numbers[counts > 1].tolist())
    if lost := sum(serial in ambiguous or not ambiguous.isdisjoint(others) for serial, others in table.items()):
        notes.append(f"{lost:,} lines of CONECT are not used: two atoms have the same number")
    for serial, others in table.items():
        for other in others:
            if serial in index and other in index and serial != other:
                yield index[serial], index[other]
