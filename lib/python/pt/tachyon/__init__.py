"""Tachyon scenes, as VMD and OVITO write them: `pt.tachyon.read` for programs, `pt-tachyon` for the command line."""

from pt.tachyon._reader import TachyonScene, read

__all__ = ["TachyonScene", "read"]
