"""Reads a C3D file by the rules of the format's guide (c3d.org), with no line of the program's own reader; refuses what public readers refuse:
header and parameters that do not agree, blocks that do not add up."""
import struct

import numpy


class Parameter:
    def __init__(self, kind, dims, data):
        self.kind, self.dims, self.data = kind, dims, data

    def texts(self):
        assert self.kind == -1
        width = self.dims[0]
        return [self.data[i:i + width].decode("utf-8").rstrip() for i in range(0, len(self.data), width)] if width else []

    def numbers(self):
        return numpy.frombuffer(self.data, {1: "u1", 2: "<u2", 4: "<f4"}[self.kind])

    def number(self):
        values = self.numbers()
        assert len(values) == 1, values
        return values[0]


def parameters_of(raw, block):
    at = (block - 1) * 512
    blocks, processor = raw[at + 2], raw[at + 3]
    assert processor == 84, processor
    end, groups, found = at + 512 * blocks, {}, []
    at += 4
    while True:
        assert at + 2 <= end, "the parameters run out of their section"
        length, group = struct.unpack_from("bb", raw, at)
        if length == 0 or group == 0:
            break
        name = raw[at + 2:at + 2 + abs(length)].decode("ascii")
        offset_at = at + 2 + abs(length)
        offset = struct.unpack_from("<H", raw, offset_at)[0]
        if group < 0:
            groups[-group] = name
            used = offset_at + 2 + 1 + raw[offset_at + 2]
        else:
            kind, rank = struct.unpack_from("bB", raw, offset_at + 2)
            dims = list(raw[offset_at + 4:offset_at + 4 + rank])
            count = abs(kind) * int(numpy.prod(dims)) if dims else abs(kind)
            data = raw[offset_at + 4 + rank:offset_at + 4 + rank + count]
            found.append((group, name, Parameter(kind, dims, data)))
            described = offset_at + 4 + rank + count
            used = described + 1 + raw[described]
        assert offset_at + offset == used, f"{name}: the next record is at {offset_at + offset}, its own end at {used}"
        at = used
    assert {g for g, _, _ in found} <= groups.keys(), "a parameter of a group that is not there"
    return {f"{groups[group]}:{name}": parameter for group, name, parameter in found}, end


class C3d:
    def __init__(self, path):
        raw = open(path, "rb").read()
        assert len(raw) % 512 == 0, "not whole blocks"
        assert raw[1] == 0x50, "not C3D"
        words = struct.unpack_from("<6H", raw, 0)
        _, points, signals, first, last, _ = words
        scale, data_block, per_frame, rate = struct.unpack_from("<fHHf", raw, 12)
        p, end = parameters_of(raw, raw[0])
        self.parameters = p
        assert p["POINT:USED"].number() == points
        assert p["POINT:SCALE"].number() == scale and scale < 0
        assert p["POINT:RATE"].number() == rate
        assert p["POINT:DATA_START"].number() == data_block and (data_block - 1) * 512 == end
        assert p["ANALOG:RATE"].number() / rate == per_frame
        assert p["ANALOG:USED"].number() * per_frame == signals
        assert p["POINT:FRAMES"].number() == min(last, 0xffff)
        low, high = p["TRIAL:ACTUAL_END_FIELD"].numbers()
        frames = int(low) + (int(high) << 16)
        assert first == 1 and min(frames, 0xffff) == last
        self.rate, self.unit = float(rate), p["POINT:UNITS"].texts()[0]
        self.points = self.all_texts("POINT:LABELS")
        self.signals = self.all_texts("ANALOG:LABELS")
        self.signal_units = self.all_texts("ANALOG:UNITS")
        assert len(self.points) == points and len(self.signals) == signals == len(self.signal_units)
        assert len(set(self.points)) == points and len(set(self.signals)) == signals
        scales, offsets = self.all_numbers("ANALOG:SCALE"), self.all_numbers("ANALOG:OFFSET")
        assert len(scales) == len(offsets) == signals
        width = 4 * points + signals
        begin = (data_block - 1) * 512
        assert begin + 4 * width * frames <= len(raw) < begin + 4 * width * frames + 512
        data = numpy.frombuffer(raw, "<f4", width * frames, begin).reshape(frames, width)
        places = data[:, :4 * points].reshape(frames, points, 4)
        self.place, self.seen = places[:, :, :3], places[:, :, 3] > -1
        self.signal = (data[:, 4 * points:] - offsets) * scales * p["ANALOG:GEN_SCALE"].number()
        self.events = {}
        if p["EVENT:USED"].number():
            times = p["EVENT:TIMES"].numbers().reshape(-1, 2)
            for label, (minutes, seconds) in zip(p["EVENT:LABELS"].texts(), times):
                self.events[label] = 60 * minutes + seconds
        key, count = struct.unpack_from("<HH", raw, 298)
        assert key == 12345 and count == len(self.events)

    def all_texts(self, name):
        return self.every(name, lambda p: p.texts())

    def all_numbers(self, name):
        return numpy.array(self.every(name, lambda p: list(p.numbers())))

    def every(self, name, take):
        values, part = take(self.parameters[name]), 2
        while f"{name}{part}" in self.parameters:
            values = values + take(self.parameters[f"{name}{part}"])
            part += 1
        return values
