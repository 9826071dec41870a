"""What a viewer of a session sees: the messages of Client.stream(), decoded.

    async for message in client.stream(session["id"], surface=False):
        if isinstance(message, Telemetry):
            print(message.tick, message.state, message.thrust_n.max(), "N")

Lengths are mm, times are ticks of a millisecond. Forces are simulated newtons, except what is said of the hand. The world
frame is the CT's: LPS, x to the patient's left, y to the back, z to the head. Arrays of numbers cannot be written to.
proto/stream.fbs describes the messages themselves.
"""

from __future__ import annotations

import dataclasses
import math
import struct
from typing import Any, Union

import numpy as np
import numpy.typing as npt

try:
    from .wire import Body, Hello as _hello, MeshDelta as _mesh_delta, ServerMessage, Telemetry as _telemetry
    from .wire import ToolChange as _tool_change
except ModuleNotFoundError as _missing:
    if _missing.name != "flatbuffers":
        raise
    raise ImportError("streams need flatbuffers: apt install python3-flatbuffers") from None

from .client import ClientError

#: Of proto/stream.fbs, that this module reads.
PROTOCOL_REVISION = 1

#: Telemetry.state, in the order of proto/stream.fbs.
STATES = ("created", "running", "paused", "finished", "stopped", "fault", "interrupted", "replaying")
#: Those of them that a session does not leave by itself.
ENDED = ("finished", "stopped", "fault", "interrupted")

_Matrix = npt.NDArray[np.float64]
_Floats = npt.NDArray[np.float32]
_Triple = tuple[float, float, float]


@dataclasses.dataclass(frozen=True, eq=False)
class Tool:
    """The reamer's cutting envelope as a mesh, in its own frame: z into the bone, origin at the apex."""

    name: str
    vertices_mm: _Floats  #: (n, 3)
    triangles: npt.NDArray[np.uint32]  #: (m, 3)


@dataclasses.dataclass(frozen=True, eq=False)
class Hello:
    """The first message: what the session is about."""

    session_id: str
    server_epoch: int  #: changes when the server restarts; blocks of another epoch are stale
    case_id: str
    case_name: str
    side: str
    grid_dims: tuple[int, int, int]  #: voxels
    voxel_spacing_mm: _Triple
    world_from_grid: _Matrix  #: (4, 4); the grid's origin is its first corner
    block_edge_voxels: int
    tool: Tool
    axis_entry_mm: _Triple  #: of the plan, world
    axis_direction: _Triple  #: unit, into the bone
    planned_depth_mm: float
    force_scale: float  #: simulated N for each N at the hand
    force_max_n: float  #: at the hand
    replay_of: str  #: the session that was recorded; empty: this is live
    duration_ticks: int  #: of the recording; 0: this is live
    scapula_mm: dict[str, _Triple] | None  #: glenoid_centre, trigonum and inferior_angle, or None


@dataclasses.dataclass(frozen=True, eq=False)
class Playback:
    """Where a replay stands."""

    position_ticks: int
    speed: float
    playing: bool
    jump: int  #: grows when the position jumps: traces of other jumps do not belong to this one


@dataclasses.dataclass(frozen=True, eq=False)
class Telemetry:
    """A piece of the trace, an entry for each of `ticks`, and what held at the newest tick.

    A session that does not run repeats its newest tick twice a second.
    """

    ticks: npt.NDArray[np.int64]
    thrust_n: _Floats  #: simulated, along the reamer's axis
    hand_force_n: _Floats  #: magnitude sent to the hand
    torque_n_mm: _Floats
    feed_rate_mm_s: _Floats
    density_g_cc: _Floats  #: mean of what is engaged, 0 without contact
    vibration_g: _Floats
    tick: int  #: the newest
    world_from_tool: _Matrix | None  #: (4, 4)
    world_from_handle: _Matrix | None
    world_from_bone_rest: _Matrix | None  #: how far the bone has moved; None: it is held rigidly
    state: str  #: one of STATES
    fault: str  #: words, where there is one
    spindle_on: bool
    spindle_speed_rad_s: float  #: in reverse negative
    stalled: bool
    irrigating: bool
    surface_temperature_c: float | None  #: of the bone under the reamer; None: not simulated
    depth_mm: float
    removed_volume_mm3: float
    cortical_share: float
    dropped: int  #: ticks that this viewer has lost so far
    tick_mean_us: float  #: health of the loop
    tick_p99_us: float
    ticks_missed: int
    stamp_us: int  #: the server's own clock; 0: not told
    playback: Playback | None  #: of replays


