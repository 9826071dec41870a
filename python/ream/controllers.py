"""Controllers of the tasks in ream.environments, to compare one's own with.

    python3 -m ream.controllers --task free-hand --controller reference --episodes 20
"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from ream._ream import Error
from ream.environments import MAX_PUSH_N, OBSERVED, STEP_S, TASKS, Action, FreeHand, Observation, Reaming


class Controller(Protocol):
    """Decides what the hand does. One is made for each episode:

        class MyController:
            def __init__(self, environment, chance):    # ream.environments.Reaming, numpy.random.Generator
                self.chance = chance
            def __call__(self, observation):             # OBSERVED names its numbers; seen() finds one
                return [0.5, 1.0]                        # of push-to-depth: push and trigger
    """

    def __call__(self, observation: Observation) -> Action:
        """The action for what was observed."""
        ...


#: Makes a controller: for an environment, and with the chance of an episode of its own.
ControllerFactory = Callable[[Reaming, np.random.Generator], Controller]

_PLACE = {name: index for index, name in enumerate(OBSERVED)}


def seen(observation: Observation, name: str) -> float:
    """One number of an observation by its name in OBSERVED."""
    return float(observation[_PLACE[name]])


class Random:
    """Evenly from the whole space of actions."""

    def __init__(self, environment: Reaming, chance: np.random.Generator) -> None:
        self._space = environment.action_space
        self._chance = chance

    def __call__(self, observation: Observation) -> Action:
        action: Action = self._chance.uniform(self._space.low, self._space.high).astype(np.float32)
        return action


class Reference:
    """Aligns before it touches, pushes evenly, lets hot bone cool, slows down before the planned depth, and lifts off.

    FreeHand's errors are taken out in proportion, as fast as the task allows.
    """

    #: Within the thesis' forces (52 N on average).
    push_n = 55.0
    #: From so far before the plan it pushes less.
    slow_mm = 0.1
    slow_push_n = 38.0
    #: Short of the plan by what the reamer still cuts when the push ends.
    stop_mm = 0.03
    approach_n = 25.0
    #: Bone dies at 56 degrees (Eriksson and Albrektsson): from here on it pushes with approach_n until it is cooler.
    hot_c = 55.0
    cooler_c = 53.0
    #: Of each step, of what is off.
    gain = 0.25
    aligned_mm = 0.15
    aligned_rad = 0.008

    def __init__(self, environment: Reaming, chance: np.random.Generator) -> None:
        self._free = isinstance(environment, FreeHand)
        self._aligned = not self._free
        self._done = False
        self._hot = False

    def __call__(self, observation: Observation) -> Action:
        push, trigger = self._push(observation)
        if not self._free:
            return np.array([push, trigger], np.float32)
        return np.array([push, *self._across(observation), trigger], np.float32)

    def _push(self, observation: Observation) -> tuple[float, float]:
        left = seen(observation, "depth_left_mm")
        self._done = self._done or left <= self.stop_mm
        if self._done:
            return -0.4, 0.0
        if not self._aligned:
            return 0.0, 0.0
        temperature_c = seen(observation, "temperature_c")
        self._hot = temperature_c > (self.cooler_c if self._hot else self.hot_c)
        if self._hot or not seen(observation, "engaged"):
            return self.approach_n / MAX_PUSH_N, 1.0
        return (self.push_n if left > self.slow_mm else self.slow_push_n) / MAX_PUSH_N, 1.0

    def _across(self, observation: Observation) -> list[float]:
        mm = np.array([seen(observation, "x_mm"), seen(observation, "y_mm")])
        rad = np.array([seen(observation, "tilt_x_rad"), seen(observation, "tilt_y_rad")])
        if np.hypot(*mm) < self.aligned_mm and np.hypot(*rad) < self.aligned_rad:
            self._aligned = True
        if self._done:
            return [0.0] * 4
        each_step = STEP_S * np.array([FreeHand.max_speed_mm_s] * 2 + [FreeHand.max_turn_rad_s] * 2)
        moves = -self.gain * np.concatenate([mm, rad]) / each_step
        return [float(move) for move in np.clip(moves, -1.0, 1.0)]


class Varied(Reference):
    """As people are: each episode it pushes harder or less, aligns better or worse, and stops early or late."""

    def __init__(self, environment: Reaming, chance: np.random.Generator) -> None:
        super().__init__(environment, chance)
        self.push_n = float(chance.uniform(35.0, 95.0))
        self.slow_push_n = min(self.push_n, float(chance.uniform(30.0, 60.0)))
        self.slow_mm = float(chance.uniform(0.0, 0.6))
        self.stop_mm = float(chance.normal(0.03, 0.3))
        self.aligned_mm = float(chance.uniform(0.1, 2.0))
        self.aligned_rad = float(chance.uniform(0.005, 0.06))
        self.gain = float(chance.uniform(0.03, 0.3))
        self.hot_c = float(chance.uniform(50.0, 80.0))
        self.cooler_c = self.hot_c - 2.0


CONTROLLERS: dict[str, ControllerFactory] = {"reference": Reference, "varied": Varied, "random": Random}


def find_controller(name: str) -> ControllerFactory:
    """By a name in CONTROLLERS, or "module:name" of your own. Raises ream.Error where there is none."""
    if name in CONTROLLERS:
        return CONTROLLERS[name]
    module, _, attribute = name.partition(":")
    if not attribute:
        raise Error(f"there is no controller {name!r}; there are {', '.join(CONTROLLERS)}, or module:name of your own")
    try:
        found: ControllerFactory = getattr(importlib.import_module(module), attribute)
    except (ImportError, AttributeError) as failure:
        raise Error(f"the controller {name!r} cannot be had: {failure}") from None
    return found


#: Sees the observation that an episode begins with, and then each step's observation, action and reward.
Watcher = Callable[[Observation, "Action | None", float], None]


def run_episode(
    environment: Reaming, factory: ControllerFactory, seed: int, watch: Watcher = lambda *_: None
) -> dict[str, Any]:
    """One episode to its end: `return`, `steps`, and the last info's `score` and `metrics`."""
    observation, _ = environment.reset(seed=seed)
    try:
        controller = factory(environment, np.random.default_rng([seed, 1]))
    except TypeError as failure:
        raise Error(f"a controller is made as MyController(environment, chance): {failure}") from failure
    watch(observation, None, 0.0)
    total, steps, ended = 0.0, 0, False
    info: dict[str, Any] = {}
    while not ended:
        action = controller(observation)
        observation, reward, terminated, truncated, info = environment.step(action)
        watch(observation, action, reward)
        total += reward
        steps += 1
        ended = terminated or truncated
    return {"return": total, "steps": steps, **info}


