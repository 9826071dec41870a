"""Be the device of a session: send where the hand is, and take the force that it feels.

    session = client.create_session({"case": "demo", "device": "network"})
    client.start_session(session["id"])
    async with client.device(session["id"]) as device:
        for step in range(2000):
            feedback = await device.move([0, 0, -0.001 * step], trigger=1.0)
            motors(device.force_n)
            await asyncio.sleep(0.001)

| device of the session | send | frame |
|---|---|---|
| `network` | move() | the device's own, mm: x to the right of the person, y up, z towards the person |
| `browser` | steer() | the world (LPS, mm), from the planned entry |

Of `network`: away from the person (-z) is along the planned axis, into the bone. The person's up is the patient's, square to
that axis. Only motion counts: wherever the first pose is, the reamer begins where the session has it. Turns are absolute; a
handle without a turn points along the planned axis. `ream devices --setup network` on the server fits other frames and scales.

The rules, which proto/device.md has in full:

- Send at least 200 times a second to `network`, 60 to `browser`. From 10 ms (100 ms) without a pose on the force falls to nothing, from
  50 ms (250 ms) on the session rests until poses come again. Nothing is sent behind your back: a program that hangs lets go.
- When the server has been silent for 50 ms, the force must leave your device. `force_n` and `torque_n_mm` are zero then.
- The newest client is the device; the one before it is told so and is out.
"""

from __future__ import annotations

import asyncio
import contextlib
import dataclasses
import enum
import math
import struct
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

try:
    import flatbuffers

    from .wire import DeviceBody, DeviceHello, DeviceMessage, Handle, Quat, Steering, Vec3
    from .wire import Feedback as _feedback
    from .wire import Welcome as _welcome
except ModuleNotFoundError as _missing:
    if _missing.name != "flatbuffers":
        raise
    raise ImportError("devices need flatbuffers: apt install python3-flatbuffers") from None

from .client import ClientError
from .stream import ENDED, STATES

if TYPE_CHECKING:
    from .client import Client

#: Of proto/device.fbs, that this module speaks.
PROTOCOL_REVISION = 1
#: Without an answer for so long, the force is none.
SILENCE_S = 0.05
#: Without an answer for so long, move() and steer() give up.
ANSWER_TIMEOUT_S = 5.0
#: In the order of proto/device.fbs: how old the newest pose is for the server.
LINK_STATES = ("fresh", "held", "fading", "lost")

_Three = tuple[float, float, float]
_NOTHING: _Three = (0.0, 0.0, 0.0)


class Button(enum.IntFlag):
    """What is pressed."""

    NONE = 0
    SPINDLE = 1  #: turns the reamer
    PAUSE = 2
    CLUTCH = 4  #: moves the hand without the reamer
    DEADMAN = 8  #: somebody holds the handle; without it the session rests
    REVERSE = 16
    IRRIGATE = 32


class Welcome(NamedTuple):
    """What the server says first."""

    session_id: str
    device: str
    force_max_n: float
    fade_ms: float  #: a pose older than this lets the force fall to nothing
    lost_ms: float  #: and from this on the session rests


@dataclasses.dataclass(frozen=True)
class Feedback:
    """The newest force, and how the session is."""

    sequence: int  #: of the newest message that the server has taken
    tick: int
    link: str  #: one of LINK_STATES
    state: str  #: of the session, one of ream.stream.STATES
    force_n: _Three  #: on the hand; frame of the device for move(), world for steer()
    torque_n_mm: _Three
    thrust_n: float  #: simulated, along the reamer's axis
    vibration_g: float
    engaged: bool  #: the reamer touches bone
    rtt_ms: float | None  #: there and back; None while it is not known
    stamp_us: int  #: the server's clock


