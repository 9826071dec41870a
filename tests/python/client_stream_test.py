import asyncio
import contextlib
import dataclasses
import io
import re
import subprocess
import sys
import threading
import time
import unittest
import unittest.mock
from collections.abc import AsyncIterator, Callable

import flatbuffers
import numpy as np
import ream
import websockets
from places import ROOT
from ream.client import Client, ClientError
from ream.stream import Hello, MeshDelta, Surface, Telemetry
from ream.wire import Body, DeviceBody, DeviceMessage, Feedback, Hello as wire_hello, ServerMessage, Vec3, Welcome
from served import ServedFolder

#: Columns of the trace by the names of Telemetry.
TRACE = ("thrust_n", "torque_n_mm", "feed_rate_mm_s", "density_g_cc", "vibration_g")


def enclosed_mm3(vertices: np.ndarray, triangles: np.ndarray) -> float:
    """By the divergence theorem; vertices are taken from near their middle, as digits would be lost far away."""
    corners = (vertices - vertices.mean(axis=0, dtype=float))[triangles].astype(float)
    return float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def area_mm2(vertices: np.ndarray, triangles: np.ndarray) -> float:
    corners = vertices[triangles].astype(float)
    return float(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2)


class StreamTest(ServedFolder):
    def watched(self, identity: str, **options: object) -> list:
        """All messages of a session's stream. One that was created is started once the stream has begun."""

        async def watch() -> list:
            messages = []
            async for message in self.client.stream(identity, **options):
                messages.append(message)
                if isinstance(message, Hello) and self.client.get_session(identity)["state"] == "created":
                    await asyncio.to_thread(self.client.start_session, identity)
            return messages

        return asyncio.run(asyncio.wait_for(watch(), 900))

    def created(self) -> str:
        return self.client.create_session({"case": "demo", "script": "short", "device": "script"})["id"]

    def recording_of(self, identity: str) -> ream.Recording:
        return ream.open(self.client.get_recording(identity, to_file=self.folder / f"{identity}.ream"))

    def test_every_tick_is_that_of_the_recording(self) -> None:
        identity = self.created()
        messages = self.watched(identity)
        hello, told = messages[0], [m for m in messages if isinstance(m, Telemetry)]
        self.assertIsInstance(hello, Hello)
        self.assertEqual((hello.session_id, hello.case_id, hello.replay_of), (identity, "demo", ""))
        self.assertEqual(told[-1].state, "finished")
        self.assertEqual(told[-1].fault, "")
        recording = self.recording_of(identity)
        rows = recording.ticks()
        seen: dict[int, tuple] = {}
        for one in (one for one in told if one.state != "created"):
            columns = [getattr(one, name) for name in (*TRACE, "hand_force_n")]
            for i, tick in enumerate(one.ticks):
                seen.setdefault(int(tick), tuple(column[i] for column in columns))
        self.assertEqual(len(seen) + told[-1].dropped, len(recording))
        self.assertGreater(len(seen), 1000)
        numbers = np.array(sorted(seen))
        values = np.array([seen[number] for number in numbers], np.float32)
        for i, name in enumerate(TRACE):
            np.testing.assert_array_equal(values[:, i], rows[name][numbers].astype(np.float32), name)
        hand = np.sqrt(sum(rows[f"hand_force_{axis}_n"].astype(float) ** 2 for axis in "xyz"))
        np.testing.assert_allclose(values[:, -1], hand[numbers], rtol=1e-6, atol=1e-6)
        self.assertGreater(values[:, 0].max(), 30)
        for one in told[:: max(1, len(told) // 20)]:
            if one.state == "running":
                world_from_tool = recording.world_from_grid @ ream.matrices(rows["grid_from_tool"][one.tick])
                np.testing.assert_allclose(one.world_from_tool, world_from_tool, atol=2e-5, rtol=1e-6)
        metrics = {metric["metric"]: metric["value"] for metric in self.client.get_score(identity)["metrics"]}
        self.assertAlmostEqual(told[-1].removed_volume_mm3, metrics["removed_volume_mm3"], delta=1e-3)

    def test_the_surface_is_that_of_the_server(self) -> None:
        identity = self.created()
        messages = self.watched(identity)
        surface = Surface(messages[0])
        deltas = [message for message in messages if isinstance(message, MeshDelta)]
        for delta in deltas:
            surface.take(delta)
        self.assertTrue(any(delta.key_complete for delta in deltas))
        answer = self.client.get_session_mesh(identity)
        if isinstance(answer, dict):
            self.client.wait(answer["id"])
        file = self.client.get_session_mesh(identity, to_file=self.folder / "left.ply")
        vertices, triangles = surface.mesh()
        expected_vertices, expected_triangles = ream.load_mesh(file)
        self.assertEqual(len(triangles), len(expected_triangles))
        volume = enclosed_mm3(expected_vertices, expected_triangles)
        self.assertGreater(volume, 1000)
        self.assertAlmostEqual(enclosed_mm3(vertices, triangles) / volume, 1, delta=1e-5)
        self.assertAlmostEqual(area_mm2(vertices, triangles) / area_mm2(expected_vertices, expected_triangles), 1, delta=1e-5)
        np.testing.assert_allclose(vertices.min(axis=0), expected_vertices.min(axis=0), atol=1e-3)
        np.testing.assert_allclose(vertices.max(axis=0), expected_vertices.max(axis=0), atol=1e-3)
        changed = [block for delta in deltas for block in delta.blocks if block.removed is not None]
        self.assertTrue(changed)
        self.assertTrue(all(len(block.removed) == block.vertex_count for block in changed))
        self.assertGreater(max(block.removed.max() for block in changed), 0)
        classes = [block.classes for delta in deltas for block in delta.blocks if block.classes is not None]
        self.assertLessEqual(max(values.max() for values in classes), 2)

    def test_who_comes_late_or_wants_no_surface_is_served(self) -> None:
        identity = self.ended_session()
        messages = self.watched(identity, stride=4)
        self.assertIsInstance(messages[0], Hello)
        self.assertTrue([message for message in messages if isinstance(message, MeshDelta)][-1].key_complete)
        self.assertEqual(messages[-1].state, "finished")
        alone = self.watched(identity, surface=False)
        self.assertEqual({type(message) for message in alone}, {Hello, Telemetry})

    def test_what_is_refused_is_one_sentence(self) -> None:
        identity = self.created()
        for client, name, status, words in (
            (Client(self.url, "wrong"), identity, 401, "log in|token"),
            (Client(self.url), identity, 401, "log in|token"),
            (self.client, "no-such-session", 404, "no-such-session"),
        ):
            for open_one in (self.first_of, self.connected):
                with self.subTest(name=name, status=status, way=open_one.__name__):
                    with self.assertRaisesRegex(ClientError, words) as raised:
                        open_one(client, name)
                    self.assertEqual(raised.exception.status, status)
                    self.assertNotIn("\n", str(raised.exception))
        with self.assertRaises(ClientError) as raised:
            self.connected(self.client, identity)  # its device is a script
        self.assertEqual(raised.exception.status, 409)
        self.assertIn("network or browser", str(raised.exception))
        self.client.stop_session(identity)

    @staticmethod
    def first_of(client: Client, name: str) -> object:
        async def first() -> object:
            async for message in client.stream(name):
                return message
            return None

        return asyncio.run(first())

    @staticmethod
    def connected(client: Client, name: str) -> None:
        async def connect() -> None:
            async with client.device(name):
                pass

        asyncio.run(connect())

    def test_what_the_guide_says_of_a_server_runs(self) -> None:
        """The blocks are text, as they need a server: this one takes the place of theirs."""
        part = (ROOT / "docs/python.md").read_text().partition("\n## A server\n")[2].partition("\n## ")[0]
        blocks = re.findall(r"^```text\n(.*?)^```", part, re.M | re.S)
        self.assertEqual(len(blocks), 3)
        names: dict = {}
        said = io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(said):
            for block in blocks:
                ours = block.replace("http://127.0.0.1:8080", self.url).replace('token="..."', f"token={self.token!r}")
                ours = ours.replace('create_session({"case": "demo"})', 'create_session({"case": "demo", "script": "short"})')
                exec(compile(ours, "docs/python.md", "exec"), names)
        self.assertIn(" finished ", said.getvalue())
        self.assertEqual(len(said.getvalue().splitlines()[-1].split(" ", 1)), 2)
        self.assertEqual(self.client.get_session(names["session"]["id"])["state"], "stopped")

    def test_a_session_of_an_earlier_run_is_refused(self) -> None:
        """Its folder is there, and nothing to watch."""
        out = self.simulated("earlier")
        bundle = self.folder / "data/sessions/of-earlier"
        if not bundle.exists():
            subprocess.run(["cp", "-r", str(out), str(bundle)], check=True)
        with self.assertRaises(ClientError) as raised:
            self.first_of(self.client, "of-earlier")
        self.assertEqual(raised.exception.status, 409)
        self.assertIn("replay_session", str(raised.exception))


class DeviceTest(ServedFolder):
    def started(self, device: str) -> str:
        identity: str = self.client.create_session({"case": "demo", "device": device})["id"]
        self.client.start_session(identity)
        return identity

    def ended(self, identity: str) -> ream.Recording:
        self.client.stop_session(identity)
        while self.client.get_session(identity)["state"] in ("running", "paused"):
            time.sleep(0.1)
        return ream.open(self.client.get_recording(identity, to_file=self.folder / f"{identity}.ream"))

    def test_the_recording_has_the_poses_that_were_sent(self) -> None:
        for _ in range(3):
            identity = self.started("network")
            try:
                rests, late = asyncio.run(asyncio.wait_for(self.moved(identity), 600))
            except ClientError as ended:
                # A machine that is so busy that the loop stands still ends the session.
                if "has ended: fault: " not in str(ended):
                    raise
                continue
            if rests[-1][2].thrust_n >= 10 or late < 0.1:
                return self.check_moves(identity, rests)
            self.ended(identity)
        self.skipTest("this machine is too busy to send 100 poses a second")

    async def moved(self, identity: str) -> tuple[list, float]:
        """Moves to known places; between them the hand rests until the handle has glided there. In the end it reams.

        The spindle stands while it moves: so thrust grows, and the reamer does not follow.
        Also the share of answers in which the server's newest pose was too old.
        """
        rests, links = [], []
        async with self.client.device(identity, name="test") as device:
            self.assertEqual((device.welcome.session_id, device.welcome.device), (identity, "network"))
            self.assertGreater(device.welcome.force_max_n, 0)
            place = np.zeros(3)
            feedback = await device.move(place)
            steps = [(0.4, 0, 0), (0, 0.3, 0), (0, 0, -0.5), (-0.4, 0, 0), (0, -0.3, 0), (0, 0, -0.5)]
            while feedback.thrust_n < 10 and place[2] > -40:
                steps.append(steps.pop(0))
                for _ in range(5):
                    place = place + np.asarray(steps[-1]) / 5
                    feedback = await device.move(place, wait=False)
                    await asyncio.sleep(0.001)
                until = feedback.tick + 120
                while feedback.tick < until:
                    feedback = await device.move(place, wait=False)
                    links.append(feedback.link)
                    await asyncio.sleep(0.001)
                rests.append((feedback.tick, place.copy(), feedback))
            until = feedback.tick + 1000
            while feedback.tick < until:
                feedback = await device.move(place, trigger=1.0)
                await asyncio.sleep(0.001)
            self.assertIs(device.feedback, feedback)
        return rests, sum(link in ("fading", "lost") for link in links) / len(links)

    def check_moves(self, identity: str, rests: list) -> None:
        recording = self.ended(identity)
        rows = recording.ticks()
        handle = ream.matrices(rows["world_from_handle"])[:, :3, 3]
        axis = recording.world_from_plan[:3, 2]
        # proto/device.md: towards the person is out of the bone, up is the patient's.
        up = np.array([0.0, 0.0, 1.0]) - axis * axis[2]
        up /= np.linalg.norm(up)
        world_from_device = np.column_stack([np.cross(up, -axis), up, -axis])
        paused = (rows["flags"] & ream.Flag.PAUSED) != 0
        compared = set()
        for (before, from_place, _), (after, to_place, _) in zip(rests, rests[1:]):
            if paused[before : after + 1].any():
                continue  # this machine was too busy to send: what was moved meanwhile does not count
            moved = world_from_device @ (to_place - from_place)
            np.testing.assert_allclose(handle[after] - handle[before], moved, atol=1e-4)
            compared.add(int(np.abs(to_place - from_place).argmax()))
        self.assertEqual(compared, {0, 1, 2}, "along each axis of the device")
        pressed = max((feedback for _, _, feedback in rests), key=lambda feedback: feedback.thrust_n)
        self.assertGreater(pressed.thrust_n, 9)
        self.assertTrue(pressed.engaged)
        self.assertGreater(pressed.force_n[2], 0, "the hand is pushed towards the person")
        self.assertAlmostEqual(pressed.thrust_n, float(rows["thrust_n"][pressed.tick]), delta=1e-3)
        self.assertEqual(ream.trigger(rows[: rests[-1][0]]).max(), 0)
        self.assertEqual(ream.trigger(rows).max(), 1)
        self.assertGreater(sum(int(rows[f"removed_{kind}"].sum()) for kind in ("cancellous", "cortical", "cartilage")), 0)
        self.assertTrue(recording.verify()["same"])

    def test_a_person_at_a_mouse_is_simulated(self) -> None:
        identity = self.started("browser")

        async def drive() -> list:
            felt = []
            async with self.client.device(identity) as device:
                with self.assertRaisesRegex(ClientError, "steer"):
                    await device.move([0, 0, 0])
                while len(felt) < 2000 and (not felt or felt[-1].thrust_n < 20):
                    felt.append(await device.steer(40.0, trigger=1.0))
                    await asyncio.sleep(0.01)
                felt.append(await device.steer(-20.0, lean=None, sideways_mm=(0, 0, 0)))
            return felt

        felt = asyncio.run(asyncio.wait_for(drive(), 600))
        self.assertGreater(max(feedback.thrust_n for feedback in felt), 19.9)
        recording = self.ended(identity)
        for feedback in felt[:-1:50]:
            self.assertAlmostEqual(feedback.thrust_n, float(recording.ticks(feedback.tick, feedback.tick + 1)["thrust_n"][0]), delta=1e-3)

    def test_nonsense_is_refused_before_it_is_sent(self) -> None:
        identity = self.started("network")

        async def drive() -> None:
            async with self.client.device(identity) as device:
                for wrong in (
                    dict(place_mm=[0, 0]),
                    dict(place_mm=[0, 0, float("nan")]),
                    dict(place_mm=[0, 0, 2001]),
                    dict(place_mm="abc"),
                    dict(place_mm=[0, 0, 0], rotation_wxyz=[1, 1, 0, 0]),
                    dict(place_mm=[0, 0, 0], trigger=1.1),
                    dict(place_mm=[0, 0, 0], hand_force_n=[1]),
                ):
                    with self.assertRaises(ClientError):
                        await device.move(**wrong)
                with self.assertRaisesRegex(ClientError, "move"):
                    await device.steer(1.0)
                feedback = await device.move([0, 0, 0])
                self.assertEqual(feedback.sequence, device._sequence)

        asyncio.run(asyncio.wait_for(drive(), 600))
        self.ended(identity)
        self.assertEqual(self.client.get_session(identity)["device"]["refused"], 0)

    def test_the_newest_client_is_the_device(self) -> None:
        identity = self.started("network")

        async def drive() -> None:
            async with self.client.device(identity, name="one") as one:
                await one.move([0, 0, 0])
                async with self.client.device(identity, name="two") as two:
                    await two.move([0, 0, 0])
                    with self.assertRaisesRegex(ClientError, "another client"):
                        while True:
                            await one.move([0, 0, 0])
                    self.assertEqual(one.force_n, (0, 0, 0))
                    await two.move([0, 0, 0])

        asyncio.run(asyncio.wait_for(drive(), 600))
        self.ended(identity)

    def test_a_session_that_has_ended_says_so(self) -> None:
        identity = self.started("network")

        async def drive() -> str:
            async with self.client.device(identity) as device:
                feedback = await device.move([0, 0, 0])
                await asyncio.to_thread(self.client.stop_session, identity)
                with self.assertRaisesRegex(ClientError, "ended: stopped"):
                    while True:
                        feedback = await device.move([0, 0, 0])
                        await asyncio.sleep(0.005)
            return feedback.state

        self.assertIn(asyncio.run(asyncio.wait_for(drive(), 600)), ("running", "paused"))
        with self.assertRaisesRegex(ClientError, "ended"):

            async def again() -> None:
                async with self.client.device(identity) as device:
                    await device.move([0, 0, 0])

            asyncio.run(asyncio.wait_for(again(), 600))


def server_message(kind: int, body: Callable[[flatbuffers.Builder], int]) -> bytes:
    b = flatbuffers.Builder(256)
    at = body(b)
    ServerMessage.ServerMessageStart(b)
    ServerMessage.ServerMessageAddBodyType(b, kind)
    ServerMessage.ServerMessageAddBody(b, at)
    b.Finish(ServerMessage.ServerMessageEnd(b))
    return bytes(b.Output())


def device_message(kind: int, body: Callable[[flatbuffers.Builder], int]) -> bytes:
    b = flatbuffers.Builder(256)
    at = body(b)
    DeviceMessage.DeviceMessageStart(b)
    DeviceMessage.DeviceMessageAddBodyType(b, kind)
    DeviceMessage.DeviceMessageAddBody(b, at)
    b.Finish(DeviceMessage.DeviceMessageEnd(b))
    return bytes(b.Output())


def hello(revision: int) -> bytes:
    def body(b: flatbuffers.Builder) -> int:
        wire_hello.HelloStart(b)
        wire_hello.HelloAddProtocolRevision(b, revision)
        return wire_hello.HelloEnd(b)

    return server_message(Body.Body.Hello, body)


def welcome(revision: int, force_max_n: float = 3.0) -> bytes:
    def body(b: flatbuffers.Builder) -> int:
        device = b.CreateString("network")
        Welcome.WelcomeStart(b)
        Welcome.WelcomeAddProtocolRevision(b, revision)
        Welcome.WelcomeAddDevice(b, device)
        Welcome.WelcomeAddForceMaxN(b, force_max_n)
        return Welcome.WelcomeEnd(b)

    return device_message(DeviceBody.DeviceBody.Welcome, body)


def feedback(sequence: int) -> bytes:
    def body(b: flatbuffers.Builder) -> int:
        Feedback.FeedbackStart(b)
        Feedback.FeedbackAddSequence(b, sequence)
        Feedback.FeedbackAddState(b, 1)
        Feedback.FeedbackAddStampUs(b, 1000)
        Feedback.FeedbackAddForceN(b, Vec3.CreateVec3(b, 0.0, 0.0, 2.0))
        return Feedback.FeedbackEnd(b)

    return device_message(DeviceBody.DeviceBody.Feedback, body)


@contextlib.asynccontextmanager
async def other_server(*answers: bytes | str) -> AsyncIterator[Client]:
    """Says these messages, one for each that it hears but for the first, and closes behind the last after one more."""

    async def serve(socket: object, _: str) -> None:
        said = list(answers)
        if socket.path.endswith("/device"):
            async for _ in socket:
                if not said:
                    return
                await socket.send(said.pop(0))
        else:
            for answer in said:
                await socket.send(answer)

    async with websockets.serve(serve, "127.0.0.1", 0) as server:
        yield Client(f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}", timeout_s=10)


class OtherServerTest(unittest.TestCase):
    """What a server of ours would not say."""

    def watched(self, *answers: bytes | str) -> list:
        async def watch() -> list:
            async with other_server(*answers) as client:
                return [message async for message in client.stream("x")]

        return asyncio.run(asyncio.wait_for(watch(), 60))

    def test_another_revision_is_said(self) -> None:
        with self.assertRaisesRegex(ClientError, "revision 2 of the stream, this client 1"):
            self.watched(hello(2))

        async def connect() -> None:
            async with other_server(welcome(2)) as client, client.device("x"):
                pass

        with self.assertRaisesRegex(ClientError, "revision 2 of the device protocol, this client 1"):
            asyncio.run(asyncio.wait_for(connect(), 60))

    def test_what_cannot_be_read_is_said(self) -> None:
        good = hello(1)
        for answers in (
            [b""],
            [b"\xff" * 40],
            ["text"],
            [good[:20]],
            [server_message(0, lambda b: 0)],
            [server_message(77, lambda b: 0)],
            [server_message(Body.Body.Telemetry, lambda b: 0)],
        ):
            with self.subTest(answers=answers), self.assertRaisesRegex(ClientError, "cannot be read"):
                self.watched(*answers)

    def test_a_block_outside_the_grid_is_refused(self) -> None:
        surface = Surface(unittest.mock.Mock(grid_dims=(9, 8, 24), block_edge_voxels=8))
        block = unittest.mock.Mock(revision=1)
        for block.block in range(6):
            surface.take(MeshDelta([block], False))
        block.block = 6
        with self.assertRaisesRegex(ClientError, "block 6, which lies outside the grid"):
            surface.take(MeshDelta([block], False))

    def test_random_damage_is_an_error_or_another_message(self) -> None:
        """Nothing else comes out of a reader."""
        from ream.stream import Reader

        random, good = np.random.default_rng(7), hello(1)
        for _ in range(500):
            bad = bytearray(good)
            for place in random.integers(0, len(bad), 3):
                bad[place] = random.integers(0, 256)
            with contextlib.suppress(ClientError):
                Reader().read(bytes(bad))

    def test_a_close_before_the_end_is_said(self) -> None:
        with self.assertRaisesRegex(ClientError, "closed the stream before"):
            self.watched()

    def test_every_field_of_the_stream_is_read(self) -> None:
        schema = (ROOT / "proto/stream.fbs").read_text()
        merged = {
            Telemetry: ({"first_tick", "tick_stride"}, {"ticks"}),
            Hello: (
                {"protocol_revision", "tool_positions_mm", "tool_indices", "tool_name"}
                | {"glenoid_centre_mm", "trigonum_mm", "inferior_angle_mm"},
                {"tool", "scapula_mm"},
            ),
            MeshDelta: (set(), set()),
        }
        for kind, (of_schema, of_ours) in merged.items():
            table = re.search(rf"^table {kind.__name__} {{\n(.*?)^}}", schema, re.M | re.S).group(1)
            fields = set(re.findall(r"\b([a-z][a-z0-9_]*):(?=[A-Za-z\[])", re.sub(r"//.*", "", table)))
            self.assertGreater(len(fields), 1)
            self.assertLessEqual(of_schema, fields)
            ours = {field.name for field in dataclasses.fields(kind)}
            self.assertEqual(fields - of_schema, ours - of_ours, kind.__name__)

    def test_more_force_than_the_device_takes_is_cut(self) -> None:
        async def drive() -> tuple:
            async with other_server(welcome(1, 0.5), feedback(1)) as client, client.device("x") as device:
                await device.move([0, 0, 0])
                return device.force_n

        with unittest.mock.patch("ream.device.time", unittest.mock.Mock(monotonic=lambda: 1.0, monotonic_ns=lambda: 10**9)):
            self.assertEqual(asyncio.run(asyncio.wait_for(drive(), 60)), (0, 0, 0.5))

    def test_a_silent_server_leaves_no_force(self) -> None:
        """By a clock that the test turns."""
        clock = unittest.mock.Mock(monotonic=lambda: now, monotonic_ns=lambda: int(now * 1e9))
        now = 100.0

        async def drive() -> None:
            nonlocal now
            async with other_server(welcome(1), feedback(1)) as client, client.device("x") as device:
                self.assertEqual(device.force_n, (0, 0, 0))
                await device.move([0, 0, 0])
                self.assertEqual(device.force_n, (0, 0, 2))
                now += 0.049
                self.assertEqual(device.force_n, (0, 0, 2))
                now += 0.002
                self.assertEqual(device.force_n, (0, 0, 0))
                self.assertEqual(device.torque_n_mm, (0, 0, 0))
                with self.assertRaisesRegex(ClientError, "closed"):
                    await device.move([0, 0, 0])

        with unittest.mock.patch("ream.device.time", clock):
            asyncio.run(asyncio.wait_for(drive(), 600))

    def test_what_is_missing_is_named(self) -> None:
        """Each package that a part of the client needs, with the way to have it."""
        for package in ("websockets", "flatbuffers"):
            code = (
                f"import sys; sys.modules[{package!r}] = None\n"
                "import asyncio, ream.client\n"
                "async def watch():\n"
                "    async for _ in ream.client.Client('http://127.0.0.1:1').stream('x'): pass\n"
                "asyncio.run(watch())"
            )
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
            self.assertIn(f"apt install python3-{package}", done.stderr.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
