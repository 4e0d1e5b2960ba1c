"""Figures of particles: `pt.figure(data)`, and what reads the data."""

from pt.figure._accept import frames, load
from pt.figure._figure import Figure, figure
from pt.figure._particles import Cell, Particles

__all__ = ["Cell", "Figure", "Particles", "figure", "frames", "load"]
