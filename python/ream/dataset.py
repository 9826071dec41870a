"""Many reamings as HDF5 files: forces, pictures, depth, labels, bone, score.

    python3 -m ream.dataset reamings --count 1000 --task free-hand

It needs h5py. It can be stopped at any time: the same command goes on. The same seed gives the same files, byte for
byte, however many processes make them. docs/python.md describes what is in them; so does the DATASHEET.md beside them.
"""

from __future__ import annotations

import argparse
import contextlib
import ctypes
import fcntl
import hashlib
import json
import multiprocessing
import os
import pathlib
import re
import signal
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.synchronize import Event
from typing import Any, NamedTuple

import numpy as np

from ream._ream import Error
from ream._ream import version as _version
from ream.controllers import CONTROLLERS, find_controller, run_episode
from ream.datasheet import datasheet
from ream.environments import OBSERVED, STEP_S, TASKS, Action, Observation, Reaming
from ream.simulation import volume

try:
    import h5py
except ImportError:
    if __name__ == "__main__":
        sys.exit("ream.dataset: it needs h5py: apt install python3-h5py")
    raise ImportError("ream.dataset needs h5py: apt install python3-h5py") from None

_PR_SET_PDEATHSIG = 1
#: Packed as the same bytes by every process.
_PACKED = {"compression": "gzip", "compression_opts": 4, "shuffle": True}
#: Leaves room between the seeds of two data sets.
_MAX_COUNT = 1_000_000
#: What a process that was ended leaves of a file.
_UNFINISHED = re.compile(r"(reaming-\d{6}\.h5|case\.h5|index\.h5|dataset\.json|DATASHEET\.md)\.\d+\.tmp")


class Settings(NamedTuple):
    """What a data set is made of. It is written beside it, as dataset.json."""

    task: str = "push-to-depth"
    controller: str = "varied"
    case: str = "demo"
    seed: int = 1
    picture_width: int = 160
    picture_height: int = 120
    #: Between two pictures, simulated; 0: none.
    picture_s: float = 1.0
    #: Of a reaming at most, simulated.
    max_time_s: float = 40.0


def _name(index: int) -> str:
    return f"reaming-{index:06}.h5"


@contextlib.contextmanager
def _new_file(path: pathlib.Path) -> Iterator[h5py.File]:
    """A file that has its name only once it is whole. It is made in memory: on a full disk HDF5 would crash."""
    with h5py.File(path.name, "w", driver="core", backing_store=False, libver=("earliest", "v110")) as file:
        yield file
        file.flush()
        content = file.id.get_file_image()
    _write(path, content)


def _write(path: pathlib.Path, content: bytes) -> None:
    """Whole or not at all."""
    unfinished = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        unfinished.write_bytes(content)
        _sync(unfinished)
        unfinished.rename(path)
        _sync(path.parent)
    finally:
        unfinished.unlink(missing_ok=True)


