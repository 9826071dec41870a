"""Rows of ticks: what a device sent, what was decided, and what followed, once a millisecond.

| field | unit | meaning |
|---|---|---|
| tick | | number of the tick, which lasts a millisecond |
| flags | | bits, see Flag; trigger() reads the one number among them |
| world_from_handle, grid_from_tool | | poses, see matrices() |
| world_from_bone_rest | | how far a mount has let the bone move |
| session_hash | | of all causes and changes up to this tick |
| thrust_n | N | simulated force of the bone along the reamer's axis |
| torque_n_mm, spindle_torque_n_mm | N mm | on the reamer about its apex; what turns the spindle |
| guide_force_n | N | that a guide or the pilot hole takes |
| hand_force_x_n, _y_n, _z_n | N | sent to the device, world frame, divided by the force scale, with its vibration |
| hand_vibration_x_n, ... | N | the part of it that is vibration |
| hand_torque_x_n_mm, ... | N mm | sent to the device |
| vibration_g | g | of the reamer, by cutting |
| feed_rate_mm_s | mm/s | of the reamer along its axis, while it touches bone |
| density_g_cc, share_cancellous, _cortical, _cartilage | g/cc, 1 | of the bone that is touched |
| engaged_points | | points of the reamer that touch |
| removed_cancellous, _cortical, _cartilage | 1/255 voxel | removed in this tick |
| changed_bricks | | bricks that this tick changed |
| spindle_speed_rad_s | rad/s | as simulated; in reverse negative |
| surface_temperature_c | °C | of the bone under the reamer |

table() of a Simulation or Recording gives the columns of trace.csv, with the depth among them.
"""

from __future__ import annotations

import enum

import numpy as np
import numpy.typing as npt

from ream import _ream

#: The NumPy type of a row. A pose has the fields `rotation_q30` and `translation_nm`.
TICK: np.dtype[np.void] = _ream.tick_dtype


class Flag(enum.IntFlag):
    """Bits of the field `flags`: `(ticks["flags"] & ream.Flag.CUTTING) != 0`."""

    #: The spindle is on.
    SPINDLE_ON = 1
    #: The session rests.
    PAUSED = 2
    #: The device that computed failed in this tick; the C++ form has taken over.
    FAILED_OVER = 4
    #: The reamer touches bone.
    ENGAGED = 8
    #: It cuts: it is pressed enough, turns, and its lips have bone.
    CUTTING = 16
    #: The hand feels clearly less than the simulated force: a limit is at work.
    WEAKENED = 32
    #: The pose was too old.
    STALE = 64
    #: The spindle turns the other way.
    REVERSED = 128
    #: The bone is irrigated.
    IRRIGATING = 256
    #: The drive cannot turn the reamer.
    STALLED = 512


def trigger(ticks: npt.NDArray[np.void]) -> npt.NDArray[np.float64]:
    """How far the trigger was pressed, 0 to 1; 0 where the spindle was off."""
    pressed: npt.NDArray[np.float64] = 1.0 - (ticks["flags"] >> 16 & 255) / 255.0
    return np.where(ticks["flags"] & Flag.SPINDLE_ON, pressed, 0.0)


def matrices(poses: npt.NDArray[np.void]) -> npt.NDArray[np.float64]:
    """Homogeneous matrices (..., 4, 4), translations in mm, of poses such as `ticks["grid_from_tool"]`."""
    made = np.zeros(poses.shape + (4, 4))
    made[..., :3, :3] = poses["rotation_q30"].reshape(poses.shape + (3, 3)) / 2.0**30
    made[..., :3, 3] = poses["translation_nm"] * 1e-6
    made[..., 3, 3] = 1.0
    return made


class Frames:
    """What leads from frame to frame, with the bone where it rests. A mount may let it move from there."""

    _core: _ream.Simulation | _ream.Recording

    @property
    def world_from_plan(self) -> npt.NDArray[np.float64]:
        """From the plan frame (origin at the planned entry, z into the bone) to the world, the CT's (LPS): (4, 4)."""
        return self._core.world_from_plan

    @property
    def world_from_grid(self) -> npt.NDArray[np.float64]:
        """From the bone's grid, mm from its first corner, to the world: (4, 4)."""
        return self._core.world_from_grid

    @property
    def spacing_mm(self) -> tuple[float, float, float]:
        """Edges of a voxel along x, y, z."""
        return self._core.spacing_mm

    def plan_from_tool(self, ticks: npt.NDArray[np.void]) -> npt.NDArray[np.float64]:
        """Where the reamer is in the bone: matrices (..., 4, 4) to the plan frame, which moves with the bone.

        The reamer's origin is the apex of its cutting surface. `[..., 2, 3]` is its depth past the planned entry.
        """
        plan_from_grid = np.linalg.inv(self.world_from_plan) @ self.world_from_grid
        found: npt.NDArray[np.float64] = plan_from_grid @ matrices(ticks["grid_from_tool"])
        return found
