"""One method for each operation of proto/openapi.yaml. Written by scripts/write-client; do not edit."""

from __future__ import annotations

import os
from typing import Any, Literal, Union

# Not written with |: 3D Slicer's Python is 3.9.
_Content = Union[bytes, bytearray, memoryview]


class Operations:
    """What a server can be asked; ream.client.Client asks it.

    Bodies and answers are JSON as the contract describes them, at /api of any server. Answers that are no JSON are
    bytes; with `to_file` they go into that file instead, and the file's path is returned. Where the server still
    has to make the file, the answer is a job: see Client.wait().
    """

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
    ) -> Any:
        raise NotImplementedError

    def _address(self, path: str, query: dict[str, Any] | None = None) -> str:
        raise NotImplementedError

    @staticmethod
    def _filled(path: str, **parts: str | int) -> str:
        raise NotImplementedError

    def get_health(self) -> Any:
        """The process answers."""
        return self._ask("GET", "/healthz")

    def get_readiness(self) -> Any:
        """Whether sessions can be made. 503 while the server prepares, and while its database does not answer."""
        return self._ask("GET", "/readyz")

    def get_server_metrics(self, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """Health of loops and devices of the sessions in memory, in the text format of Prometheus.

        For operators, any token, and programs on the server's own machine.
        """
        return self._ask("GET", "/metrics", to_file=to_file)

    def get_contract(self, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """This description."""
        return self._ask("GET", "/api/v1/openapi.yaml", to_file=to_file)

    def who_am_i(self) -> Any:
        """Who asks, and whether the server wants to know."""
        return self._ask("GET", "/api/v1/login")

    def log_in(self, body: dict[str, Any]) -> Any:
        """Log a page in.

        The cookie ends after 24 hours, or 2 without any use. Failed logins make the next one wait, longer each time
        (429).
        """
        return self._ask("POST", "/api/v1/login", body=body)

    def log_out(self) -> None:
        """End the login of this page."""
        self._ask("DELETE", "/api/v1/login")

    def log_in_by_link(self, body: dict[str, Any]) -> Any:
        """Let a page watch, by what a viewer link says behind "#watch="."""
        return self._ask("POST", "/api/v1/login/link", body=body)

    def change_password(self, body: dict[str, Any]) -> None:
        """Change one's own password.

        Ends all other logins of the user, and all tokens and links unless they are to stay.
        """
        self._ask("POST", "/api/v1/login/password", body=body)

    def list_users(self) -> Any:
        """All users by name; for operators and instructors."""
        return self._ask("GET", "/api/v1/users")

    def add_user(self, body: dict[str, Any]) -> Any:
        """Add a user; the first one is an operator, and from then on everybody has to log in."""
        return self._ask("POST", "/api/v1/users", body=body)

    def get_user(self, id: str) -> Any:
        """One user; for operators and instructors."""
        return self._ask("GET", self._filled("/api/v1/users/{id}", id=id))

    def change_user(self, id: str, body: dict[str, Any]) -> Any:
        """Change a user.

        A new password ends the user's logins, and tokens and links unless they are to stay; disabling ends all that the
        user has. 409 when no operator would be left who can log in.
        """
        return self._ask("PATCH", self._filled("/api/v1/users/{id}", id=id), body=body)

    def remove_user(self, id: str) -> None:
        """Remove a user with all logins, tokens and links; sessions stay."""
        self._ask("DELETE", self._filled("/api/v1/users/{id}", id=id))

    def list_tokens(self, *, user_id: str | None = None) -> Any:
        """One's own tokens that have not ended, newest first; an operator has those of all.

        user_id: For operators: of that user only
        """
        return self._ask("GET", "/api/v1/tokens", query={"user_id": user_id})

    def add_token(self, body: dict[str, Any]) -> Any:
        """Make a token for a program; its secret is told this once.

        A token made by means of a token can do no more and lives no longer than that one.
        """
        return self._ask("POST", "/api/v1/tokens", body=body)

    def revoke_token(self, id: str) -> None:
        """Revoke a token, one's own or, as an operator, anybody's; what it has open is closed."""
        self._ask("DELETE", self._filled("/api/v1/tokens/{id}", id=id))

    def list_links(self) -> Any:
        """Viewer links that one has made and that have not ended, newest first; an operator has those of all."""
        return self._ask("GET", "/api/v1/links")

    def add_link(self, body: dict[str, Any]) -> Any:
        """Make a viewer link to one session or to all; its secret is told this once.

        The link is the page's address with "#watch=" and the secret behind it, which browsers never send to the server.
        409 while the server has no users: everybody may watch without a link then.
        """
        return self._ask("POST", "/api/v1/links", body=body)

    def revoke_link(self, id: str) -> None:
        """Revoke a viewer link; who watches by it is sent away."""
        self._ask("DELETE", self._filled("/api/v1/links/{id}", id=id))

    def list_audit(self, *, limit: int | None = None, before: int | None = None) -> Any:
        """What has been changed of access and data, newest first; for operators.

        before: Only entries with lower numbers; "next" of the page before
        """
        return self._ask("GET", "/api/v1/audit", query={"limit": limit, "before": before})

    def list_uploads(
        self,
        *,
        limit: int | None = None,
        cursor: str | None = None,
        sort: Literal["name", "-name", "id", "-id", "bytes", "-bytes"] | None = None,
    ) -> Any:
        """Files on their way here, a page at a time.

        Of files that others send only operators see the name; for instructors it is "*" with the ending.

        limit: Most items of the page
        cursor: `next` of the page before, with the same sort and filters; absent means the first page
        """
        return self._ask("GET", "/api/v1/uploads", query={"limit": limit, "cursor": cursor, "sort": sort})

    def begin_upload(self, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Begin to send a file in pieces.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask("POST", "/api/v1/uploads", headers={"Idempotency-Key": idempotency_key}, body=body)

    def get_upload(self, id: str) -> Any:
        """How much of a file has come."""
        return self._ask("GET", self._filled("/api/v1/uploads/{id}", id=id))

    def append_to_upload(self, id: str, content: _Content, *, offset: int) -> Any:
        """Send the next piece, at most 1 MiB.

        offset: Where the piece begins; 409 unless that is what has come so far
        """
        return self._ask("PUT", self._filled("/api/v1/uploads/{id}", id=id), query={"offset": offset}, content=content)

    def delete_upload(self, id: str) -> None:
        """Give up an upload."""
        self._ask("DELETE", self._filled("/api/v1/uploads/{id}", id=id))

    def list_jobs(
        self,
        *,
        limit: int | None = None,
        cursor: str | None = None,
        sort: Literal["number", "-number"] | None = None,
        case_id: str | None = None,
        session_id: str | None = None,
        kind: Literal["import", "segmentation", "build", "export", "mesh", "snapshot", "deviation", "rescoring"] | None = None,
        state: Literal["waiting", "running", "done", "failed", "cancelled"] | None = None,
    ) -> Any:
        """Long work, a page at a time; trainees see that on their own sessions.

        limit: Most items of the page
        cursor: `next` of the page before, with the same sort and filters; absent means the first page
        sort: -number: newest first
        case_id: Only work on that case
        session_id: Only work on that session
        """
        return self._ask(
            "GET",
            "/api/v1/jobs",
            query={"limit": limit, "cursor": cursor, "sort": sort, "case_id": case_id, "session_id": session_id, "kind": kind, "state": state},
        )

    def get_job(self, id: str) -> Any:
        """One job."""
        return self._ask("GET", self._filled("/api/v1/jobs/{id}", id=id))

    def cancel_job(self, id: str) -> Any:
        """Ask a job to end; it does at its next step."""
        return self._ask("DELETE", self._filled("/api/v1/jobs/{id}", id=id))

    def get_job_result(self, id: str, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """The file that a job has made; it is kept for a day.

        One Range can be asked for (206, or 416 beyond the end).
        """
        return self._ask("GET", self._filled("/api/v1/jobs/{id}/result", id=id), to_file=to_file)

    def list_cases(
        self,
        *,
        limit: int | None = None,
        cursor: str | None = None,
        sort: Literal["id", "-id", "name", "-name", "side", "-side", "stage", "-stage"] | None = None,
    ) -> Any:
        """Cases that can be read, a page at a time.

        limit: Most items of the page
        cursor: `next` of the page before, with the same sort and filters; absent means the first page
        """
        return self._ask("GET", "/api/v1/cases", query={"limit": limit, "cursor": cursor, "sort": sort})

    def create_case(self, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Make a case of an uploaded CT, or of the CT of another case (for the other shoulder).

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask("POST", "/api/v1/cases", headers={"Idempotency-Key": idempotency_key}, body=body)

    def get_case(self, id: str) -> Any:
        """One case with its plan."""
        return self._ask("GET", self._filled("/api/v1/cases/{id}", id=id))

    def delete_case(self, id: str) -> None:
        """Delete a case to which no sessions belong."""
        self._ask("DELETE", self._filled("/api/v1/cases/{id}", id=id))

    def get_volume(self, id: str, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """The case's whole CT as a NRRD file of 16-bit HU, without names; LPS mm.

        409 for a case that was made without a CT.
        """
        return self._ask("GET", self._filled("/api/v1/cases/{id}/volume", id=id), to_file=to_file)

    def get_slice(
        self,
        id: str,
        axis: Literal["u", "v", "w"],
        index: int,
        *,
        of: Literal["hu", "labels"] | None = None,
        revision: int | None = None,
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """One slice of the case's CT.

        axis: The voxel axis across which the slice lies
        of: hu (the default): 16-bit signed HU; labels: one byte a voxel, 0 nothing, 1 scapula, 2 humerus, 3 clavicle, 4
            other bone
        revision: Of the segmentation that is meant: 409 when its labels are no longer those
        """
        return self._ask(
            "GET",
            self._filled("/api/v1/cases/{id}/volume/slices/{axis}/{index}", id=id, axis=axis, index=index),
            query={"of": of, "revision": revision},
            to_file=to_file,
        )

    def get_case_mesh(self, id: str, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """Surface of the segmented scapula, or of the bone of a case without a CT; LPS mm."""
        return self._ask("GET", self._filled("/api/v1/cases/{id}/mesh", id=id), to_file=to_file)

    def get_case_surroundings(self, id: str, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """What of the scapula lies around the bone that is reamed, for pictures; LPS mm. 404 where there is nothing."""
        return self._ask("GET", self._filled("/api/v1/cases/{id}/surroundings", id=id), to_file=to_file)

    def segment_case(self, id: str, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Tell the bones of the case's shoulder apart.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask(
            "POST",
            self._filled("/api/v1/cases/{id}/segmentation", id=id),
            headers={"Idempotency-Key": idempotency_key},
            body=body,
        )

    def undo_segmentation(self, id: str) -> Any:
        """Go back to the segmentation before."""
        return self._ask("POST", self._filled("/api/v1/cases/{id}/segmentation/undo", id=id))

    def build_case(self, id: str, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Make the bone that can be reamed.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask(
            "POST",
            self._filled("/api/v1/cases/{id}/build", id=id),
            headers={"Idempotency-Key": idempotency_key},
            body=body,
        )

    def get_landmarks(self, id: str) -> Any:
        """The landmarks that are set, as PUT takes them."""
        return self._ask("GET", self._filled("/api/v1/cases/{id}/landmarks", id=id))

    def set_landmarks(self, id: str, body: dict[str, Any]) -> Any:
        """Replace all landmarks; any subset of them."""
        return self._ask("PUT", self._filled("/api/v1/cases/{id}/landmarks", id=id), body=body)

    def get_measures(self, id: str) -> Any:
        """Version, inclination and subluxation by the landmarks."""
        return self._ask("GET", self._filled("/api/v1/cases/{id}/measures", id=id))

    def get_plan(self, id: str) -> Any:
        """The plan; 404 while there is none."""
        return self._ask("GET", self._filled("/api/v1/cases/{id}/plan", id=id))

    def set_plan(self, id: str, body: dict[str, Any]) -> Any:
        """Replace the plan.

        409 with the reason when reaming alone would have to correct 15 degrees or more and the plan does not override
        that.
        """
        return self._ask("PUT", self._filled("/api/v1/cases/{id}/plan", id=id), body=body)

    def propose_plan(self, id: str, body: dict[str, Any]) -> Any:
        """A plan for wanted angles and depth; nothing is saved."""
        return self._ask("POST", self._filled("/api/v1/cases/{id}/plan/proposal", id=id), body=body)

    def assess_plan(self, id: str, body: dict[str, Any]) -> Any:
        """What a plan would do, and what it reaches where it is carried out exactly; nothing is saved."""
        return self._ask("POST", self._filled("/api/v1/cases/{id}/plan/assessment", id=id), body=body)

    def list_reamers(self) -> Any:
        """The library of reamers, users' own included."""
        return self._ask("GET", "/api/v1/reamers")

    def list_sessions(
        self,
        *,
        limit: int | None = None,
        cursor: str | None = None,
        sort: Literal["created_utc", "-created_utc", "duration_s", "-duration_s", "case", "-case", "trainee", "-trainee", "state", "-state", "points", "-points"] | None = None,
        state: str | None = None,
        case: str | None = None,
        trainee: str | None = None,
        study: str | None = None,
        participant: str | None = None,
        from_: str | None = None,
        to: str | None = None,
        q: str | None = None,
        outcome: str | None = None,
        points_from: float | None = None,
        points_to: float | None = None,
    ) -> Any:
        """Sessions of the data folder, those of earlier runs of the server included, a page at a time; and open
        replays.

        Of those that the caller may see. Filters are all to be met. Where there is another page a Link header leads
        there, too.

        limit: Most items of the page
        cursor: `next` of the page before, with the same sort and filters; absent means the first page
        sort: Key, behind - for the other way about
        state: Any of these states, by commas
        trainee: Id of the user who trains; trainees see their own only
        from_: Created then or later; UTC, or the beginning of one such as 2026-01
        to: Created before then
        q: Words that id, case, script, names or title hold
        outcome: Any of these results, by commas; none: not judged, or by a rubric that decides nothing
        points_from: So many points or more; sessions without points do not pass
        points_to: So many points or fewer
        """
        return self._ask(
            "GET",
            "/api/v1/sessions",
            query={"limit": limit, "cursor": cursor, "sort": sort, "state": state, "case": case, "trainee": trainee, "study": study, "participant": participant, "from": from_, "to": to, "q": q, "outcome": outcome, "points_from": points_from, "points_to": points_to},
        )

    def create_session(self, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Make a session ready to start.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask("POST", "/api/v1/sessions", headers={"Idempotency-Key": idempotency_key}, body=body)

    def get_session(self, id: str) -> Any:
        """One session or replay."""
        return self._ask("GET", self._filled("/api/v1/sessions/{id}", id=id))

    def change_session(self, id: str, body: dict[str, Any]) -> Any:
        """Change what a session is called, whose it is, and whether it is kept for good.

        A trainee may change the title only (403).
        """
        return self._ask("PATCH", self._filled("/api/v1/sessions/{id}", id=id), body=body)

    def delete_session(self, id: str) -> None:
        """Delete a session that has ended.

        It can be restored for as long as the server keeps deleted sessions (30 days unless it was told otherwise).
        Trainees delete their own, but none of a study (403). 409 while the session is live or in use, or has `keep`.
        """
        self._ask("DELETE", self._filled("/api/v1/sessions/{id}", id=id))

    def restore_session(self, id: str) -> Any:
        """Have a deleted session back.

        Sessions that were deleted for their age are deleted again unless they get `keep`.
        """
        return self._ask("POST", self._filled("/api/v1/sessions/{id}/restore", id=id))

    def list_deleted_sessions(
        self,
        *,
        limit: int | None = None,
        cursor: str | None = None,
        sort: Literal["deleted_utc", "-deleted_utc"] | None = None,
    ) -> Any:
        """Deleted sessions that can be restored, a page at a time.

        limit: Most items of the page
        cursor: `next` of the page before, with the same sort and filters; absent means the first page
        sort: -deleted_utc: lately deleted ones first
        """
        return self._ask("GET", "/api/v1/trash", query={"limit": limit, "cursor": cursor, "sort": sort})

    def pause_session(self, id: str) -> Any:
        """Take the force away until the session is started again.

        As the device's own pause button does it, in a tick that is recorded; a script waits meanwhile. The session is
        `paused` and `held` when this answers, and goes on with POST start.
        """
        return self._ask("POST", self._filled("/api/v1/sessions/{id}/pause", id=id))

    def reset_session(self, id: str, *, idempotency_key: str | None = None) -> Any:
        """Another attempt from intact bone.

        Ends the session, whose recording is kept, and makes a new one with the same settings, trainee and study, which
        runs if the old one ran. The old one's `followed_by` names it, and viewers and devices that are connected to the
        old one are told so by a farewell with code 4001. Each attempt is scored by itself.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask(
            "POST",
            self._filled("/api/v1/sessions/{id}/reset", id=id),
            headers={"Idempotency-Key": idempotency_key},
        )

    def start_session(self, id: str) -> Any:
        """Start a session that was created, or go on with one that was paused by POST pause."""
        return self._ask("POST", self._filled("/api/v1/sessions/{id}/start", id=id))

    def stop_session(self, id: str) -> Any:
        """End a session that has not ended, or a replay, which is then unknown."""
        return self._ask("POST", self._filled("/api/v1/sessions/{id}/stop", id=id))

    def resume_session(self, id: str, *, body: dict[str, Any] | None = None, idempotency_key: str | None = None) -> Any:
        """Go on with a session that was interrupted or stopped.

        The bone is as the session left it; recording and metrics go on under the same id, the script begins anew. It
        runs when this answers. The body may be left out.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask(
            "POST",
            self._filled("/api/v1/sessions/{id}/resume", id=id),
            headers={"Idempotency-Key": idempotency_key},
            body=body,
        )

    def list_annotations(self, id: str) -> Any:
        """Remarks in the session's recording, in the order they were made."""
        return self._ask("GET", self._filled("/api/v1/sessions/{id}/annotations", id=id))

    def annotate_session(self, id: str, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Put a remark into the session's recording, while it runs or after its end.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask(
            "POST",
            self._filled("/api/v1/sessions/{id}/annotations", id=id),
            headers={"Idempotency-Key": idempotency_key},
            body=body,
        )

    def replay_session(self, id: str, *, idempotency_key: str | None = None) -> Any:
        """Open the recording of a session that has ended.

        The replay has an id of its own. Its stream is that of a live session, with `replay_of` in the hello and
        `playback` in all telemetry; its metrics are those up to the moment shown. It rests at the start until it is
        told to play. As many replays are open as the server allows, and two for each trainee or viewer; then the one
        that has gone unwatched for longest gives way, or 503 (409 for one's own) when all are watched. One that nobody
        has watched or asked for 15 minutes ends.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask(
            "POST",
            self._filled("/api/v1/sessions/{id}/replay", id=id),
            headers={"Idempotency-Key": idempotency_key},
        )

    def control_playback(self, id: str, body: dict[str, Any]) -> Any:
        """Play, rest, change the speed of a replay or go to a moment.

        All viewers of the replay see the same. Playing from the end begins at the start again.
        """
        return self._ask("POST", self._filled("/api/v1/sessions/{id}/playback", id=id), body=body)

    def get_session_metrics(self, id: str) -> Any:
        """Metrics so far; final once the session has ended.

        Of a replay they are those up to the moment shown: 503 while the recording is still being read up to there, 422
        when it is damaged before.
        """
        return self._ask("GET", self._filled("/api/v1/sessions/{id}/metrics", id=id))

    def get_recording(self, id: str, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """The session's recording as it is now; proto/recording.md describes it.

        One Range can be asked for (206, or 416 beyond the end).
        """
        return self._ask("GET", self._filled("/api/v1/sessions/{id}/recording", id=id), to_file=to_file)

    def get_session_file(self, id: str) -> Any:
        """What was simulated, by which build, and how it ended; proto/session.schema.json describes it."""
        return self._ask("GET", self._filled("/api/v1/sessions/{id}/session.json", id=id))

    def get_trace(
        self,
        id: str,
        *,
        from_s: float | None = None,
        to_s: float | None = None,
        stride: int | None = None,
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """Force trace, one row a tick; of a live session what has been written down so far.

        At most a million rows (422); an export has no such limit.

        from_s: Simulated time of the first row
        to_s: The rows end before it
        stride: One row every so many ticks
        """
        return self._ask(
            "GET",
            self._filled("/api/v1/sessions/{id}/trace", id=id),
            query={"from_s": from_s, "to_s": to_s, "stride": stride},
            to_file=to_file,
        )

    def get_session_mesh(
        self,
        id: str,
        *,
        stride: int | None = None,
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """Surface of the bone, as it is now or as the session left it; LPS mm.

        Of a session that has ended it may have to be made first; then the answer is 202 with the job that does so.

        stride: Of a live session one sample every so many voxels
        """
        return self._ask(
            "GET",
            self._filled("/api/v1/sessions/{id}/mesh", id=id),
            query={"stride": stride},
            to_file=to_file,
        )

    def get_snapshot(self, id: str, *, to_file: str | os.PathLike[str] | None = None) -> Any:
        """A picture of the bone, as it is now or as the session left it; freshly cut bone is red.

        Of a session that has ended it may have to be made first; then the answer is 202 with the job that does so.
        """
        return self._ask("GET", self._filled("/api/v1/sessions/{id}/snapshot", id=id), to_file=to_file)

    def export_session(self, id: str, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Make a file of a session that has ended.

        503 when too many jobs wait or run, or four of the same trainee.

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask(
            "POST",
            self._filled("/api/v1/sessions/{id}/exports", id=id),
            headers={"Idempotency-Key": idempotency_key},
            body=body,
        )

    def stream_session(self, id: str, *, stride: int | None = None) -> str:
        """Surface, poses and force trace as they change.

        A WebSocket of binary FlatBuffers messages (proto/stream.fbs, ServerMessage): Hello, then MeshDelta until the
        surface is whole, then MeshDelta and Telemetry live. Without an upgrade the answer is 426. Slow links may ask
        for a coarser surface with `stride`: one sample every 2 or 4 voxels, about 1/4 or 1/16 of the bytes; blocks and
        units stay the same.
        """
        return self._address(self._filled("/api/v1/sessions/{id}/stream", id=id), query={"stride": stride})

    def connect_device(self, id: str) -> str:
        """Be the device of a session.

        A WebSocket of binary FlatBuffers messages (proto/device.fbs, DeviceMessage; proto/device.md says how to write a
        client): DeviceHello, answered by Welcome, then Handle or Steering, each answered by Feedback. A client that
        connects takes the place of one that was there. 409 when the session's device is none that connects itself.
        Without an upgrade the answer is 426.
        """
        return self._address(self._filled("/api/v1/sessions/{id}/device", id=id))

    def list_studies(self) -> Any:
        """Studies, newest first; trainees have those they take part in."""
        return self._ask("GET", "/api/v1/studies")

    def create_study(self, body: dict[str, Any]) -> Any:
        """Make a study; it is open at once."""
        return self._ask("POST", "/api/v1/studies", body=body)

    def join_study(self, body: dict[str, Any]) -> Any:
        """Take part in the study that has this join code.

        Only for callers with an account; 409 when they take part already or the study is closed.
        """
        return self._ask("POST", "/api/v1/studies/join", body=body)

    def get_study(self, id: str) -> Any:
        """One study with its questionnaire."""
        return self._ask("GET", self._filled("/api/v1/studies/{id}", id=id))

    def change_study(self, id: str, body: dict[str, Any]) -> Any:
        """Replace what the study is made of; once somebody takes part only name and description."""
        return self._ask("PUT", self._filled("/api/v1/studies/{id}", id=id), body=body)

    def delete_study(self, id: str) -> None:
        """Delete a study that nobody takes part in."""
        self._ask("DELETE", self._filled("/api/v1/studies/{id}", id=id))

    def close_study(self, id: str) -> Any:
        """Nothing more is added from here on: no participants, sessions or answers."""
        return self._ask("POST", self._filled("/api/v1/studies/{id}/close", id=id))

    def reopen_study(self, id: str) -> Any:
        """Go on with a study that was closed and not unblinded."""
        return self._ask("POST", self._filled("/api/v1/studies/{id}/reopen", id=id))

    def unblind_study(self, id: str) -> Any:
        """Show who the participants are to all who see their sessions, for good. Only of a closed study."""
        return self._ask("POST", self._filled("/api/v1/studies/{id}/unblind", id=id))

    def list_participants(self, id: str) -> Any:
        """Who takes part, by code.

        Until the study is closed, callers who are no operators learn the codes only, so that who scores does not know
        who is how experienced.
        """
        return self._ask("GET", self._filled("/api/v1/studies/{id}/participants", id=id))

    def enrol_participant(self, id: str, body: dict[str, Any]) -> Any:
        """Enrol somebody; they are known by a code from here on.

        Only operators may say who it is, by user_id or name.
        """
        return self._ask("POST", self._filled("/api/v1/studies/{id}/participants", id=id), body=body)

    def get_participant(self, id: str, code: str) -> Any:
        """One participant with the answers; trainees have themselves only."""
        return self._ask("GET", self._filled("/api/v1/studies/{id}/participants/{code}", id=id, code=code))

    def withdraw_participant(self, id: str, code: str) -> None:
        """Forget a participant, with answers, person, and rows in exports."""
        self._ask("DELETE", self._filled("/api/v1/studies/{id}/participants/{code}", id=id, code=code))

    def answer_questionnaire(self, id: str, code: str, body: dict[str, Any]) -> Any:
        """Answer the study's questionnaire, or change the answers while the study is open.

        By the participant; for participants without an account by operators and instructors.
        """
        return self._ask(
            "PUT",
            self._filled("/api/v1/studies/{id}/participants/{code}/answers", id=id, code=code),
            body=body,
        )

    def get_feel_trial(self, id: str, code: str) -> Any:
        """The trial of a study of feel that the participant does next.

        A trial is a session on two plates, which POST /api/v1/sessions with the study makes, and an answer. Nothing
        says which answer was right before the study is closed. 409 when the study is none of feel.
        """
        return self._ask("GET", self._filled("/api/v1/studies/{id}/participants/{code}/feel-trial", id=id, code=code))

    def answer_feel_trial(self, id: str, code: str, body: dict[str, Any]) -> Any:
        """Answer the trial, for good.

        By the participant; for participants without an account by operators and instructors. 409 before the plates were
        touched, for another trial than the next, and when the study is closed.
        """
        return self._ask(
            "PUT",
            self._filled("/api/v1/studies/{id}/participants/{code}/feel-trial", id=id, code=code),
            body=body,
        )

    def get_feel_report(
        self,
        id: str,
        *,
        form: Literal["report", "answers"] | None = None,
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """How often participants were right. For operators; for instructors once the study is closed (409 before).

        form: report: JSON; answers: every answer as CSV
        """
        return self._ask("GET", self._filled("/api/v1/studies/{id}/feel", id=id), query={"form": form}, to_file=to_file)

    def get_sample_size(
        self,
        *,
        question: Literal["means", "shares", "agreement", "precision"],
        effect: float | None = None,
        first: float | None = None,
        second: float | None = None,
        least: float | None = None,
        expected: float | None = None,
        width: float | None = None,
        raters: int | None = None,
        significance: float | None = None,
        power: float | None = None,
    ) -> Any:
        """How many persons or sessions a study needs.

        means: two groups whose means are `effect` standard deviations apart. shares: two groups of which `first` and
        `second` are the shares that do something. agreement: `raters` raters whose ICC is expected to be `expected`,
        shown to be over `least`. precision: an interval of that ICC about `width` wide. 422 names what is missing or
        makes no sense.

        significance: Two-sided of means and shares, one-sided of agreement; precision has none
        power: Precision has none
        """
        return self._ask(
            "GET",
            "/api/v1/sample-size",
            query={"question": question, "effect": effect, "first": first, "second": second, "least": least, "expected": expected, "width": width, "raters": raters, "significance": significance, "power": power},
        )

    def list_persons(self, id: str) -> Any:
        """Who is behind the codes. For operators; for instructors once the study is unblinded (403 before). Every look
        is kept in the audit log.
        """
        return self._ask("GET", self._filled("/api/v1/studies/{id}/persons", id=id))

    def list_raters(self, id: str) -> Any:
        """Who rates the study's sessions, and how far they are."""
        return self._ask("GET", self._filled("/api/v1/studies/{id}/raters", id=id))

    def add_rater(self, id: str, body: dict[str, Any]) -> Any:
        """Let an instructor rate the study's sessions.

        Until the study is closed, the rater sees the study's sessions in the rating queue only: lists leave them out,
        and what they are worth is refused. 409 for operators, who see who takes part, and for somebody who rates
        already.
        """
        return self._ask("POST", self._filled("/api/v1/studies/{id}/raters", id=id), body=body)

    def remove_rater(self, id: str, label: str) -> None:
        """Remove a rater with all their ratings, while the study is open.

        label: As R1
        """
        self._ask("DELETE", self._filled("/api/v1/studies/{id}/raters/{label}", id=id, label=label))

    def get_rating_queue(self, id: str) -> Any:
        """What the caller rates, in an order of their own.

        Sessions that were carried out on bone, of a study with a design its tests only, none of the caller's own. A key
        says nothing about participant or time. 404 when the caller rates nothing here.
        """
        return self._ask("GET", self._filled("/api/v1/studies/{id}/rating-queue", id=id))

    def rate_session(self, id: str, key: str, body: dict[str, Any]) -> Any:
        """Rate one session by the study's rating form, or change the rating while the study is open.

        key: As the rating queue has it
        """
        return self._ask("PUT", self._filled("/api/v1/studies/{id}/rating-queue/{key}", id=id, key=key), body=body)

    def replay_for_rating(self, id: str, key: str) -> Any:
        """Open the recording of a session in the caller's rating queue.

        As POST /api/v1/sessions/{id}/replay, but it does not say which session it is of, has no marks (remarks may name
        people) and refuses its metrics.

        key: As the rating queue has it
        """
        return self._ask("POST", self._filled("/api/v1/studies/{id}/rating-queue/{key}/replay", id=id, key=key))

    def get_codebook(self, id: str) -> Any:
        """What the columns of the export mean."""
        return self._ask("GET", self._filled("/api/v1/studies/{id}/codebook", id=id))

    def get_validity(
        self,
        id: str,
        *,
        form: Literal["report", "numbers", "sessions", "ratings", "script"] | None = None,
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """Whether scores mean anything; agreement of raters, experts against novices, arms. For operators; for
        instructors once the study is closed (409 before).

        Sessions that were carried out and touched bone. docs/validity.md says what each number means. `sessions`,
        `ratings` and `script` are the files with which R computes the numbers again.

        form: report: JSON; numbers, sessions and ratings: CSV; script: for R
        """
        return self._ask(
            "GET",
            self._filled("/api/v1/studies/{id}/validity", id=id),
            query={"form": form},
            to_file=to_file,
        )

    def export_study(
        self,
        id: str,
        *,
        format: Literal["json", "csv"] | None = None,
        table: Literal["sessions", "answers", "groups", "ratings"] | None = None,
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """All sessions and answers with a summary by level of experience. For operators; for instructors once the study
        is closed (409 before).

        table: Which one as CSV; JSON holds all
        """
        return self._ask(
            "GET",
            self._filled("/api/v1/studies/{id}/export", id=id),
            query={"format": format, "table": table},
            to_file=to_file,
        )

    def list_metrics(self) -> Any:
        """What a session is measured by, and so what a rubric may ask for, in reading order."""
        return self._ask("GET", "/api/v1/metrics")

    def list_rubrics(self) -> Any:
        """How sessions can be judged; `standard` is always there."""
        return self._ask("GET", "/api/v1/rubrics")

    def add_rubric(self, body: dict[str, Any]) -> Any:
        """Keep a new rubric as version 1; for operators and instructors."""
        return self._ask("POST", "/api/v1/rubrics", body=body)

    def get_rubric(self, id: str, *, version: int | None = None) -> Any:
        """The newest version of a rubric, or an earlier one."""
        return self._ask("GET", self._filled("/api/v1/rubrics/{id}", id=id), query={"version": version})

    def edit_rubric(self, id: str, body: dict[str, Any]) -> Any:
        """Keep an edited rubric as its next version; for operators and instructors.

        No version is ever changed, so that every score can be had again. The body's `version` is the one that was
        edited: 409 when that is not the newest any more, as somebody else was quicker. If-Match with the ETag of the
        rubric is heeded, too (412). What says the same as the newest makes no new version.
        """
        return self._ask("PUT", self._filled("/api/v1/rubrics/{id}", id=id), body=body)

    def list_benchmarks(self) -> Any:
        """What experts reach, newest first."""
        return self._ask("GET", "/api/v1/benchmarks")

    def add_benchmark(self, body: dict[str, Any]) -> Any:
        """Make a benchmark of experts' sessions, and pass marks by contrasting them with novices'; for operators and
        instructors.

        Proficiency-based progression: the mean of the experts in each metric is what has to be reached; an expert
        farther than 1.96 standard deviations from the mean of all does not count there. With `novices` the contrasting-
        groups method gives a mark of the points by the rubric, and of each metric; it needs three sessions of each
        group or more.
        """
        return self._ask("POST", "/api/v1/benchmarks", body=body)

    def get_benchmark(self, id: str) -> Any:
        """One benchmark; trainees are not told whose sessions it is made of."""
        return self._ask("GET", self._filled("/api/v1/benchmarks/{id}", id=id))

    def get_score(self, id: str, *, rubric: str | None = None, benchmark: str | None = None) -> Any:
        """What a session is worth, every number with its definition, unit, source, confidence and limits.

        As it was kept when the session ended or was last scored; by another rubric, or against a benchmark, it is
        computed and not kept. Of a session that goes on it is the score so far. What could not be measured is null,
        with the reason in `missing`.

        rubric: Judged by this one; absent means the newest standard one
        benchmark: Compared with these experts
        """
        return self._ask(
            "GET",
            self._filled("/api/v1/sessions/{id}/score", id=id),
            query={"rubric": rubric, "benchmark": benchmark},
        )

    def score_session(self, id: str, body: dict[str, Any]) -> Any:
        """Judge a session that has ended by a rubric, and keep the score; for operators and instructors.

        From its metrics as they are kept. POST /api/v1/rescorings computes these anew from recordings, too.
        """
        return self._ask("POST", self._filled("/api/v1/sessions/{id}/score", id=id), body=body)

    def preview_score(self, id: str, body: dict[str, Any]) -> Any:
        """What a session is worth by a rubric that has not been saved; for operators and instructors.

        As GET score of the same session would say, had the rubric been saved. Neither rubric nor score is kept.
        """
        return self._ask("POST", self._filled("/api/v1/sessions/{id}/score/preview", id=id), body=body)

    def get_deviation(
        self,
        id: str,
        *,
        to: Literal["plan", "implant", "wall"],
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """How far the surface that a session left lies from the plan or from the implant's back, or how thick the bone
        behind it is, one byte a vertex.

        Signed bytes in the order of the vertices of GET mesh: mm = byte * Deviation-Step-Mm, positive where it is too
        deep or a gap; +-127 stand for Deviation-Range-Mm or more, Deviation-Unknown for nothing to compare. Of `wall`
        it is the bone left behind the reamed face, along its normal to where the bone ends first. It may have to be
        made first; then the answer is 202 with the job that does so.
        """
        return self._ask(
            "GET",
            self._filled("/api/v1/sessions/{id}/deviation", id=id),
            query={"to": to},
            to_file=to_file,
        )

    def list_scores(
        self,
        *,
        format: Literal["json", "csv"] | None = None,
        table: Literal["scores", "codebook"] | None = None,
        rubric: str | None = None,
        state: str | None = None,
        case: str | None = None,
        trainee: str | None = None,
        study: str | None = None,
        participant: str | None = None,
        from_: str | None = None,
        to: str | None = None,
        q: str | None = None,
        outcome: str | None = None,
        points_from: float | None = None,
        points_to: float | None = None,
        to_file: str | os.PathLike[str] | None = None,
    ) -> Any:
        """A table of scores for statistics, one row a session that has ended, with its codebook.

        Of the sessions that the caller may see and the filters let pass, judged by one rubric. Who trained stands there
        as a code or the id of a user, never as a name; what a session does not say is empty.

        table: Which one as CSV; JSON holds both
        rubric: Judged by this one; absent means the newest standard one
        state: Any of these states, by commas
        trainee: Id of the user who trains; trainees see their own only
        from_: Created then or later; UTC, or the beginning of one such as 2026-01
        to: Created before then
        q: Words that id, case, script, names or title hold
        outcome: Any of these results, by commas; none: not judged, or by a rubric that decides nothing
        points_from: So many points or more; sessions without points do not pass
        points_to: So many points or fewer
        """
        return self._ask(
            "GET",
            "/api/v1/scores",
            query={"format": format, "table": table, "rubric": rubric, "state": state, "case": case, "trainee": trainee, "study": study, "participant": participant, "from": from_, "to": to, "q": q, "outcome": outcome, "points_from": points_from, "points_to": points_to},
            to_file=to_file,
        )

    def rescore_sessions(self, body: dict[str, Any], *, idempotency_key: str | None = None) -> Any:
        """Compute metrics of many sessions anew from their recordings, judge them and keep the scores; for operators
        and instructors.

        A job that says how far it is and can be cancelled; what it has done until then stays. A session that cannot be
        scored, or would say less than before (its case is gone), is left as it was and told in the job's result (schema
        Rescored).

        idempotency_key: Any name for this request. Sent again with the same name within 24 hours it is answered the
            same, with Idempotency-Replayed, and made once (409 while the first is under way, 422 for another request)
        """
        return self._ask("POST", "/api/v1/rescorings", headers={"Idempotency-Key": idempotency_key}, body=body)

    def get_learning(
        self,
        *,
        trainee: str | None = None,
        participant: str | None = None,
        name: str | None = None,
        case: str | None = None,
        rubric: str | None = None,
        benchmark: str | None = None,
        acceptable_rate: float | None = None,
        unacceptable_rate: float | None = None,
        alpha: float | None = None,
        beta: float | None = None,
    ) -> Any:
        """A trainee's sessions in order of time, with CUSUM and, against a benchmark, what was reached.

        By `trainee`, `participant` or `name`, one of them; trainees leave all out or name themselves. Sessions of
        studies are told by the participant's code only, to others than operators and the person, and never by `name`.
        Scripted sessions and those that cut nothing are left out.

        trainee: Id of the user who trains
        participant: Code under which a study knows the trainee
        name: Name that sessions without a user were given, exactly
        case: Sessions on this case only
        rubric: Judged by this one; absent means the newest standard one
        benchmark: Compared with these experts
        acceptable_rate: Share of failures of the proficient
        unacceptable_rate: Of the others; above the acceptable one
        alpha: Chance of calling the proficient not so
        beta: Chance of calling the others proficient
        """
        return self._ask(
            "GET",
            "/api/v1/learning",
            query={"trainee": trainee, "participant": participant, "name": name, "case": case, "rubric": rubric, "benchmark": benchmark, "acceptable_rate": acceptable_rate, "unacceptable_rate": unacceptable_rate, "alpha": alpha, "beta": beta},
        )

    def listen_to_changes(self, *, since: int | None = None) -> str:
        """What changes on the server, as it happens.

        A WebSocket of JSON texts (schema ChangeMessage). The first is `hello` with the newest number; then one for
        every change that the caller may know of, numbered upwards. Who comes back says with `since` which number they
        saw last and gets what they have missed. Where that is not kept any more, `missed` is true in the hello, or a
        message `missed` comes: then read again what you show. Without an upgrade the answer is 426.

        since: Number of the last message that was seen
        """
        return self._address("/api/v1/events", query={"since": since})
