"""Tunes the friction task while it runs in QEMU, through the addresses of its A2L file alone.

Memory is read and written by gdb, as a debug probe or an XCP driver would do it. Between two ticks of the friction task a page is
written, and the numbers measured after the tick say what became of it.

    python tuner.py IMAGE FILE
"""

import math
import socket
import struct
import subprocess
import sys
import zlib

from description import read_a2l
from pygdbmi.gdbcontroller import GdbController

QEMU = (
    "qemu-system-arm -machine mps2-an386 -nographic -monitor none -serial none -icount shift=0 "
    "-semihosting-config enable=on,target=native -S"
).split()
TAKEN, LAYOUT, CHECKSUM, RANGE, TOGETHER = range(5)

# Friction of a model that is set up anew with 25 % more friction coefficient, over that of the flash, at 12 rad/s and 9 kN
# (measured): a ball with more friction is held off its seat and spins more.
UP = 1.57

# Constants take some 400,000 instructions, of which a tick of the friction task has 168,000, less those of both interrupts.
LATEST = 10


class Gdb:
    """The processor, stopped at a tick of the friction task."""

    def __init__(self, image, port):
        command = ["gdb-multiarch", "--nx", "--quiet", "--interpreter=mi3"]
        self.gdb = GdbController(command, time_to_check_for_additional_output_sec=1e-4)
        self.answers = []
        self.say(f"-file-exec-and-symbols {image}")
        self.say(f"-target-select remote localhost:{port}")
        self.say("-break-insert -h *PendSV")

    def next(self, kind):
        """The next answer of a kind."""
        while True:
            for index, answer in enumerate(self.answers):
                if answer["type"] == kind and (kind == "result" or answer["message"] == "stopped"):
                    del self.answers[: index + 1]
                    return answer
            self.answers += self.gdb.get_gdb_response(timeout_sec=120)

    def say(self, command):
        self.gdb.write(command, read_response=False)
        answer = self.next("result")
        assert answer["message"] != "error", answer["payload"]["msg"]
        return answer["payload"]

    def tick(self, count=1):
        """To the beginning of a later tick."""
        if count > 1:
            self.say(f"-break-after 1 {count - 1}")
        self.say("-exec-continue")
        stopped = self.next("notify")
        assert stopped["payload"]["reason"] == "breakpoint-hit", stopped

    def read(self, address):
        memory = self.say(f"-data-read-memory-bytes {address} 4")["memory"]
        return bytes.fromhex(memory[0]["contents"])

    def write(self, address, word):
        self.say(f"-data-write-memory-bytes {address} {word.hex()}")


class Tuner:
    """Numbers by their names in the A2L file."""

    def __init__(self, gdb, numbers):
        self.gdb = gdb
        self.numbers = numbers
        # What the checksum goes over: the words of the page in the order of their addresses.
        first = numbers["layout"][0]
        last = numbers["checksum"][0]
        page = [name for name, number in numbers.items() if first <= number[0] <= last]
        self.page = sorted(page, key=lambda name: numbers[name][0])

    def get(self, name):
        address, kind, *_ = self.numbers[name]
        return struct.unpack("<f" if kind == "FLOAT32_IEEE" else "<I", self.gdb.read(address))[0]

    def words(self, **changes):
        """The page as it stands, with some numbers changed and the checksum that belongs to it."""
        words = {name: self.gdb.read(self.numbers[name][0]) for name in self.page}
        for name, value in changes.items():
            is_float = self.numbers[name][1] == "FLOAT32_IEEE"
            words[name] = struct.pack("<f" if is_float else "<I", value)
        sum_of = b"".join(words[name] for name in self.page[:-1])
        words["checksum"] = struct.pack("<I", zlib.crc32(sum_of))
        return words

    def write(self, words):
        for name, word in words.items():
            self.gdb.write(self.numbers[name][0], word)

    def reference(self):
        return {name: self.gdb.read(self.numbers[f"reference.{name}"][0]) for name in self.page}


