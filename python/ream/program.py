"""What the program `ream` does with files, as functions: import, plan, simulate, score, export, mesh.

    import ream.program

    made = ream.program.import_ct("ct", out="shoulder", roi="glenoid")
    ream.program.plan(made["case"], version_deg=0, depth_mm=1.5)

Each runs one command of the program in a process of its own. Keyword arguments are the command's options with
underscores: `roi="glenoid"` is `--roi glenoid`, True gives an option without a value, and None leaves it out. Several
numbers become one value: `axis=(0, 0, 0, 1, 0, 0)`. What the command prints with `--json` is returned.

`ream COMMAND --help` lists the options; docs/reference.md explains them. What the program refuses is a ream.Error.
"""

from __future__ import annotations

import json
import numbers
import os
import pathlib
import shutil
import subprocess
from collections.abc import Sequence
from typing import Any, Union

from ream._ream import Error

Value = Union[str, float, bool, None, "os.PathLike[str]", Sequence[float]]

#: Where the program is; None: REAM_BIN, in PATH, or in the build that the package is of.
program: str | os.PathLike[str] | None = None


def _program() -> str:
    beside = pathlib.Path(__file__).resolve().parent.parent.parent / "ream"
    for place in (program, os.environ.get("REAM_BIN")):
        if place:
            return os.fspath(place)
    found = shutil.which("ream")
    if found is None and os.access(beside, os.X_OK) and beside.is_file():
        found = str(beside)
    if found is None:
        raise Error("the program ream is not in PATH; install the package ream, or set ream.program.program")
    return found


def _words(options: dict[str, Value]) -> list[str]:
    words: list[str] = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, (str, os.PathLike)):
            words.append(f"{option}={os.fspath(value)}")
        elif isinstance(value, numbers.Real):
            words.append(f"{option}={int(value) if isinstance(value, numbers.Integral) else float(value)}")
        else:
            words.append(f"{option}=" + ",".join(repr(float(number)) for number in value))
    return words


def run(command: str, *things: str | os.PathLike[str], **options: Value) -> Any:
    """Any command that has `--json`: `run("list", "cases")`. Returns what it prints, from JSON.

    Raises ream.Error where the command fails, with its message.
    """
    # After "--" nothing is taken for an option, whatever a file is called.
    arguments = [_program(), command, "--json", *_words(options)]
    if things:
        arguments += ["--", *map(os.fspath, things)]
    try:
        done = subprocess.run(arguments, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
    except OSError as failure:
        raise Error(f"the program ream cannot be run: {failure}") from None
    if done.returncode != 0:
        raise _error_of(command, done)
    return json.loads(done.stdout) if done.stdout.strip() else None


def _error_of(command: str, done: subprocess.CompletedProcess[str]) -> Error:
    lines = done.stderr.strip().splitlines()
    message = lines[-1] if lines else f"ream {command} ended with {done.returncode} and said nothing"
    try:
        told = json.loads(message)
        message = told["error"] if isinstance(told, dict) else message
    except (ValueError, KeyError):
        pass
    error = Error(message)
    error.kind = "usage" if done.returncode == 2 else "invalid_input"
    return error


def simulate(case: str, script: str | os.PathLike[str], out: str | os.PathLike[str], **options: Value) -> dict[str, Any]:
    """`ream simulate`: a scripted reaming into the folder `out`. Returns its metrics."""
    told: dict[str, Any] = run("simulate", case=case, script=script, out=out, **options)
    return told


def import_ct(path: str | os.PathLike[str], out: str | os.PathLike[str], **options: Value) -> dict[str, Any]:
    """`ream import`: a CT (DICOM folder, NRRD, NIfTI, MetaImage, zip) becomes the case `out`."""
    told: dict[str, Any] = run("import", path, out=out, **options)
    return told


def plan(case: str, **options: Value) -> dict[str, Any]:
    """`ream plan`: plans a case, and says what the plan reaches. Without options it shows the plan that is there."""
    told: dict[str, Any] = run("plan", case, **options)
    return told


def score(session: str | os.PathLike[str], **options: Value) -> dict[str, Any]:
    """`ream score`: a session, a folder or a recording, judged by a rubric; see also Simulation.score()."""
    told: dict[str, Any] = run("score", session, **options)
    return told


def export(session: str | os.PathLike[str], out: str | os.PathLike[str], **options: Value) -> pathlib.Path:
    """`ream export`: a recording as a table, a mesh, voxels, a report or a bundle, by the ending of `out`."""
    return pathlib.Path(run("export", session, out=out, **options)["out"])


def femesh(source: str | os.PathLike[str], out: str | os.PathLike[str], **options: Value) -> dict[str, Any]:
    """`ream femesh`: voxels as a mesh of hexahedra with moduli, for Abaqus and CalculiX (.inp) or VTK (.vtu)."""
    told: dict[str, Any] = run("femesh", source, out=out, **options)
    return told


def solve(source: str | os.PathLike[str], **options: Value) -> dict[str, Any]:
    """`ream solve`: voxels compressed between platens. Returns the apparent modulus, its bounds, and strains."""
    told: dict[str, Any] = run("solve", source, **options)
    return told


def render(what: str | os.PathLike[str], out: str | os.PathLike[str]) -> pathlib.Path:
    """`ream render`: a case or a session as a picture (PNG); see also Simulation.picture()."""
    return pathlib.Path(run("render", what, out=out)["out"])
