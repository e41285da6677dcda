#!/usr/bin/env python3
"""Writes go.wav, success.wav and failure.wav, 16-bit PCM mono at 44.1 kHz. Run in this folder."""
import math
import struct
import wave

RATE = 44100


def bell(t, frequency):
    if t < 0:
        return 0.0
    attack = min(1.0, t / 0.006)
    return attack * sum(a * math.exp(-t * d) * math.sin(2 * math.pi * frequency * m * t) for m, a, d in ((1, 1.0, 6.5), (2, 0.35, 9.0), (3, 0.12, 14.0)))


def beep(t, frequency, length):
    """A plain tone with edges of 2 ms: its onset is sharp, and it does not click."""
    edge = max(0.0, min(1.0, t / 0.002, (length - t) / 0.002))
    return edge * math.sin(2 * math.pi * frequency * t)


def write(name, samples):
    fade = int(0.05 * RATE) if len(samples) > 0.3 * RATE else 0
    for i in range(fade):
        samples[-1 - i] *= i / fade
    peak = max(abs(s) for s in samples)
    with wave.open(name, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(b"".join(struct.pack("<h", round(0.6 * 32767 * s / peak)) for s in samples))


def times(seconds):
    return [i / RATE for i in range(int(seconds * RATE))]


write("success.wav", [0.42 * bell(t, 659.25) + 0.42 * bell(t - 0.11, 987.77) for t in times(0.75)])
write("go.wav", [beep(t, 1000.0, 0.1) for t in times(0.1)])
write("failure.wav", [0.42 * bell(t, 329.63) + 0.42 * bell(t - 0.13, 246.94) for t in times(0.75)])
