"""A recording of an exported blind check, and the simulator as it stands, fitted to it."""
import csv
import gzip

import numpy as np
from scipy.signal import lfilter


def read(path):
    """Columns by name."""
    with gzip.open(path, "rt", newline="") as file:
        rows = csv.reader(file)
        names = next(rows)
        values = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows])
    return dict(zip(names, values.T))


def wavelet_variance(signal):
    """Haar wavelet variances at 2, 4, 8, … samples: half the overlapping Allan variances [Percival and Walden 2000]."""
    total = np.concatenate([[0.0], np.cumsum(signal)])
    variances = []
    size = 1
    while 8 * size <= len(signal):
        means = (total[size:] - total[:-size]) / size
        variances.append(0.25 * np.mean((means[size:] - means[:-size]) ** 2))
        size *= 2
    return np.array(variances)


def regressors(columns):
    """1, T and T' of the linear thermal drift."""
    time = columns["t_s"]
    parts = [np.ones(len(time))]
    temperature = columns.get("temperature_C")
    if temperature is not None and np.ptp(temperature) > 0.5:
        parts += [temperature - temperature.mean(), np.gradient(temperature, time)]
    return np.column_stack(parts)


def error_of(columns):
    """The gyro less the true rate and the thermal drift, by least squares."""
    error = columns["gyro_dps"] - columns.get("rate_ref_dps", 0.0)
    drift = regressors(columns)
    return error - drift @ np.linalg.lstsq(drift, error, rcond=None)[0]


def heading_error_of(columns):
    """The heading less the true one, deg; None without a compass."""
    if "heading_deg" not in columns:
        return None
    rate = np.broadcast_to(columns.get("rate_ref_dps", 0.0), columns["t_s"].shape)
    steps = rate[1:] * np.diff(columns["t_s"])  # as the simulator turns: a rate is held before its sample
    error = columns["heading_deg"] - np.concatenate([[0.0], np.cumsum(steps)])
    error = (error + 180.0) % 360.0 - 180.0
    offset = np.degrees(np.angle(np.mean(np.exp(1j * np.radians(error)))))
    return (error - offset + 180.0) % 360.0 - 180.0


class Baseline:
    """White noise and a random walk, by the generalised method of wavelet moments; white noise of the compass."""

    def __init__(self, columns):
        self.columns = columns
        error = error_of(columns)
        observed = wavelet_variance(error)
        size = 2.0 ** np.arange(len(observed))
        laws = np.column_stack([0.5 / size, (2 * size**2 + 1) / (12 * size)])
        weights = np.sqrt(len(error) / size) / observed
        shares = np.linalg.lstsq(laws * weights[:, None], observed * weights, rcond=None)[0]
        self.white, self.step = np.sqrt(np.maximum(shares, 0.0))
        heading = heading_error_of(columns)
        self.heading = None if heading is None else heading.std()

    def replica(self, random):
        """The columns with other noise."""
        made = dict(self.columns)
        count = len(made["t_s"])
        noise = self.white * random.standard_normal(count) + np.cumsum(self.step * random.standard_normal(count))
        made["gyro_dps"] = made.get("rate_ref_dps", 0.0) + noise
        if self.heading is not None:
            true = self.columns["heading_deg"] - heading_error_of(self.columns)
            made["heading_deg"] = true + self.heading * random.standard_normal(count)
        return made


def ar1(phi, std, count, random):
    innovations = std * np.sqrt(1 - phi**2) * random.standard_normal(count)
    innovations[0] = std * random.standard_normal()
    return lfilter([1.0], [1.0, -phi], innovations)