def _sync(path: pathlib.Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextlib.contextmanager
def _only_one(folder: pathlib.Path) -> Iterator[None]:
    """Nobody else makes a data set there meanwhile."""
    folder.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Error(f"another process is making a data set in {folder}") from None
        yield
    finally:
        os.close(descriptor)


class _Stopped(Exception):
    """The data set is to be made no further for now."""


#: In a process that makes reamings for another one: set when it is to stop.
_stop: Event | None = None


class _Episode:
    """Takes an episode down as it goes."""

    def __init__(self, environment: Reaming, settings: Settings) -> None:
        self._environment = environment
        self._settings = settings
        self._picture_steps = round(settings.picture_s / STEP_S)
        self.observations: list[Observation] = []
        self.actions: list[Action] = []
        self.rewards: list[float] = []
        self.ticks: list[np.ndarray[Any, Any]] = []
        self.pictures: list[Any] = []
        self.picture_ticks: list[int] = []

    def watch(self, observation: Observation, action: Action | None, reward: float) -> None:
        """See controllers.Watcher."""
        if _stop is not None and _stop.is_set():
            raise _Stopped
        self.observations.append(observation)
        self.ticks.append(self._environment.last_ticks)
        if action is not None:
            self.actions.append(np.asarray(action, np.float32))
            self.rewards.append(reward)
        if self._picture_steps and len(self.actions) % self._picture_steps == 0:
            self.take_picture()

    def take_picture(self) -> None:
        """Of this moment."""
        simulation = self._environment.simulation
        if self.picture_ticks[-1:] != [simulation.tick]:
            self.pictures.append(simulation.picture(self._settings.picture_width, self._settings.picture_height))
            self.picture_ticks.append(simulation.tick)


def _write_episode(file: h5py.File, environment: Reaming, episode: _Episode) -> None:
    steps = file.create_group("steps")
    steps.create_dataset("observations", data=np.stack(episode.observations), **_PACKED)
    steps.create_dataset("actions", data=np.stack(episode.actions), **_PACKED)
    steps.create_dataset("rewards", data=np.array(episode.rewards), **_PACKED)
    steps.attrs["observed"] = list(OBSERVED)
    ticks = file.create_group("ticks")
    for name, column in environment.simulation.table(np.concatenate(episode.ticks)).items():
        ticks.create_dataset(name, data=column.astype(np.float32), **_PACKED)
    if not episode.pictures:
        return
    pictures = file.create_group("pictures")
    pictures.create_dataset("tick", data=np.array(episode.picture_ticks, np.uint32))
    for name in ("rgb", "depth_mm", "labels", "cut"):
        pictures.create_dataset(name, data=np.stack([getattr(one, name) for one in episode.pictures]), **_PACKED)


class _Maker:
    """Makes reamings of one data set, in one process."""

    def __init__(self, folder: pathlib.Path, settings: Settings) -> None:
        self._folder = folder
        self._settings = settings
        self._factory = find_controller(settings.controller)
        self._environment = TASKS[settings.task](settings.case, max_time_s=settings.max_time_s)
        self._whole = volume(self._environment.simulation.coverage)
        # Refuses a size that cannot be.
        if settings.picture_s:
            self._environment.simulation.picture(settings.picture_width, settings.picture_height)

    def make(self, index: int) -> int:
        """Writes the file of reaming `index`; returns `index`."""
        settings, environment = self._settings, self._environment
        seed = settings.seed * _MAX_COUNT + index
        episode = _Episode(environment, settings)
        end = run_episode(environment, self._factory, seed, episode.watch)
        if settings.picture_s:
            episode.take_picture()
        simulation = environment.simulation
        with _new_file(self._folder / _name(index)) as file:
            file.attrs["seed"] = seed
            file.attrs["return"] = end["return"]
            file.attrs["session_hash"] = simulation.session_hash
            file.attrs["grid_hash"] = simulation.grid_hash
            file.attrs["metrics"] = json.dumps(end["metrics"], sort_keys=True)
            file.attrs["score"] = json.dumps(end["score"], sort_keys=True)
            _write_episode(file, environment, episode)
            removed = self._whole - volume(simulation.coverage)
            file.create_dataset("bone/removed", data=removed, chunks=True, **_PACKED)
        return index

    def bone_hash(self) -> str:
        """Of bone and plan before the first tick."""
        simulation = self._environment.simulation
        told = hashlib.sha256(self._whole.tobytes())
        told.update(volume(simulation.density).tobytes())
        told.update(json.dumps(simulation.plan, sort_keys=True).encode())
        return told.hexdigest()

    def write_case(self) -> None:
        """case.h5: the bone before anything was removed."""
        simulation = self._environment.simulation
        density = volume(simulation.density)
        with _new_file(self._folder / "case.h5") as file:
            file.create_dataset("coverage", data=self._whole, chunks=True, **_PACKED)
            file.create_dataset("density", data=density, chunks=True, **_PACKED)
            file.attrs["case"] = self._settings.case
            file.attrs["plan"] = json.dumps(simulation.plan, sort_keys=True)
            file.attrs["spacing_mm"] = simulation.spacing_mm
            file.attrs["world_from_grid"] = simulation.world_from_grid
            file.attrs["world_from_plan"] = simulation.world_from_plan


_maker: _Maker | None = None


def _begin_worker(folder: pathlib.Path, settings: Settings, parent: int, stop: Event) -> None:
    global _maker, _stop
    _stop = stop
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    # Ends with the process that began it, whatever ends that (prctl(2)).
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)
    _maker = _Maker(folder, settings)


