"""pt-farm: scene files on a Dask cluster. The program `pt` reads them and writes the pictures, so that options, messages
and files are its own; workers need the package alone."""

from __future__ import annotations

import argparse
import contextlib
import importlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from typing import Any

from pt._enums import Sampling
from pt._errors import Error
from pt._film import Film
from pt.farm._errors import FarmError
from pt.farm._job import job_of
from pt.farm._options import Options
from pt.farm._progress import Progress
from pt.farm._render import render
from pt.farm._sum import write_film
from pt.farm._tev import Viewer
from pt.farm._workers import now

SHOWN_EVERY = 1.0  # seconds
INTERNAL, TARGET_MISSED, STOPPED = 1, 7, 130  # exit codes, those of pt

# What `pt render` alone can do: its meaning would be lost.
REFUSED = ("--time", "--crop", "--layers", "--alpha", "--preview-every", "--piece-rows", "--watch", "--shader-dir",
           "--validation", "--submit-ms", "--format", "--describe", "--stats")


def parser() -> argparse.ArgumentParser:
    root = argparse.ArgumentParser(prog="pt-farm", description="Renders scene files on a Dask cluster.",
                                   allow_abbrev=False)
    command = root.add_subparsers(dest="command", required=True).add_parser(
        "render", allow_abbrev=False, help="render a scene",
        epilog="All other options are those of `pt render`: --size, --spp, --error, --sampling, --seed, --set, ...")
    command.add_argument("scene", metavar="SCENE")
    command.add_argument("-o", "--output", action="append", default=[], metavar="IMAGE")
    command.add_argument("--film", metavar="FILM")
    command.add_argument("--standard-error", metavar="EXR")
    command.add_argument("--png-bits", choices=("8", "16"), default="8")
    where = command.add_mutually_exclusive_group()
    where.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster, as tls://host:8786")
    where.add_argument("--local-workers", type=int, metavar="N", help="processes on this machine (default: 2)")
    command.add_argument("--tls", nargs=3, metavar=("CA", "CERT", "KEY"), help="files, for a tls:// scheduler")
    command.add_argument("--device", help="of each worker, as of pt render")
    command.add_argument("--checkpoint", metavar="FILM")
    command.add_argument("--resume", action="store_true")
    command.add_argument("--part-seconds", type=float, default=5.0)
    command.add_argument("--patience", type=float, default=10.0)
    command.add_argument("--frames", metavar="A-B")
    command.add_argument("--skip-existing", action="store_true")
    command.add_argument("--tev", nargs="?", const="", metavar="HOST:PORT")
    command.add_argument("-q", "--quiet", action="store_true")
    return root


def program() -> str:
    return os.environ.get("PT_PROGRAM", "pt")


def run_program(*arguments: str) -> str:
    """What `pt` prints. SystemExit with its code where it fails, which it has explained."""
    try:
        done = subprocess.run([program(), *arguments], stdout=subprocess.PIPE, text=True)
    except OSError as error:
        sys.exit(f"pt-farm: the program pt is needed to read scenes and write pictures (PT_PROGRAM names it): {error}")
    if done.returncode:
        sys.exit(done.returncode)
    return done.stdout


