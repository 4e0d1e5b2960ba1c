"""Tachyon scenes, as VMD and OVITO write them."""

from pt.tachyon._reader import TachyonScene, read

__all__ = ["TachyonScene", "read"]
