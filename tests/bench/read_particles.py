"""Measures how fast files of particles are read: MB of the file, unpacked, a CPU second, and peak memory.

    python3 tests/bench/read_particles.py --program build/bin/pt_read_particles

Makes a file of each format of the same random particles, by a fixed seed, reads each several times in turn, and prints
the least CPU time (user and system, of the whole reading), as whatever else runs on the machine only ever adds to it.
Files are warm. Needs NumPy, and the programs gzip and zstd.
"""

import argparse
import os
import subprocess
import tempfile

import numpy as np

from table import print_table

SEED = 1
EDGE = 100.0
SYMBOLS = np.array(["H", "O", "Si"])
RECORD = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("charge", "f4")]


class Cloud:
    def __init__(self, count):
        random = np.random.default_rng(SEED)
        self.count = count
        self.positions = random.random((count, 3)) * EDGE
        self.types = random.integers(1, len(SYMBOLS) + 1, count)
        self.charges = random.normal(size=count)

    def rows(self, form, *columns):
        """Text, a line a particle."""
        return "".join(map((form + "\n").__mod__, zip(*(column.tolist() for column in columns))))

    def numbers(self, form):
        return self.rows(form, *self.positions.T, self.charges)

    def records(self):
        table = np.empty(self.count, RECORD)
        for (name, _), column in zip(RECORD, (*self.positions.T, self.charges)):
            table[name] = column
        return table


def write_dump(cloud, file):
    bounds = f"0 {EDGE:g}\n" * 3
    file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{cloud.count}\nITEM: BOX BOUNDS pp pp pp\n{bounds}"
               "ITEM: ATOMS id type x y z charge\n".encode())
    ids = np.arange(1, cloud.count + 1)
    file.write(cloud.rows("%d %d %.6g %.6g %.6g %.6g", ids, cloud.types, *cloud.positions.T, cloud.charges).encode())


def write_xyz(cloud, file):
    file.write(f"{cloud.count}\n\n".encode())
    file.write(cloud.rows("%s %.6f %.6f %.6f", SYMBOLS[cloud.types - 1], *cloud.positions.T).encode())


def write_extended_xyz(cloud, file):
    file.write(f"{cloud.count}\nProperties=species:S:1:pos:R:3:charge:R:1\n".encode())
    symbols = SYMBOLS[cloud.types - 1]
    file.write(cloud.rows("%-2s %16.8f %16.8f %16.8f %16.8f", symbols, *cloud.positions.T, cloud.charges).encode())


def write_csv(cloud, file):
    file.write(b"x,y,z,charge\n" + cloud.numbers("%r,%r,%r,%r").encode())


def ply_head(cloud, form):
    properties = "".join(f"property float {name}\n" for name, _ in RECORD)
    return f"ply\nformat {form} 1.0\nelement vertex {cloud.count}\n{properties}end_header\n".encode()


def write_text_ply(cloud, file):
    file.write(ply_head(cloud, "ascii") + cloud.numbers("%.7g %.7g %.7g %.7g").encode())


def write_binary_ply(cloud, file):
    file.write(ply_head(cloud, "binary_little_endian") + cloud.records().tobytes())


def write_npy(cloud, file):
    np.save(file, cloud.records())


def write_npz(cloud, file):
    np.savez_compressed(file, positions=cloud.positions.astype("f4"), charge=cloud.charges.astype("f4"))


WRITERS = {"LAMMPS dump": ("cloud.dump", write_dump), "XYZ": ("cloud.xyz", write_xyz),
           "extended XYZ": ("cloud.extxyz", write_extended_xyz), "CSV": ("cloud.csv", write_csv),
           "PLY, text": ("text.ply", write_text_ply), "PLY, binary": ("binary.ply", write_binary_ply),
           "NPY": ("cloud.npy", write_npy), "NPZ, deflated": ("cloud.npz", write_npz)}
PACKERS = {"gzip": (["gzip", "-k", "-6"], ".gz"), "zstd": (["zstd", "-k", "-q", "-3"], ".zst")}


def make_files(cloud, folder):
    """Paths by name, each with its size when unpacked."""
    files = {}
    for name, (file_name, write) in WRITERS.items():
        path = os.path.join(folder, file_name)
        with open(path, "wb") as file:
            write(cloud, file)
        files[name] = (path, os.path.getsize(path))
    path, size = files["LAMMPS dump"]
    for name, (command, suffix) in PACKERS.items():
        subprocess.run([*command, path], check=True)
        files[f"LAMMPS dump, {name}"] = (path + suffix, size)
    return files


def read(program, name, path):
    columns = [] if name == "XYZ" else ["charge"]
    output = subprocess.run([program, path, *columns], check=True, capture_output=True, text=True).stdout.split()
    return int(output[1]), float(output[2]), float(output[3])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, metavar="FILE", help="pt_read_particles of the tests")
    parser.add_argument("--count", type=lambda text: int(float(text)), default=2_000_000, help="of particles")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        files = make_files(Cloud(arguments.count), folder)
        runs = {name: [] for name in files}
        for _ in range(arguments.rounds):
            for name, (path, _) in files.items():
                runs[name].append(read(arguments.program, name, path))
        rows = []
        for name, (path, size) in files.items():
            if any(count != arguments.count for count, _, _ in runs[name]):
                raise SystemExit(f"{name}: not all particles were read")
            seconds = min(seconds for _, seconds, _ in runs[name])
            rows.append([name, f"{size / 1e6:.0f}", f"{seconds:.2f}", f"{size / 1e6 / seconds:.0f}",
                         f"{runs[name][0][2]:.0f}"])
    print_table([["format", "MB", "CPU s", "MB / CPU s", "peak MiB"], *rows])


if __name__ == "__main__":
    main()
