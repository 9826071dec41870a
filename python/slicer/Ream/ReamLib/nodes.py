"""What a server has, as nodes of the scene. Everything that comes here is in RAS, mm."""

from __future__ import annotations

import json
from typing import Any, Optional

import numpy as np
import slicer
import vtk
from vtk.util import numpy_support

from .bench import LoadedCase, LoadedSession, Plan
from .client import ClientError
from .files import Mesh

#: Deviations beyond this have the colour of it.
DEVIATION_RANGE_MM = 2.0
#: Names that a server's OpenIGTLink gives: what moves, and by what.
LIVE = {"Reamer": "ReamerToRas", "Bone": "BoneToRas"}
_SETTINGS = "ream.settings"
_CASE = "ream.case"


def show_case(case: LoadedCase) -> list:
    """The case's nodes, in order: CT, bone, landmarks, plan; those that it has."""
    nodes = []
    if case.volume is not None:
        volume = slicer.util.loadVolume(str(case.volume), {"name": f"{case.name} CT"})
        # The file does not stay: a scene that is saved shall write the CT itself.
        slicer.mrmlScene.RemoveNode(volume.GetStorageNode())
        nodes.append(volume)
    if case.bone is not None:
        bone = model_node(f"{case.name} bone", case.bone)
        bone.GetDisplayNode().SetColor(0.93, 0.89, 0.78)
        nodes.append(bone)
    if case.landmarks:
        nodes.append(belong(landmarks_node(f"{case.name} landmarks", case.landmarks), case.id))
    if case.plan is not None:
        nodes.append(belong(plan_node(f"{case.name} plan", case.plan), case.id))
    return nodes


def show_session(session: LoadedSession) -> list:
    """The session's nodes, in order: surface, tool path, component, trace, score."""
    surface = model_node(f"{session.id} surface", session.surface)
    if session.deviation_mm is not None:
        show_scalars(surface, "deviation_mm", session.deviation_mm, (-DEVIATION_RANGE_MM, DEVIATION_RANGE_MM))
    nodes = [surface]
    if len(session.path) > 1:
        nodes.append(path_node(f"{session.id} tool path", session.path, session.trace["thrust_n"]))
    if session.component is not None:
        component = model_node(f"{session.id} component", session.component)
        component.GetDisplayNode().SetColor(0.4, 0.6, 0.9)
        component.GetDisplayNode().SetOpacity(0.5)
        nodes.append(component)
    nodes.append(table_node(f"{session.id} trace", list(session.trace), list(session.trace.values())))
    heading, *rows = session.score
    nodes.append(table_node(f"{session.id} score", heading, [list(column) for column in zip(*rows)]))
    return nodes


def model_node(name: str, mesh: Mesh) -> Any:
    """A surface."""
    data = vtk.vtkPolyData()
    data.SetPoints(_points(mesh.vertices))
    data.SetPolys(_cells(mesh.triangles))
    if mesh.normals is not None:
        normals = numpy_support.numpy_to_vtk(np.ascontiguousarray(mesh.normals), deep=True)
        normals.SetName("Normals")
        data.GetPointData().SetNormals(normals)
    return _model(name, data)


def path_node(name: str, path: np.ndarray, thrust_n: np.ndarray) -> Any:
    """A line through places, coloured by thrust. A model, as a markups curve is slow with thousands of points."""
    data = vtk.vtkPolyData()
    data.SetPoints(_points(path))
    data.SetLines(_cells(np.arange(len(path))[None, :]))
    node = _model(name, data)
    show_scalars(node, "thrust_n", thrust_n, (0.0, max(1.0, float(np.max(thrust_n)))))
    node.GetDisplayNode().SetLineWidth(3)
    return node


def show_scalars(node: Any, name: str, values: np.ndarray, shown: tuple) -> None:
    """One number a point, as the node's colour; `shown` is the range of colours."""
    scalars = numpy_support.numpy_to_vtk(np.ascontiguousarray(values, np.float32), deep=True)
    scalars.SetName(name)
    node.GetPolyData().GetPointData().AddArray(scalars)
    display = node.GetDisplayNode()
    display.SetActiveScalar(name, vtk.vtkAssignAttribute.POINT_DATA)
    display.SetAndObserveColorNodeID("vtkMRMLColorTableNodeFileDivergingBlueRed.txt")
    display.SetScalarRangeFlag(slicer.vtkMRMLDisplayNode.UseManualScalarRange)
    display.SetScalarRange(*shown)
    display.SetScalarVisibility(True)


def landmarks_node(name: str, places: dict) -> Any:
    """A point for each landmark; its label says which."""
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLMarkupsFiducialNode", name)
    slicer.util.updateMarkupsControlPointsFromArray(node, np.array(list(places.values()), float))
    for i, label in enumerate(places):
        node.SetNthControlPointLabel(i, label)
    node.CreateDefaultDisplayNodes()
    return node


