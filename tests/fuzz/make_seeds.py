"""Writes what the fuzzers begin with: make_seeds.py FOLDER makes FOLDER/<fuzzer>/<seed>.

The messages are those of proto/golden, in the framing that fuzz_input.hpp takes apart.
"""

import struct
import sys
from pathlib import Path

import file_seeds

GOLDEN = Path(__file__).resolve().parents[2] / "proto/golden"
HELLO, HANDLE, STEERING = (
    (GOLDEN / f"device_{name}.bin").read_bytes() for name in ("hello", "handle", "steering")
)


def piece(data: bytes) -> bytes:
    return struct.pack("<H", len(data)) + data


def frame(opcode: int, payload: bytes, final: bool = True) -> bytes:
    head = bytes([opcode | (0x80 if final else 0)])
    size = len(payload)
    head += bytes([0x80 | size]) if size < 126 else bytes([0x80 | 126]) + struct.pack(">H", size)
    return head + bytes(4) + payload


def http() -> list[bytes]:
    host = "Host: localhost\r\n"
    return [
        text.encode()
        for text in (
            f"\x00GET /api/v1/sessions?limit=5&sort=-created HTTP/1.1\r\n{host}If-None-Match: \"a\"\r\n\r\n",
            f"\x07POST /api/v1/sessions HTTP/1.1\r\n{host}Origin: http://localhost\r\nContent-Length: 2\r\n\r\n{{}}"
            f"GET /index.html HTTP/1.1\r\n{host}Range: bytes=0-5\r\n\r\n",
            f"\x1fPUT /api/v1/uploads/a%20b?offset=0 HTTP/1.1\r\n{host}Transfer-Encoding: chunked\r\n"
            "Expect: 100-continue\r\n\r\n3;x=y\r\nabc\r\n0\r\nX: z\r\n\r\n",
            f"\x03GET /api/v1/sessions/1/stream HTTP/1.1\r\n{host}Upgrade: websocket\r\nConnection: Upgrade\r\n\r\n",
            "\x00HEAD /../secret HTTP/1.0\r\nHost: [::1]:80\r\nConnection: keep-alive\r\nCookie: ream_session=x\r\n\r\n",
            f"\x00DELETE /api/v1/sessions/1/annotations/2 HTTP/1.1\r\n{host}Content-Length: 1\r\nContent-Length: 1\r\n\r\n",
        )
    ]


def headers() -> list[bytes]:
    return [
        bytes([cut]) + text.encode()
        for cut, text in (
            (0, "bytes=0-99"),
            (0, "bytes=-5"),
            (0, "bytes=100-18446744073709551616"),
            (0, 'W/"a", "b", *'),
            (0, "/api/v1/cases/left%20one?a=1+2&b=%C3%A9"),
            (16, "ream.example.orghttps://ream.example.org"),
            (13, "[2001:db8::1]http://[2001:db8::1]"),
            (0, "ream_session=abc; other=\"x\"; Bearer abc"),
        )
    ]


def device_messages() -> list[bytes]:
    def say(client: int, message: bytes) -> bytes:
        return bytes([client]) + piece(message)

    return [
        b"\x00" + say(0, HELLO) + say(0, HANDLE) + say(1, HELLO) + say(1, HANDLE) + say(0, HANDLE),
        b"\x01" + say(0, HELLO) + say(0, STEERING) + say(0, HELLO),
        b"\x00" + say(0, HANDLE) + say(1, b""),
    ]


def websocket() -> list[bytes]:
    talk = piece(frame(2, HELLO)) + piece(frame(2, HANDLE)) + piece(frame(9, b"ping"))
    parts = piece(frame(2, HELLO[:40], False) + frame(9, b"") + frame(0, HELLO[40:]))
    close = piece(frame(8, b"\x03\xe8bye"))
    return [bytes([kind]) + body + close for kind in (0, 1) for body in (talk, parts, piece(frame(1, b"text")))]