def _work(index: int) -> int:
    assert _maker is not None
    with contextlib.suppress(_Stopped):
        _maker.make(index)
    return index


def _number(value: Any) -> float:
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else float("nan")


def _write_index(folder: pathlib.Path, count: int) -> dict[str, np.ndarray[Any, Any]]:
    """index.h5: a number for each reaming and metric, and a link to each file."""
    rows = []
    for index in range(count):
        with h5py.File(folder / _name(index), "r") as file:
            score = json.loads(file.attrs["score"])
            row = {key: _number(value) for key, value in json.loads(file.attrs["metrics"]).items()}
            row |= {"seed": float(file.attrs["seed"]), "return": float(file.attrs["return"])}
            row |= {"points": _number(score["points"]), "passed": float(score.get("outcome") == "pass")}
            row["ticks"] = float(len(file["ticks/t_s"]))
            rows.append(row)
    columns = {key: np.array([row.get(key, float("nan")) for row in rows]) for key in sorted({k for r in rows for k in r})}
    columns = {key: column for key, column in columns.items() if not np.isnan(column).all()}
    with _new_file(folder / "index.h5") as file:
        for key, column in columns.items():
            file.create_dataset(key, data=column)
        for index in range(count):
            file[f"reamings/{index:06}"] = h5py.ExternalLink(_name(index), "/")
    return columns


def _begin(folder: pathlib.Path, settings: Settings, maker: _Maker) -> None:
    """Writes dataset.json and case.h5, or refuses what is of other settings or of another bone."""
    about = {"ream": _version, **settings._asdict(), "bone": maker.bone_hash()}
    path = folder / "dataset.json"
    unfinished = [file for file in folder.iterdir() if _UNFINISHED.fullmatch(file.name)]
    if not path.exists():
        if any(file.name != "case.h5" and file not in unfinished for file in folder.iterdir()):
            raise Error(f"{folder} has something else in it; choose a new or empty folder")
        _remove(unfinished)
        maker.write_case()
        _write(path, (json.dumps(about, indent=2) + "\n").encode())
        return
    try:
        found = json.loads(path.read_text())
    except ValueError:
        found = None
    if not isinstance(found, dict):
        raise Error(f"{path} cannot be read as the settings of a data set; choose another folder")
    for key, value in about.items():
        if found.get(key) != value:
            raise Error(f"{folder} was made with {key} {found.get(key)!r}, not {value!r}; choose another folder")
    _remove(unfinished)


def _remove(files: list[pathlib.Path]) -> None:
    for file in files:
        file.unlink()


def make_dataset(
    folder: str | os.PathLike[str], count: int, settings: Settings = Settings(), *, jobs: int = 1, quiet: bool = True
) -> None:
    """Makes `count` reamings in `folder`, or goes on where it was stopped. See the module.

    jobs: processes. They are started anew (`spawn`): call this under `if __name__ == "__main__":`.
    Raises ream.Error for settings that cannot be, and for a folder of other settings.
    """
    if settings.task not in TASKS:
        raise Error(f"there is no task {settings.task!r}; there are {', '.join(TASKS)}")
    if not 0 < count <= _MAX_COUNT or jobs < 1 or not 0 <= settings.seed < 2**32:
        raise Error(f"count must be 1 to {_MAX_COUNT}, jobs at least 1, seed 0 to 2**32 - 1")
    picture_steps = settings.picture_s / STEP_S
    if not (0 <= settings.picture_s < 1e6 and abs(picture_steps - round(picture_steps)) < 1e-6):
        raise Error(f"picture_s must be 0 or a multiple of {STEP_S:g}")
    place = pathlib.Path(folder)
    maker = _Maker(place, settings)
    with _only_one(place):
        _begin(place, settings, maker)
        missing = [index for index in range(count) if not (place / _name(index)).exists()]
        _make_all(place, settings, maker, missing, min(jobs, max(len(missing), 1)), count, quiet)
        columns = _write_index(place, count)
        # It may have been written to since, but for what is no longer so.
        if missing or not (place / "DATASHEET.md").exists():
            _write(place / "DATASHEET.md", datasheet(settings._asdict(), columns, _version).encode())


