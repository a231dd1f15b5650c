"""The peers of make bench: PyWavelets and NumPy at the jobs gyrocal_bench times.

signal_peer.py FOLDER reads FOLDER/NAME.f64 (doubles), writes FOLDER/NAME.result.f64 and prints one
JSON object of versions and CPU seconds. Exit code 3: PyWavelets or NumPy is not installed.
"""
import glob
import json
import os
import sys
import warnings

import peer_clock

try:
    import numpy
    import pywt
except ImportError:
    sys.exit(3)
warnings.simplefilter("ignore")  # levels beyond the useful one


def decompose(signal):
    return pywt.wavedec(signal, "db4", mode="symmetric", level=5)


def round_trip(signal):
    bands = pywt.wavedec(signal, "db4", mode="periodization", level=len(signal).bit_length() - 1)
    return pywt.waverec(bands, "db4", mode="periodization")


def denoise(signal):
    bands = decompose(signal)
    sigma = numpy.median(numpy.abs(bands[-1])) / 0.6744897501960817
    threshold = sigma * numpy.sqrt(2 * numpy.log(len(signal)))
    bands[1:] = [pywt.threshold(band, threshold, "soft") for band in bands[1:]]
    return pywt.waverec(bands, "db4", mode="symmetric")[: len(signal)]


def fit_three(drift):
    """GM(1,1), improved GM(1,1) of degree 5, cubic in the index."""
    n = len(drift)
    k = numpy.arange(1, n + 1)
    summed = numpy.cumsum(drift)
    mean = (summed[1:] + summed[:-1]) / 2
    a, b = numpy.linalg.lstsq(numpy.column_stack([-mean, numpy.ones(n - 1)]), drift[1:], rcond=None)[0]
    fitted = (drift[0] - b / a) * numpy.exp(-a * (k - 1)) + b / a
    gm11 = numpy.diff(fitted, prepend=0)
    centred = (fitted - fitted.mean()) / fitted.std(ddof=1)
    improved = fitted + numpy.polyval(numpy.polyfit(centred, summed - fitted, 5), centred)
    improved = numpy.diff(improved, prepend=0)
    improved[0] = drift[0]
    cubic = numpy.polyval(numpy.polyfit(k, drift, 3), k)
    return numpy.concatenate([gm11, improved, cubic])


JOBS = {
    "decompose": lambda signal: numpy.concatenate(decompose(signal)),
    "round_trip": round_trip,
    "denoise": lambda signal: numpy.concatenate([denoise(row) for row in signal.reshape(25, -1)]),
    "fit": fit_three,
}
TIMED = dict(JOBS, decompose=decompose)  # without joining the bands


def main():
    answer = {"versions": {"pywt": pywt.__version__, "numpy": numpy.__version__}, "seconds": {}}
    for path in sorted(glob.glob(os.path.join(sys.argv[1], "*.f64"))):
        name = os.path.basename(path)[:-4]
        job = name.rsplit("_", 1)[0]
        signal = numpy.fromfile(path)
        JOBS[job](signal).tofile(os.path.join(sys.argv[1], name + ".result"))
        answer["seconds"][name] = peer_clock.time_of_call_s(lambda: TIMED[job](signal))
    print(json.dumps(answer))


main()
