"""As much of gymnasium as tells whether ream's environments become its own. Debian 12 does not have gymnasium."""

from typing import Any, Generic, TypeVar

from gymnasium import spaces as spaces

_Observation = TypeVar("_Observation")
_Action = TypeVar("_Action")

registered: dict[str, str] = {}


class Env(Generic[_Observation, _Action]):
    def reset(self, *, seed: Any = None, options: Any = None) -> Any: ...


def register(id: str, entry_point: str) -> None:
    registered[id] = entry_point