def belong(node: Any, case: str) -> Any:
    """Keeps with a node which case it is of."""
    node.SetAttribute(_CASE, case)
    return node


def require_of(node: Any, case: str) -> None:
    """Raises ClientError where a node is of another case. One that the user has made is of none yet, and may be sent."""
    of = node.GetAttribute(_CASE)
    if of and of != case:
        raise ClientError(f"{node.GetName()!r} is of case {of!r}, not of {case!r}; choose {of!r} above")


def landmarks_of(node: Any) -> dict:
    """Label to place, RAS, of the points that have been placed. Raises ClientError where a label is there twice."""
    places: dict = {}
    world = slicer.util.arrayFromMarkupsControlPoints(node, world=True)
    for i in range(node.GetNumberOfControlPoints()):
        if node.GetNthControlPointPositionStatus(i) != slicer.vtkMRMLMarkupsNode.PositionDefined:
            continue
        label = node.GetNthControlPointLabel(i)
        if label in places:
            raise ClientError(f"two points are called {label!r}; delete one")
        places[label] = world[i]
    return places


def plan_node(name: str, plan: Plan) -> Any:
    """A line from the entry into the bone, as long as the depth. It keeps the plan's other settings."""
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLMarkupsLineNode", name)
    slicer.util.updateMarkupsControlPointsFromArray(node, np.array([plan.entry, plan.end]))
    for i, label in enumerate(("entry", "end")):
        node.SetNthControlPointLabel(i, label)
    node.SetAttribute(_SETTINGS, json.dumps(plan.settings))
    node.CreateDefaultDisplayNodes()
    return node


def plan_from(node: Any) -> Plan:
    """The plan that a line says. Raises ClientError for a line that is not whole."""
    if node.GetNumberOfControlPoints() != 2:
        raise ClientError("the plan is a line of two points: entry, and end of the reaming")
    entry, end = slicer.util.arrayFromMarkupsControlPoints(node, world=True)
    settings = node.GetAttribute(_SETTINGS)
    return Plan(entry, end, json.loads(settings) if settings else {})


def table_node(name: str, names: list, columns: list) -> Any:
    """A column for each name: of numbers, or of texts."""
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLTableNode", name)
    for title, values in zip(names, columns):
        if isinstance(values, np.ndarray):
            column = numpy_support.numpy_to_vtk(np.ascontiguousarray(values, float), deep=True)
        else:
            column = vtk.vtkStringArray()
            for value in values:
                column.InsertNextValue(value)
        column.SetName(title)
        node.AddColumn(column)
    return node


def watch(host: str, port: int) -> Any:
    """A connector to a server's OpenIGTLink, active. Raises ClientError without the extension."""
    if not hasattr(slicer, "vtkMRMLIGTLConnectorNode"):
        raise ClientError("to watch live, install the extension SlicerOpenIGTLink (Extensions Manager)")
    connector = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLIGTLConnectorNode", "ream")
    connector.SetTypeClient(host, port)
    connector.Start()
    return connector


def stop_watching(connector: Any) -> None:
    """Ends it; what has come stays in the scene."""
    connector.Stop()
    slicer.mrmlScene.RemoveNode(connector)


def arrange_live() -> bool:
    """Puts what the server sends under what moves it. True once all of it has come."""
    whole = True
    for model_name, transform_name in LIVE.items():
        model = _first("vtkMRMLModelNode", model_name)
        transform = _first("vtkMRMLLinearTransformNode", transform_name)
        if model is None or transform is None:
            whole = False
        elif model.GetTransformNodeID() != transform.GetID():
            model.SetAndObserveTransformNodeID(transform.GetID())
    return whole


def _first(kind: str, name: str) -> Optional[Any]:
    for i in range(slicer.mrmlScene.GetNumberOfNodesByClass(kind)):
        node = slicer.mrmlScene.GetNthNodeByClass(i, kind)
        if node.GetName() == name:
            return node
    return None


def _model(name: str, data: Any) -> Any:
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLModelNode", name)
    node.SetAndObservePolyData(data)
    node.CreateDefaultDisplayNodes()
    return node


def _points(places: np.ndarray) -> Any:
    points = vtk.vtkPoints()
    points.SetData(numpy_support.numpy_to_vtk(np.ascontiguousarray(places, np.float32), deep=True))
    return points


def _cells(corners: np.ndarray) -> Any:
    """Rows of numbers of points, each row a cell."""
    count, size = corners.shape
    flat = np.column_stack([np.full(count, size), corners]).astype(np.int64).reshape(-1)
    cells = vtk.vtkCellArray()
    cells.SetCells(count, numpy_support.numpy_to_vtkIdTypeArray(flat, deep=True))
    return cells