def expect(tuner, what, state, refused, friction, field=0):
    """What became of the page: the background has looked at it when the next tick begins, and that tick shows it. The friction
    torque is within 5 % of `friction` (balls that are renewed one by one settle within 1 %, and the nut's speed rises by 0.2 % a
    tick)."""
    tuner.gdb.tick(2)
    found = [tuner.get(name) for name in ("page_state", "page_field", "pages_refused")]
    assert found == [state, field, refused], f"{what}: {found}"
    torque = tuner.get("friction_torque")
    assert abs(torque / friction - 1) < 0.05, f"{what}: {torque} N m instead of {friction}"
    assert tuner.get("regime") == 1, what
    assert tuner.get("faults") & ~0x60 == 0, what
    print(f"{what}: state {state}, friction torque {torque:.4f} N m", flush=True)


def taken(tuner, pages):
    """Ticks until a sound page is in use. None of them is missing: constants are made in the background."""
    steps = tuner.get("steps")
    for ticks in range(1, LATEST + 1):
        tuner.gdb.tick()
        assert tuner.get("steps") == steps + ticks
        if tuner.get("pages_taken") == pages:
            print(f"page {pages} in use after {ticks} ticks", flush=True)
            return
    raise AssertionError(f"page {pages} is not in use after {LATEST} ticks")


def tune(tuner):
    # The nut turns steadily under a steady load from 1.5 s on.
    tuner.gdb.tick(1550)
    friction, level = tuner.get("friction_torque"), tuner.get("level_forward")
    reference = tuner.reference()
    assert tuner.words() == reference, "the page in RAM is not that of the flash"

    # Friction coefficient 25 % up, at both ends of its law: the model takes it and goes on from where it was.
    up = {name: 1.25 * tuner.get(name) for name in ("friction_boundary", "friction_full_film")}
    tuner.write(tuner.words(**up))
    taken(tuner, 1)
    tuner.gdb.tick(20)
    expect(tuner, "friction coefficient 25 % up", TAKEN, 0, UP * friction)
    assert abs(tuner.get("level_forward") - level) < 0.01, "the adaptation has lost its level"
    friction = tuner.get("friction_torque")
    good = tuner.words()

    # Damaged: one bit of a number, the checksum as it was.
    damaged = bytes([good["share"][0] ^ 1]) + good["share"][1:]
    tuner.write({"share": damaged})
    expect(tuner, "one bit wrong", CHECKSUM, 1, friction)
    tuner.write(good)
    expect(tuner, "mended", TAKEN, 1, friction)

    # Out of range, and no number, with a checksum that holds.
    place = tuner.page.index("friction_boundary") - 1
    upper = tuner.numbers["friction_boundary"][3][1]
    tuner.write(tuner.words(friction_boundary=1.01 * upper))
    expect(tuner, "friction out of range", RANGE, 2, friction, place)
    tuner.write(tuner.words(friction_boundary=math.nan))
    expect(tuner, "friction not a number", RANGE, 3, friction, place)

    # Half written: numbers first, the checksum some ticks later.
    new = {**good, **tuner.words(**up, share=0.5)}
    checksum = {"checksum": new.pop("checksum")}
    tuner.write(new)
    expect(tuner, "half written", CHECKSUM, 4, friction)
    assert tuner.get("pages_taken") == 1, "a refused page was taken"
    tuner.write(checksum)
    taken(tuner, 2)
    expect(tuner, "written", TAKEN, 4, friction)

    # Of another layout; and numbers that are sound one by one, but not together.
    layout = tuner.get("layout")
    tuner.write(tuner.words(layout=layout ^ 1))
    expect(tuner, "other layout", LAYOUT, 5, friction)
    tuner.write(tuner.words(layout=layout, breakaway_angle=0.04))
    expect(tuner, "play too small for the breakaway angle", TOGETHER, 6, friction)

    # Back to the flash.
    tuner.write(reference)
    taken(tuner, 3)
    tuner.gdb.tick(20)
    expect(tuner, "back to the flash", TAKEN, 6, friction / UP)


def main(image, a2l):
    numbers, _ = read_a2l(a2l)
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    qemu = subprocess.Popen([*QEMU, "-gdb", f"tcp:localhost:{port}", "-kernel", image])
    try:
        gdb = Gdb(image, port)
        tune(Tuner(gdb, numbers))
        gdb.gdb.exit()
    finally:
        qemu.kill()
        qemu.wait()


if __name__ == "__main__":
    main(*sys.argv[1:])
