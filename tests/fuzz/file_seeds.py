"""Files that the fuzzers of what is read from outside begin with; make_seeds.py writes them."""

import gzip
import io
import json as json_text
import struct
import zipfile
import zlib
from pathlib import Path

PROTO = Path(__file__).resolve().parents[2] / "proto"
CT_STORAGE = b"1.2.840.10008.5.1.4.1.1.2"


def element(tag: int, vr: bytes, value: bytes) -> bytes:
    if len(value) % 2:
        value += b"\0" if vr in (b"UI", b"OB") else b" "
    head = struct.pack("<HH", tag >> 16, tag & 0xFFFF) + vr
    long_form = vr in (b"OB", b"OW", b"SQ", b"UN")
    return head + struct.pack("<HI" if long_form else "<H", *([0] if long_form else []), len(value)) + value


def dicom_file(syntax: bytes, pixels: bytes, more: bytes = b"") -> bytes:
    meta = element(0x00020002, b"UI", CT_STORAGE) + element(0x00020010, b"UI", syntax)
    short = lambda number: struct.pack("<H", number)  # noqa: E731
    data = (
        element(0x00080008, b"CS", b"ORIGINAL\\PRIMARY\\AXIAL")
        + element(0x00080060, b"CS", b"CT")
        + element(0x00180050, b"DS", b"1.5")
        + element(0x0020000E, b"UI", b"1.2.3")
        + element(0x00200013, b"IS", b"1")
        + element(0x00200032, b"DS", b"1\\2\\3.5")
        + element(0x00200037, b"DS", b"1\\0\\0\\0\\1\\0")
        + element(0x00280002, b"US", short(1))
        + element(0x00280004, b"CS", b"MONOCHROME2")
        + more
        + element(0x00280010, b"US", short(4))
        + element(0x00280011, b"US", short(4))
        + element(0x00280030, b"DS", b"0.5\\0.75")
        + element(0x00280100, b"US", short(16))
        + element(0x00280101, b"US", short(16))
        + element(0x00280103, b"US", short(1))
        + element(0x00281052, b"DS", b"-10")
        + element(0x00281053, b"DS", b"2")
        + element(0x00281054, b"LO", b"HU")
        + pixels
    )
    if syntax.endswith(b".99"):
        packer = zlib.compressobj(9, zlib.DEFLATED, -15)
        data = packer.compress(data) + packer.flush()
    return bytes(128) + b"DICM" + element(0x00020000, b"UL", struct.pack("<I", len(meta))) + meta + data


def rle_pixels() -> bytes:
    segment = bytes([15]) + bytes(range(16)) + b"\0"
    frame = struct.pack("<3I52x", 2, 64, 64 + len(segment)) + segment * 2
    item = lambda data: struct.pack("<HHI", 0xFFFE, 0xE000, len(data)) + data  # noqa: E731
    end = struct.pack("<HHI", 0xFFFE, 0xE0DD, 0)
    return struct.pack("<HH2sHI", 0x7FE0, 0x0010, b"OB", 0, 0xFFFFFFFF) + item(b"") + item(frame) + end


def dicom() -> list[bytes]:
    raw = element(0x7FE00010, b"OW", bytes(range(32)))
    return [
        dicom_file(b"1.2.840.10008.1.2.1", raw),
        dicom_file(b"1.2.840.10008.1.2.1", raw * 1, element(0x00280008, b"IS", b"2")),
        dicom_file(b"1.2.840.10008.1.2.1.99", raw),
        dicom_file(b"1.2.840.10008.1.2.5", rle_pixels()),
        dicom_file(b"1.2.840.10008.1.2.1", raw)[132:],
    ]


def nrrd(encoding: str = "raw", space: str = "left-posterior-superior", voxels: bytes = bytes(range(24))) -> bytes:
    return (
        f"NRRD0004\n# made\ntype: short\ndimension: 3\nspace: {space}\nsizes: 3 2 2\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1.5)\nkinds: domain domain domain\nendian: little\n"
        f"encoding: {encoding}\nspace origin: (1,2,3)\nkey:=value\n\n"
    ).encode() + voxels


