"""Cases and sessions of a server, as 3D Slicer has them: places in RAS, mm. Knows nothing of Slicer."""

from __future__ import annotations

import pathlib
from typing import Any, NamedTuple, Optional

import numpy as np

from .client import Client, ClientError
from .files import Mesh, read_ply, read_stl, read_table
from .frames import lps_from_ras, ras_from_lps

#: Landmarks with one place each, as a server calls them, and as they are labelled in Slicer.
LANDMARKS = {
    "glenoid_centre_mm": "glenoid centre",
    "superior_rim_mm": "superior rim",
    "inferior_rim_mm": "inferior rim",
    "anterior_rim_mm": "anterior rim",
    "posterior_rim_mm": "posterior rim",
    "trigonum_mm": "trigonum",
    "inferior_angle_mm": "inferior angle",
}
_HEAD, _BICONCAVITY = "humeral head", ("paleoglenoid edge", "biconcavity ridge", "neoglenoid edge")
#: All labels, in reading order.
LABELS = (*LANDMARKS.values(), _HEAD, *_BICONCAVITY)
#: Of a trace with more rows, every n-th is loaded.
MAX_TRACE_ROWS = 20_000


class Plan(NamedTuple):
    """A planned axis."""

    entry: np.ndarray  #: RAS
    end: np.ndarray  #: RAS: the entry, moved by the depth along the axis, into the bone
    settings: dict  #: the server's plan, without its axis: reamer, guide, component


class LoadedCase(NamedTuple):
    """What a server has of a case."""

    id: str
    name: str
    volume: Optional[pathlib.Path]  #: a NRRD file, which names its own frame; None: the case has no CT
    bone: Optional[Mesh]  #: RAS
    landmarks: dict  #: label to place, RAS
    plan: Optional[Plan]


class LoadedSession(NamedTuple):
    """What a session has left."""

    id: str
    surface: Mesh  #: RAS
    deviation_mm: Optional[np.ndarray]  #: from the plan, one a vertex; NaN: nothing to compare. None: `missing` says why
    trace: dict  #: columns of trace.csv as the server has them, LPS
    path: np.ndarray  #: (n, 3) RAS: the reamer's apex at each row of the trace
    score: list  #: rows of texts, the first of them the heading
    component: Optional[Mesh]  #: RAS
    missing: list  #: sentences about what could not be had