@dataclasses.dataclass(frozen=True, eq=False)
class MeshBlock:
    """The surface of one block; it replaces what was known of that block. Decoded when decode() is called."""

    block: int  #: x + blocks_x * (y + blocks_y * z)
    revision: int  #: grows for each block
    tick: int
    vertex_count: int  #: 0: the block is empty now
    index_count: int
    vertices: bytes  #: meshopt vertex stream, as proto/stream.fbs has it
    indices: bytes  #: meshopt index stream
    _classes: npt.NDArray[np.uint8]
    _removed: npt.NDArray[np.uint8]
    _densities: npt.NDArray[np.uint8]

    def decode(self) -> tuple[npt.NDArray[np.uint16], _Floats, npt.NDArray[np.uint32]]:
        """Positions (n, 3) in 1/1024 voxel from the block's first corner minus one voxel, outward normals (n, 3) in the
        grid frame, triangles (m, 3), counter-clockwise from outside.

        Surface puts them together. Raises ream.Error for damaged streams. Needs the module `ream`, not only a copy of the client.
        """
        from ._ream import block_surface

        return block_surface(self.vertices, self.vertex_count, self.indices, self.index_count)

    @property
    def classes(self) -> npt.NDArray[np.uint8] | None:
        """Of the bone right under each vertex: 0 cancellous, 1 cortical, 2 cartilage; None: not known."""
        return _unpacked(self._classes, 2, self.vertex_count)

    @property
    def removed(self) -> npt.NDArray[np.uint8] | None:
        """How far each vertex lies under the surface of the beginning: 0 not at all, 15 half a voxel or more.

        None where nothing is gone.
        """
        return _unpacked(self._removed, 4, self.vertex_count)

    @property
    def density_g_cc(self) -> _Floats | None:
        """Of the bone right under each vertex, in steps of 0.125; 0 in cartilage, None where it is not told."""
        steps = _unpacked(self._densities, 4, self.vertex_count)
        return None if steps is None else steps.astype(np.float32) * np.float32(0.125)


@dataclasses.dataclass(frozen=True, eq=False)
class MeshDelta:
    """Blocks whose surface has changed."""

    blocks: list[MeshBlock]
    key_complete: bool  #: with these, the first whole picture is there


@dataclasses.dataclass(frozen=True, eq=False)
class ToolChange:
    """Replays only: from here on another reamer is in the hand."""

    tool: Tool


Message = Union[Hello, MeshDelta, Telemetry, ToolChange]


