"""Recordings without a server."""

from __future__ import annotations

import json
import os
from typing import Any

import numpy as np
import numpy.typing as npt

from ream import _ream
from ream.ticks import Frames

_MANY_TICKS = 2**40
#: Fields of the header that are JSON themselves.
_JSON_FIELDS = ("settings", "plan", "grid", "description", "tables", "anatomy")


class Recording(Frames):
    """A recording.ream. Its ticks are read when they are asked for."""

    _core: _ream.Recording

    def __init__(self, name: str | os.PathLike[str], data: str | os.PathLike[str] | None = None) -> None:
        """name: a file, a session's folder, or the id of a session in the data folder `data`."""
        self._core = _ream.Recording(os.fspath(name), data)
        self._data = data
        notes = json.loads(self._core.notes_json())
        #: What was simulated, by which build; settings, plan and grid among it.
        self.header: dict[str, Any] = notes["header"]
        for field in _JSON_FIELDS:
            self.header[field] = json.loads(self.header[field]) if self.header[field] else None
        #: Which reamer was used, and from which tick on.
        self.segments: list[dict[str, Any]] = notes["segments"]
        self.events: list[dict[str, Any]] = notes["events"]
        self.annotations: list[dict[str, Any]] = notes["annotations"]
        #: How it was closed; None where it never was.
        self.end: dict[str, Any] | None = notes["end"]
        self.path: str = notes["path"]
        #: What is damaged and left out; empty for a whole file.
        self.damage: str = notes["damage"]

    def __repr__(self) -> str:
        return f"<ream.Recording {self.path!r}, {len(self)} ticks>"

    def __len__(self) -> int:
        return self._core.tick_count

    def ticks(self, first: int = 0, last: int | None = None) -> npt.NDArray[np.void]:
        """Rows of type ream.TICK, from tick `first` to before `last`; all of them by default.

        help(ream.ticks) lists the fields. Ticks that the recording does not have are left out.
        """
        rows: npt.NDArray[np.void] = self._core.ticks(first, _MANY_TICKS if last is None else last)
        return rows

    def table(self, first: int = 0, last: int | None = None) -> dict[str, npt.NDArray[np.float64]]:
        """The columns of trace.csv for these ticks, as `pandas.DataFrame` takes them; depth is `tool_depth_mm`.

        docs/scripting.md explains each column.
        """
        return self._core.table(first, _MANY_TICKS if last is None else last)

    def coverage(self, tick: int | None = None, *, case: str | os.PathLike[str] = "") -> npt.NDArray[np.uint8]:
        """The bone after `tick` ticks, as Simulation.coverage has it; by default at the end.

        A recording keeps the bone every 0.25 s: you get the last such moment before. It needs the case: `case` is
        its folder, when it is not in the data folder.
        """
        return self._core.coverage(len(self) if tick is None else tick, os.fspath(case), self._data)

    def verify(self, *, backend: str = "cpu", case: str | os.PathLike[str] = "") -> dict[str, Any]:
        """Computes every tick again and compares: `same`, and the first `difference` in words."""
        told: dict[str, Any] = json.loads(self._core.verify_json(backend, os.fspath(case), self._data))
        return told


def open(name: str | os.PathLike[str], data: str | os.PathLike[str] | None = None) -> Recording:
    """The recording of that name: a file, a session's folder, or a session's id."""
    return Recording(name, data)
