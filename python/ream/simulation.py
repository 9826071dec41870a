"""A reaming that Python steps."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from ream import _ream
from ream.models import Device, EngagedBone, FeedModel
from ream.pictures import Picture
from ream.ticks import TICK, Frames

_MANY_TICKS = 2**40
_Kind = TypeVar("_Kind", bound=np.generic)


def _plain(value: Any) -> Any:
    """For what NumPy has in a script."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"a script cannot hold a {type(value).__name__}")


def _script_text(script: dict[str, Any]) -> str:
    try:
        return json.dumps(script, default=_plain, allow_nan=False)
    except ValueError:
        raise _ream.Error("a script cannot hold nan or infinite numbers") from None


def _triple(numbers: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = numbers
    return float(x), float(y), float(z)


class Simulation(Frames):
    """One case, one reamer and one hand, stepped a millisecond at a time as the program does it.

    The same case and the same input give the same bits as `ream simulate`: compare `session_hash` and `grid_hash`.
    Poses are the handle's in the plan frame: its origin is the planned entry, z goes along the planned axis into
    the bone. The handle's origin is the apex of a reamer that nothing holds back.

    One thread uses a simulation at a time. Other threads can use others meanwhile.
    """

    _core: _ream.Simulation

    def __init__(
        self,
        case: str | os.PathLike[str] = "demo",
        *,
        script: str | os.PathLike[str] | dict[str, Any] = "demo",
        reamer: str | os.PathLike[str] | None = None,
        reamer_axis: Sequence[float] | None = None,
        point_spacing_mm: float = 0.3,
        force_scale: float | None = None,
        feed_model: str | FeedModel | None = None,
        removal: str = "profile",
        backend: str = "cpu",
        seed: int = 1,
        data: str | os.PathLike[str] | None = None,
    ) -> None:
        """Loads the case and prepares the first tick; `demo` is made on first use, which takes some seconds.

        case: `demo`, the id of a case in the data folder, or the folder of one.
        script: `demo`, the path of a script, or a dictionary with what a script says. It sets drive, stiffness,
            vibration and the device's limits (`device_profile`), and has the hand of run_script().
        reamer: words such as "sphere 17.5", the name of one in the data folder, or a mesh file; else the plan's.
        reamer_axis: of a mesh file, in its mm: a point of the axis and the feed direction, x, y, z each; else estimated.
        point_spacing_mm: distance of the points of the reamer that feel bone, 0.02 to 5.
        force_scale: simulated newtons for each newton of the hand, 0.01 to 1000; else the script's.
        feed_model: how fast the reamer cuts, such as "edge" (docs/scripting.md lists them), or an object of your own
            as ream.models.FeedModel; else the script's.
        removal: "profile", or "decay" as in the thesis.
        backend: "cpu", "opencl" or "opencl:1". They give the same bits.
        seed: of all that is random, such as tremor and vibration.
        data: the data folder; else REAM_DATA, or ~/.local/share/ream.
        """
        if not 0 <= seed < 2**64:
            raise _ream.Error("seed must be a whole number from 0 to 2**64 - 1")
        if reamer_axis is not None and len(reamer_axis) != 6:
            raise _ream.Error("reamer_axis must have six numbers: a point and a direction")
        content = _script_text(script) if isinstance(script, dict) else None
        name = "demo" if isinstance(script, dict) else os.fspath(script)
        self._core = _ream.Simulation(
            os.fspath(case),
            name,
            content,
            os.fspath(reamer or ""),
            None if reamer_axis is None else [float(number) for number in reamer_axis],
            point_spacing_mm,
            force_scale,
            feed_model if isinstance(feed_model, str) else "",
            removal,
            backend,
            seed,
            data,
        )
        if feed_model is not None and not isinstance(feed_model, str):
            self._core.use_feed_model(feed_model, EngagedBone)

    def __repr__(self) -> str:
        return f"<ream.Simulation of case {self._core.case!r}, {self._core.reamer}, after {self.tick} ticks>"

    def reset(self) -> None:
        """Back to before the first tick: all the bone is there again."""
        self._core.reset()

    def step(
        self, pose: npt.ArrayLike, trigger: float = 1.0, *, reversed: bool = False, irrigating: bool = False
    ) -> np.void:
        """One millisecond with the handle at `pose`, and what came of it: a row of type ream.TICK.

        pose: x, y, z in mm, or these and a quaternion w, x, y, z. The first pose also puts the reamer there, so
            that it must lie outside the bone. Later the reamer follows the handle by a spring (`stiffness_n_mm`)
            and as fast as it cuts.
        trigger: 0, the spindle stands, to 1, full speed.
        """
        row: np.void = self._core.step(np.asarray(pose, float), trigger, reversed, irrigating)[0]
        return row

    def run(
        self,
        poses: npt.ArrayLike,
        triggers: npt.ArrayLike = 1.0,
        *,
        reversed: bool = False,
        irrigating: bool = False,
    ) -> npt.NDArray[np.void]:
        """As many steps as there are rows in `poses` (n, 3) or (n, 7); `triggers` is one number or n.

        Poses and triggers are checked before the first step. After Ctrl-C, `tick` says how many steps were done.
        """
        rows, each = np.asarray(poses, float), np.asarray(triggers, float)
        if each.ndim == 0:
            each = np.full(rows.shape[:1], each)
        ticks: npt.NDArray[np.void] = self._core.run(rows, each, reversed, irrigating)
        return ticks

    def run_script(self, ticks: int | None = None) -> npt.NDArray[np.void]:
        """The script's hand reams, for `ticks` or to the script's end. Call it again to go on.

        The hand can only ream from the beginning: after step(), run() or restore(), call reset() first.
        """
        rows: npt.NDArray[np.void] = self._core.run_script(_MANY_TICKS if ticks is None else ticks)
        return rows

    def run_device(self, device: Device, ticks: int | None = None) -> npt.NDArray[np.void]:
        """A device of your own moves the handle: read() before each tick, write() after it, until it gives None.

        ticks: at most so many.
        """
        rows: list[np.void] = []
        while ticks is None or len(rows) < ticks:
            asked = device.read()
            if asked is None:
                break
            pose, trigger = asked
            rows.append(self.step(pose, trigger))
            device.write(rows[-1])
        return np.array(rows, TICK)

    def snapshot(self) -> _ream.Snapshot:
        """This moment, to go back to with restore(): bone, reamer, drive, heat and vibration.

        It does not keep the script's hand.
        """
        return self._core.snapshot()

    def restore(self, snapshot: _ream.Snapshot) -> None:
        """Goes back to a snapshot of this simulation. The same poses then give the same ticks, to the bit."""
        self._core.restore(snapshot)

    def metrics(self) -> dict[str, Any]:
        """What is scored so far, as in metrics.json (docs/reference.md). Takes some hundredths of a second."""
        told: dict[str, Any] = json.loads(self._core.metrics_json())
        return told

    def score(self, rubric: str | os.PathLike[str] = "standard") -> dict[str, Any]:
        """What the bone is worth so far by a rubric: `points`, `outcome`, `reasons` and each criterion.

        rubric: a file, or the name of one in the data folder, with "@" and a version where not the newest is meant.
        """
        told: dict[str, Any] = json.loads(self._core.score_json(os.fspath(rubric)))
        return told

    def save(self, folder: str | os.PathLike[str], *, pictures: bool = False) -> None:
        """Writes the session so far as `ream simulate` does: recording, trace.csv, metrics, score.

        The session is computed once more for it, from what the hand did, so that `ream replay` can verify it. Steps
        that restore() has taken back are not in it.

        folder: new or empty.
        pictures: with snapshot.png and reamed.ply, too, which take some seconds.
        """
        self._core.save(os.fspath(folder), pictures)

    def picture(
        self,
        width: int = 320,
        height: int = 240,
        *,
        eye_mm: Sequence[float] | None = None,
        target_mm: Sequence[float] = (0.0, 0.0, 0.0),
        up: Sequence[float] | None = None,
        field_of_view_rad: float = 0.6,
        reamer: bool = True,
    ) -> Picture:
        """Colours, depth and labels of each pixel, as a camera sees bone and reamer now.

        eye_mm, target_mm: where the camera is and what it looks at, in the plan frame with the bone at rest; without
            `eye_mm` it is in front of the glenoid and a little above, superior up.
        up: what is up in the picture, plan frame; by default y.
        field_of_view_rad: from the lower edge to the upper one, of a camera of your own.
        reamer: False leaves the reamer out, so that the bone under it is seen.
        """
        eye = None if eye_mm is None else _triple(eye_mm)
        drawn = self._core.picture(
            eye, _triple(target_mm), None if up is None else _triple(up), field_of_view_rad, width, height, reamer
        )
        return Picture(*drawn)

    def table(self, ticks: npt.ArrayLike) -> dict[str, npt.NDArray[np.float64]]:
        """The columns of trace.csv for these ticks, as `pandas.DataFrame` takes them; depth is `tool_depth_mm`.

        `removed_volume_mm3` counts from the first of them. docs/scripting.md explains each column.
        """
        rows = np.atleast_1d(np.asarray(ticks))
        if rows.size and rows.dtype.names != TICK.names:
            raise _ream.Error("ticks must be rows of type ream.TICK, as step() and run() give them")
        return self._core.table(rows.astype(TICK))

    @property
    def plan(self) -> dict[str, Any]:
        """What is planned, as in plan.json: entry, axis, depth and reamer."""
        told: dict[str, Any] = json.loads(self._core.plan_json())
        return told

    @property
    def tick(self) -> int:
        """The number of ticks that have passed."""
        return self._core.tick

    @property
    def session_hash(self) -> str:
        """A hash of all input and all changes so far, as in metrics.json."""
        return self._core.session_hash

    @property
    def grid_hash(self) -> str:
        """A hash of what is left of the bone, as in metrics.json."""
        return self._core.grid_hash

    @property
    def stiffness_n_mm(self) -> float:
        """Of the spring between handle and reamer, simulated newtons."""
        return self._core.stiffness_n_mm

    @property
    def script_s(self) -> float:
        """How long the script lasts at most, in seconds."""
        return self._core.script_s

    @property
    def backend(self) -> str:
        """What computes: cpu, or the name of an OpenCL device."""
        return self._core.backend

    @property
    def coverage(self) -> npt.NDArray[np.uint8]:
        """What is left of each voxel, 0 to 255, without a copy: it changes with each step.

        Six indices: the brick (z, y, x), then the voxel in it (z, y, x). ream.volume() makes a plain array.
        """
        return self._core.coverage

    @property
    def density(self) -> npt.NDArray[np.uint8]:
        """Density of each voxel, as `coverage`: hundredths of g/cc up to 250, and 255 for cartilage."""
        return self._core.density

    def surface(self, stride: int = 1) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.uint32]]:
        """The bone's surface: vertices (n, 3), mm, in the CT's frame with the bone where it rests, and triangles.

        stride: 1, 2 or 4; a sample each so many voxels.
        """
        return self._core.surface(stride)


def volume(bricks: npt.NDArray[_Kind]) -> npt.NDArray[_Kind]:
    """A copy of `coverage` or `density` as a plain array with indices z, y, x."""
    z, y, x, edge = bricks.shape[:4]
    return bricks.transpose(0, 3, 1, 4, 2, 5).reshape(z * edge, y * edge, x * edge)