def nifti1() -> bytes:
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, 3, 2, 2, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 4, 16)
    struct.pack_into("<8f", header, 76, 1, 1, 1, 1.5, 0, 0, 0, 0)
    struct.pack_into("<2f", header, 108, 352, 1)
    struct.pack_into("<2h", header, 252, 0, 1)
    struct.pack_into("<12f", header, 280, 1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1.5, 7)
    header[123] = 2
    header[344:348] = b"n+1\0"
    return bytes(header) + bytes(range(24))


def nifti2(order: str = "<") -> bytes:
    header = bytearray(544)
    struct.pack_into(order + "i8s2h", header, 0, 540, b"n+2\0\r\n\x1a\n", 4, 16)
    struct.pack_into(order + "8q", header, 16, 3, 3, 2, 2, 1, 1, 1, 1)
    struct.pack_into(order + "8d", header, 104, 1, 1, 1, 1.5, 0, 0, 0, 0)
    struct.pack_into(order + "q2d", header, 168, 544, 1, 0)
    struct.pack_into(order + "2i", header, 344, 0, 1)
    struct.pack_into(order + "12d", header, 400, 1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1.5, 7)
    struct.pack_into(order + "i", header, 500, 2)
    return bytes(header) + bytes(range(24))


def meta_image(packed: bool = False) -> bytes:
    voxels = zlib.compress(bytes(range(24))) if packed else bytes(range(24))
    packing = f"CompressedData = True\nCompressedDataSize = {len(voxels)}\n" if packed else ""
    return (
        f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n{packing}"
        "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\nElementSpacing = 1 1 1.5\nDimSize = 3 2 2\n"
        "ElementType = MET_SHORT\nElementDataFile = LOCAL\n"
    ).encode() + voxels


def volume() -> list[bytes]:
    text = " ".join(map(str, range(12))).encode()
    return [
        b"\x00" + nrrd(),
        b"\x00" + nrrd("gzip", "RAS", gzip.compress(bytes(range(24)), mtime=0)),
        b"\x00" + nrrd("ascii", "LPS", text),
        b"\x01" + nrrd(),
        b"\x02" + nifti1(),
        b"\x02" + nifti2(),
        b"\x02" + nifti2(">"),
        b"\x03" + gzip.compress(nifti1(), mtime=0),
        b"\x04" + meta_image(),
        b"\x04" + meta_image(True),
        b"\x05" + meta_image(),
    ]


def text_rows() -> list[bytes]:
    rows = [f"{x} {y} {z} {x + 2 * y - z}" for z in range(2) for y in range(2) for x in range(3)]
    mimics = [f"+{x}.5E+000, -{y}.0E+000,   {z}.0E+001,    +{x}" for z in range(2) for y in range(2) for x in range(2)]
    return [
        "\n".join(["# spacing_mm 1 1 2", *rows, ""]).encode(),
        "\r\n".join([*mimics, ""]).encode(),
        b"0.5;0.5;0.5;7\n1.5;0.5;0.5;8\n0.5\t1.5\t0.5\t9\n1.5,1.5,0.5,1e2\n0.5 0.5 1.5 nan\n",
    ]