class Device:
    """A session's device. Made by Client.device(); `async with` connects it and hangs up. For one task at a time."""

    def __init__(self, client: Client, session: str, name: str) -> None:
        self._client, self._session, self._name = client, session, name
        self._open = contextlib.AsyncExitStack()
        self._socket: Any = None
        self._listener: asyncio.Task[None] | None = None
        self._news = asyncio.Event()
        self._ended: ClientError | None = None
        self._sequence = 0
        self._echo_us = 0
        self._heard_s = -math.inf
        #: What the server said at the beginning.
        self.welcome = Welcome("", "", 0.0, 0.0, 0.0)
        #: The newest; None before the first.
        self.feedback: Feedback | None = None

    async def __aenter__(self) -> Device:
        address = self._client.connect_device(self._session)
        meant = f"the device of session {self._session} does not connect itself; make sessions with network or browser"
        self._socket = await self._open.enter_async_context(self._client._socket(address, {409: meant}))
        try:
            await self._socket.send(_hello(self._name))
            data = await asyncio.wait_for(self._socket.recv(), ANSWER_TIMEOUT_S)
            self.welcome = _read_welcome(data)
        except BaseException as failure:
            # What has become of the connection is said by the client's own words.
            if not await self._open.__aexit__(type(failure), failure, failure.__traceback__):
                raise
        self._listener = asyncio.create_task(self._listen())
        return self

    async def __aexit__(self, *_: object) -> None:
        if self._listener is not None:
            self._listener.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._listener
        await self._open.aclose()

    @property
    def force_n(self) -> _Three:
        """For the motors: the newest force, at most `welcome.force_max_n`, or zero where the server has been silent for 50 ms."""
        if self.feedback is None or not self._is_fresh():
            return _NOTHING
        force = self.feedback.force_n
        length = math.sqrt(sum(each * each for each in force))
        scale = min(1.0, self.welcome.force_max_n / length) if length > 0 else 1.0
        return (scale * force[0], scale * force[1], scale * force[2])

    @property
    def torque_n_mm(self) -> _Three:
        """As force_n."""
        return self.feedback.torque_n_mm if self.feedback is not None and self._is_fresh() else _NOTHING

    async def move(
        self,
        place_mm: Sequence[float],
        rotation_wxyz: Sequence[float] = (1.0, 0.0, 0.0, 0.0),
        *,
        trigger: float = 0.0,
        buttons: Button = Button.NONE,
        held: bool = True,
        hand_force_n: Sequence[float] | None = None,
        wait: bool = True,
    ) -> Feedback:
        """Says where the handle is and returns the answer to it. Of sessions with the device `network`.

        place_mm: x, y, z in the device's own frame, within 2 m. rotation_wxyz: a unit quaternion.
        trigger: from 0 (the spindle is off) to 1. held: somebody holds the handle; else the session rests.
        hand_force_n: that the hand exerts, of devices that measure it.
        wait: False returns at once, with the newest answer (the first one is waited for). So you can send often enough where the
            way there and back takes longer than some milliseconds. Answers come while you await anything, such as a sleep.

        Raises ClientError when the session or the connection has ended, and when the server does not answer.
        """
        self._require("move" if self.welcome.device != "browser" else "steer", "move")
        place, turn = _finite("place_mm", place_mm, 3), _finite("rotation_wxyz", rotation_wxyz, 4)
        if any(abs(coordinate) > 2000.0 for coordinate in place):
            raise ClientError("place_mm is more than 2 m away")
        if abs(math.hypot(*turn) - 1.0) > 1e-3:
            raise ClientError("rotation_wxyz is no unit quaternion")
        b = flatbuffers.Builder(256)
        Handle.HandleStart(b)
        self._number(b, Handle, trigger, buttons | (Button.DEADMAN if held else Button.NONE))
        Handle.HandleAddXMm(b, place[0])
        Handle.HandleAddYMm(b, place[1])
        Handle.HandleAddZMm(b, place[2])
        Handle.HandleAddRotation(b, Quat.CreateQuat(b, *turn))
        if hand_force_n is not None:
            Handle.HandleAddHandForceN(b, Vec3.CreateVec3(b, *_finite("hand_force_n", hand_force_n, 3)))
        return await self._say(_finished(b, DeviceBody.DeviceBody.Handle, Handle.HandleEnd(b)), wait)

    async def steer(
        self,
        push_n: float,
        sideways_mm: Sequence[float] = _NOTHING,
        lean: Sequence[float] | None = None,
        *,
        trigger: float = 0.0,
        buttons: Button = Button.NONE,
        wait: bool = True,
    ) -> Feedback:
        """Says what the simulated hand should do and returns the answer to it. Of sessions with the device `browser`.

        push_n: simulated N along the planned axis, negative to withdraw; -30 to 80 count.
        sideways_mm: world frame, from the planned entry; up to 60 mm of what is across the axis count.
        lean: world frame, where the reamer's axis should point, up to 30 degrees off the planned one; None: along it.

        wait: as in move(). Raises ClientError as move().
        """
        self._require("steer" if self.welcome.device in ("browser", "") else "move", "steer")
        b = flatbuffers.Builder(256)
        Steering.SteeringStart(b)
        self._number(b, Steering, trigger, buttons | Button.DEADMAN)
        Steering.SteeringAddPushN(b, _finite("push_n", [push_n], 1)[0])
        Steering.SteeringAddSidewaysMm(b, Vec3.CreateVec3(b, *_finite("sideways_mm", sideways_mm, 3)))
        if lean is not None:
            direction = _finite("lean", lean, 3)
            if not any(direction):
                raise ClientError("lean has no length")
            Steering.SteeringAddLean(b, Vec3.CreateVec3(b, *direction))
        return await self._say(_finished(b, DeviceBody.DeviceBody.Steering, Steering.SteeringEnd(b)), wait)

    def _require(self, taken: str, asked: str) -> None:
        """The server would only count what is of the other kind, and not answer."""
        if taken != asked:
            raise ClientError(f"a session with the device {self.welcome.device!r} is driven by {taken}(), not {asked}()")

    def _is_fresh(self) -> bool:
        return self._ended is None and time.monotonic() - self._heard_s < SILENCE_S

    def _number(self, b: Any, table: Any, trigger: float, buttons: Button) -> None:
        """What both kinds of message begin with."""
        if not 0.0 <= trigger <= 1.0:
            raise ClientError("trigger goes from 0 to 1")
        name = table.__name__.rpartition(".")[2]
        pressed = buttons | Button.SPINDLE if trigger > 0.0 else buttons
        age_us = int((time.monotonic() - self._heard_s) * 1e6) if self._echo_us else 0
        self._sequence = (self._sequence + 1) % 2**32
        getattr(table, f"{name}AddSequence")(b, self._sequence)
        getattr(table, f"{name}AddSentUs")(b, time.monotonic_ns() // 1000)
        getattr(table, f"{name}AddEchoUs")(b, self._echo_us)
        getattr(table, f"{name}AddEchoAgeUs")(b, min(age_us, 2**32 - 1))
        getattr(table, f"{name}AddButtons")(b, int(pressed))
        getattr(table, f"{name}AddTriggerSlack")(b, 255 - round(255 * trigger))

    async def _say(self, message: bytes, wait: bool) -> Feedback:
        if self._socket is None:
            raise ClientError("the device is not connected; use it in `async with`")
        if self._ended is not None:
            raise self._ended
        number, until = self._sequence, time.monotonic() + ANSWER_TIMEOUT_S
        try:
            await self._socket.send(message)
        except Exception:
            # The listener has the reason.
            await asyncio.wait({self._listener}, timeout=ANSWER_TIMEOUT_S)
            raise self._ended or ClientError("the connection broke") from None
        while self.feedback is None or (wait and 0 < (number - self.feedback.sequence) % 2**32 < 2**31):
            if self._ended is not None:
                raise self._ended
            self._news.clear()
            try:
                await asyncio.wait_for(self._news.wait(), until - time.monotonic())
            except asyncio.TimeoutError:
                raise ClientError(f"the server has not answered for {ANSWER_TIMEOUT_S:g} s") from None
        if self.feedback.state in ENDED:
            raise ClientError(f"session {self._session} has ended: {await asyncio.to_thread(self._end, self.feedback.state)}")
        return self.feedback

    def _end(self, state: str) -> str:
        """How it has ended, with the reason where there is one."""
        with contextlib.suppress(ClientError):
            fault = self._client.get_session(self._session)["fault"]
            return f"{state}: {fault}" if fault else state
        return state

    async def _listen(self) -> None:
        """Takes the newest answer until the connection ends, and says then why."""
        try:
            async for data in self._socket:
                told = _read_feedback(data)
                self._heard_s, self._echo_us, self.feedback = time.monotonic(), told.stamp_us, told
                self._news.set()
            self._ended = ClientError("the server has closed the connection of the device")
        except asyncio.CancelledError:
            raise
        except ClientError as failure:
            self._ended = failure
        except Exception as failure:
            reason = getattr(getattr(failure, "rcvd", None), "reason", "")
            self._ended = ClientError(f"the server has ended the connection of the device: {reason or failure}")
        finally:
            self._news.set()


def _finite(name: str, values: Sequence[float], count: int) -> list[float]:
    try:
        numbers = [float(value) for value in values]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != count or not all(math.isfinite(number) for number in numbers):
        raise ClientError(f"{name} must be {count} finite numbers" if count > 1 else f"{name} must be a finite number")
    return numbers


def _finished(b: Any, kind: int, body: int) -> bytes:
    DeviceMessage.DeviceMessageStart(b)
    DeviceMessage.DeviceMessageAddBodyType(b, kind)
    DeviceMessage.DeviceMessageAddBody(b, body)
    b.Finish(DeviceMessage.DeviceMessageEnd(b))
    return bytes(b.Output())


def _hello(name: str) -> bytes:
    b = flatbuffers.Builder(128)
    text = b.CreateString(name)
    DeviceHello.DeviceHelloStart(b)
    DeviceHello.DeviceHelloAddProtocolRevision(b, PROTOCOL_REVISION)
    DeviceHello.DeviceHelloAddName(b, text)
    return _finished(b, DeviceBody.DeviceBody.DeviceHello, DeviceHello.DeviceHelloEnd(b))


def _body(data: bytes | str, kind: int, table: Any) -> Any:
    """Raises ClientError for anything but a message of that kind."""
    try:
        if isinstance(data, str):
            raise ValueError("text")
        message = DeviceMessage.DeviceMessage.GetRootAs(data, 0)
        found, body = message.BodyType(), message.Body()
        if found != kind or body is None:
            raise ValueError(f"of kind {found}")
        table.Init(body.Bytes, body.Pos)
        return table
    except (struct.error, IndexError, TypeError, ValueError) as failure:
        raise ClientError(f"the server sent a device a message that cannot be read: {failure}") from None


def _read_welcome(data: bytes | str) -> Welcome:
    w = _body(data, DeviceBody.DeviceBody.Welcome, _welcome.Welcome())
    if w.ProtocolRevision() != PROTOCOL_REVISION:
        raise ClientError(
            f"the server speaks revision {w.ProtocolRevision()} of the device protocol, this client {PROTOCOL_REVISION}; "
            "install the python3-ream of the server's version"
        )
    try:
        name, device = (w.SessionId() or b"").decode(), (w.Device() or b"").decode()
        welcome = Welcome(name, device, w.ForceMaxN(), w.FadeMs(), w.LostMs())
    except (struct.error, IndexError, UnicodeDecodeError) as failure:
        raise ClientError(f"the server sent a device a message that cannot be read: {failure}") from None
    if not (math.isfinite(welcome.force_max_n) and welcome.force_max_n >= 0):
        raise ClientError("the server does not say how strong the device's force may be")
    return welcome


def _read_feedback(data: bytes | str) -> Feedback:
    f = _body(data, DeviceBody.DeviceBody.Feedback, _feedback.Feedback())
    try:
        force, torque = f.ForceN(), f.TorqueNMm()
        for vector in (force, torque):
            if vector is not None and not all(math.isfinite(each) for each in (vector.X(), vector.Y(), vector.Z())):
                raise ClientError("the server sent a device a force that is no number")
        return Feedback(
            sequence=f.Sequence(),
            tick=f.Tick(),
            link=LINK_STATES[f.Link()],
            state=STATES[f.State()],
            force_n=_NOTHING if force is None else (force.X(), force.Y(), force.Z()),
            torque_n_mm=_NOTHING if torque is None else (torque.X(), torque.Y(), torque.Z()),
            thrust_n=f.ThrustN(),
            vibration_g=f.VibrationG(),
            engaged=f.Engaged(),
            rtt_ms=None if f.RttMs() < 0 else f.RttMs(),
            stamp_us=f.StampUs(),
        )
    except (struct.error, IndexError) as failure:
        raise ClientError(f"the server sent a device a message that cannot be read: {failure}") from None