class Surface:
    """The bone's surface, put together of the blocks that have come."""

    def __init__(self, hello: Hello) -> None:
        self._hello = hello
        #: Along x, y and z.
        self._block_counts = [-(-dim // hello.block_edge_voxels) for dim in hello.grid_dims]
        self._blocks: dict[int, MeshBlock] = {}

    def take(self, delta: MeshDelta) -> None:
        """Blocks take the place of those before them. Raises ClientError for a block outside the grid."""
        for block in delta.blocks:
            if block.block >= math.prod(self._block_counts):
                raise ClientError(f"the server sent block {block.block}, which lies outside the grid")
            known = self._blocks.get(block.block)
            if known is not None and known.revision > block.revision:
                continue
            self._blocks[block.block] = block

    def mesh(self) -> tuple[_Floats, npt.NDArray[np.uint32]]:
        """Vertices (n, 3) in the world, LPS mm, with the bone at rest, and triangles (m, 3).

        Blocks do not share the vertices at their borders, where these are doubled; they lie at the same place.
        """
        edge, spacing = self._hello.block_edge_voxels, np.asarray(self._hello.voxel_spacing_mm)
        blocks_x, blocks_y, _ = self._block_counts
        vertices, triangles, count = [np.zeros((0, 3))], [np.zeros((0, 3), np.uint32)], 0
        for number in sorted(self._blocks):
            units, _, corners = self._blocks[number].decode()
            place = np.array([number % blocks_x, number // blocks_x % blocks_y, number // (blocks_x * blocks_y)])
            vertices.append((place * edge - 1 + units / 1024.0) * spacing)
            triangles.append(corners + np.uint32(count))
            count += len(units)
        world = self._hello.world_from_grid
        placed = np.concatenate(vertices) @ world[:3, :3].T + world[:3, 3]
        return placed.astype(np.float32), np.concatenate(triangles)


class Reader:
    """Decodes the messages of one connection in order. Raises ClientError for what it cannot read."""

    def __init__(self, surface: bool = True) -> None:
        """surface: False leaves out MeshDelta."""
        self._surface = surface
        self._greeted = False
        self._key_complete = not surface
        self._over = False
        self._quiet = True
        #: Nothing more is to come: the session has ended, and its surface is whole.
        self.ended = False

    def read(self, data: bytes | str) -> Message | None:
        """The message, or None where it is left out."""
        try:
            return self._read(data)
        except (struct.error, IndexError, TypeError, ValueError, AttributeError) as failure:
            raise ClientError(f"the server sent a message that cannot be read: {failure}") from None

    def _read(self, data: bytes | str) -> Message | None:
        if isinstance(data, str):
            raise ValueError("it is text")
        message = ServerMessage.ServerMessage.GetRootAs(data, 0)
        kind, body = message.BodyType(), message.Body()
        if kind == Body.Body.Hello:
            self._greeted = True
            return _hello_of(_as(_hello.Hello, body))
        if not self._greeted:
            raise ValueError("the stream did not begin with Hello")
        if kind == Body.Body.MeshDelta:
            delta = _as(_mesh_delta.MeshDelta, body)
            self._key_complete |= delta.KeyComplete()
            self._quiet = False
            return _delta_of(delta) if self._surface else None
        if kind == Body.Body.Telemetry:
            told = _telemetry_of(_as(_telemetry.Telemetry, body))
            self._note(told)
            return told
        if kind == Body.Body.ToolChange:
            return ToolChange(_tool_of(_as(_tool_change.ToolChange, body)))
        raise ValueError(f"its kind is {kind}")

    def _note(self, told: Telemetry) -> None:
        """Telemetry and surface take turns: two telemetries after each other say that no surface waits."""
        over = told.state in ENDED
        self.ended = over and self._key_complete and (not self._surface or (self._over and self._quiet))
        self._over, self._quiet = over, True


def _as(kind: Any, body: Any) -> Any:
    if body is None:
        raise ValueError("it lacks its body")
    table = kind()
    table.Init(body.Bytes, body.Pos)
    return table


def _text(value: bytes | None) -> str:
    return "" if value is None else value.decode()


def _numbers(value: Any, kind: type) -> Any:
    """A vector as NumPy; flatc's readers give 0 where there is none."""
    return np.zeros(0, kind) if isinstance(value, int) else value


def _triple(value: Any) -> _Triple:
    return (0.0, 0.0, 0.0) if value is None else (value.X(), value.Y(), value.Z())


def _matrix(pose: Any) -> _Matrix | None:
    if pose is None:
        return None
    from .wire import Quat, Vec3

    turn, place = pose.Rotation(Quat.Quat()), pose.TranslationMm(Vec3.Vec3())
    w, x, y, z = turn.W(), turn.X(), turn.Y(), turn.Z()
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = _triple(place)
    return made


def _unpacked(packed: npt.NDArray[np.uint8], bits: int, count: int) -> npt.NDArray[np.uint8] | None:
    if len(packed) == 0:
        return None
    shifts = np.arange(0, 8, bits, dtype=np.uint8)
    return (packed[:, None] >> shifts & np.uint8((1 << bits) - 1)).reshape(-1)[:count]


def _tool_of(message: Any) -> Tool:
    return Tool(
        _text(message.ToolName()),
        _numbers(message.ToolPositionsMmAsNumpy(), np.float32).reshape(-1, 3),
        _numbers(message.ToolIndicesAsNumpy(), np.uint32).reshape(-1, 3),
    )


def _hello_of(h: Any) -> Hello:
    if h.ProtocolRevision() != PROTOCOL_REVISION:
        raise ClientError(
            f"the server speaks revision {h.ProtocolRevision()} of the stream, this client {PROTOCOL_REVISION}; "
            "install the python3-ream of the server's version"
        )
    points = {"glenoid_centre": h.GlenoidCentreMm(), "trigonum": h.TrigonumMm(), "inferior_angle": h.InferiorAngleMm()}
    dims = [int(dim) for dim in _numbers(h.GridDimsAsNumpy(), np.int32)]
    if len(dims) != 3 or min(dims) < 1 or h.BlockEdgeVoxels() < 1:
        raise ValueError(f"its grid is of {dims} voxels, in blocks of {h.BlockEdgeVoxels()}")
    world_from_grid = _matrix(h.WorldFromGrid())
    return Hello(
        session_id=_text(h.SessionId()),
        server_epoch=h.ServerEpoch(),
        case_id=_text(h.CaseId()),
        case_name=_text(h.CaseName()),
        side=_text(h.Side()),
        grid_dims=(dims[0], dims[1], dims[2]),
        voxel_spacing_mm=_triple(h.VoxelSpacingMm()),
        world_from_grid=np.eye(4) if world_from_grid is None else world_from_grid,
        block_edge_voxels=h.BlockEdgeVoxels(),
        tool=_tool_of(h),
        axis_entry_mm=_triple(h.AxisEntryMm()),
        axis_direction=_triple(h.AxisDirection()),
        planned_depth_mm=h.PlannedDepthMm(),
        force_scale=h.ForceScale(),
        force_max_n=h.ForceMaxN(),
        replay_of=_text(h.ReplayOf()),
        duration_ticks=h.DurationTicks(),
        scapula_mm=None if None in points.values() else {name: _triple(point) for name, point in points.items()},
    )


def _delta_of(delta: Any) -> MeshDelta:
    blocks = []
    for i in range(delta.BlocksLength()):
        b = delta.Blocks(i)
        streams = [_numbers(part, np.uint8) for part in (b.VerticesAsNumpy(), b.IndicesAsNumpy())]
        packed = (b.ClassesAsNumpy(), b.RemovedAsNumpy(), b.DensitiesAsNumpy())
        blocks.append(
            MeshBlock(
                b.Block(),
                b.Revision(),
                b.Tick(),
                b.VertexCount(),
                b.IndexCount(),
                *(part.tobytes() for part in streams),
                *(_numbers(part, np.uint8) for part in packed),
            )
        )
    return MeshDelta(blocks, delta.KeyComplete())


def _telemetry_of(t: Any) -> Telemetry:
    thrust_n = _numbers(t.ThrustNAsNumpy(), np.float32)
    playback = t.Playback()
    return Telemetry(
        ticks=t.FirstTick() + max(t.TickStride(), 1) * np.arange(len(thrust_n), dtype=np.int64),
        thrust_n=thrust_n,
        hand_force_n=_numbers(t.HandForceNAsNumpy(), np.float32),
        torque_n_mm=_numbers(t.TorqueNMmAsNumpy(), np.float32),
        feed_rate_mm_s=_numbers(t.FeedRateMmSAsNumpy(), np.float32),
        density_g_cc=_numbers(t.DensityGCcAsNumpy(), np.float32),
        vibration_g=_numbers(t.VibrationGAsNumpy(), np.float32),
        tick=t.Tick(),
        world_from_tool=_matrix(t.WorldFromTool()),
        world_from_handle=_matrix(t.WorldFromHandle()),
        world_from_bone_rest=_matrix(t.WorldFromBoneRest()),
        state=STATES[t.State()],
        fault=_text(t.Fault()),
        spindle_on=t.SpindleOn(),
        spindle_speed_rad_s=t.SpindleSpeedRadS(),
        stalled=t.Stalled(),
        irrigating=t.Irrigating(),
        surface_temperature_c=t.SurfaceTemperatureC() or None,
        depth_mm=t.DepthMm(),
        removed_volume_mm3=t.RemovedVolumeMm3(),
        cortical_share=t.CorticalShare(),
        dropped=t.Dropped(),
        tick_mean_us=t.TickMeanUs(),
        tick_p99_us=t.TickP99Us(),
        ticks_missed=t.TicksMissed(),
        stamp_us=t.StampUs(),
        playback=None
        if playback is None
        else Playback(playback.PositionTicks(), playback.Speed(), playback.Playing(), playback.Jump()),
    )
