"""ream has LPS, 3D Slicer has RAS; both in mm.

LPS: x to the patient's left, y to the back, z to the head. RAS: x to the right, y to the front, z to the head. Between them
is half a turn about z, so directions keep their handedness and surfaces their outside.
"""

from __future__ import annotations

import numpy as np

_FLIP = np.array([-1.0, -1.0, 1.0])


def ras_from_lps(vectors) -> np.ndarray:
    """Points or directions (..., 3) of LPS in RAS. The same function leads back."""
    found = np.asarray(vectors)
    if found.shape[-1:] != (3,):
        raise ValueError("points have three coordinates")
    return (found * _FLIP).astype(found.dtype if found.dtype.kind == "f" else float)


lps_from_ras = ras_from_lps
