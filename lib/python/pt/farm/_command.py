from __future__ import annotations

import argparse
import contextlib
import importlib
import logging
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from pt._command_line import CODE_OF_RESULT, FILES, INTERNAL, NO_DEVICE, SIGNAL, TARGET_MISSED, numbered, program
from pt._enums import Sampling
from pt._errors import Error
from pt._film import Film
from pt._scene_file import Display, SceneFile, load
from pt._text import tell
from pt.farm._arguments import check, frames_of, parser, refuse
from pt.farm._job import Job
from pt.farm._options import FarmError, Options
from pt.farm._render import render
from pt.farm._shown import Shown, Signals
from pt.farm._sum import write_film

SAMPLES, SAMPLES_TO_ERROR = 64, 65536


@contextlib.contextmanager
def cluster(arguments: argparse.Namespace) -> Iterator[Any]:
    logging.getLogger("distributed").setLevel(logging.ERROR)
    try:
        dask: Any = importlib.import_module("distributed")
    except ImportError as error:
        refuse(f"needs Dask: pip install './lib/python[farm]' ({error})", INTERNAL)
    if arguments.scheduler:
        security = None
        if arguments.tls:
            ca, certificate, key = arguments.tls
            security = dask.Security(tls_ca_file=ca, tls_client_cert=certificate, tls_client_key=key,
                                     require_encryption=True)
        try:
            client = dask.Client(arguments.scheduler, security=security)
        except (OSError, ValueError, TypeError) as error:  # TypeError comes from tls:// without certificates
            refuse(f"--scheduler {arguments.scheduler}: {error}", NO_DEVICE)
        with client:
            yield client
        return
    count = arguments.local_workers or 2
    # Otherwise each worker's driver takes all processors.
    os.environ.setdefault("LP_NUM_THREADS", str(max((os.cpu_count() or count) // count, 1)))
    with dask.LocalCluster(n_workers=count, threads_per_worker=1, processes=True, dashboard_address=None,
                      host="127.0.0.1") as local, dask.Client(local) as client:
        yield client


def read_scene(arguments: argparse.Namespace, frame: int | None) -> SceneFile:
    path, text = arguments.scene, None
    if path == "-":
        path, text = "standard input", arguments.standard_input
    return load(path, text=text, overrides=[*arguments.set, *arguments.overrides], frame=frame)


def sample_count(arguments: argparse.Namespace, file: SceneFile) -> int:
    count = file.samples or (SAMPLES_TO_ERROR if arguments.error else SAMPLES)
    left: int = 2**32 - arguments.first_sample
    if count > left and not arguments.error:
        refuse(f"--first-sample {arguments.first_sample}: {count} samples from there on would pass the last index, {2**32 - 1}")
    return min(count, left)


def write_pictures(film: Film, arguments: argparse.Namespace, display: Display, frame: int | None) -> None:
    if arguments.film:
        write_film(film, numbered(arguments.film, frame))
    if not arguments.output:
        return
    options = [word for name, value in vars(display).items() if value is not None
               for word in (f"--{name}", ",".join(map(repr, value)) if isinstance(value, tuple) else str(value))]
    options += ["--alpha"] if arguments.alpha else []
    options += [word for name in arguments.output for word in ("-o", numbered(name, frame))]
    options += ["--layers", arguments.layers] if arguments.layers else []
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sum.ptfilm")
        write_film(film, path)
        done = subprocess.run([program(), "merge", path, "-q", *options])
        if done.returncode:
            if not (arguments.film or arguments.checkpoint):
                kept = tempfile.mkstemp(prefix="pt-farm-", suffix=".ptfilm")[1]
                shutil.copyfile(path, kept)
                tell("pt-farm", f"the film is kept: pt merge {kept} -o ...")
            sys.exit(done.returncode)


def render_pictures(arguments: argparse.Namespace, signals: Signals) -> int:
    check(arguments)
    frames = frames_of(arguments)
    if arguments.scene == "-":
        arguments.standard_input = sys.stdin.read()
    code = 0
    options = Options(part_seconds=arguments.part_seconds, patience=arguments.patience, mixed=arguments.mixed,
                      checkpoint=arguments.checkpoint, checkpoint_every=arguments.checkpoint_every,
                      wait_for_workers=arguments.wait)
    for frame in frames[:1]:
        sample_count(arguments, read_scene(arguments, frame))
    with cluster(arguments) as client:
        for frame in frames:
            file = read_scene(arguments, frame)
            settings = replace(file.settings, first_sample=arguments.first_sample, coverage=arguments.alpha)
            signals.is_rendering = True
            try:
                result = render(client, Job(file.scene, file.camera, settings, arguments.device),
                                sample_count(arguments, file), target_error=arguments.error,
                                sampling=Sampling[arguments.sampling.upper()], options=options,
                                progress=Shown(arguments.quiet, signals))
            except FarmError as error:
                if error.broken_rules:
                    raise file.explained(Error(str(error), error.broken_rules)) from error
                raise
            if signals.number and frame is not None:
                break
            write_pictures(result.film, arguments, file.display, frame)
            signals.is_rendering = False
            if len(result.devices) > 1 and not arguments.quiet:
                tell("pt-farm", "devices were mixed, so the picture is right, but not bit by bit: "
                                f"{'; '.join(result.devices)}")
            if signals.number:
                break
            if result.progress.ended_by == "limit":
                code = TARGET_MISSED
    return SIGNAL + signals.number if signals.number else code


def main() -> int:
    arguments = parser().parse_args()
    signals = Signals()
    try:
        return render_pictures(arguments, signals)
    except (FarmError, Error) as error:
        tell("pt-farm", str(error))
        return SIGNAL + signals.number if signals.number else CODE_OF_RESULT.get(error.result, INTERNAL)
    except OSError as error:
        tell("pt-farm", str(error))
        return FILES


if __name__ == "__main__":
    sys.exit(main())
