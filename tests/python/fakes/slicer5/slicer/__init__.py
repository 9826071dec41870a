"""As much of 3D Slicer 5 as Ream uses: scene and nodes with the functions that the real ones have, with real VTK inside.

Functions refuse what the real ones refuse or misunderstand: unknown classes, other types, arrays of other shapes.
"""

from typing import Any

import numpy as np
import vtk
from vtk.util import numpy_support


class vtkMRMLNode:
    _ancestors: tuple[str, ...] = ()

    def __init__(self, name: str, identity: str) -> None:
        self._name, self._id = name, identity
        self._attributes: dict[str, str] = {}

    def GetName(self) -> str:
        return self._name

    def GetID(self) -> str:
        return self._id

    def IsA(self, kind: str) -> bool:
        return kind in {known.__name__ for known in type(self).__mro__}

    def SetAttribute(self, name: str, value: str) -> None:
        _need(name, str), _need(value, str)
        self._attributes[name] = value

    def GetAttribute(self, name: str) -> Any:
        return self._attributes.get(name)


def _need(value: Any, kind: Any) -> None:
    if not isinstance(value, kind):
        raise TypeError(f"{value!r} is no {kind}")


class vtkMRMLDisplayNode(vtkMRMLNode):
    UseManualScalarRange = 0
    UseDataScalarRange = 1

    def __init__(self, *words: Any) -> None:
        super().__init__(*words)
        self.shown: dict[str, Any] = {}

    def SetColor(self, r: float, g: float, b: float) -> None:
        self.shown["color"] = (float(r), float(g), float(b))

    def SetOpacity(self, opacity: float) -> None:
        self.shown["opacity"] = float(opacity)

    def SetLineWidth(self, width: float) -> None:
        self.shown["line_width"] = float(width)

    def SetActiveScalar(self, name: str, location: int) -> None:
        _need(name, str)
        if location not in (vtk.vtkAssignAttribute.POINT_DATA, vtk.vtkAssignAttribute.CELL_DATA):
            raise ValueError("no such location")
        self.shown["scalar"] = name

    def SetAndObserveColorNodeID(self, identity: str) -> None:
        if not identity.startswith(("vtkMRMLColorTableNode", "vtkMRMLProceduralColorNode")):
            raise ValueError(identity)

    def SetScalarRangeFlag(self, flag: int) -> None:
        if flag not in range(5):
            raise ValueError("no such flag")

    def SetScalarRange(self, low: float, high: float) -> None:
        self.shown["range"] = (float(low), float(high))

    def SetScalarVisibility(self, visible: bool) -> None:
        self.shown["scalar_visible"] = bool(visible)


class vtkMRMLStorageNode(vtkMRMLNode):
    pass


class vtkMRMLTransformableNode(vtkMRMLNode):
    _transform: Any = None

    def GetTransformNodeID(self) -> Any:
        return self._transform

    def SetAndObserveTransformNodeID(self, identity: str) -> None:
        if mrmlScene.GetNodeByID(identity) is None:
            raise ValueError("no such transform")
        self._transform = identity


class vtkMRMLDisplayableNode(vtkMRMLTransformableNode):
    _display: Any = None
    _storage: Any = None

    def CreateDefaultDisplayNodes(self) -> None:
        if self._display is None:
            self._display = vtkMRMLDisplayNode("", f"display of {self._id}")

    def GetDisplayNode(self) -> Any:
        return self._display

    def GetStorageNode(self) -> Any:
        return self._storage


class vtkMRMLModelNode(vtkMRMLDisplayableNode):
    _data: Any = None

    def SetAndObservePolyData(self, data: Any) -> None:
        _need(data, vtk.vtkPolyData)
        self._data = data

    def GetPolyData(self) -> Any:
        return self._data


class vtkMRMLLinearTransformNode(vtkMRMLDisplayableNode):
    pass


class vtkMRMLScalarVolumeNode(vtkMRMLDisplayableNode):
    def __init__(self, *words: Any) -> None:
        super().__init__(*words)
        self._ijk_to_ras = np.eye(4)
        self._array = np.zeros((0, 0, 0))

    def GetIJKToRASMatrix(self, matrix: Any) -> None:
        _need(matrix, vtk.vtkMatrix4x4)
        matrix.DeepCopy(self._ijk_to_ras.reshape(-1).tolist())


