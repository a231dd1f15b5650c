"""The peer of gyrocal's frame codec: what a script does with the bytes pyserial's read() gives it.

frames_peer.py FILE takes the bytes of FILE as 8 frames a read, finds frames by their header,
unpacks counter, gyro and temperature, counts the lost ones, and prints CPU seconds a frame as JSON.
"""
import json
import struct
import sys
import time

import peer_clock

HEADER = b"\x40\x0b\x52"
FRAME = struct.Struct(">3xH3hh")


def samples_of(stream):
    waiting = b""
    samples = []
    lost = 0
    last = 0
    for at in range(0, len(stream), 8 * FRAME.size):
        waiting += stream[at:at + 8 * FRAME.size]
        begin = 0
        while len(waiting) - begin >= FRAME.size:
            if waiting[begin:begin + 3] != HEADER:
                begin += 1
                continue
            counter, x, y, z, temperature = FRAME.unpack_from(waiting, begin)
            lost += (counter - last - 1) % 65536
            last = counter
            samples.append((counter, x, y, z, temperature))
            begin += FRAME.size
        waiting = waiting[begin:]
    return samples, lost


def main():
    with open(sys.argv[1], "rb") as file:
        stream = file.read()
    taken = []
    for _ in range(5):
        before = time.thread_time()
        samples, lost = samples_of(stream)
        taken.append((time.thread_time() - before) / len(samples))
        assert lost == 0 and len(samples) * FRAME.size == len(stream)
    print(json.dumps({"cpu_s": peer_clock.spread(taken)}))


main()
