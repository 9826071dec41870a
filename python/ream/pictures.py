"""What a camera sees of bone and reamer."""

from __future__ import annotations

import enum
from typing import NamedTuple

import numpy as np
import numpy.typing as npt


class Label(enum.IntEnum):
    """What a pixel of Picture.labels shows."""

    NOTHING = 0
    CANCELLOUS = 1
    CORTICAL = 2
    CARTILAGE = 3
    REAMER = 4


class Picture(NamedTuple):
    """A picture of (height, width) pixels, top row first. All of its arrays show the same rays."""

    #: Colours for people, (height, width, 3).
    rgb: npt.NDArray[np.uint8]
    #: Distance along the viewing direction, mm; infinite where nothing is seen.
    depth_mm: npt.NDArray[np.float32]
    #: Label of each pixel.
    labels: npt.NDArray[np.uint8]
    #: Where the bone that is seen was cut.
    cut: npt.NDArray[np.bool_]
