from pt.figures._accept import frames, load
from pt.figures._cell import Cell
from pt.figures._figure import Figure, figure
from pt.figures._particles import Particles
from pt.figures._series import panels

__all__ = ["Cell", "Figure", "Particles", "figure", "frames", "load", "panels"]
