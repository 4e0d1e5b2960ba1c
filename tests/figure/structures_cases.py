import gzip


def atom(name, residue, x, element="", number=1):
    """A line of a PDB file. Names fill columns 13 to 16 exactly."""
    return f"ATOM  {number:5} {name:<4} {residue:>3} A   1    {x:8.3f}{0:8.3f}{0:8.3f}{1:6.2f}{0:6.2f}          {element:>2}\n"


def gro(*atoms, box="1 1 1"):
    rows = "".join(f"{i:5}{residue:<5}{name:>5}{i:5}{x:8.3f}{0:8.3f}{0:8.3f}\n" for i, (residue, name, x) in enumerate(atoms, 1))
    return f"title\n{len(atoms)}\n{rows}{box}\n"


def cif(sites, symmetry="_space_group_name_H-M_alt 'P 1'", cell=(4, 4, 4, 90, 90, 90), columns=()):
    keys = ("label", "type_symbol", "fract_x", "fract_y", "fract_z", *columns)
    lengths = zip(("length_a", "length_b", "length_c", "angle_alpha", "angle_beta", "angle_gamma"), cell)
    return "\n".join(["data_a", *(f"_cell_{key} {value}" for key, value in lengths), symmetry, "loop_",
                      *(f"_atom_site_{key}" for key in keys), *sites, ""])


def loop(category, keys, *rows):
    return "\n".join(["loop_", *(f"_{category}.{key}" for key in keys.split()), *rows, ""])


MMCIF = "data_x\n" + loop(
    "atom_site", """group_PDB id type_symbol label_atom_id label_alt_id label_comp_id label_asym_id label_entity_id label_seq_id
    Cartn_x Cartn_y Cartn_z occupancy auth_seq_id auth_asym_id pdbx_PDB_model_num""",
    "ATOM 1 C CA . ALA A 1 1 0 0 0 1 7 Q 3", "ATOM 2 S SG . CYS A 1 2 5 0 0 1 8 Q 3", "ATOM 3 S SG . CYS B 1 2 7 0 0 1 9 R 3",
    "ATOM 4 C CA . ALA A 1 1 1 0 0 1 7 Q 5") + loop(
    "struct_conn", "id conn_type_id " + " ".join(f"ptnr{end}_{key}" for end in (1, 2) for key in (
        "label_asym_id", "label_comp_id", "label_seq_id", "label_atom_id", "auth_asym_id", "auth_seq_id")),
    "disulf1 disulf A CYS 2 SG Q 8 B CYS 2 SG R 9")

LAMMPS = "made up\n\n{atoms} atoms\n{types} atom types\n{more}\n-1 3 xlo xhi\n-2 2 ylo yhi\n0 5 zlo zhi\n{masses}\nAtoms{hint}\n\n{rows}\n"


def lammps(*rows, types=2, more="", masses="", hint=""):
    return LAMMPS.format(atoms=len(rows), types=types, more=more, masses=masses, hint=hint, rows="\n".join(rows))


MASSES = "\nMasses\n\n1 15.9994\n2 1.008\n"
POSCAR = "made up\n{scale}\n2 0 0\n0 3 0\n0 0 4\n{rest}\n"
SDF = """water
  made up

  3  2  0  0  0  0  0  0  0  0999 V2000
    0.0000    0.0000    0.0000 O   0  0
    0.9600    0.0000    0.0000 H   0  0
    9.0000    0.9300    0.0000 H   0  0
  1  2  1  0
  1  3  1  0
M  END
$$$$
"""
MOL2 = """@<TRIPOS>MOLECULE
made up
 3 2 1 0 0
SMALL
NO_CHARGES

@<TRIPOS>ATOM
 1 C1 0 0 0 C.ar 1 LIG 0
 2 CL1 1.7 0 0 Cl 1 LIG 0
 3 H1 -1 0 0 h1 1 LIG 0
@<TRIPOS>BOND
 1 1 2 ar
 2 1 3 1
"""
CML = """<?xml version="1.0"?><molecule xmlns="http://www.xml-cml.org/schema"><atomArray>
<atom id="a1" elementType="C" x3="0" y3="0" z3="0"/><atom id="a2" elementType="Br" x3="1.9" y3="0" z3="0"/></atomArray>
<bondArray><bond atomRefs2="a1 a2" order="1"/></bondArray></molecule>
"""

