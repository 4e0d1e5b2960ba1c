#!python
"""The command pt of a wheel replaces itself by the package's program, without importing NumPy. This script's folder joins
PATH, so that pt finds the wheel's other commands."""
import importlib.util
import os
import sys

package = importlib.util.find_spec("pt").submodule_search_locations[0]
os.environ["PATH"] = os.path.dirname(os.path.realpath(__file__)) + os.pathsep + os.environ.get("PATH", os.defpath)
os.execv(os.path.join(package, "bin", "pt"), ["pt", *sys.argv[1:]])
