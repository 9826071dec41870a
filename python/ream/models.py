"""What you can write yourself: feed models, and devices."""

from __future__ import annotations

from typing import NamedTuple, Protocol, Union

import numpy as np
import numpy.typing as npt


class EngagedBone(NamedTuple):
    """Bone under the reamer's cutting surface in one tick."""

    #: Cancellous, cortical, cartilage: share of the engaged cutting edge. They add up to 1.
    share: tuple[float, float, float]
    #: Mean density of each of them, g/cc.
    density_g_cc: tuple[float, float, float]
    #: Of the cutting surface that is engaged, mm2.
    area_mm2: float
    #: Cutting edge that resists motion along the axis, mm.
    edge_mm: float
    #: Over all of them, g/cc.
    mean_density_g_cc: float


#: resistance_n_s_mm: thrust divided by feed rate. torque_arm_mm: torque on the spindle divided by thrust.
#: tangential_ratio: load along the lips' path over that along the normal; above 0 it gives torque and sideways
#: force by place, in place of the arm.
CuttingLoad = Union[float, tuple[float], tuple[float, float], tuple[float, float, float]]


class FeedModel(Protocol):
    """How fast a turning reamer sinks into bone, and what turns it.

    An object with such a `load` goes to Simulation as `feed_model`. It is called in each tick in which the reamer
    touches bone, and should depend on nothing but its arguments: then reset() and restore() give the same bits.
    What it raises, a Ctrl-C among it, ends the simulation until reset() or restore().
    """

    def load(self, bone: EngagedBone, thrust_n: float) -> CuttingLoad:
        """The resistance in N s/mm alone, or (resistance_n_s_mm, torque_arm_mm, tangential_ratio).

        thrust_n: simulated, of the tick before, for laws that are not linear in it.
        """
        ...


class Device(Protocol):
    """A hand, a robot or a controller, asked once a millisecond: see Simulation.run_device()."""

    def read(self) -> tuple[npt.ArrayLike, float] | None:
        """The handle's pose in the plan frame and the trigger, as for Simulation.step(); None at the end."""
        ...

    def write(self, tick: np.void) -> None:
        """What came of it: a row of type ream.TICK. `hand_force_x_n`, _y_n and _z_n are what the hand feels."""
        ...
