"""Arguments: the strip program, the shared library."""

import os
import subprocess
import sys
import tempfile

MOST = 1_240_000  # bytes

with tempfile.TemporaryDirectory() as folder:
    stripped = os.path.join(folder, "libpt.so")
    subprocess.run([sys.argv[1], "-o", stripped, sys.argv[2]], check=True)
    size = os.path.getsize(stripped)
print(f"{size} bytes stripped, of {MOST} at most")
sys.exit(size > MOST)
