"""Files that a server gives, as NumPy arrays. They are as the server writes them: LPS, mm."""

from __future__ import annotations

import csv
import io
from typing import NamedTuple, Optional

import numpy as np

_PLY_TYPES = {
    "char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4", "float": "<f4", "double": "<f8",
    "int8": "i1", "uint8": "u1", "int16": "<i2", "uint16": "<u2", "int32": "<i4", "uint32": "<u4", "float32": "<f4", "float64": "<f8",
}  # fmt: skip
_STL_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


class FileError(ValueError):
    """A file that is not what it should be."""


class Mesh(NamedTuple):
    """Triangles, counter-clockwise from outside."""

    vertices: np.ndarray  #: (n, 3) float32, mm
    triangles: np.ndarray  #: (m, 3) int64
    normals: Optional[np.ndarray]  #: (n, 3), where the file has them


def read_ply(content: bytes) -> Mesh:
    """A binary little-endian PLY of triangles. Raises FileError."""
    head, mark, body = content.partition(b"end_header\n")
    lines = [line.split() for line in head.decode("ascii", "replace").splitlines()]
    if not mark or not lines or lines[0] != ["ply"] or ["format", "binary_little_endian", "1.0"] not in lines:
        raise FileError("the surface is no binary PLY file")
    elements: list = []
    for words in lines:
        if words[:1] == ["element"] and len(words) == 3 and words[2].isdigit():
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"] and elements:
            elements[-1][2].append(words[1:])
    if [name for name, _, _ in elements] != ["vertex", "face"]:
        raise FileError("the surface has other elements than vertices and faces")
    try:
        vertex = np.dtype([(words[1], _PLY_TYPES[words[0]]) for words in elements[0][2]])
        (listed,) = elements[1][2]
        face = np.dtype([("count", _PLY_TYPES[listed[1]]), ("corners", _PLY_TYPES[listed[2]], 3)])
    except (KeyError, ValueError, IndexError):
        raise FileError("the surface has properties that are not known") from None
    rows, faces = elements[0][1], elements[1][1]
    if len(body) != rows * vertex.itemsize + faces * face.itemsize:
        raise FileError("the surface's file is not whole")
    points = np.frombuffer(body, vertex, rows)
    corners = np.frombuffer(body, face, faces, rows * vertex.itemsize)
    if not (corners["count"] == 3).all():
        raise FileError("the surface has faces that are no triangles")
    return _checked(points, corners["corners"].astype(np.int64))


def _checked(points: np.ndarray, triangles: np.ndarray) -> Mesh:
    names = points.dtype.names or ()
    if not {"x", "y", "z"} <= set(names):
        raise FileError("the surface's vertices have no place")
    if triangles.size and not 0 <= triangles.min() <= triangles.max() < len(points):
        raise FileError("a triangle of the surface has a vertex that is not there")
    columns = [np.stack([points[axis] for axis in axes], axis=1) if set(axes) <= set(names) else None
               for axes in (("x", "y", "z"), ("nx", "ny", "nz"))]  # fmt: skip
    return Mesh(columns[0].astype(np.float32), triangles, columns[1])


def read_stl(content: bytes) -> Mesh:
    """A binary STL. Raises FileError."""
    count = int.from_bytes(content[80:84], "little")
    if len(content) != 84 + count * _STL_TRIANGLE.itemsize:
        raise FileError("the component's file is no whole binary STL")
    corners = np.frombuffer(content, _STL_TRIANGLE, count, 84)["corners"].reshape(-1, 3)
    vertices, number = np.unique(corners, axis=0, return_inverse=True)
    return Mesh(vertices, number.reshape(-1, 3).astype(np.int64), None)


def read_table(content: bytes) -> dict:
    """Columns of a CSV of numbers, by name. Raises FileError."""
    rows = csv.reader(io.StringIO(content.decode("utf-8")))
    names = next(rows, [])
    try:
        values = np.array([[float(cell) for cell in row] for row in rows]).reshape(-1, len(names))
    except ValueError:
        raise FileError("the trace has cells that are no numbers, or rows of other lengths") from None
    return {name: values[:, i] for i, name in enumerate(names)}
