"""Meshes and voxels."""

from __future__ import annotations

import os
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ream import _ream


class Voxels(NamedTuple):
    """Marked voxels of a grid."""

    #: One truth value a voxel, indices z, y, x.
    marked: npt.NDArray[np.bool_]
    #: The first corner of voxel (0, 0, 0): x, y, z, mm.
    origin_mm: tuple[float, float, float]
    #: Edges of a voxel along x, y, z.
    size_mm: tuple[float, float, float]


def load_mesh(path: str | os.PathLike[str]) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.uint32]]:
    """Vertices (n, 3) and triangles (m, 3) of an STL, OBJ, PLY, OFF or GLB file, in the file's own unit."""
    return _ream.load_mesh(path)


def _corners(triangles: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    """Refuses what would become another vertex's number."""
    corners = np.asarray(triangles)
    if corners.size and not np.issubdtype(corners.dtype, np.integer):
        raise _ream.Error("triangles must be whole numbers, of their vertices")
    if corners.size and (corners.min() < 0 or corners.max() >= 2**32):
        raise _ream.Error("a triangle has a vertex that is not there")
    return corners.astype(np.uint32)


def voxelize(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    size_mm: float | tuple[float, float, float],
    *,
    origin_mm: tuple[float, float, float] | None = None,
    solid: bool = False,
    surface: bool = True,
    thin: bool = False,
) -> Voxels:
    """The voxels that a mesh touches, and with `solid` those inside it, too.

    size_mm: the edge of a voxel, or three: x, y, z.
    origin_mm: a corner of any voxel; else the grid begins half a voxel before the mesh.
    surface: False with `solid` leaves only voxels whose centre is inside.
    thin: mark only as many voxels as keep the surface closed against steps from face to face (6-separating),
        instead of every voxel that is touched.
    """
    edges = np.broadcast_to(np.asarray(size_mm, float), 3)
    size = (float(edges[0]), float(edges[1]), float(edges[2]))
    marked, origin = _ream.voxelize(
        np.asarray(vertices, np.float32), _corners(triangles), size, origin_mm, solid, surface, thin
    )
    return Voxels(marked, origin, size)
