"""The bases of a scripted module."""

import pathlib
import sys
import types
import unittest
from typing import Any

import qt


class ScriptedLoadableModule:
    def __init__(self, parent: Any) -> None:
        self.parent = parent


class ScriptedLoadableModuleWidget:
    def __init__(self, parent: Any = None) -> None:
        self.parent = parent
        self.layout = qt.QVBoxLayout()

    def setup(self) -> None:
        pass

    def resourcePath(self, name: str) -> str:
        """Below the folder Resources beside the module's file."""
        return str(pathlib.Path(sys.modules[type(self).__module__].__file__).parent / "Resources" / name)


class ScriptedLoadableModuleLogic:
    def __init__(self, parent: Any = None) -> None:
        pass


class ScriptedLoadableModuleTest(unittest.TestCase):
    def runTest(self) -> None:
        raise NotImplementedError

    def delayDisplay(self, message: str, msec: int = 100) -> None:
        if not isinstance(message, str):
            raise TypeError("delayDisplay(str)")


def parent() -> types.SimpleNamespace:
    """What Slicer gives to a module."""
    return types.SimpleNamespace()
