"""A server's REST API from Python: a method for each of its operations.

    from ream.client import Client

    client = Client("http://127.0.0.1:8080", token="...")
    for session in client.list_sessions(limit=10)["sessions"]:
        print(session["id"], session["state"])

`help(ream.client.Client)` lists the operations; the server describes them at /api. Answers are what the JSON says.
What the server refuses is a ClientError, with its sentence about what to do.
"""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import json
import os
import pathlib
import ssl
import tempfile
import time
import urllib.parse
from collections.abc import AsyncIterator, Iterator
from typing import TYPE_CHECKING, Any, Literal

from ._operations import Operations, _Content

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from ._ream import Error
    from .device import Device
    from .stream import Message
else:
    try:
        from ._ream import Error
    except ImportError:  # a copy of this file without the module, as 3D Slicer has it

        class Error(Exception):
            """What is refused; `kind` as ream.Error has it."""

            kind = "unavailable"


_PIECE_BYTES = 1 << 20
#: Of one message of a WebSocket: more than any that a server sends.
_MAX_MESSAGE_BYTES = 64 << 20
_KINDS = {404: "not_found", 409: "conflict", 429: "unavailable"}


class ClientError(Error):
    """What a server refused, or why it could not be asked.

    `status` is that of HTTP, 0 where there was no answer; `problem` is the whole answer, where it was problem+json.
    """

    def __init__(self, message: str, status: int = 0, problem: dict[str, Any] | None = None) -> None:
        super().__init__(message)
        self.status = status
        self.problem = problem or {}
        self.kind = _KINDS.get(status, "invalid_input" if 400 <= status < 500 else "unavailable")


