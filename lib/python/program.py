#!python
"""A wheel's command pt: becomes the package's program without importing NumPy. Finds pt-figure and others beside
itself."""
import importlib.util
import os
import sys

package = importlib.util.find_spec("pt").submodule_search_locations[0]
os.environ["PATH"] = os.path.dirname(os.path.realpath(__file__)) + os.pathsep + os.environ.get("PATH", os.defpath)
os.execv(os.path.join(package, "bin", "pt"), ["pt", *sys.argv[1:]])