@contextlib.contextmanager
def cluster(arguments: argparse.Namespace) -> Iterator[Any]:
    """A client of it."""
    dask: Any = importlib.import_module("distributed")  # which has no types, and takes half a second
    if arguments.scheduler:
        security = None
        if arguments.tls:
            ca, certificate, key = arguments.tls
            security = dask.Security(tls_ca_file=ca, tls_client_cert=certificate, tls_client_key=key, require_encryption=True)
        with dask.Client(arguments.scheduler, security=security) as client:
            yield client
        return
    count = arguments.local_workers or 2
    # Each takes its share of the processors; drivers take all of them else.
    os.environ.setdefault("LP_NUM_THREADS", str(max((os.cpu_count() or count) // count, 1)))
    with dask.LocalCluster(n_workers=count, threads_per_worker=1, processes=True, dashboard_address=None,
                      host="127.0.0.1") as local, dask.Client(local) as client:
        yield client


def numbered(pattern: str, frame: int | None) -> str:
    """# signs become the frame's number, as with pt render --frames."""
    if frame is None:
        return pattern
    place = re.search(r"#+(?=[^#]*$)", pattern)
    if place is None:
        sys.exit(f"pt-farm: {pattern}: with --frames the name must have # signs, for the number of the frame")
    return pattern[:place.start()] + str(frame).zfill(len(place.group())) + pattern[place.end():]


class Shown:
    """Progress on stderr, and the picture in a viewer."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self._quiet, self._time, self._told = arguments.quiet, 0.0, 0
        self._viewer = Viewer(arguments.tev) if arguments.tev is not None else None
        self._name = arguments.scene

    def __call__(self, progress: Progress, film: Film | None) -> None:
        for message in progress.messages[self._told:]:
            print(f"\npt-farm: {message}", file=sys.stderr)
        self._told = len(progress.messages)
        if now() - self._time < SHOWN_EVERY and not progress.ended_by:
            return
        self._time = now()
        if film is not None:
            stats = film.stats()
            progress.samples = stats.mean_sample_count
            progress.error, progress.error_high = stats.relative_rmse, stats.relative_rmse_high
            if self._viewer:
                self._viewer.show(self._name, film)
        if not self._quiet:
            print(f"\r{progress.line()}", end="\n" if progress.ended_by else "", file=sys.stderr, flush=True)


def write_pictures(film: Film, arguments: argparse.Namespace, display: dict[str, Any], frame: int | None) -> None:
    if arguments.film:
        write_film(film, numbered(arguments.film, frame))
    if not arguments.output and not arguments.standard_error:
        return
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sum.ptfilm")
        write_film(film, path)
        options = ["--exposure", str(display["exposure"]), "--tonemap", display["tonemap"], "--png-bits",
                   arguments.png_bits]
        options += ["--gamma", str(display["gamma"])] if display["gamma"] else []
        options += [word for name in arguments.output for word in ("-o", numbered(name, frame))]
        options += ["--standard-error", numbered(arguments.standard_error, frame)] if arguments.standard_error else []
        run_program("merge", path, "-q", *options)


def is_done(arguments: argparse.Namespace, frame: int | None) -> bool:
    names = [*arguments.output, *filter(None, (arguments.film, arguments.standard_error))]
    return all(pathlib.Path(numbered(name, frame)).exists() for name in names)


def check(arguments: argparse.Namespace, others: list[str]) -> None:
    for word in others:
        if word.partition("=")[0] in REFUSED:
            sys.exit(f"pt-farm: {word}: a farm has no such option; see pt render")
    if not (arguments.output or arguments.film):
        sys.exit("pt-farm: -o or --film is missing: there is nothing to write")
    if arguments.resume and not arguments.checkpoint:
        sys.exit("pt-farm: --resume: needs --checkpoint, the file to go on from")
    if arguments.frames and arguments.checkpoint:
        sys.exit("pt-farm: --checkpoint: --frames have none; --skip-existing goes on after the frames that are done")
    if arguments.checkpoint and not arguments.resume and pathlib.Path(arguments.checkpoint).exists():
        sys.exit(f"pt-farm: --checkpoint {arguments.checkpoint}: is there already; go on from it by --resume")


def render_pictures(arguments: argparse.Namespace, others: list[str]) -> int:
    check(arguments, others)
    frames = ["--frames", arguments.frames] if arguments.frames else []
    lines = run_program("render", arguments.scene, "--describe", "-", "-q", *frames, *others).splitlines()
    shown, code = Shown(arguments), 0
    options = Options(part_seconds=arguments.part_seconds, patience=arguments.patience,
                      checkpoint=arguments.checkpoint)
    with cluster(arguments) as client:
        for line in lines:
            description = json.loads(line)
            frame = description["frame"]
            if arguments.skip_existing and frame is not None and is_done(arguments, frame):
                continue
            result = render(client, job_of(description, arguments.device), description["samples"],
                            target_error=description["target_error"], sampling=Sampling(description["sampling"]),
                            options=options, progress=shown)
            write_pictures(result.film, arguments, description["display"], frame)
            if result.progress.ended_by == "limit":
                code = TARGET_MISSED
    return code


def main() -> int:
    arguments, others = parser().parse_known_args()
    try:
        return render_pictures(arguments, others)
    except (FarmError, Error, OSError) as error:
        print(f"pt-farm: {error}", file=sys.stderr)
        return INTERNAL
    except KeyboardInterrupt:
        return STOPPED


if __name__ == "__main__":
    sys.exit(main())