class Client(Operations):
    """One server, asked by one user. Threads may share it."""

    def __init__(
        self, url: str, token: str | None = None, *, timeout_s: float = 60.0, tls: ssl.SSLContext | None = None
    ) -> None:
        """url: such as http://127.0.0.1:8080, with the path before /api where there is one.

        token: of `ream user token` or add_token(); a server without users needs none.
        timeout_s: that the server may be silent. tls: for certificates of your own.
        """
        try:
            parts = urllib.parse.urlsplit(url)
            port = parts.port or {"http": 80, "https": 443}[parts.scheme]
            usable = bool(parts.hostname) and not parts.query and not parts.fragment
        except (ValueError, KeyError):
            usable = False
        if not usable:
            raise ClientError("that is not the address of a server; it is like http://127.0.0.1:8080")
        if parts.username is not None or parts.password is not None:
            raise ClientError("an address has no user and password here; give a token")
        if token is not None and not (token.isascii() and token.isprintable()):
            raise ClientError("a token has printable ASCII characters only")
        self.url = url.rstrip("/")
        self._host, self._port = parts.hostname or "", port
        self._prefix = parts.path.rstrip("/")
        self._token = token
        self._timeout_s = timeout_s
        self._tls = (tls or ssl.create_default_context()) if parts.scheme == "https" else None

    def __repr__(self) -> str:
        return f"<ream.client.Client of {self.url}>"

    def upload(self, path: str | os.PathLike[str]) -> str:
        """Sends a file in pieces; the answer is what bodies call `upload_id`."""
        file = pathlib.Path(path)
        with file.open("rb") as content:
            size = os.fstat(content.fileno()).st_size
            upload = self.begin_upload({"name": file.name, "bytes": size})
            sent = 0
            while sent < size:
                content.seek(sent)
                piece = content.read(_PIECE_BYTES)
                upload = self.append_to_upload(upload["id"], piece, offset=sent)
                if not piece or upload["received"] != sent + len(piece):
                    raise ClientError(f"{file} changed while it was sent, or the server lost a piece of it")
                sent += len(piece)
        identity: str = upload["id"]
        return identity

    def wait(self, job: str, *, timeout_s: float = 3600.0) -> dict[str, Any]:
        """Waits for a job's end and returns it. Raises ClientError where it failed, was cancelled, or takes longer."""
        until = time.monotonic() + timeout_s
        while True:
            told: dict[str, Any] = self.get_job(job)
            if told["state"] == "done":
                return told
            if told["state"] in ("failed", "cancelled"):
                why = (told["problem"] or {}).get("detail", "no reason given")
                raise ClientError(f"job {job} {told['state']}: {why}")
            if time.monotonic() > until:
                raise ClientError(f"job {job} is not done after {timeout_s:g} s")
            time.sleep(0.2)

    def wait_until_ready(self, *, timeout_s: float = 300.0) -> None:
        """Waits until the server can make sessions: it may have just begun."""
        until = time.monotonic() + timeout_s
        while True:
            try:
                self.get_readiness()
                return
            except ClientError as error:
                if error.status not in (0, 503) or time.monotonic() > until:
                    raise
            time.sleep(0.2)

    def deviation_mm(self, session: str, to: Literal["plan", "implant", "wall"]) -> npt.NDArray[np.float32]:
        """How far each vertex of get_session_mesh() lies from the plan or the implant, or the wall behind it, in mm.

        Positive: too deep, or a gap. NaN: there is nothing to compare with. The mesh must have been asked for without
        a stride, after the session has ended. It waits where the server has to compute it.
        """
        import numpy as np

        path = self._filled("/api/v1/sessions/{id}/deviation", id=session)
        heads: dict[str, str] = {}
        answer = self._ask("GET", path, query={"to": to}, heads=heads)
        if isinstance(answer, dict):
            self.wait(answer["id"])
            answer = self._ask("GET", path, query={"to": to}, heads=heads)
        steps = np.frombuffer(answer, np.int8)
        found: npt.NDArray[np.float32] = (steps * float(heads["deviation-step-mm"])).astype(np.float32)
        found[steps == int(heads["deviation-unknown"])] = np.nan
        return found

    async def changes(self, since: int | None = None) -> AsyncIterator[dict[str, Any]]:
        """What changes on the server, as it happens, from after message `since`. Needs python3-websockets.

        The first is `hello`; the contract's ChangeMessage describes the others. Ends when the server closes.
        """
        async with self._socket(self.listen_to_changes(since=since)) as socket:
            async for message in socket:
                yield json.loads(message)

    async def stream(
        self, session: str, *, surface: bool = True, stride: Literal[1, 2, 4] = 1
    ) -> AsyncIterator[Message]:
        """What a viewer of a session sees, as it happens: messages of ream.stream, the first of them Hello.

        Then come MeshDelta (the bone's surface, block by block), Telemetry (about 60 a second), and in replays
        ToolChange. Ends when the session has ended and its surface is whole; of a session that has ended already that
        is at once. A replay does not end: leave it when you have seen enough.

        surface: False leaves MeshDelta out. The server sends it all the same, at a stride of 4, for the protocol has
            no way to ask for none: about a sixteenth of the bytes. Blocks that nobody decodes cost little.
        stride: 2 and 4 ask for a coarser surface, one sample every so many voxels.

        Who reads too slowly loses telemetry, not the connection: Telemetry.dropped counts the ticks. Raises ClientError where
        the server refuses, speaks another revision of the protocol, or closes before the session has ended. Needs
        python3-websockets and python3-flatbuffers.
        """
        from .stream import Reader

        reader = Reader(surface)
        address = self.stream_session(session, stride=stride if surface else 4)
        refusals = {409: f"session {session} is not open here, so that there is only its recording: replay_session() shows it"}
        async with self._socket(address, refusals) as socket:
            async for data in socket:
                message = reader.read(data)
                if message is not None:
                    yield message
                if reader.ended:
                    return
        raise ClientError(f"{self.url} closed the stream before session {session} had ended")

    def device(self, session: str, *, name: str = "python") -> Device:
        """Be the device of a session that was made with the device `network` or `browser`; `async with` connects.

        help(ream.device) has the frames and the rules. name: who you are, for the server. Needs python3-websockets and
        python3-flatbuffers.
        """
        from .device import Device

        return Device(self, session, name)

    @contextlib.asynccontextmanager
    async def _socket(self, address: str, refusals: dict[int, str] | None = None) -> AsyncIterator[Any]:
        """An open WebSocket. What goes wrong with it is a ClientError, also while it is used.

        refusals: what a status means where the server's own words cannot be had.
        """
        try:
            import websockets
        except ImportError:
            raise ImportError("WebSockets of ream.client need websockets: apt install python3-websockets") from None
        headers = {"Authorization": f"Bearer {self._token}"} if self._token else {}
        opening = websockets.connect(
            address,
            extra_headers=headers,
            ssl=self._tls,
            compression=None,
            max_size=_MAX_MESSAGE_BYTES,
            open_timeout=self._timeout_s,
        )
        try:
            async with opening as socket:
                yield socket
        except websockets.InvalidStatusCode as refused:
            status = refused.status_code
            meant = (refusals or {}).get(status, f"the server refused the WebSocket with status {status}")
            raise await asyncio.to_thread(self._refused, address, status, meant) from None
        except websockets.ConnectionClosedError as closed:
            why = closed.rcvd.reason if closed.rcvd is not None and closed.rcvd.reason else "the connection broke"
            raise ClientError(f"{self.url} has closed the connection: {why}") from None
        except (OSError, ValueError, asyncio.TimeoutError, websockets.WebSocketException) as failure:
            why = str(failure) or type(failure).__name__
            raise ClientError(f"{self.url} cannot be listened to: {why}") from None

    def _refused(self, address: str, status: int, meant: str) -> ClientError:
        """Why a WebSocket was refused: its answer is not passed on, so what it belongs to is asked for in plain HTTP."""
        path = address.removeprefix("ws" + self.url[len("http") :]).partition("?")[0]
        try:
            self._ask("GET", path.rpartition("/")[0])
        except ClientError as refusal:
            if refusal.status == status:
                return refusal
        return ClientError(meant, status)

    def _address(self, path: str, query: dict[str, Any] | None = None) -> str:
        return "ws" + self.url.removeprefix("http") + path + _encoded(query)

    @staticmethod
    def _filled(path: str, **parts: str | int) -> str:
        for name, part in parts.items():
            text = str(part)
            if text in ("", ".", ".."):
                raise ClientError(f"{name} must not be {text!r}")
            path = path.replace("{" + name + "}", urllib.parse.quote(text, safe=""))
        return path

    def _ask(
        self,
        method: str,
        path: str,
        *,
        query: dict[str, Any] | None = None,
        headers: dict[str, str | None] | None = None,
        body: Any = None,
        content: _Content | None = None,
        to_file: str | os.PathLike[str] | None = None,
        heads: dict[str, str] | None = None,
    ) -> Any:
        """heads: takes the answer's headers, names in lower case."""
        sent = {name: value for name, value in (headers or {}).items() if value is not None}
        if self._token:
            sent["Authorization"] = f"Bearer {self._token}"
        if body is not None:
            content = json.dumps(body, allow_nan=False).encode()
            sent["Content-Type"] = "application/json"
        elif content is not None:
            sent["Content-Type"] = "application/octet-stream"
        connection = self._connection()
        try:
            with _failures(self.url):
                connection.request(method, self._prefix + path + _encoded(query), bytes(content or b"") or None, sent)
                reply = connection.getresponse()
            if heads is not None:
                heads.update((key.lower(), value) for key, value in reply.getheaders())
            if to_file is not None and reply.status in (200, 206):
                return _saved(reply, pathlib.Path(to_file), self.url)
            with _failures(self.url):
                return _answer(reply)
        finally:
            connection.close()

    def _connection(self) -> http.client.HTTPConnection:
        if self._tls is not None:
            return http.client.HTTPSConnection(self._host, self._port, timeout=self._timeout_s, context=self._tls)
        return http.client.HTTPConnection(self._host, self._port, timeout=self._timeout_s)