class Bench:
    """One server, asked by one user. Raises client.ClientError for what it refuses."""

    def __init__(self, url: str, token: str = "") -> None:
        self.client = Client(url.strip(), token.strip() or None)

    def check(self) -> str:
        """Who asks, in words. Raises where the server does not let them in."""
        told = self.client.who_am_i()
        if told["login_needed"] and told["user"] is None:
            raise ClientError("this server has users: make a token with `ream user token NAME --for slicer`", 401)
        return f"connected as {told['user']['display_name']}" if told["user"] else "connected"

    def cases(self) -> list:
        """(id, words) of all cases, by id."""
        return [(case["id"], f"{case['name']} ({case['side']})") for case in self._pages(self.client.list_cases, "cases")]

    def sessions(self, case: Optional[str] = None) -> list:
        """(id, words) of sessions that have ended, newest first; of one case where it is named."""
        listed = self._pages(self.client.list_sessions, "sessions", sort="-created_utc", case=case)
        over = ("finished", "stopped", "fault", "interrupted")
        return [
            (one["id"], " ".join([one["created_utc"][:16].replace("T", " "), one["title"] or one["trainee"] or one["script"]]))
            for one in listed
            if one["kind"] == "session" and one["state"] in over
        ]

    def reamers(self) -> list:
        """Names that a plan may have."""
        return [reamer["name"] for reamer in self.client.list_reamers()["reamers"]]

    def load_case(self, case: str, folder: pathlib.Path) -> LoadedCase:
        """folder: where the CT goes."""
        told = self.client.get_case(case)
        volume = None
        if told["ct"] is not None:
            volume = self.client.get_volume(case, to_file=pathlib.Path(folder) / "ct.nrrd")
        bone = None
        if told["stage"] != "ct":
            bone = in_ras(read_ply(self.client.get_case_mesh(case)))
        plan = None if told["plan"] is None else plan_of(told["plan"])
        return LoadedCase(case, told["name"], volume, bone, places_of(told["landmarks"] or {}), plan)

    def load_session(self, session: str) -> LoadedSession:
        """Of a session that has ended. It waits for what the server has to make first."""
        missing: list = []
        surface = in_ras(read_ply(self._made(self.client.get_session_mesh, session)))
        deviation = self._if_there(missing, "deviation from the plan", self.client.deviation_mm, session, "plan")
        if deviation is not None and len(deviation) != len(surface.vertices):
            raise ClientError(f"the server gave {len(deviation)} deviations for {len(surface.vertices)} vertices")
        stride = max(1, -(-int(self.client.get_session(session)["tick"]) // MAX_TRACE_ROWS))
        trace = read_table(self.client.get_trace(session, stride=stride))
        path = ras_from_lps(np.stack([trace[f"tool_{axis}_mm"] for axis in "xyz"], axis=1))
        component = self._if_there(missing, "component", self._component, session)
        return LoadedSession(
            session, surface, deviation, trace, path, score_rows(self.client.get_score(session)), component, missing
        )

    def send_landmarks(self, case: str, places: dict) -> dict:
        """Replaces the landmarks by places (label to RAS); keeps what has no place. Returns the case."""
        known = self.client.get_landmarks(case) if self.client.get_case(case)["landmarks"] else {}
        return self.client.set_landmarks(case, landmarks_from(places, known))

    def propose_plan(self, case: str, targets: dict) -> tuple:
        """A plan of the server's and its warnings; nothing is saved. targets: as POST plan/proposal takes them."""
        told = self.client.propose_plan(case, targets)
        return plan_of(told["plan"]), told["assessment"]["warnings"]

    def send_plan(self, case: str, entry_ras: Any, end_ras: Any, settings: dict) -> list:
        """Replaces the plan: the axis goes from entry to end, whose distance is the depth. Returns the warnings.

        settings: of Plan, with at least the reamer.
        """
        return list(self.client.set_plan(case, new_plan(entry_ras, end_ras, settings))["assessment"]["warnings"])

    def _pages(self, method: Any, key: str, **query: Any) -> list:
        found: list = []
        cursor = None
        while True:
            page = method(limit=100, cursor=cursor, **query)
            found += page[key]
            cursor = page["next"]
            if cursor is None:
                return found

    def _made(self, method: Any, session: str) -> bytes:
        """What may have to be made first."""
        answer = method(session)
        if isinstance(answer, dict):
            self.client.wait(answer["id"])
            answer = method(session)
        return answer

    def _component(self, session: str) -> Mesh:
        job = self.client.export_session(session, {"format": "implant"})
        self.client.wait(job["id"])
        return in_ras(read_stl(self.client.get_job_result(job["id"])))

    @staticmethod
    def _if_there(missing: list, what: str, method: Any, *arguments: Any) -> Any:
        try:
            return method(*arguments)
        except ClientError as refused:
            if refused.status in (401, 403):
                raise
            missing.append(f"no {what}: {refused}")
            return None


def in_ras(mesh: Mesh) -> Mesh:
    """Half a turn: the outside of a triangle stays outside."""
    return Mesh(ras_from_lps(mesh.vertices), mesh.triangles, None if mesh.normals is None else ras_from_lps(mesh.normals))


def places_of(landmarks: dict) -> dict:
    """Label to place, RAS, of a server's landmarks."""
    found = {label: landmarks[key] for key, label in LANDMARKS.items() if key in landmarks}
    if "humeral_head" in landmarks:
        found[_HEAD] = landmarks["humeral_head"]["centre_mm"]
    found.update(zip(_BICONCAVITY, landmarks.get("biconcavity_mm", ())))
    return {label: ras_from_lps(np.asarray(place, float)) for label, place in found.items()}


def landmarks_from(places: dict, known: dict) -> dict:
    """What PUT landmarks takes. known: the server's; what a place cannot say (radius, Walch type) is taken from there."""
    unknown = sorted(set(places) - set(LABELS))
    if unknown:
        raise ClientError(f"no landmark is called {unknown[0]!r}; the labels are: {', '.join(LABELS)}")
    placed = {label: [float(x) for x in lps_from_ras(np.asarray(place, float))] for label, place in places.items()}
    sent: dict = {key: placed[label] for key, label in LANDMARKS.items() if label in placed}
    edges = [placed[label] for label in _BICONCAVITY if label in placed]
    if len(edges) == len(_BICONCAVITY):
        sent["biconcavity_mm"] = edges
    elif edges:
        raise ClientError(f"a biconcave face needs all of: {', '.join(_BICONCAVITY)}")
    if _HEAD in placed:
        if "humeral_head" not in known:
            raise ClientError("the humeral head has a radius: set it on the page first, or delete that point")
        sent["humeral_head"] = {"centre_mm": placed[_HEAD], "radius_mm": known["humeral_head"]["radius_mm"]}
    if "walch" in known:
        sent["walch"] = known["walch"]
    return sent


def plan_of(plan: dict) -> Plan:
    """A server's plan."""
    entry = np.asarray(plan["entry_mm"], float)
    end = entry + plan["depth_mm"] * np.asarray(plan["axis_direction"], float)
    axis = ("entry_mm", "axis_direction", "depth_mm")
    settings = {key: value for key, value in plan.items() if key not in axis and value is not None}
    return Plan(ras_from_lps(entry), ras_from_lps(end), settings)


def new_plan(entry_ras: Any, end_ras: Any, settings: dict) -> dict:
    """What PUT plan takes. The angles that the old plan aimed at are left out: the axis says them now."""
    entry, end = (lps_from_ras(np.asarray(place, float)) for place in (entry_ras, end_ras))
    depth_mm = float(np.linalg.norm(end - entry))
    if not 0.1 <= depth_mm <= 100:
        raise ClientError("the line from entry to end is as long as the depth: draw 0.1 to 100 mm")
    sent = {key: value for key, value in settings.items() if key not in ("version_deg", "inclination_deg")}
    sent["entry_mm"] = [float(x) for x in entry]
    sent["axis_direction"] = [float(x) for x in (end - entry) / depth_mm]
    sent["depth_mm"] = depth_mm
    return sent


def score_rows(score: dict) -> list:
    """A table of texts: heading, the whole, then every metric that has a value or a reason for none."""
    rows = [["metric", "value", "unit", "verdict", "points"]]
    rows.append(["overall", _text(score["points"]), "points", str(score["outcome"] or ""), _text(score["points"])])
    for metric in score["metrics"]:
        value = _text(metric["value"]) if metric["value"] is not None else f"missing: {metric['missing']}"
        rows.append([metric["name"], value, metric["unit"] or "", metric["verdict"] or "", _text(metric["points"])])
    return rows


def _text(number: Optional[float]) -> str:
    return "" if number is None else f"{number:.6g}"