class vtkMRMLMarkupsNode(vtkMRMLDisplayableNode):
    PositionUndefined, PositionPreview, PositionDefined, PositionMissing = range(4)
    _most: Any = None

    def __init__(self, *words: Any) -> None:
        super().__init__(*words)
        self._points: list[list] = []  # place, label, status

    def GetNumberOfControlPoints(self) -> int:
        return len(self._points)

    def RemoveAllControlPoints(self) -> None:
        self._points.clear()

    def AddControlPoint(self, place: Any, label: str = "") -> int:
        _need(place, vtk.vtkVector3d)
        if self._most is not None and len(self._points) == self._most:
            return -1
        self._points.append([np.array([place[i] for i in range(3)]), label, self.PositionDefined])
        return len(self._points) - 1

    def SetNthControlPointLabel(self, n: int, label: str) -> None:
        _need(label, str)
        self._points[n][1] = label

    def GetNthControlPointLabel(self, n: int) -> str:
        return self._points[n][1]

    def GetNthControlPointPositionStatus(self, n: int) -> int:
        return self._points[n][2]

    def UnsetNthControlPointPosition(self, n: int) -> None:
        self._points[n][2] = self.PositionUndefined


class vtkMRMLMarkupsFiducialNode(vtkMRMLMarkupsNode):
    pass


class vtkMRMLMarkupsLineNode(vtkMRMLMarkupsNode):
    _most = 2


class vtkMRMLTableNode(vtkMRMLNode):
    def __init__(self, *words: Any) -> None:
        super().__init__(*words)
        self._table = vtk.vtkTable()

    def GetTable(self) -> Any:
        return self._table

    def AddColumn(self, column: Any) -> Any:
        _need(column, vtk.vtkAbstractArray)
        if self._table.GetNumberOfColumns() and column.GetNumberOfTuples() != self._table.GetNumberOfRows():
            raise ValueError("a column of another length")
        self._table.AddColumn(column)
        return column

    def GetNumberOfRows(self) -> int:
        return int(self._table.GetNumberOfRows())

    def GetNumberOfColumns(self) -> int:
        return int(self._table.GetNumberOfColumns())


class _ConnectorNode(vtkMRMLNode):
    """Of the extension SlicerOpenIGTLink; see install_openigtlink()."""

    def __init__(self, *words: Any) -> None:
        super().__init__(*words)
        self.server: Any = None
        self.active = False

    def SetTypeClient(self, host: str, port: int) -> int:
        _need(host, str), _need(port, int)
        self.server = (host, port)
        return 1

    def Start(self) -> int:
        if self.server is None:
            return 0
        self.active = True
        return 1

    def Stop(self) -> int:
        self.active = False
        return 1


class vtkMRMLScene:
    def __init__(self) -> None:
        self._nodes: list[vtkMRMLNode] = []
        self._made = 0

    def AddNewNodeByClass(self, kind: str, name: str = "") -> Any:
        known = globals().get(kind)
        if not (isinstance(known, type) and issubclass(known, vtkMRMLNode)):
            return None  # the real one writes into the log
        self._made += 1
        node = known(name, f"{kind}{self._made}")
        self._nodes.append(node)
        return node

    def RemoveNode(self, node: Any) -> None:
        _need(node, vtkMRMLNode)
        self._nodes = [known for known in self._nodes if known is not node]
        for known in self._nodes:
            if getattr(known, "_storage", None) is node:
                known._storage = None

    def Clear(self, removeSingletons: bool = False) -> None:
        self._nodes.clear()

    def GetNumberOfNodesByClass(self, kind: str) -> int:
        return len(self._of(kind))

    def GetNthNodeByClass(self, n: int, kind: str) -> Any:
        return self._of(kind)[n]

    def GetNodeByID(self, identity: str) -> Any:
        return next((node for node in self._nodes if node.GetID() == identity), None)

    def _of(self, kind: str) -> list:
        return [node for node in self._nodes if node.IsA(kind)]


mrmlScene = vtkMRMLScene()


def install_openigtlink(there: bool) -> None:
    """Whether the extension is there."""
    if there:
        globals()["vtkMRMLIGTLConnectorNode"] = type("vtkMRMLIGTLConnectorNode", (_ConnectorNode,), {})
    else:
        globals().pop("vtkMRMLIGTLConnectorNode", None)


def polydata_arrays(node: vtkMRMLModelNode) -> tuple[np.ndarray, np.ndarray]:
    """For tests: points, and the connectivity of polygons or lines."""
    data = node.GetPolyData()
    cells = data.GetPolys() if data.GetNumberOfPolys() else data.GetLines()
    return (
        numpy_support.vtk_to_numpy(data.GetPoints().GetData()),
        numpy_support.vtk_to_numpy(cells.GetConnectivityArray()),
    )


from slicer import util as util  # noqa: E402 - it needs the nodes
