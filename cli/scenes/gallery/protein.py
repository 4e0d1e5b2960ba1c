"""An antibody's arm that binds, of Debian's package freesasa, without its water, by ASE:

    python3 protein.py /usr/share/freesasa/test-data/1a0q.pdb && pt figure 1a0q.xyz --view right --box none -o protein.png
"""

import sys

from ase.data import vdw_radii
from ase.io import read

atoms = read(sys.argv[1])
atoms = atoms[atoms.arrays["residuenames"] != "HOH"]
atoms.set_array("radius", vdw_radii[atoms.numbers])
atoms.write("1a0q.xyz", columns=["symbols", "positions", "radius"])