def main(words: list[str] | None = None) -> int:
    """Runs episodes and prints what each was worth."""
    parser = argparse.ArgumentParser(prog="python3 -m ream.controllers", description=main.__doc__)
    parser.add_argument("--task", choices=TASKS, default="push-to-depth", help="default: %(default)s")
    parser.add_argument(
        "--controller", default="reference", help=f"{', '.join(CONTROLLERS)}, or module:name; default: %(default)s"
    )
    parser.add_argument("--case", default="demo", help="default: %(default)s")
    parser.add_argument("--episodes", type=int, default=10, help="default: %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="of the first; default: %(default)s")
    asked = parser.parse_args(words)
    try:
        factory = find_controller(asked.controller)
        environment = TASKS[asked.task](asked.case)
        points = []
        print("seed  seconds  depth error mm  points  outcome    return")
        for seed in range(asked.seed, asked.seed + asked.episodes):
            episode = run_episode(environment, factory, seed)
            score, error = episode["score"], episode["metrics"]["depth_error_mm"]
            points.append(score["points"] or 0.0)
            print(
                f"{seed:4}  {STEP_S * episode['steps']:7.2f}  {'-' if error is None else format(error, '.2f'):>14}"
                f"  {points[-1]:6.1f}  {score.get('outcome') or '-':9}  {episode['return']:6.3f}"
            )
    except Error as error:
        print(f"ream.controllers: {error}", file=sys.stderr)
        return 2 if error.kind == "usage" else 1
    if points:
        print(f"points: mean {np.mean(points):.1f}, standard deviation {np.std(points):.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
