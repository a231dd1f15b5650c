"""The peer of gyrocal's store: Python's sqlite3, executemany, a transaction a dwell.

store_peer.py FILE writes 25 dwells of 3000 samples into a campaign that stands in FILE, and prints
the CPU seconds of a sample as JSON.
"""
import json
import random
import sqlite3
import sys
import time

import peer_clock

DWELLS, SAMPLES = 25, 3000


def main():
    database = sqlite3.connect(sys.argv[1], isolation_level=None)
    for pragma in ("journal_mode = WAL", "synchronous = FULL", "foreign_keys = ON"):
        database.execute("PRAGMA " + pragma)
    counts = random.Random(11)
    taken = []
    for ordinal in range(DWELLS):
        rows = [(ordinal + 1, seq, 3600000000000 + seq * 20000000, counts.randint(-9, 40),
                 counts.randint(-9, 40), counts.randint(-9, 40), 5120, None) for seq in range(SAMPLES)]
        before = time.thread_time()
        database.execute("BEGIN IMMEDIATE")
        database.execute("INSERT INTO dwell (id, campaign_id, board_id, ordinal, attempt, t_start_ns, t_end_ns, "
                         "timed_soak, samples, frames_missing, counter_first) "
                         "VALUES (?, 1, 1, ?, 1, 0, 1, 0, ?, 0, 1)", (ordinal + 1, ordinal, SAMPLES))
        database.executemany("INSERT INTO sample VALUES (?, ?, ?, ?, ?, ?, ?, ?)", rows)
        database.execute("COMMIT")
        taken.append((time.thread_time() - before) / SAMPLES)
    print(json.dumps({"cpu_s": peer_clock.spread(taken)}))


main()
