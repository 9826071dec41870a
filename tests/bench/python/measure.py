"""Measures the package for Python and prints the figures as JSON; `ream bench python` shows them.

REAM_BIN is the program, REAM_DATA a data folder of its own.
"""

import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import time

import numpy as np
import ream

FOLDER = pathlib.Path(os.environ["REAM_DATA"])
MINUTES = 10
RESETS = 10_000


def long_script() -> dict:
    """A hand with tremor presses and lets go, ten minutes long, so slowly that the reamer stays in the vault."""
    pushes = []
    for second in range(0, 60 * MINUTES, 4):
        pushes += [{"t_s": second, "force_n": 0}, {"t_s": second + 0.5, "force_n": 55}]
        pushes += [{"t_s": second + 3.0, "force_n": 55}, {"t_s": second + 3.5, "force_n": -5}]
    return {
        "device": "hand",
        "duration_s": 60 * MINUTES,
        "spindle_rpm": 25,
        "specimen_factor": 0.1,
        "hand": {"start_mm": [0, 0, -2], "tremor_rms_n": 5, "force_profile": pushes},
    }


def resident_mb() -> float:
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def differing(a: np.ndarray, b: np.ndarray) -> int:
    """Rows of which any field differs, and those that one has more."""
    rows = min(len(a), len(b))
    unlike = np.zeros(rows, bool)

    for name in a.dtype.names:  # byte for byte: a row has no gaps within a field
        x, y = (np.ascontiguousarray(side[name][:rows]).view(np.uint8).reshape(rows, -1) for side in (a, b))
        unlike |= (x != y).any(axis=1)
    return int(unlike.sum()) + abs(len(a) - len(b))


def against_the_program() -> dict[str, float]:
    script = long_script()
    path = FOLDER / "long.json"
    path.write_text(json.dumps(script))
    out = FOLDER / "long"
    words = ["simulate", "--case", "demo", "--script", str(path), "--backend", "cpu", "--out", str(out)]
    subprocess.run([os.environ["REAM_BIN"], *words], check=True, stdout=sys.stderr)
    begun = time.perf_counter()
    recorded = ream.open(out).ticks()
    read_s = time.perf_counter() - begun
    ticks = ream.Simulation("demo", script=script).run_script()
    if not (ticks["flags"] & ream.Flag.CUTTING).any():
        raise SystemExit("the reamer of ten minutes did not cut")
    return {
        "compared_ticks": float(min(len(ticks), len(recorded))),
        "differing_ticks": float(differing(ticks, recorded)),
        "read_mb_s": (out / "recording.ream").stat().st_size / 1e6 / read_s,
    }


def speed() -> dict[str, float]:
    simulation = ream.Simulation("demo")
    begun = time.perf_counter()
    ticks = simulation.run_script()
    demo_s = time.perf_counter() - begun
    snapshot = simulation.snapshot()
    restores = []
    for _ in range(11):
        begun = time.perf_counter()
        simulation.restore(snapshot)
        restores.append(time.perf_counter() - begun)
    simulation.reset()
    away = np.tile([0.0, 0.0, -30.0], (20_000, 1))
    rows, steps = [], []
    for _ in range(5):
        begun = time.perf_counter()
        simulation.run(away)
        rows.append((time.perf_counter() - begun) / len(away))
        begun = time.perf_counter()
        for pose in away:
            simulation.step(pose)
        steps.append((time.perf_counter() - begun) / len(away))
    return {
        "demo_ticks_1_s": len(ticks) / demo_s,
        "row_us": 1e6 * statistics.median(rows),
        "step_us": 1e6 * statistics.median(steps),
        "restore_ms": 1e3 * statistics.median(restores),
        "snapshot_kb": snapshot.bytes / 1e3,
    }


def resets() -> dict[str, float]:
    """Each with some bone cut away; the first hundred are left out, as what they take is kept for the next."""
    simulation = ream.Simulation("demo")
    poses = np.zeros((20, 3))
    poses[:, 2] = np.linspace(-1.0, 1.0, 20)
    took = np.zeros(RESETS + 100)
    before = 0.0
    for i in range(RESETS + 100):
        if i == 100:
            before = resident_mb()
        simulation.run(poses)
        begun = time.perf_counter()
        simulation.reset()
        took[i] = time.perf_counter() - begun
    return {"resets_mb": resident_mb() - before, "reset_ms": 1e3 * float(np.median(took))}


os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})  # one core
print(json.dumps({**speed(), **resets(), **against_the_program()}))
