"""How the Python peers of make bench measure: as measure.h does."""
import statistics
import time


def spread(values):
    return [statistics.median_high(values), min(values), max(values)]


def time_of_call_s(call):
    """CPU time of one call: batches of about 2 ms for half a second, at least 5."""
    call()
    begin = time.thread_time()
    call()
    batch = max(1, int(2e-3 / max(time.thread_time() - begin, 1e-8)))
    times = []
    start = time.thread_time()
    while len(times) < 5 or time.thread_time() - start < 0.5:
        before = time.thread_time()
        for _ in range(batch):
            call()
        times.append((time.thread_time() - before) / batch)
    return spread(times)