def _make_all(
    place: pathlib.Path,
    settings: Settings,
    maker: _Maker,
    missing: list[int],
    jobs: int,
    count: int,
    quiet: bool,
) -> None:
    def tell(done: int) -> None:
        if not quiet:
            print(f"\r{count - len(missing) + done} of {count}", end="", file=sys.stderr, flush=True)

    if jobs == 1:
        for done, index in enumerate(missing):
            maker.make(index)
            tell(done + 1)
    else:
        spawn = multiprocessing.get_context("spawn")
        stop = spawn.Event()
        with ProcessPoolExecutor(jobs, spawn, _begin_worker, (place, settings, os.getpid(), stop)) as pool:
            try:
                # Processes begin while the first are submitted; Ctrl-C is for this one alone.
                before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
                try:
                    submitted = [pool.submit(_work, index) for index in missing]
                finally:
                    signal.pthread_sigmask(signal.SIG_SETMASK, before)
                for done, future in enumerate(as_completed(submitted)):
                    future.result()
                    tell(done + 1)
            except KeyboardInterrupt:
                stop.set()
                raise
            except BrokenProcessPool:
                raise Error("a process was ended from outside, perhaps for want of memory; try fewer --jobs") from None
            finally:
                pool.shutdown(cancel_futures=True)
    if not quiet:
        print(file=sys.stderr)


def _parser() -> argparse.ArgumentParser:
    usual = Settings()
    parser = argparse.ArgumentParser(
        prog="python3 -m ream.dataset", description="Makes a data set of reamings. The same command goes on with one."
    )
    parser.add_argument("folder", help="new, empty, or that of the data set to go on with")
    parser.add_argument("--count", type=int, default=1000, help="of reamings; default: %(default)s")
    parser.add_argument("--seed", type=int, default=usual.seed, help="of all chance; default: %(default)s")
    parser.add_argument("--task", default=usual.task, help=f"{' or '.join(TASKS)}; default: %(default)s")
    names = ", ".join(CONTROLLERS)
    parser.add_argument("--controller", default=usual.controller, help=f"{names}, or module:name; default: %(default)s")
    parser.add_argument("--case", default=usual.case, help="default: %(default)s")
    parser.add_argument(
        "--picture-s", type=float, default=usual.picture_s, help="seconds between pictures; 0: none; default: %(default)s"
    )
    size = f"{usual.picture_width}x{usual.picture_height}"
    parser.add_argument("--picture-size", default=size, help="WIDTHxHEIGHT; default: %(default)s")
    parser.add_argument(
        "--max-time-s", type=float, default=usual.max_time_s, help="of a reaming, simulated; default: %(default)s"
    )
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes; default: %(default)s")
    return parser


def _settings_of(asked: argparse.Namespace) -> Settings:
    width, _, height = asked.picture_size.partition("x")
    if not (width.isdecimal() and height.isdecimal()):
        raise Error(f"--picture-size is WIDTHxHEIGHT, such as 160x120, not {asked.picture_size!r}")
    pictures = (int(width), int(height), asked.picture_s)
    return Settings(asked.task, asked.controller, asked.case, asked.seed, *pictures, asked.max_time_s)


def main(words: list[str] | None = None) -> int:
    """The command."""
    parser = _parser()
    asked = parser.parse_args(words)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        make_dataset(asked.folder, asked.count, _settings_of(asked), jobs=asked.jobs, quiet=False)
    except KeyboardInterrupt:
        print(f"\nream.dataset: stopped; the same command goes on in {asked.folder}", file=sys.stderr)
        return 130
    except (Error, OSError) as error:
        print(f"ream.dataset: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
