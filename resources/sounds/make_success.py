#!/usr/bin/env python3
"""Writes success.wav: two bell-like tones, a fifth apart, 16-bit PCM mono at 44.1 kHz. Run in this folder."""
import math
import struct
import wave

RATE = 44100


def bell(t, frequency):
    if t < 0:
        return 0.0
    attack = min(1.0, t / 0.006)
    return attack * sum(a * math.exp(-t * d) * math.sin(2 * math.pi * frequency * m * t) for m, a, d in ((1, 1.0, 6.5), (2, 0.35, 9.0), (3, 0.12, 14.0)))


samples = [0.42 * bell(i / RATE, 659.25) + 0.42 * bell(i / RATE - 0.11, 987.77) for i in range(int(0.75 * RATE))]
fade = int(0.05 * RATE)
for i in range(fade):
    samples[-1 - i] *= i / fade
peak = max(abs(s) for s in samples)
with wave.open("success.wav", "wb") as file:
    file.setnchannels(1)
    file.setsampwidth(2)
    file.setframerate(RATE)
    file.writeframes(b"".join(struct.pack("<h", round(0.6 * 32767 * s / peak)) for s in samples))
