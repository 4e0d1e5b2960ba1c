"""A million balls along a gyroid, a surface that occurs in block copolymers and butterfly wings:

    python3 million.py && pt figure gyroid.npz --color height -o million.png
"""

import numpy as np

side = 190
x, y, z = np.indices((side, side, side)).reshape(3, -1) * (4 * np.pi / side)  # two periods in each direction
distance = abs(np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x))
nearest = np.argpartition(distance, 1_000_000)[:1_000_000]
places = np.stack([x, y, z], axis=1)[nearest] * side / (4 * np.pi)
np.savez("gyroid.npz", positions=places.astype(np.float32), height=places[:, 2].astype(np.float32))
