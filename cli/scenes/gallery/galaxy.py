"""A spiral galaxy of 200,000 stars with their ages: python3 galaxy.py && pt figure galaxy.npz --color age -o galaxy.png"""

import numpy as np

random = np.random.default_rng(4)
count = 200_000
radius = 7 * random.beta(2, 5, count)
is_in_arm = (random.random(count) < 0.7) & (radius > 0.8)
arm = random.integers(0, 2, count) * np.pi + 2.2 * np.log(radius + 0.2) + random.normal(0, 0.28, count)
angle = np.where(is_in_arm, arm, random.uniform(0, 2 * np.pi, count))  # two logarithmic spirals in a disc
height = random.normal(0, 0.05 + 0.35 * np.exp(-radius))
age = np.where(is_in_arm, random.beta(2, 5, count), random.beta(5, 2, count))
np.savez("galaxy.npz", positions=np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1),
         radius=random.uniform(0.012, 0.03, count), age=age)
