"""Gymnasium's interface where it is installed; else the little of it that an environment needs.

The names and their behaviour are those of gymnasium 0.26 to 1.x (https://gymnasium.farama.org/api/env/).
"""

from __future__ import annotations

from typing import Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

try:
    from gymnasium import Env, register
    from gymnasium.spaces import Box

    INSTALLED = True
except ImportError:
    INSTALLED = False
    _Observation = TypeVar("_Observation")
    _Action = TypeVar("_Action")

    class Box:  # type: ignore[no-redef]
        """Arrays of one shape, each number between two bounds."""

        def __init__(self, low: Any, high: Any, shape: tuple[int, ...], dtype: Any, seed: int | None = None) -> None:
            self.shape = shape
            self.dtype = np.dtype(dtype)
            self.low = np.broadcast_to(np.asarray(low, dtype), shape).copy()
            self.high = np.broadcast_to(np.asarray(high, dtype), shape).copy()
            self._random = np.random.default_rng(seed)

        def __repr__(self) -> str:
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"

        def seed(self, seed: int | None = None) -> None:
            """Makes what sample() gives repeatable."""
            self._random = np.random.default_rng(seed)

        def sample(self) -> npt.NDArray[Any]:
            """Numbers evenly between bounds; normally distributed where there are none."""
            bounded = np.isfinite(self.low) & np.isfinite(self.high)
            low, high = np.where(bounded, self.low, 0.0), np.where(bounded, self.high, 1.0)
            even = self._random.uniform(low, high)
            return np.where(bounded, even, self._random.normal(size=self.shape)).astype(self.dtype)

        def contains(self, value: Any) -> bool:
            """Whether a value is of this space."""
            return (
                isinstance(value, np.ndarray)
                and value.shape == self.shape
                and np.can_cast(value.dtype, self.dtype)
                and bool(np.all(value >= self.low) and np.all(value <= self.high))
            )

        __contains__ = contains

    class Env(Generic[_Observation, _Action]):  # type: ignore[no-redef]
        """What gymnasium.Env has."""

        metadata: dict[str, Any] = {"render_modes": []}
        render_mode: str | None = None
        spec: Any = None
        action_space: Box
        observation_space: Box
        _np_random: np.random.Generator | None = None

        @property
        def np_random(self) -> np.random.Generator:
            """What all chance of an episode comes from; reset(seed=...) begins it anew."""
            if self._np_random is None:
                self._np_random = np.random.default_rng()
            return self._np_random

        @property
        def unwrapped(self) -> Any:
            """This environment."""
            return self

        def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> Any:
            """Begins the chance of the episodes to come."""
            if seed is not None:
                self._np_random = np.random.default_rng(seed)

        def close(self) -> None:
            """Nothing has to be closed."""

        def __enter__(self) -> Any:
            return self

        def __exit__(self, *_: Any) -> None:
            self.close()

    def register(id: str, **_: Any) -> None:  # type: ignore[misc]
        """Without gymnasium there is no list of environments."""


__all__ = ["INSTALLED", "Box", "Env", "register"]