def json() -> list[bytes]:
    point = "[1.5, -2, 3e1]"
    return [
        bytes([kind]) + text.encode()
        for kind, text in (
            (0, f'{{"case": "demo", "title": "x", "force_scale": 26, "place_mm": {point}, "blinded": true}}'),
            (0, '{"unknown": 1, "case": 5, "title": "' + "é" * 20 + '", "a/b~c": [[[{}]]]}'),
            (1, f'{{"glenoid_centre_mm": {point}, "trigonum_mm": {point}, "humeral_head": {{"centre_mm": {point},'
                f'"radius_mm": 24}}, "biconcavity_mm": [{point}, {point}, {point}], "walch": "B2"}}'),
            (2, f'{{"entry_mm": {point}, "axis_direction": [0, 0, 1], "depth_mm": 2, "reamer": "sphere 24",'
                '"pilot_diameter_mm": 6.2, "pilot_depth_mm": 8}'),
            (3, '{"device": "hand", "duration_s": 3, "hand": {"start_mm": [0, 0, -1], "force_profile":'
                '[{"t_s": 0, "force_n": 45}]}, "buttons": [{"t_s": 1, "spindle": false}]}'),
            (0x80, '{"case": "demo", "script": "demo", "force_scale": 1.5, "theatre": true}'),
            (0x88, '{"title": "a", "tasks": [{"case": "demo", "script": "demo"}], "questionnaire": {"items": [{}]}}'),
            (0x8B, '{"name": "a", "criteria": [{"metric": "duration_s", "bands": [{"from": 0, "points": 5}]}]}'),
            (3, '{"device": "poses", "poses": [{"t_s": 0, "place_mm": [0, 0, 0]}]}'),
        )
    ]


def recording() -> list[bytes]:
    return [b"\x00" + (GOLDEN / "recording-2.ream").read_bytes()]


def causes() -> list[bytes]:
    # A brick of bone; a tick whose pose is above it and cuts, column by column, plane by plane.
    start = b"\x01" + struct.pack("<3I3dQ", 8, 8, 8, 0.25, 0.25, 0.25, 0) + b"\x01"
    words = [16 | 8 | 1, 1 << 30, 0, 0, 0, 1 << 30, 0, 0, 0, 1 << 30, 4_000_000, 3_000_000, 2_000_000]
    planes = b"".join(word.to_bytes(4, "big") for word in words)
    ticks = b"\x03" + struct.pack("<2IQ", 0, 1, 0) + bytes(len(words)) + planes
    end = b"\x04" + struct.pack("<IQI", 0, 0, 0)
    def take(part: bytes) -> bytes:
        return b"\x00" + piece(part)

    good, keep, back = b"\x01", b"\x02", b"\x03"
    return [
        b"\x00" + take(start),
        b"\x01" + take(end),
        b"\x02" + take(ticks) + take(end),
        b"\x02" + keep + good * 3 + keep + good * 2 + back + good * 6 + keep + b"\x07" + good,
    ]


def backup() -> list[bytes]:
    user = '["id","name","display_name","role","enabled","created_utc","password_hash"]'
    row = '["u1","tom","Tom","trainee",1,"2026-01-01T00:00:00Z","x"]'
    study = '["id","name"]\n["s1",null]\n'
    return [
        bytes([kind]) + text.encode()
        for kind, text in (
            (0, '{"format": "ream backup", "revision": 1, "made_utc": "2026-01-01T00:00:00Z", "build": "ream 0.1.0",'
                '"tables": [{"table": "users", "rows": 1}], "files": 3, "migrations": [1, 10]}'),
            (5, f"{user}\n{row}\n"),
            (10, f"{user}\n{row}\n{row}"),
            (7, study),
        )
    ]


def zstd_frame(data: bytes) -> bytes:
    """Of 256 to 65,791 bytes, stored as they are."""
    head = b"\x28\xb5\x2f\xfd\x60" + struct.pack("<H", len(data) - 256)
    return head + struct.pack("<I", len(data) << 3 | 1)[:3] + data


def bundle() -> list[bytes]:
    about = b'{"format": "ream session bundle", "revision": 1, "session": "s1", "case": "demo"}'
    session = b'{"id": "s1", "case": "demo", "title": "x", "state": "finished"}'
    case = (
        b'{"id": "a", "name": "a", "source": "a", "side": "right", "dims": [8, 8, 8], "spacing_mm": [1, 1, 1],'
        b'"world_from_grid": {"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "translation_mm": [0, 0, 0]},'
        b'"cortical_threshold_g_cc": 1, "calibration": {"intercept_mg_cc": 0, "slope_mg_cc_per_hu": 1,'
        b'"threshold_hu": 200}, "warnings": []}'
    )
    plan = b'{"entry_mm": [1, 2, 3], "axis_direction": [0, 0, 1], "depth_mm": 2, "reamer": "sphere 24"}'
    voxels = zstd_frame(bytes(range(256)) * 2)
    recording = (GOLDEN / "recording-4.ream").read_bytes()
    whole = [about, session, recording, case, plan, voxels, voxels]
    return [b"".join(map(piece, members)) for members in (whole, whole[:3], [about, b"", recording, case, b"", voxels])]


def main() -> None:
    for make in (http, headers, device_messages, websocket, json, recording, causes, backup, bundle, *file_seeds.ALL):
        folder = Path(sys.argv[1]) / make.__name__
        folder.mkdir(parents=True, exist_ok=True)
        for number, seed in enumerate(make(), 1):
            (folder / f"seed-{number}").write_bytes(seed)


if __name__ == "__main__":
    main()
