"""Inside gdb, started by walks.py: writes `file function` for each function of the project at its first entry within a walk's segments.

WALK_FUNCTIONS: a file of lines `address-in-hex file function`, by address. WALK_SEGMENTS: `function@N` or `function@N>last`, separated by
semicolons: from the N-th entry of that function, in the thread that enters it, until it returns or `last` is entered. WALK_ASKED: rooms whose own
calls are not followed. WALK_OUT: where the lines go, a blank one between segments.
"""
import bisect
import os

import gdb

FUNCTIONS = [line.rstrip("\n").split(" ", 2) for line in open(os.environ["WALK_FUNCTIONS"])]
out = open(os.environ["WALK_OUT"], "w")
ADDRESSES = [int(a, 16) for a, f, n in FUNCTIONS]
ASKED = tuple(room + "/" for room in os.environ["WALK_ASKED"].split(";") if room)
thread = None  # of the segment that is under way
last = ""
first_stack = 0  # where the segment's first function was entered: frames above it are its callers


def asked_for():
    """Whether a function of a room that is only asked stands between the segment's first function and this one."""
    frame = gdb.newest_frame().older()
    for _ in range(60):
        if frame is None or not frame.is_valid() or int(frame.read_register("rsp")) > first_stack:
            return False
        at = bisect.bisect_right(ADDRESSES, frame.pc() - offset) - 1
        if 0 <= at < len(ADDRESSES) - 1 and FUNCTIONS[at][1].startswith(ASKED):
            return True
        frame = frame.older()
    return False


class Entry(gdb.Breakpoint):
    """Stops nothing; tells of the first entry by the segment's thread."""

    def __init__(self, address, file, function):
        super().__init__("*" + hex(address), internal=True)
        self.enabled = False
        self.file, self.function = file, function

    def stop(self):
        if gdb.selected_thread().num != thread:
            return False
        self.enabled = False
        if not (ASKED and asked_for()):
            print(self.file, self.function, file=out)
        return bool(last) and self.function.startswith(last)


class Returned(gdb.Breakpoint):
    """Stops where the function that was just entered returns to (its caller's next instruction lies on top of the stack: x86-64)."""

    def __init__(self):
        self.stack = int(gdb.parse_and_eval("(unsigned long)$rsp"))
        super().__init__("*" + str(int(gdb.parse_and_eval("*(unsigned long*)$rsp"))), internal=True)

    def stop(self):
        return gdb.selected_thread().num == thread and int(gdb.parse_and_eval("(unsigned long)$rsp")) > self.stack


for command in ["pagination off", "confirm off", "breakpoint always-inserted on", "print thread-events off", "breakpoint pending on"]:
    gdb.execute("set " + command)
gdb.execute("handle SIGPIPE SIGUSR1 SIGALRM nostop noprint pass", to_string=True)
gdb.execute("tbreak main", to_string=True)
gdb.execute("run", to_string=True)
offset = int(gdb.parse_and_eval("(unsigned long)&main")) - next(int(a, 16) for a, f, n in FUNCTIONS if n == "main")
entries = []
for segment in os.environ["WALK_SEGMENTS"].split(";"):
    name, _, rest = segment.partition("@")
    nth, _, last = rest.partition(">")
    starts = [int(a, 16) for a, f, n in FUNCTIONS if n.startswith(name)]
    if not starts:
        raise gdb.GdbError("no function is called " + name)
    begin = [gdb.Breakpoint("*" + hex(offset + a), internal=True) for a in starts]
    for b in begin:
        b.ignore_count = int(nth or 1) - 1
    gdb.execute("continue", to_string=True)
    thread = gdb.selected_thread().num
    first_stack = int(gdb.parse_and_eval("(unsigned long)$rsp"))
    here = gdb.selected_frame().pc() - offset
    for b in begin:
        b.delete()
    if not entries:
        entries = [Entry(offset + int(a, 16), f, n) for a, f, n in FUNCTIONS if n != "main"]
    for e in entries:
        e.enabled = True
    print(next(f + " " + n for a, f, n in FUNCTIONS if int(a, 16) == here), file=out)
    back = Returned()
    gdb.execute("continue", to_string=True)
    back.delete()
    for e in entries:
        e.enabled = False
    print(file=out, flush=True)
out.close()
gdb.execute("kill", to_string=True)
