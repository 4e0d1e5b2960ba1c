"""An antibody's arm that binds, of Debian's package freesasa, without its water, by ASE:

    python3 protein.py /usr/share/freesasa/test-data/1a0q.pdb
    pt figure 1a0q.xyz --radius van-der-waals --view right --box none -o protein.png
"""

import sys

from ase.io import read

atoms = read(sys.argv[1])
atoms = atoms[[name.strip() != "HOH" for name in atoms.arrays["residuenames"]]]
atoms.write("1a0q.xyz", columns=["symbols", "positions"])
