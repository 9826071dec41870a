"""ream for Python: glenoid reaming, stepped tick by tick, and recordings as NumPy arrays.

    import ream

    simulation = ream.Simulation("demo")
    ticks = simulation.run_script()
    print(ticks["thrust_n"].max(), simulation.metrics()["removed_volume_mm3"])

It computes what the program computes, to the bit. Lengths are millimetres, forces newtons, angles radians.
docs/python.md is the guide.
"""

import numpy as _numpy

if int(_numpy.__version__.split(".")[0]) > 1:
    raise ImportError("ream needs NumPy 1, as Debian 12 has it; this is NumPy " + _numpy.__version__)

from ream._ream import Error, Snapshot
from ream._ream import version as __version__
from ream.meshes import Voxels, load_mesh, voxelize
from ream.pictures import Label, Picture
from ream.recording import Recording, open
from ream.simulation import Simulation, volume
from ream.ticks import TICK, Flag, matrices, trigger

# open() is left out: it would hide Python's own from those who import everything.
__all__ = [
    "TICK",
    "Error",
    "Flag",
    "Label",
    "Picture",
    "Recording",
    "Simulation",
    "Snapshot",
    "Voxels",
    "__version__",
    "load_mesh",
    "matrices",
    "trigger",
    "volume",
    "voxelize",
]
