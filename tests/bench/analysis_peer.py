"""The peer of gyrocal's campaign analysis: a plain script for one board, from SQLite to models.

analysis_peer.py FILE reads the accepted dwells' raw samples, converts them to deg/s, takes the Allan
deviation of each dwell at octaves, filters it (db4, level 5, approximation) and takes the mean as zero
drift; fits GM(1,1), improved GM(1,1), a cubic in the index and polynomials in temperature, each also
with every setpoint and every three neighbours left out; stores them in a table of its own and prints,
as JSON, the fitted values of each axis and the CPU seconds of reading the samples. It leaves out what
gyrocal does beyond: the smoothing spline, the noise model, the bands, the hashes.
Exit code 3: PyWavelets or NumPy is not installed.
"""
import json
import sqlite3
import sys
import time

try:
    import numpy
    import pywt
except ImportError:
    sys.exit(3)


def grey(drift):
    """The accumulated fit as a function of the index from 0."""
    n = len(drift)
    summed = numpy.cumsum(drift)
    mean = (summed[1:] + summed[:-1]) / 2
    a, b = numpy.linalg.lstsq(numpy.column_stack([-mean, numpy.ones(n - 1)]), drift[1:], rcond=None)[0]
    return lambda k: (drift[0] - b / a) * numpy.exp(-a * k) + b / a


def differences(accumulated, drift, k):
    """Of a series accumulated from index 0; a negative index stands for the first value."""
    return numpy.where(k < 0.5, drift[0], accumulated(k) - accumulated(k - 1))


def gm11(_, drift, at):
    model = grey(drift)
    return differences(model, drift, at)


def improved_gm11(_, drift, at):
    model = grey(drift)
    k = numpy.arange(len(drift))
    fitted = model(k)
    centre, scale = fitted.mean(), fitted.std(ddof=1)
    residual = numpy.polyfit((fitted - centre) / scale, numpy.cumsum(drift) - fitted, 5)
    return differences(lambda k: model(k) + numpy.polyval(residual, (model(k) - centre) / scale), drift, at)


def polynomial(degree):
    return lambda x, drift, at: numpy.polyval(numpy.polyfit(x, drift, degree), at)


def left_out_rmse(fit, x, drift, neighbours):
    wrong = []
    for i in range(len(drift)):
        keep = abs(numpy.arange(len(drift)) - i) > neighbours
        wrong.append(fit(x[keep], drift[keep], x[i]) - drift[i])
    return float(numpy.sqrt(numpy.mean(numpy.square(wrong))))


def allan_deviations(rates):
    summed = numpy.concatenate([[0], numpy.cumsum(rates - rates.mean())])
    factors = [2**i for i in range(20) if 2**i <= len(rates) / 4]
    return [numpy.sqrt(numpy.mean((summed[2 * m:] - 2 * summed[m:-m] + summed[:-2 * m]) ** 2) / 2) / m
            for m in factors]


def zero_drift(rates):
    bands = pywt.wavedec(rates, "db4", mode="symmetric", level=5)
    bands[1:] = [numpy.zeros_like(band) for band in bands[1:]]
    return pywt.waverec(bands, "db4", mode="symmetric")[: len(rates)].mean()


def main():
    database = sqlite3.connect(sys.argv[1])
    scale = database.execute("SELECT lsb_per_dps_x, lsb_per_dps_y, lsb_per_dps_z, lsb_per_dps_per_k_x, "
                             "lsb_per_dps_per_k_y, lsb_per_dps_per_k_z FROM board").fetchone()
    dwells = database.execute("SELECT dwell.id, setpoint_c FROM dwell JOIN setpoint USING (campaign_id, ordinal) "
                              "WHERE reject_reason IS NULL ORDER BY ordinal").fetchall()
    before = time.thread_time()
    samples = [numpy.array(database.execute("SELECT gyro_x_lsb, gyro_y_lsb, gyro_z_lsb, temperature_raw "
                                            "FROM sample WHERE dwell_id = ? ORDER BY seq", (dwell,)).fetchall())
               for dwell, _ in dwells]
    reading_s = time.thread_time() - before
    index = numpy.arange(len(dwells))
    temperature = numpy.array([setpoint for _, setpoint in dwells])
    methods = {"gm11": (index, gm11), "improved_gm11": (index, improved_gm11), "least_squares": (index, polynomial(3))}
    for degree in range(1, 6):
        methods[f"polynomial_{degree}"] = (temperature, polynomial(degree))
    database.execute("CREATE TABLE IF NOT EXISTS peer_model (axis, method, fitted, rmse, left_out, block_left_out)")
    answer = {"reading_s": reading_s}
    for axis in range(3):
        rates = [rows[:, axis] / (scale[axis] + scale[3 + axis] * (rows[:, 3] / 256 - 20)) for rows in samples]
        deviations = [allan_deviations(dwell) for dwell in rates]
        drift = numpy.array([zero_drift(dwell) for dwell in rates])
        answer["xyz"[axis]] = {}
        for method, (x, fit) in methods.items():
            fitted = fit(x, drift, x)
            database.execute("INSERT INTO peer_model VALUES (?, ?, ?, ?, ?, ?)",
                             ("xyz"[axis], method, json.dumps([fitted.tolist(), deviations[0]]),
                              float(numpy.sqrt(numpy.mean((fitted - drift) ** 2))),
                              left_out_rmse(fit, x, drift, 0), left_out_rmse(fit, x, drift, 1)))
            if not method.startswith("polynomial"):  # those gyrocal weighs by the dwells' errors
                answer["xyz"[axis]][method] = fitted.tolist()
    database.commit()
    print(json.dumps(answer))


main()
