"""What a station's log says, read without the program: ticks, events, notes and the samples of the others (docs/recording.md)."""
import struct
import zlib
from pathlib import Path

def records(data):
    """(type, payload, its end) of each record of a log, by the rule of docs/recording.md: reading ends at the first that is not right."""
    at, number = 16, 0
    while at + 16 <= len(data):
        length, kind, _, sequence = struct.unpack_from("<IHHI", data, at)
        end = at + 12 + length
        if sequence != number or end + 4 > len(data) or zlib.crc32(data[at:end]) != struct.unpack_from("<I", data, end)[0]:
            return
        yield kind, data[at + 12:end], end + 4
        at, number = end + 4, number + 1


VELOCITY, BUTTONS, SAME_POSITION, COMMAND, MISSED, JUMP_TICK, JUMP_TIME = 2, 4, 8, 16, 32, 64, 128
SIZES = {VELOCITY: 24, BUTTONS: 4, COMMAND: 1, MISSED: 4}  # bytes that a tick has where its flag is set


class StationLog:
    def __init__(self, path):
        self.times = []    # ns, on the station's clock, by tick
        self.events = []   # (tick, kind, trial, value, text)
        self.given = []    # (tick, peer, round trip, sequence, time)
        self.frequencies = []  # (tick, omega_o): of the copy from there on
        self.own = None
        self.closed = False
        self.trials = 0
        data, at = Path(path).read_bytes(), 16
        for kind, payload, at in records(data):
            self._take(kind, payload)
        self.whole = at == len(data)

    def _take(self, kind, p):
        if kind == 2:
            self._ticks(p)
        elif kind == 4:
            tick, what, trial, value, size = struct.unpack_from("<QBidI", p)
            self.events.append((tick, what, trial, value, p[25:25 + size].decode()))
        elif kind == 5:
            self.trials += 1
        elif kind == 6:
            self.closed = True
        elif kind == 9:
            count, self.own, places, rates = struct.unpack_from("<IIII", p)
            step = 88 + 8 * (places + rates)
            for i in range(count):
                tick, peer, trip, sequence, time = struct.unpack_from("<QidId", p, 16 + i * step)
                if peer == -1:
                    self.frequencies.append((tick, trip))
                if peer < 0:
                    continue
                self.given.append((tick, peer, trip, sequence, time))

    def _ticks(self, p):
        count, = struct.unpack_from("<I", p)
        at = 4
        for _ in range(count):
            flags = p[at]
            at += 1
            if flags & JUMP_TICK:
                tick, = struct.unpack_from("<Q", p, at)
                at += 8
                if not self.times:
                    self.times = [None] * tick  # so that the index is the tick
                if tick != len(self.times):
                    raise ValueError(f"ticks {len(self.times)} to {tick} are missing")
            if flags & JUMP_TIME:
                self._last, = struct.unpack_from("<q", p, at)
                at += 8
            else:
                self._last += struct.unpack_from("<I", p, at)[0]
                at += 4
            at += (0 if flags & SAME_POSITION else 24) + sum(size for flag, size in SIZES.items() if flags & flag)
            self.times.append(self._last)

    def tick_of(self, kind):
        """The first event of a kind: 4 onset, 5 end of the trial."""
        return next((e[0] for e in self.events if e[1] == kind), None)

    def notes(self):
        return [e[4] for e in self.events if e[1] == 12]
