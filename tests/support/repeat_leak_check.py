"""Runs a command up to three times, because LeakSanitizer itself may crash ("Tracer caught signal 11" of GCC 12)."""

import subprocess
import sys

BROKEN = b"LeakSanitizer has encountered a fatal error"

for attempt in range(3):
    done = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    sys.stdout.buffer.write(done.stdout)
    if done.returncode == 0 or BROKEN not in done.stdout:
        break
sys.exit(done.returncode if done.returncode >= 0 else 128 - done.returncode)