# Rows: name, text, elements or types, and further content (places along x, lengths of the cell, origin, bonds, and
# words of a note).
CASES = (
    ("names.pdb", atom(" CA", "ALA", 0) + atom("HG11", "VAL", 1) + atom("1HB", "ALA", 2) + atom(" SD", "MET", 3) +
     atom("CA", "CA", 4) + atom("ZN", "ZN", 5), "C H H S Ca Zn", {"note": "guessed from the names of residues and atoms: CA of ALA is C"}),
    ("sodium.pdb", atom("NA", "NA", 0) + atom(" CL", "CL", 1) + atom("SOD", "SOD", 2) + atom(" NA", "HEM", 3), "Na Cl Na N", {}),
    ("sites.pdb", atom(" OH2", "TP4", 0) + atom(" MW", "SOL", 1) + atom("EPW", "WAT", 2) + atom(" H1", "TP4", 3), "O H",
     {"x": [0, 3], "note": "2 virtual sites of 4"}),
    ("selenium.pdb", atom("SE", "MSE", 0) + atom(" CE", "MSE", 1), "Se C", {}),
    ("old.pdb", atom(" CA", "ALA", 0).rstrip()[:66].ljust(72) + "1CRN  70\n", "C", {}),
    ("charge.pdb", atom(" CA", "ALA", 0, "C").rstrip("\n") + "01\n", "C", {}),
    ("short.pdb", atom(" CA", "ALA", 2)[:54] + "\n", "C", {"x": [2]}),
    ("models.pdb", "MODEL        7\n" + atom(" CA", "ALA", 0, "C") + "ENDMDL\nMODEL        7\n" + atom(" CA", "ALA", 9, "C") + "ENDMDL\n",
     "C", {"x": [0], "note": "model 7 is shown of 2"}),
    ("ends.pdb", atom(" CA", "ALA", 0, "C") + "END\n" + atom(" CA", "ALA", 9, "C") + "END\n", "C", {"x": [0], "note": "of 2"}),
    ("cell.pdb", "CRYST1    1.000    1.000    1.000  90.00  90.00  90.00 P 1           1\n" + atom(" CA", "ALA", 0, "C"), "C", {"cell": None}),
    ("moved.pdb", "CRYST1 80.000   81.000   82.000  90.00  90.00  90.00\n" + atom(" CA", "ALA", 0, "C"), "C", {"cell": [80, 81, 82]}),
    ("bonds.pdb", atom(" C1", "LIG", 0, "C", 1) + atom(" C2", "LIG", 5, "C", 2) + "CONECT    1    2\nCONECT    2    1\n", "C C",
     {"bonds": [[0, 1]]}),
    ("docked.pdbqt", "".join(atom(name, "LIG", i).rstrip("\n")[:77].ljust(77) + kind + "\n" for i, (name, kind) in enumerate(
        (("O1", "OA"), ("H1", "HD"), ("C1", "A "), ("N1", "NA"), ("CL1", "Cl")))), "O H C N Cl", {}),
    ("a.mmcif", MMCIF, "C S S", {"note": "model 3 is shown of 2", "bonds": [[1, 2]]}),
    ("content.txt", atom(" CA", "ALA", 3, "C"), "C", {"x": [3]}),

    ("salt.cif", cif(["Na1 Na+ 0 0 0", "Cl1 Cl- 0.5 0.5 0.5"], "_symmetry_space_group_name_H-M 'F m -3 m'"), "Na Na Na Na Cl Cl Cl Cl",
     {"cell": [4, 4, 4]}),
    ("hall.cif", cif(["Na1 Na 0.1 0.2 0.3"], "_space_group_name_Hall '-P 1'"), "Na Na", {"x": [0.4, 3.6]}),
    ("operations.cif", cif(["Na1 Na 0.1 0.2 0.3"], "loop_\n_symmetry_equiv_pos_as_xyz\n'x,y,z'\n'-x,y+1/2,-z+1/2'"), "Na Na", {"x": [0.4, 3.6]}),
    ("setting.cif", cif(["C1 C 0.1 0.2 0.3"], "_symmetry_space_group_name_H-M 'P 1 21/n 1'", (4, 5, 6, 90, 100, 90)), "C C C C", {}),
    ("rhombohedral.cif", cif(["Bi1 Bi 0.234 0.234 0.234"], "_symmetry_space_group_name_H-M 'R -3 m :R'", (4.7, 4.7, 4.7, 57, 57, 57)), "Bi Bi", {}),
    ("disorder.cif", cif(["C1 C 0 0 0 0.4 1", "C2 C 0.2 0 0 0.6 2"], columns=("occupancy", "disorder_group")), "C",
     {"x": [0.8], "note": "1 sites of other disorder groups than 2"}),
    ("nowhere.cif", cif(["C1 C 0 0 0", "H1 H ? ? ?"]), "C", {"note": "1 sites without a position"}),
    ("water.cif", cif(["Wat ? 0 0 0", "D1 D 0.2 0 0"]), "O H", {}),
    ("blocks.cif", cif(["C1 C 0 0 0"]) + cif(["N1 N 0 0 0"]).replace("data_a", "data_b"), "C", {"note": "structure 0 of 2 is shown, a"}),

    ("ions.gro", gro(("NA", "NA", 0), ("CL", "CL", 0.1), ("ALA", "CA", 0.2), ("CA", "CA", 0.3), ("ION", "SOD", 0.4)), "Na Cl C Ca Na",
     {"x": [0, 1, 2, 3, 4], "cell": [10, 10, 10]}),
    ("beads.gro", gro(("ALA", "BB", 0), ("LYS", "BB", 0.4), ("LYS", "SC1", 0.8), ("W", "W", 1.2)), ["BB", "BB", "SC1", "W"],
     {"note": "beads (MARTINI)"}),
    ("flat.gro", gro(("SOL", "OW", 0), box="1 2 0"), "O", {"cell": [10, 20, 0]}),

    ("masses.data", lammps("1 1 0 0 0", "2 2 1 0 0", masses=MASSES, hint=" # atomic"), "O H",
     {"cell": [4, 4, 5], "origin": [-1, -2, 0], "note": "type 1 is O, 2 is H"}),
    ("types.data", lammps("1 1 0 0 0", "2 2 1 0 0", hint=" # atomic"), [1, 2], {}),
    ("lj.data", lammps("1 1 0 0 0", "2 2 1 0 0", masses="\nMasses\n\n1 1.0\n2 1.0\n", hint=" # atomic"), [1, 2], {}),
    ("data.peptide", lammps("1 1 1 -0.8 0 0 0", "2 1 2 0.4 1 0 0", more="1 bonds\n1 bond types", masses=MASSES) + "\nBonds\n\n1 1 1 2\n", "O H",
     {"bonds": [[0, 1]], "note": "taken to be full"}),
    ("unbonded.data", lammps("1 1 0 0 0", types=1, more="1 bonds", hint=" # atomic"), [1],
     {"note": "the header has 1 bonds, but there is no section Bonds"}),
    ("images.data", lammps("1 1 0 0 0 0 0 0", "2 2 1 0 0 1 0 0", masses=MASSES), "O H", {"x": [0, 1], "note": "taken to be atomic"}),
    ("charge.data", lammps("1 1 -0.8 0 0 0", "2 2 0.4 1 0 0", masses=MASSES), "O H", {"note": "taken to be charge"}),
    ("sphere.data", lammps("1 1 2.0 1.0 0 0 0", "2 1 1.0 1.0 1 0 0", types=1, hint=" # sphere"), [1, 1], {"radii": [1, 0.5]}),
    ("ellipsoids.data", lammps("2 1 1 1 0 0 0", "1 1 1 1 1 0 0", types=1, more="2 ellipsoids", hint=" # ellipsoid") +
     "\nEllipsoids\n\n1 3 2 1 1 0 0 0\n2 5 5 5 1 0 0 0\n", [1, 1], {"radii": [2.5, 1], "note": "2 ellipsoids are drawn as balls"}),
    ("united.data", lammps("1 1 0 0 0", "2 2 1 0 0", masses="\nMasses\n\n1 15.035\n2 14.027\n", hint=" # atomic"), "C C", {}),
    ("tilted.data", lammps("1 1 0 0 0", types=1, more="1 0 0 xy xz yz"), [1], {"cell": [4, 17**0.5, 5]}),

    ("POSCAR", POSCAR.format(scale=2, rest="Na Cl\n1 2\nDirect\n0 0 0\n0.5 0 0\n0.25 0 0 Cl"), "Na Cl Cl", {"x": [0, 2, 1], "cell": [4, 6, 8]}),
    ("old.vasp", POSCAR.format(scale=1, rest="1 1\nSelective dynamics\nCartesian\n1 0 0 T T F\n0 0 0 T T T").replace("made up", "Fe O"),
     "Fe O", {"x": [1, 0]}),
    ("volume.vasp", POSCAR.format(scale=-192, rest="Si_pv\n1\nd\n0.5 0 0"), "Si", {"cell": [4, 6, 8], "x": [2]}),
    ("unnamed", POSCAR.format(scale=1.0, rest="  C\n  1\nDirect\n 0.5 0 0"), "C", {"x": [1]}),

    ("two.sdf", SDF + SDF.replace(" 9.0000", " 8.0000"), "O H H", {"x": [0, 0.96, 9], "note": "molecule 0 of 2 is shown"}),
    ("ligand.mol2", MOL2, "C Cl H", {"bonds": [[0, 1], [0, 2]]}),
    ("a.cml", CML, "C Br", {"bonds": [[0, 1]]}),

    ("flat.xyz", '1\nLattice="0 4 0 4 0 0 0 0 0" pbc="T T T"\nSi 1 0 0\n', "Si", {"cell": [4, 4, 0], "periodic": [True, True, False]}),
    ("mixture.xyz", "2\n\nA 0 0 0\nB 1 0 0\n", ["A", "B"], {}),
    ("ellipsoids.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
     "ITEM: ATOMS id type x y z shapex shapey shapez diameter\n1 1 0 0 0 3 2 1 0\n2 1 1 0 0 0 0 0 5\n3 1 2 0 0 0 0 0 0\n", [1, 1],
     {"radii": [1, 2.5], "note": "1 of 3 particles are left out: their radius is 0"}))

