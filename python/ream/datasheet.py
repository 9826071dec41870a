"""What a data set says of itself, by the questions of Gebru et al., Datasheets for Datasets (2018)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ream.environments import OBSERVED

_TEXT = """# Datasheet

Written by `ream.dataset` of ream {version}. The questions are those of Gebru et al., *Datasheets for Datasets* (2018).

## Why was it made?

To train and compare programs that estimate or control glenoid reaming: force from motion, depth and segmentation from
pictures, what is left of the bone, a score before the end.

## What is in it?

{count} simulated reamings of case `{case}`: task `{task}`, controller `{controller}`, seed {seed}. All are of one bone:
what is learned from them says nothing yet of other bones.

| file | what |
|---|---|
| `index.h5` | each metric and score as an array with a number for each reaming; links to the files as `reamings/000000` |
| `reaming-000000.h5` ... | one reaming each |
| `case.h5` | the bone before anything was removed: `coverage` (0 to 255) and `density` (hundredths of g/cc; 255: cartilage) |
| `dataset.json` | what it was made with |

Of each reaming:

| place | shape | what |
|---|---|---|
| `ticks/*` | n | each column of trace.csv at 1 kHz: poses, forces, torque, feed, vibration, temperature |
| `steps/observations` | m + 1, {observed} | what the controller saw, 50 times a second; attribute `observed` names the columns |
| `steps/actions`, `steps/rewards` | m | what it did, and what that was worth |
| `pictures/rgb` | k, {height}, {width}, 3 | for people |
| `pictures/depth_mm` | k, {height}, {width} | along the viewing direction; infinite where nothing is seen |
| `pictures/labels` | k, {height}, {width} | 0 nothing, 1 cancellous, 2 cortical, 3 cartilage, 4 reamer |
| `pictures/cut` | k, {height}, {width} | bone that was cut |
| `pictures/tick` | k | when |
| `bone/removed` | z, y, x | coverage that is gone, 0 to 255 a voxel |
| attributes | | `seed`, `return`, `metrics`, `score` (JSON), `session_hash`, `grid_hash` |

| in this data set | least | mean | most |
|---|---|---|---|
{figures}

{passed} of {count} pass.

## How was it made?

By simulation alone: no person and no patient is in it, unless the case is a patient's. The hand is a program with
chance in it, not a surgeon: how its errors are distributed is ours. Cutting forces, heat and vibration are those of
ream's models, with the limits that its validity report names. The tracks of vibration are the same in every reaming: what differs is
where the hand pushes.

## Was anything left out or changed?

Nothing is left out: numbers are seeds `{seed}` x 1,000,000 + index, in order. Columns of `ticks` are rounded to 32 bits.

## Can it be made again?

Yes. The same version of ream, case and settings give the same files, byte for byte, on machines of one kind. The
attribute `session_hash` of a file is that of the whole session.

## What should it not be used for?

For decisions about patients, and for saying how well a person reams.

## Under which licence, and who looks after it?

Whoever made it decides. Say here who that is.
"""


def _row(name: str, column: npt.NDArray[np.float64]) -> str:
    there = column[~np.isnan(column)]
    return f"| `{name}` | {there.min():.4g} | {there.mean():.4g} | {there.max():.4g} |"


def datasheet(settings: dict[str, Any], columns: dict[str, npt.NDArray[np.float64]], version: str) -> str:
    """The text of DATASHEET.md. `columns`: those of index.h5."""
    shown = ("points", "depth_error_mm", "axis_error_deg", "entry_error_mm", "removed_volume_mm3")
    shown += ("axial_thrust_mean_n", "axial_thrust_peak_n", "ticks")
    return _TEXT.format(
        version=version,
        count=len(columns["seed"]),
        case=settings["case"],
        task=settings["task"],
        controller=settings["controller"],
        seed=settings["seed"],
        observed=len(OBSERVED),
        width=settings["picture_width"],
        height=settings["picture_height"],
        figures="\n".join(_row(name, columns[name]) for name in shown if name in columns),
        passed=int(columns["passed"].sum()),
    )
