"""What the misspecification tests look at: numbers that each of the catalogue's effects moves."""
import numpy as np

from recording import error_of, heading_error_of, wavelet_variance


def correlation(a, b):
    a, b = a - a.mean(), b - b.mean()
    scale = np.sqrt(np.sum(a**2) * np.sum(b**2))
    return np.sum(a * b) / scale if scale > 0 else 0.0


def of_noise(error):
    steps = np.diff(error)
    power = np.mean(steps**2) or 1.0
    return [
        np.log(np.mean(steps**4) / power**2),
        np.mean(steps == 0.0),
        np.log(len(np.unique(np.round(error, 9))) / len(error)),
        correlation(error[1:], error[:-1]),
        correlation(steps[1:], steps[:-1]),
    ]


def summary(columns):
    """Of a whole recording."""
    error = error_of(columns)
    parts = list(np.log(wavelet_variance(error) + 1e-30)) + of_noise(columns["gyro_dps"])
    temperature = columns.get("temperature_C")
    if temperature is not None and np.ptp(temperature) > 0.5:
        rising = np.gradient(temperature) > 0
        parts += [correlation(error, (temperature - temperature.mean()) ** 2),
                  correlation(np.abs(np.diff(error)), temperature[1:]),
                  correlation(error, np.where(rising, 1.0, -1.0))]
    for name, rate in columns.items():
        if name.startswith("rate_ref") or name.startswith("gyro_") and name != "gyro_dps":
            parts += [correlation(error, rate), correlation(error, np.abs(rate)),
                      correlation(error, np.gradient(rate))]
        if name.startswith("acc_"):
            parts.append(correlation(error, rate))
    heading = heading_error_of(columns)
    if heading is not None:
        true = np.radians(columns["heading_deg"] - heading)
        parts += of_noise(heading)
        parts += [correlation(heading, f(k * true)) for k in (1, 2) for f in (np.sin, np.cos)]
        parts += list(np.log(wavelet_variance(heading) + 1e-30))
    return np.array(parts)


def pieces(columns, count):
    """Summaries of so many pieces of a recording: spectra, tails and lattices, and errors of the heading."""
    error, heading = error_of(columns), heading_error_of(columns)
    rows = []
    for part in np.array_split(np.arange(len(error)), count):
        piece = error[part]
        row = list(np.log(wavelet_variance(piece) + 1e-30)) + of_noise(columns["gyro_dps"][part])
        row += [np.mean(piece), np.log(np.std(np.diff(piece)) + 1e-30)]
        if heading is not None:
            row += of_noise(heading[part]) + [np.mean(heading[part]), np.log(np.std(heading[part]) + 1e-30)]
        rows.append(row)
    shortest = min(map(len, rows))
    return np.array([row[:shortest] for row in rows])