def zip_file(entries: list[tuple[str, bytes]], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as archive:
        for name, data in entries:
            archive.writestr(zipfile.ZipInfo(name), data, method)
    return out.getvalue()


def zip() -> list[bytes]:
    return [
        zip_file([("scan/slice.dcm", dicom()[0]), ("__MACOSX/x", b"y")]),
        zip_file([("a.nrrd", nrrd())], zipfile.ZIP_STORED),
        zip_file([("../../evil", b"x"), ("/absolute", b"x"), ("a\\b.dcm", b"x")]),
        zip_file([("rows.txt", text_rows()[2]), ("inner.zip", zip_file([("a", b"b")]))]),
    ]


def mesh() -> list[bytes]:
    ply = (
        "ply\nformat {} 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
    corners = (0, 0, 0, 1, 0, 0, 0, 1, 0)
    return [
        b"\x00" + ply.format("ascii").encode() + b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        b"\x00" + ply.format("binary_little_endian").encode() + struct.pack("<9fB3i", *corners, 3, 0, 1, 2),
        b"\x00" + ply.format("binary_big_endian").encode() + struct.pack(">9fB3i", *corners, 3, 0, 1, 2),
        b"\x01OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        b"\x02" + bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, *corners, 0),
        b"\x02solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        b"endsolid a\n",
        b"\x03v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    ]


def haply() -> list[bytes]:
    place = {"cursor_position": {"x": 0, "y": -0.12, "z": 0.15}}
    grip = {"device_id": "6", "state": {"orientation": {"w": 0, "x": 1, "y": 0, "z": 0}, "buttons": {"a": False}}}
    frame = {
        "session_id": 7,
        "inverse3": [{"device_id": "049D", "config": {"filters": {"force_scale": {"gain": 0.5}}}, "state": place}],
        "wireless_verse_grip": [grip],
    }
    event = {"type": "device", "name": "brake", "device_id": "049D", "level": "warning"}
    pieces = [json_text.dumps(message).encode() for message in (frame, frame, event)]
    return [b"".join(struct.pack("<H", len(data)) + data for data in pieces)]


def vibration() -> list[bytes]:
    def wav(kind: int, channels: int, bits: int) -> bytes:
        size = channels * bits // 8
        form = struct.pack("<4sIHHIIHH", b"fmt ", 16, kind, channels, 8000, 8000 * size, size, bits)
        data = bytes(range(8 * size))
        body = b"WAVE" + form + struct.pack("<4sI", b"data", len(data)) + data
        return b"\x01" + struct.pack("<4sI", b"RIFF", len(body)) + body

    return [
        wav(1, 1, 16),
        wav(3, 1, 32),
        wav(1, 2, 8),
        b"\x00time_s,g\n0,0.1\n0.001,-2\n0.002,3e-1\n",
        b"\x00g\n1\n2\n-0.5\n",
    ]


def documents() -> list[bytes]:
    rotation = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    volume_answer = {"dims": [3, 2, 2], "spacing_mm": [1, 1, 1], "rotation": rotation, "origin_mm": [0, 0, 0],
                     "source": "x", "warnings": ["y"], "patient": ["a", "b"]}  # fmt: skip
    band = {"metric": "duration_s", "mean": 20.5, "sd": 2, "count": 4, "dropped": []}
    return [
        b"\x00" + (PROTO / "questionnaires/face_validity_1.json").read_bytes()[:4000],
        b"\x00" + json_text.dumps({"id": "a", "title": "A", "items": [
            {"id": "b", "kind": "likert", "words": "c", "points": 5, "low": "d", "high": "e"},
            {"id": "f", "kind": "choice", "words": "g", "options": [{"id": "h", "words": "i"}]},
            {"id": "j", "kind": "text", "words": "k", "longest": 100}]}).encode(),
        b"\x01" + b'{"realistic_bone": 4, "remarks": "good", "unknown": [1]}',
        b"\x02" + (PROTO / "rubrics/standard.json").read_bytes(),
        b"\x03" + json_text.dumps({"name": "a", "sessions": ["b", "c"], "metrics": [band]}).encode(),
        b"\x04" + b'{"title": "a", "trainee_id": "b", "trainee": "c", "study": "d", "attempt": 2, "keep": true}',
        b"\x05" + json_text.dumps({"id": "a", "name": "b", "side": "left", "volume": volume_answer,
                                   "segmentations": [], "source": "x", "warnings": []}).encode(),
        b"\x06" + b'{"threshold_hu": 200, "upsample": 2, "cartilage_mm": 2, "whole": false}',
        b"\x07" + json_text.dumps(volume_answer).encode(),
        b"\x07" + "+created_utc\nabc\n2026".encode().hex().encode(),
    ]  # fmt: skip


ALL = (dicom, volume, text_rows, zip, mesh, haply, vibration, documents)