def _encoded(query: dict[str, Any] | None) -> str:
    words = {True: "true", False: "false"}
    there = {
        name: words[value] if isinstance(value, bool) else value
        for name, value in (query or {}).items()
        if value is not None
    }
    return "?" + urllib.parse.urlencode(there) if there else ""


@contextlib.contextmanager
def _failures(url: str) -> Iterator[None]:
    """What goes wrong with a connection, or an answer that is none, as a ClientError."""
    try:
        yield
    except (OSError, http.client.HTTPException, ValueError, RecursionError) as failure:
        raise ClientError(f"{url} cannot be asked: {failure or type(failure).__name__}") from None


def _answer(reply: http.client.HTTPResponse) -> Any:
    kind = (reply.getheader("Content-Type") or "").split(";")[0].strip()
    if not 200 <= reply.status < 300:
        raise _refusal(reply, kind)
    content = reply.read()
    if kind == "application/json":
        return json.loads(content)
    return content if content or kind else None


def _refusal(reply: http.client.HTTPResponse, kind: str) -> ClientError:
    content = reply.read()
    problem: Any = None
    if kind == "application/problem+json":
        try:
            problem = json.loads(content)
        except ValueError:
            problem = None
    if not isinstance(problem, dict):
        elsewhere = reply.getheader("Location")
        more = f"; it says to ask {elsewhere}" if elsewhere else ""
        return ClientError(f"the server answered {reply.status} {reply.reason}{more}", reply.status)
    message = str(problem.get("detail") or problem.get("title") or reply.reason)
    return ClientError(message, reply.status, problem)


def _saved(reply: http.client.HTTPResponse, path: pathlib.Path, url: str) -> pathlib.Path:
    """Under a name of its own until all of it has come. Raises OSError where it cannot be written."""
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.name, suffix=".part", delete=False) as file:
        unfinished = pathlib.Path(file.name)
        try:
            while True:
                with _failures(url):
                    piece = reply.read(_PIECE_BYTES)
                if not piece:
                    break
                file.write(piece)
            file.flush()
            os.fsync(file.fileno())
            if reply.length not in (None, 0) or (reply.length is None and reply.getheader("Content-Length")):
                raise ClientError("the server ended before the file was whole")
            unfinished.chmod(0o666 & ~_umask())
            unfinished.rename(path)
        except BaseException:
            unfinished.unlink(missing_ok=True)
            raise
    return path


def _umask() -> int:
    """New files are for whom they usually are."""
    mask = os.umask(0o077)
    os.umask(mask)
    return mask
