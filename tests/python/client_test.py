import asyncio
import contextlib
import inspect
import re
import socket
import subprocess
import threading
import time
import unittest

import ream
import yaml
from places import ROOT
from ream._operations import Operations
from ream.client import Client, ClientError
from served import ServedFolder

CONTRACT = yaml.safe_load((ROOT / "proto/openapi.yaml").read_text())
OPERATIONS = {
    operation["operationId"]: (verb, path, operation)
    for path, item in CONTRACT["paths"].items()
    for verb, operation in item.items()
    if verb != "parameters"
}
#: What any request may be answered, as the contract's introduction says.
ANY_REQUEST = {400, 413, 414, 431, 429, 503, 421, 401}


def method_name(operation_id: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", operation_id).lower()


class ClientTest(ServedFolder):
    def stopped_session(self) -> str:
        """The id of a session in which the demo's hand has reamed for a moment."""
        session = self.client.create_session({"case": "demo", "title": "By a program"})
        identity: str = session["id"]
        with contextlib.suppress(ClientError):
            self.client.start_session(identity)
        while self.client.get_session(identity)["tick"] < 1500:
            time.sleep(0.1)
        self.client.stop_session(identity)
        while self.client.get_session(identity)["state"] == "running":
            time.sleep(0.1)
        return identity

    def test_the_operations_are_those_of_the_contract(self) -> None:
        subprocess.run([str(ROOT / "scripts/write-client"), "--check"], check=True)
        methods = {name for name in vars(Operations) if not name.startswith("_")}
        self.assertEqual(methods, {method_name(name) for name in OPERATIONS})

    def test_says_who_asks(self) -> None:
        self.assertEqual(self.client.who_am_i()["user"]["name"], "anna")
        with self.assertRaises(ClientError) as raised:
            Client(self.url).list_sessions()
        self.assertEqual(raised.exception.status, 401)
        self.assertIsInstance(raised.exception, ream.Error)

    def test_a_session_from_beginning_to_end(self) -> None:
        identity = self.stopped_session()
        listed = self.client.list_sessions(limit=5, sort="-created_utc")["sessions"]
        self.assertIn(identity, [session["id"] for session in listed])
        metrics = self.client.get_session_metrics(identity)
        self.assertGreater(len(metrics), 20)
        recording = self.client.get_recording(identity, to_file=self.folder / "from-server.ream")
        self.assertEqual(len(ream.open(recording)), self.client.get_session(identity)["tick"])
        self.assertTrue(ream.open(recording).verify()["same"])
        snapshot = self.client.get_snapshot(identity, to_file=self.folder / "no-job.png")
        self.assertEqual(isinstance(snapshot, dict), not (self.folder / "no-job.png").exists())
        snapshot = self.client.get_snapshot(identity)
        if isinstance(snapshot, dict):
            self.client.wait(snapshot["id"], timeout_s=60)
            snapshot = self.client.get_snapshot(identity)
        self.assertEqual(snapshot[:4], b"\x89PNG")
        self.client.annotate_session(identity, {"words": "Steady"})
        job = self.client.export_session(identity, {"format": "csv", "stride": 10})
        self.client.wait(job["id"], timeout_s=60)
        rows = self.client.get_job_result(job["id"]).decode().splitlines()
        self.assertTrue(rows[0].startswith("t_s,"))
        self.client.delete_session(identity)
        with self.assertRaises(ClientError) as raised:
            self.client.get_session(identity)
        self.assertEqual((raised.exception.status, raised.exception.kind), (404, "not_found"))

    def test_sends_files_in_pieces(self) -> None:
        file = self.folder / "scan.txt"
        file.write_bytes(b"0 0 0 1\n" * 300_000)
        identity = self.client.upload(file)
        upload = self.client.get_upload(identity)
        self.assertEqual((upload["name"], upload["received"]), ("scan.txt", file.stat().st_size))
        self.client.delete_upload(identity)

    def test_a_job_that_fails_says_why(self) -> None:
        file = self.folder / "no-scan.nrrd"
        file.write_bytes(b"no scan")
        made = self.client.create_case({"name": "No scan", "side": "left", "upload_id": self.client.upload(file)})
        job = next(job for job in self.client.list_jobs()["jobs"] if job["case_id"] in (made.get("case_id"), made.get("id")))
        with self.assertRaisesRegex(ClientError, "failed: .*"):
            self.client.wait(job["id"], timeout_s=60)

    def test_hears_what_changes(self) -> None:
        async def first_change() -> list[dict]:
            heard = []
            async for message in self.client.changes():
                heard.append(message)
                if len(heard) == 1:
                    session = await asyncio.to_thread(self.client.create_session, {"case": "demo"})
                    await asyncio.to_thread(self.client.stop_session, session["id"])
                if len(heard) > 1:
                    return heard
            return heard

        heard = asyncio.run(asyncio.wait_for(first_change(), 30))
        self.assertEqual(heard[0]["kind"], "hello")
        self.assertGreater(len(heard), 1)

    def test_every_operation_can_be_called(self) -> None:
        session = self.stopped_session()
        for name, (verb, path, operation) in OPERATIONS.items():
            method = getattr(self.client, method_name(name))
            with self.subTest(name):
                statuses = self.outcome(verb, path, operation, method, session)
                documented = {int(code) for code in operation["responses"]}
                self.assertIn(statuses, documented | ANY_REQUEST, f"{verb} {path}")

    def outcome(self, verb: str, path: str, operation: dict, method: object, session: str) -> int:
        """What a call with plausible arguments comes to: its status. What changes things is asked of nobody."""
        arguments = []
        named = {"offset": 0, "expected": 10, "sd": 1, "difference": 1}
        given = {}
        for name, parameter in inspect.signature(method).parameters.items():
            if parameter.kind is parameter.POSITIONAL_OR_KEYWORD:
                real = "demo" if "/cases/" in path else session
                arguments.append(
                    {"body": {}, "content": b"x", "index": 1, "axis": "axial", "key": "key", "code": "P001"}.get(
                        name, real if verb == "get" else "nobody-at-all"
                    )
                )
            elif parameter.default is parameter.empty:
                given[name] = named.get(name, 1)
        try:
            answer = method(*arguments, **given)
        except ClientError as refused:
            self.assertTrue(str(refused))
            self.assertEqual(refused.problem.get("status"), refused.status)
            return refused.status
        if "101" in operation["responses"]:
            self.assertTrue(answer.startswith("ws://"), answer)
            return 101
        return min(int(code) for code in operation["responses"] if code.startswith("2"))

    def test_names_cannot_lead_elsewhere(self) -> None:
        for name in ("../users", "a/b", "a?b", "ä"):
            with self.assertRaises(ClientError) as raised:
                self.client.get_session(name)
            self.assertIn(raised.exception.status, (404, 422, 400))
        for name in ("", "..", "."):
            with self.assertRaises(ClientError) as raised:
                self.client.get_session(name)
            self.assertEqual(raised.exception.status, 0)

    def test_wrong_addresses_and_tokens_are_said(self) -> None:
        for wrong in ("127.0.0.1:8080", "ftp://127.0.0.1", "http://", "http://host:port", "http://h/?q=1", "http://[::1"):
            with self.assertRaisesRegex(ClientError, "http://127.0.0.1:8080"):
                Client(wrong)
        with self.assertRaises(ClientError) as raised:
            Client("http://anna:secret@127.0.0.1")
        self.assertNotIn("secret", str(raised.exception))
        with self.assertRaises(ClientError):
            Client(self.url, "two\r\nlines")
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            with self.assertRaisesRegex(ClientError, "cannot be asked"):
                Client(f"http://127.0.0.1:{taken.getsockname()[1]}").get_health()

    def test_answers_that_are_none_are_said(self) -> None:
        moved = b"HTTP/1.1 301 Moved\r\nLocation: https://elsewhere/\r\nContent-Length: 2\r\n\r\nno"
        deep = b"HTTP/1.1 400 No\r\nContent-Type: application/problem+json\r\nContent-Length: 6\r\n\r\n[[[[[["
        wrong = b"HTTP/1.1 200 OK\r\nContent-Length: abc\r\n\r\nhalf"
        for reply in (moved, deep, wrong, b"", b"HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\nhalf", b"nonsense\r\n\r\n"):
            with self.subTest(reply=reply), socket.socket() as server:
                server.bind(("127.0.0.1", 0))
                server.listen()

                def answer(server: socket.socket = server, reply: bytes = reply) -> None:
                    connection, _ = server.accept()
                    with connection:
                        connection.recv(65536)
                        connection.sendall(reply)

                thread = threading.Thread(target=answer)
                thread.start()
                out = self.folder / "part.bin"
                with self.assertRaises(ClientError):
                    Client(f"http://127.0.0.1:{server.getsockname()[1]}").get_recording("x", to_file=out)
                thread.join()
                self.assertEqual([path for path in self.folder.iterdir() if path.name.startswith("part.bin")], [])


if __name__ == "__main__":
    unittest.main()
