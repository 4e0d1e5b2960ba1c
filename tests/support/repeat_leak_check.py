"""Runs a test, and again if the leak check at the end of a program broke down, which says nothing about the program.

Arguments: the command. GCC 12's LeakSanitizer stops all threads to look for leaks, and once in some hundreds of runs it
faults while it does ("Tracer caught signal 11"); the program, which had done all its work, then ends with exit code 1.
What fails otherwise fails here, and so does a check that breaks down three times in a row.
"""

import subprocess
import sys

BROKEN = b"LeakSanitizer has encountered a fatal error"

for attempt in range(3):
    done = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    sys.stdout.buffer.write(done.stdout)
    if done.returncode == 0 or BROKEN not in done.stdout:
        break
sys.exit(done.returncode if done.returncode >= 0 else 128 - done.returncode)
