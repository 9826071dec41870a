"""A real server for all tests of a class, with one user."""

import json
import signal
import subprocess
import time

from places import PROGRAM, SHORT_SCRIPT, DataFolder
from ream.client import Client


class ServedFolder(DataFolder):
    """`client` asks as operator anna."""

    #: More words of `ream serve`.
    serve_words: tuple[str, ...] = ()

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        add = [str(PROGRAM), "user", "add", "anna", "--display-name", "Anna", "--data", cls.data]
        subprocess.run(add, input="a long password\n", text=True, check=True, capture_output=True)
        cls.token = cls.ream("user", "token", "anna", "--for", "tests", "--data", cls.data).strip()
        scripts = cls.folder / "data/scripts"
        scripts.mkdir(exist_ok=True)
        (scripts / "short.json").write_text(json.dumps(SHORT_SCRIPT))
        words = ["serve", "--port", "0", "--data", cls.data, "--json", *cls.serve_words]
        log = (cls.folder / "serve.log").open("w")
        cls.addClassCleanup(log.close)
        cls.server = subprocess.Popen([str(PROGRAM), *words], stdout=subprocess.PIPE, stderr=log, text=True)
        cls.addClassCleanup(cls.stop)
        cls.address = json.loads(cls.server.stdout.readline())
        cls.url = cls.address["url"]
        cls.client = Client(cls.url, cls.token, timeout_s=300)
        cls.client.wait_until_ready(timeout_s=600)

    @classmethod
    def stop(cls) -> None:
        cls.server.send_signal(signal.SIGTERM)
        cls.server.communicate(timeout=300)

    @classmethod
    def ended_session(cls, **body: str) -> str:
        """The id of a session in which the short script has reamed the demo to its end."""
        session = cls.client.create_session({"case": "demo", "script": "short", "device": "script", **body})
        identity: str = session["id"]
        cls.client.start_session(identity)
        while (state := cls.client.get_session(identity)["state"]) in ("created", "running"):
            time.sleep(0.1)
        assert state == "finished", state
        return identity