REFUSED = (
    ("a.gro", "title\n2\n    1SOL     OW    1   0.100   0.200   0.300\n", "a.gro:3: the file ends after 1 of 2 particles"),
    ("a.gro", "title\n1\n    1SOL     OW    1   0.1x0   0.200   0.300\n1 1 1\n", "a.gro:3: x = '0.1x0': must be a number of 8 columns"),
    ("a.gro", "title\nx\n", "a.gro:2: 'x': must be the number of atoms"),
    ("a.pdb", "HEADER    NOTHING\n", "a.pdb: has no atoms: no line begins with ATOM or HETATM"),
    ("a.cif", "data_a\n_cell_length_a 1\n", "a.cif: has no atoms: no data block has"),
    ("a.data", lammps("1 1 0 0 0", "2 2 1 0 z", masses=MASSES, hint=" # atomic"), "a.data:18: z = 'z': must be a number"),
    ("a.data", lammps("1 1 2.0 1.0 5 6 7 8.5", types=1), "a.data:12: the atom style is not known: 8 columns"),
    ("a.data", lammps("1 1 0 0 0", types=1, hint=" # full"), "a.data:12: '1 1 0 0 0': has 5 columns; atom_style full has 7"),
    ("a.data", lammps("1 1 0 0 0", types=1, more="1 bonds") + "\nBonds\n\n1 1 1 9\n", "a.data: Bonds: atom 9: must be the number of an atom"),
    ("POSCAR", POSCAR.format(scale=1, rest="C\n2\nDirect\n0 0 0"), "POSCAR:9: the file ends after 1 of 2 particles"),
    ("a.psf", "PSF\n", "a.psf: has no positions: give it as the topology of a trajectory"),
    ("a.xtc", b"\0\0\7\xcb", "a.xtc: has positions alone: topology must name a file"),
    ("a.xyz", b"1" * (1 << 25), "a.xyz:1: the line is longer than 16,777,216 bytes: this is no text"),
    ("a.csv.gz", gzip.compress(b"1" * (1 << 25)), "a.csv.gz:1: the line is longer than 16,777,216 bytes: this is no text"),
    ("a.xyz", "2\n\nO 0 0 0\nO 1 0 0\nO 2 0 0\n", "a.xyz:5: 'O 2 0 0': must be the number of particles"),
    ("a.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n",
     "a.dump: frame -1: the data have no frame with particles"),
    ("a.dump", "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id xs ys zs\n1 0.5 1e999 0.5\n",
     "a.dump: particle 1 of 1: x = nan, y = inf, z = nan: must be finite"))
