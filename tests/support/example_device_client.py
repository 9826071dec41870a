#!/usr/bin/env python3
"""A haptic device's client with nothing but Python's standard library: it says where the handle is and prints the force.
Usage: example_device_client.py PORT SESSION MESSAGES"""
import base64, os, socket, struct, sys, time

HELLO, HANDLE, WELCOME, FEEDBACK = 1, 2, 4, 5                  # DeviceBody in device.fbs
SPINDLE, DEADMAN = 1, 8

def message(kind, fields):
    """A DeviceMessage around a table; `fields` is a list of (slot, struct format, values), widest first."""
    slots, data = [0] * (1 + max(slot for slot, _, _ in fields)), b''
    for slot, form, values in fields:
        slots[slot] = 8 + len(data)
        data += struct.pack('<' + form, *values)
    vtable = struct.pack(f'<HH{len(slots)}H', 4 + 2 * len(slots), 8 + len(data), *slots)
    vtable += bytes(-len(vtable) % 8)
    root = struct.pack('<I4xHHHHiIB7x', 16, 8, 12, 8, 4, 8, 12 + len(vtable), kind)
    return root + vtable + struct.pack('<i4x', len(vtable)) + data

def body(bytes_):
    """The kind of a DeviceMessage and a function that reads a field of its body, 0s where it is absent."""
    def field(table, slot, form):
        vtable = table - struct.unpack_from('<i', bytes_, table)[0]
        size = struct.unpack_from('<H', bytes_, vtable)[0]
        at = struct.unpack_from('<H', bytes_, vtable + 4 + 2 * slot)[0] if 4 + 2 * slot < size else 0
        return (struct.unpack_from('<' + form, bytes_, table + at), table + at) if at else ((0,) * len(form), 0)
    root = struct.unpack_from('<I', bytes_)[0]
    kind, (offset, at) = field(root, 0, 'B')[0][0], field(root, 1, 'I')
    return kind, lambda slot, form: field(at + offset[0], slot, form)[0]

class WebSocket:
    def __init__(self, port, path):
        self.socket = socket.create_connection(('127.0.0.1', port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f'GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n'
                             f'Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n').encode())
        self.stream = self.socket.makefile('rb')
        if b' 101 ' not in self.stream.readline():
            sys.exit('the server does not take a device: ' + self.stream.read().decode())
        while self.stream.readline() != b'\r\n':
            pass
    def send(self, payload):                                   # our messages are shorter than 65536 bytes
        size = len(payload)
        head = struct.pack('>BB', 0x82, 0x80 | size) if size < 126 else struct.pack('>BBH', 0x82, 0xfe, size)
        self.socket.sendall(head + bytes(4) + payload)         # a mask of zeros is a mask
    def receive(self):
        while True:
            first, size = self.stream.read(2)
            if size == 126:
                size = struct.unpack('>H', self.stream.read(2))[0]
            payload = self.stream.read(size)
            if first & 15 == 8:
                sys.exit('closed by the server: ' + payload[2:].decode())
            if first & 15 == 2:
                return payload

port, session, messages = int(sys.argv[1]), sys.argv[2], int(sys.argv[3])
server = WebSocket(port, f'/api/v1/sessions/{session}/device')
server.send(message(HELLO, [(0, 'I', (1,))]))                  # protocol_revision
assert body(server.receive())[0] == WELCOME
echo_us = 0
for sequence in range(1, messages + 1):
    z_mm = -0.1 * sequence                                     # away from the person: into the bone
    now_us = time.monotonic_ns() // 1000
    server.send(message(HANDLE, [(1, 'Q', (now_us,)), (2, 'Q', (echo_us,)), (4, 'd', (0.0,)), (5, 'd', (0.0,)),
                                 (6, 'd', (z_mm,)), (3, '4f', (1, 0, 0, 0)), (0, 'I', (sequence,)),
                                 (7, 'B', (SPINDLE | DEADMAN,))]))
    kind, field = body(server.receive())
    assert kind == FEEDBACK
    force_n = field(5, 'fff')                                  # goes to the motors; without an answer for 50 ms: zero
    echo_us = field(1, 'Q')[0]
    time.sleep(0.001)
print(f'{messages} answers, the last to message {field(0, "I")[0]}: force {force_n} N, round trip {field(10, "f")[0]:.2f} ms')
