"""Functions of slicer.util that Ream uses."""

import contextlib
import gzip
import pathlib
import types
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from typing import Any

import numpy as np
import qt
import slicer
import vtk

#: What errorDisplay() was told.
errors: list[str] = []


def loadVolume(filename: str, properties: dict | None = None, returnNode: bool = False) -> Any:
    """A NRRD file of 16-bit samples. Slicer turns its space to RAS, whatever it is."""
    if not isinstance(filename, str):
        raise TypeError("loadVolume(str)")
    head, _, body = pathlib.Path(filename).read_bytes().partition(b"\n\n")
    lines = head.decode().splitlines()
    if not lines[0].startswith("NRRD000"):
        raise RuntimeError("Failed to load file")
    fields = dict(line.split(": ", 1) for line in lines[1:] if ": " in line and not line.startswith("#"))
    if fields["encoding"] not in ("raw", "gzip") or fields["endian"] != "little" or fields["type"] not in ("short", "int16"):
        raise RuntimeError(f"this fake does not read {fields}")
    turn = {"left-posterior-superior": (-1, -1, 1), "right-anterior-superior": (1, 1, 1)}[fields["space"]]
    vectors = [_vector(word) for word in fields["space directions"].split()]
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLScalarVolumeNode", (properties or {}).get("name", ""))
    matrix = np.eye(4)
    matrix[:3, :3] = np.diag(turn) @ np.array(vectors).T
    matrix[:3, 3] = np.diag(turn) @ _vector(fields["space origin"])
    node._ijk_to_ras = matrix
    if fields["encoding"] == "gzip":
        body = gzip.decompress(body)
    sizes = [int(word) for word in fields["sizes"].split()]
    node._array = np.frombuffer(body, "<i2").reshape(sizes[::-1])
    node._storage = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLStorageNode", filename)
    return node


def _vector(words: str) -> np.ndarray:
    return np.array([float(word) for word in words.strip("()").split(",")])


def arrayFromVolume(node: Any) -> np.ndarray:
    """Indices k, j, i."""
    return node._array


def updateMarkupsControlPointsFromArray(node: Any, narray: np.ndarray, world: bool = False) -> None:
    if narray.shape == (0,):
        node.RemoveAllControlPoints()
        return
    if len(narray.shape) != 2 or narray.shape[1] != 3:
        raise RuntimeError(f"Unsupported numpy array shape: {narray.shape} expected (N,3)")
    node.RemoveAllControlPoints()
    for row in narray:
        node.AddControlPoint(vtk.vtkVector3d(row))


def arrayFromMarkupsControlPoints(node: Any, world: bool = False) -> np.ndarray:
    return np.array([point[0] for point in node._points]).reshape(-1, 3)


def resetThreeDViews() -> None:
    pass


def errorDisplay(text: str) -> None:
    errors.append(text)


@contextlib.contextmanager
def tryWithErrorDisplay(message: str | None = None, show: bool = True, waitCursor: bool = False) -> Iterator[None]:
    """Shows what is raised, and goes on behind it."""
    try:
        yield
    except Exception as failure:
        errorDisplay(f"{message}\n\n{failure}")


class qMRMLWidget(qt.QWidget):
    def setMRMLScene(self, scene: Any) -> None:
        if scene is not slicer.mrmlScene:
            raise TypeError("setMRMLScene(vtkMRMLScene)")


class qMRMLNodeComboBox(qt.QWidget):
    properties = {"nodeTypes": [], "noneEnabled": False}

    def __init__(self) -> None:
        super().__init__()
        self._values["_node"] = None

    def currentNode(self) -> Any:
        return self._node

    def setCurrentNode(self, node: Any) -> None:
        if node is not None and not any(node.IsA(kind) for kind in self.nodeTypes):
            raise TypeError(f"{node.GetID()} is none of {self.nodeTypes}")
        self._values["_node"] = node


class ctkCollapsibleButton(qt.QWidget):
    properties = {"text": "", "collapsed": False}


def loadUI(path: str) -> Any:
    """Makes the widgets of a file of Qt's designer."""
    root = ElementTree.parse(path).getroot().find("widget")
    made: dict[str, Any] = {}
    top = _made(root, made)
    top._values["_children"] = made
    return top


def childWidgetVariables(widget: Any) -> Any:
    return types.SimpleNamespace(**widget._children)


def _made(element: Any, made: dict[str, Any]) -> Any:
    kinds = {**vars(qt), **globals()}
    widget = kinds[element.get("class")]()
    if element.get("name") in made:
        raise ValueError(f"two widgets are called {element.get('name')}")
    made[element.get("name")] = widget
    for part in element.findall("property"):
        (value,) = part
        setattr(widget, part.get("name"), _value(value))
    for child in element.iter("widget"):
        if child is not element and child.get("name") not in made:
            _made(child, made)
    return widget


def _value(element: Any) -> Any:
    text = element.text or ""
    kinds = {"string": str, "number": int, "double": float, "enum": str}
    if element.tag == "bool":
        return {"true": True, "false": False}[text]
    if element.tag == "stringlist":
        return [item.text for item in element]
    return kinds[element.tag](text)
