"""One picture on many machines. Dask (distributed) runs the workers; their films are added exactly.

    from distributed import Client
    from pt import farm
    with Client("tcp://scheduler:8786") as client:
        result = farm.render(client, farm.Job(scene, camera, settings), 1000, target_error=0.01)
    result.film.image().save("picture.png")

lib/python/FARM.md describes failures, equal bits and trust.
"""

from pt.farm._job import Job
from pt.farm._options import FarmError, Options, Progress, Result
from pt.farm._render import render

__all__ = ["FarmError", "Job", "Options", "Progress", "Result", "render"]
