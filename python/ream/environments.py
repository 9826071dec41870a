"""Tasks for controllers, with gymnasium's interface: PushToDepth and FreeHand.

    from ream.environments import PushToDepth

    environment = PushToDepth()
    observation, info = environment.reset(seed=1)
    observation, reward, terminated, truncated, info = environment.step(environment.action_space.sample())

Where gymnasium is installed they are its environments, and `gymnasium.make("ream/PushToDepth-v0")` makes one once
`ream.environments` is imported. The same seed and the same actions give the same bits, in every process.

A step is 20 ms: 50 actions a second. An episode ends when the hand has cut and lifts the reamer off, when it is 3 mm
too deep, or when its time is up.

The reward of a step is how much nearer to the plan it brought the reamer (`closeness()`, as far as the reamer has
got), and on top of it, when the hand has ended the episode, the rubric's points, a hundredth each. So the rewards of a
finished reaming add up to its score, from 0 to 1, and what was gained in closeness. Where time is up (`truncated`) there
are no points.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from ream._gymnasium import Box, Env, register
from ream._ream import Error
from ream.simulation import Simulation
from ream.ticks import Flag

Observation = npt.NDArray[np.float32]
Action = npt.NDArray[np.float32]

#: What an observation holds, in this order. Places and tilts are the reamer's in the plan frame; forces, feed, speed and
#: temperature those of the step's last tick; vibration and what was removed those of the whole step.
OBSERVED: Final = (
    "depth_mm",
    "depth_left_mm",
    "deepest_mm",
    "x_mm",
    "y_mm",
    "tilt_x_rad",
    "tilt_y_rad",
    "thrust_n",
    "torque_n_mm",
    "feed_rate_mm_s",
    "spindle_speed_rad_s",
    "vibration_rms_g",
    "temperature_c",
    "engaged",
    "removed_mm3",
)

_TICKS_A_STEP: Final = 20
#: Of simulated time.
STEP_S: Final = 1e-3 * _TICKS_A_STEP
#: Simulated newtons of the hand at full action.
MAX_PUSH_N: Final = 100.0
#: So far it must come up from the deepest place, free of bone, to have lifted off.
_LIFTED_MM: Final = 2.0
_TOO_DEEP_MM: Final = 3.0
#: In mm and radians: a start further off is a mistake.
_MAX_START: Final = 100.0
#: Of place and of tilt, what halves closeness.
_HALF_MM: Final = 4.0
_HALF_RAD: Final = math.radians(16.0)


def _rotation(tilt_x_rad: float, tilt_y_rad: float) -> npt.NDArray[np.float64]:
    """A unit quaternion w, x, y, z: about x and y at once."""
    angle = math.hypot(tilt_x_rad, tilt_y_rad)
    share = math.sin(0.5 * angle) / angle if angle > 0 else 0.5
    return np.array([math.cos(0.5 * angle), share * tilt_x_rad, share * tilt_y_rad, 0.0])


class Reaming(Env[Observation, Action]):
    """What both tasks have in common: a hand that is not quite steady, what is observed, rewards, and the end."""

    metadata = {"render_modes": ["rgb_array"], "render_fps": 50}

    #: How unsteady the hand is: newtons along the axis, mm across, and radians; standard deviations.
    unsteady_n = 3.0
    unsteady_mm = 0.05
    unsteady_rad = math.radians(0.2)
    #: For how long it stays on one side.
    unsteady_s = 0.15
    #: Where it begins: standard deviations of place across and of tilt, and how far before the planned entry.
    start_offset_mm = 0.3
    start_tilt_rad = math.radians(0.5)
    start_height_mm = 3.0

    def __init__(
        self,
        case: str = "demo",
        *,
        max_time_s: float = 40.0,
        rubric: str | Callable[[dict[str, Any]], float] = "standard",
        render_mode: str | None = None,
        **simulation: Any,
    ) -> None:
        """case, simulation: as those of ream.Simulation. rubric: what the end is judged by, see
        Simulation.score(); or a function of your own that gives points, 0 to 100, for metrics as metrics() has them.

        max_time_s: of an episode, in simulated seconds.
        """
        if render_mode not in (None, "rgb_array"):
            raise Error('render_mode must be "rgb_array" or None')
        if not 0 < max_time_s < 1e6:
            raise Error("max_time_s must be above 0, and below a million")
        self.simulation = Simulation(case, **simulation)
        if not callable(rubric):
            self.simulation.score(rubric)  # refuses what is none
        self.max_steps = math.ceil(max_time_s / STEP_S)
        self.rubric = rubric
        self.render_mode = render_mode
        self.planned_depth_mm = float(self.simulation.plan["depth_mm"])
        low = np.full(len(OBSERVED), -np.inf, np.float32)
        self.observation_space = Box(low, -low, (len(OBSERVED),), np.float32)
        self._voxel_mm3 = float(np.prod(self.simulation.spacing_mm))
        self._ended = True

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.simulation!r}>"

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """A new episode. The same seed begins the same one.

        options: `x_mm`, `y_mm`, `tilt_x_rad`, `tilt_y_rad` and `height_mm` begin at a place of your own.
        """
        super().reset(seed=seed)
        self._ended = True
        chance = self.np_random
        start = {
            "x_mm": chance.normal(0.0, self.start_offset_mm),
            "y_mm": chance.normal(0.0, self.start_offset_mm),
            "tilt_x_rad": chance.normal(0.0, self.start_tilt_rad),
            "tilt_y_rad": chance.normal(0.0, self.start_tilt_rad),
            "height_mm": self.start_height_mm,
        }
        for name, value in (options or {}).items():
            if name not in start:
                raise Error(f"there is no option {name!r}; there are " + ", ".join(start))
            start[name] = float(value)
            if not abs(start[name]) <= _MAX_START:
                raise Error(f"{name} must be a number from -{_MAX_START:g} to {_MAX_START:g}, not {value!r}")
        #: Where the hand holds the handle across the axis: x, y, and tilts about x and y.
        self._hand = np.array([start[name] for name in ("x_mm", "y_mm", "tilt_x_rad", "tilt_y_rad")])
        self._unsteady = np.zeros(5)
        self._steps = 0
        self._has_cut = False
        self._begin(start["height_mm"])
        self._remember()
        self._ended = False
        return self._observe(), {}

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """20 ms of the hand. The last step's info has `score` and `metrics`."""
        if self._ended:
            raise Error("the episode has ended; call reset()")
        asked = np.asarray(action, float)
        if asked.shape != self.action_space.shape or not np.isfinite(asked).all():
            raise Error(f"an action is {self.action_space.shape[0]} finite numbers")
        push, across, trigger = self._decided(np.clip(asked, self.action_space.low, self.action_space.high))
        before = self._closeness
        self._move(push, across, trigger)
        self._remember()
        terminated = self._lifted() or self._depth > self.planned_depth_mm + _TOO_DEEP_MM
        truncated = not terminated and self._steps >= self.max_steps
        reward = self._closeness - before
        info: dict[str, Any] = {}
        if terminated or truncated:
            self._ended = True
            info["metrics"] = self.simulation.metrics()
            info["score"] = self._score(info["metrics"])
            if terminated:
                reward += (info["score"]["points"] or 0.0) / 100.0
        return self._observe(), float(reward), terminated, truncated, info

    def render(self) -> npt.NDArray[np.uint8] | None:
        """What a camera in front of the glenoid sees, (240, 320, 3); None without render_mode "rgb_array"."""
        return self.simulation.picture().rgb if self.render_mode == "rgb_array" else None

    @property
    def last_ticks(self) -> npt.NDArray[np.void]:
        """The ticks of the last step, or the one of reset(): rows of type ream.TICK."""
        return self._ticks

    def closeness(self) -> float:
        """How near the plan is, from 1 (there) towards 0 (far away).

        Depth and place across count by the millimetre and tilt by the radian. What counts is the deepest place that
        was reached, as bone does not grow back.
        """
        depth, x_mm, y_mm, tilt_x, tilt_y = self._reached
        left = abs(self.planned_depth_mm - depth)
        apart = (left + math.hypot(x_mm, y_mm)) / _HALF_MM + math.hypot(tilt_x, tilt_y) / _HALF_RAD
        return 1.0 / (1.0 + apart)

    def _score(self, metrics: dict[str, Any]) -> dict[str, Any]:
        if callable(self.rubric):
            return {"points": float(self.rubric(metrics)), "outcome": None}
        return self.simulation.score(self.rubric)

    def _decided(self, action: npt.NDArray[np.float64]) -> tuple[float, npt.NDArray[np.float64], float]:
        """Of an action within its bounds: push in N, how far the hand moves x, y and tilts, and the trigger."""
        raise NotImplementedError

    def _begin(self, height_mm: float) -> None:
        """Puts the reamer at the start, further away where it would lie in bone."""
        for further in range(20):
            self.simulation.reset()
            try:
                self._handle = np.array([self._hand[0], self._hand[1], -height_mm - 2.0 * further, *self._hand[2:]])
                self._ticks = self.simulation.run(self._poses(self._handle[None]), 0.0)
                return
            except Error as error:
                if error.kind != "invalid_input":
                    raise
        raise Error("there is bone wherever the reamer could begin; choose another case or start")

    @staticmethod
    def _poses(handles: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Rows x, y, z, tilt x, tilt y as rows of poses."""
        return np.array([[*handle[:3], *_rotation(handle[3], handle[4])] for handle in handles])

    def _move(self, push_n: float, across: npt.NDArray[np.float64], trigger: float) -> None:
        kept = math.exp(-STEP_S / self.unsteady_s)
        self._unsteady = kept * self._unsteady + math.sqrt(1.0 - kept * kept) * self.np_random.normal(size=5)
        push_n += self.unsteady_n * self._unsteady[0]
        self._hand = self._hand + across
        amounts = np.array([self.unsteady_mm, self.unsteady_mm, self.unsteady_rad, self.unsteady_rad])
        x_mm, y_mm, tilt_x, tilt_y = self._hand + amounts * self._unsteady[1:]
        # The spring between handle and reamer gives the push.
        z_mm = self._depth + push_n / self.simulation.stiffness_n_mm
        target = np.array([x_mm, y_mm, z_mm, tilt_x, tilt_y])
        shares = np.arange(1, _TICKS_A_STEP + 1)[:, None] / _TICKS_A_STEP
        handles = self._handle + shares * (target - self._handle)
        self._handle = target
        self._ticks = self.simulation.run(self._poses(handles), trigger)
        self._steps += 1

    def _remember(self) -> None:
        """Where the reamer is, and the deepest place that counts."""
        plan_from_tool = self.simulation.plan_from_tool(self._ticks[-1:])[0]
        x_mm, y_mm, depth = plan_from_tool[:3, 3]
        axis = plan_from_tool[:3, 2]
        # About x it tips the axis towards -y, about y towards x.
        here = np.array([depth, x_mm, y_mm, math.atan2(-axis[1], axis[2]), math.atan2(axis[0], axis[2])])
        self._depth = float(depth)
        self._place = here
        removed = sum(int(self._ticks[f"removed_{kind}"].sum()) for kind in ("cancellous", "cortical", "cartilage"))
        self._removed_mm3 = removed / 255.0 * self._voxel_mm3
        if not self._has_cut or depth > self._reached[0]:
            self._reached = here
        self._has_cut = self._has_cut or removed > 0
        self._closeness = self.closeness()

    def _engaged(self) -> bool:
        return bool(int(self._ticks[-1]["flags"]) & Flag.ENGAGED)

    def _lifted(self) -> bool:
        return self._has_cut and not self._engaged() and bool(self._reached[0] - self._depth >= _LIFTED_MM)

    def _observe(self) -> Observation:
        last = self._ticks[-1]
        depth, x_mm, y_mm, tilt_x, tilt_y = self._place
        vibration = self._ticks["vibration_g"].astype(float)
        return np.array(
            [
                depth,
                self.planned_depth_mm - self._reached[0],
                self._reached[0],
                x_mm,
                y_mm,
                tilt_x,
                tilt_y,
                last["thrust_n"],
                last["spindle_torque_n_mm"],
                last["feed_rate_mm_s"],
                last["spindle_speed_rad_s"],
                math.sqrt(float(np.mean(vibration * vibration))),
                last["surface_temperature_c"],
                float(self._engaged()),
                self._removed_mm3,
            ],
            np.float32,
        )


class PushToDepth(Reaming):
    """Ream to the planned depth, on the planned axis.

    The hand holds place and tilt by itself. An action has two numbers: push along the axis, from -1 (100 N away from
    the bone) to 1 (100 N onto it), and trigger, from 0 to 1.
    """

    def __init__(self, case: str = "demo", **options: Any) -> None:
        """As Reaming."""
        super().__init__(case, **options)
        self.action_space = Box(np.array([-1.0, 0.0], np.float32), np.array([1.0, 1.0], np.float32), (2,), np.float32)

    def _decided(self, action: npt.NDArray[np.float64]) -> tuple[float, npt.NDArray[np.float64], float]:
        return MAX_PUSH_N * action[0], np.zeros(4), float(action[1])


class FreeHand(Reaming):
    """Find the planned axis, and ream to the planned depth.

    The hand begins some mm beside the axis and some degrees off. An action has six numbers: push and trigger as
    PushToDepth, and between them how fast the hand moves x and y, from -1 to 1 for 10 mm/s, and tilts about x and y,
    from -1 to 1 for 0.5 rad/s.
    """

    start_offset_mm = 2.5
    start_tilt_rad = math.radians(5.0)
    start_height_mm = 8.0

    max_speed_mm_s: Final = 10.0
    max_turn_rad_s: Final = 0.5

    def __init__(self, case: str = "demo", **options: Any) -> None:
        """As Reaming."""
        super().__init__(case, **options)
        low = np.array([-1.0, -1.0, -1.0, -1.0, -1.0, 0.0], np.float32)
        self.action_space = Box(low, np.ones(6, np.float32), (6,), np.float32)

    def _decided(self, action: npt.NDArray[np.float64]) -> tuple[float, npt.NDArray[np.float64], float]:
        most = np.array([self.max_speed_mm_s, self.max_speed_mm_s, self.max_turn_rad_s, self.max_turn_rad_s])
        return MAX_PUSH_N * action[0], STEP_S * most * action[1:5], float(action[5])


#: By the names that commands have for them.
TASKS: Final[dict[str, type[Reaming]]] = {"push-to-depth": PushToDepth, "free-hand": FreeHand}

register(id="ream/PushToDepth-v0", entry_point="ream.environments:PushToDepth")
register(id="ream/FreeHand-v0", entry_point="ream.environments:FreeHand")
