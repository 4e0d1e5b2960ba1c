from pt.figures._accept import frames, load
from pt.figures._cell import Cell
from pt.figures._figure import Figure, figure
from pt.figures._particles import Particles

__all__ = ["Cell", "Figure", "Particles", "figure", "frames", "load"]
