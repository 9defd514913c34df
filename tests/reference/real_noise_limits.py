#!/usr/bin/env python3
"""How often an effect could be told from the noise of a real sensor at rest by whoever knows every parameter.

    real_noise_limits.py CHECK.json [--draws 400]

For each file and axis of the check's real noise, the slow noise is fitted to cluster means by exact likelihood, dense matrices
throughout: white noise, a random walk and one exponentially correlated (Ornstein-Uhlenbeck) error. Then, for each effect,

- a known curve (ramp, settling, sine): detected where its marginal likelihood ratio, over its size and over how much further walk there may
  be, exceeds what noise alone reaches in 2 %;
- a random error (Gauss-Markov, 1/f, telegraph by its covariance): detected where the likelihood ratio of the two
  covariances exceeds its 98 % quantile without the effect; told from its rival where the ratio to the rival's nearest
  covariance is above zero, too;
- repeated samples: detected where more values repeat than the 98 % quantile of a binomial with the chance of a repeat that the
  recording itself has.

No diagnosis that has to find parameters as well can do better in the mean.
"""
import argparse
import csv
import gzip
import json
from pathlib import Path

import numpy as np
from scipy import linalg, optimize, stats

FALSE_ALARMS = 0.02
POINTS = 900
AGAINST_EACH_OTHER = {"gauss_markov": "bias_instability", "bias_instability": "gauss_markov"}


def gyro(path, axis, longest_s):
    with gzip.open(path, "rt") as text:
        rows = csv.reader(line for line in text if not line.startswith("#"))
        names = next(rows)
        t, w = names.index("t_s"), names.index(f"gyro_{axis}_dps")
        values = []
        for row in rows:
            try:
                values.append((float(row[t]), float(row[w])))
            except ValueError:
                continue
    times, rates = np.array(values).T
    sound = np.isfinite(rates)
    times, rates = times[sound], rates[sound]
    keep = times < times[0] + longest_s
    return times[keep] - times[0], rates[keep]


def cluster_means(times, rates):
    length = max(1, len(rates) // POINTS)
    count = len(rates) // length
    interval = np.median(np.diff(times))
    means = rates[:count * length].reshape(count, length).mean(axis=1)
    return (np.arange(count) + 0.5) * length * interval, means, length, interval


def decaying(t, std, time_s):
    return std ** 2 * np.exp(-np.abs(t[:, None] - t[None, :]) / time_s)


def walk(t, q):
    return q * np.minimum(t[:, None], t[None, :])


def flicker(t, coefficient, shortest_s):
    """Ornstein-Uhlenbeck errors a factor of four in time apart, equal variances: 1/f in between."""
    times = [shortest_s * 4.0 ** j for j in range(12) if shortest_s * 4.0 ** j < 4.0 * t[-1]]
    part = np.sqrt(2.0 * coefficient ** 2 * np.log(2.0) / np.pi)
    return sum(decaying(t, part, time_s) for time_s in times)


def log_likelihood(covariance, values):
    """Of values whose mean is free; values may be columns."""
    lower = linalg.cholesky(covariance, lower=True)
    one = linalg.solve_triangular(lower, np.ones(len(covariance)), lower=True)
    e = linalg.solve_triangular(lower, values, lower=True)
    e = e - np.outer(one, one @ e).reshape(e.shape) / (one @ one)
    return -0.5 * np.sum(e ** 2, axis=0) - np.log(np.diag(lower)).sum() - 0.5 * np.log(one @ one)


def fitted_noise(t, means):
    spread = means.std()

    def covariance(p):
        white, q, std, time_s = np.exp(p)
        return np.diag(np.full(len(t), white ** 2)) + walk(t, q ** 2) + decaying(t, std, time_s)

    best = None
    for time_s in (4.0 * (t[1] - t[0]), t[-1] / 20.0):
        start = np.log([spread, 0.1 * spread / np.sqrt(t[-1]), 0.3 * spread, time_s])
        found = optimize.minimize(lambda p: -log_likelihood(covariance(p), means), start, method="Nelder-Mead",
                                  options={"maxiter": 220, "xatol": 0.02, "fatol": 0.02})
        if best is None or found.fun < best.fun:
            best = found
    return covariance(best.x), np.exp(best.x)


def curve_power(t, own, curve, draws, rng):
    """Marginal likelihoods over the curve's size and over how much further walk there may be, with the curve and without."""
    curve = (curve - curve.mean()) / curve.std()
    size = np.sqrt(np.diag(own).mean())
    further = [0.0, *(size / np.sqrt(t[-1]) * np.geomspace(0.01, 10.0, 10))]
    factors = [linalg.cholesky(own + walk(t, q ** 2), lower=True) for q in further]

    def odds(values):
        prior = values.std(axis=0)
        ratios = [], []
        for lower in factors:
            one, s = linalg.solve_triangular(lower, np.column_stack([np.ones(len(t)), curve]), lower=True).T
            e = linalg.solve_triangular(lower, values, lower=True)
            s = s - one * (one @ s) / (one @ one)
            e = e - np.outer(one, one @ e) / (one @ one)
            plain = -0.5 * np.sum(e ** 2, axis=0) - np.log(np.diag(lower)).sum() - 0.5 * np.log(one @ one)
            v = prior ** 2 * (s @ s)
            ratios[0].append(plain)
            ratios[1].append(plain + 0.5 * (s @ e) ** 2 / (s @ s) * v / (1.0 + v) - 0.5 * np.log1p(v))
        return np.logaddexp.reduce(ratios[1], axis=0) - np.logaddexp.reduce(ratios[0], axis=0)

    noise = linalg.cholesky(own, lower=True) @ rng.standard_normal((len(own), draws))
    other = linalg.cholesky(own, lower=True) @ rng.standard_normal((len(own), draws))
    return lambda amount: np.mean(odds(noise + np.outer(curve, np.full(draws, amount)))
                                  > np.quantile(odds(other), 1.0 - FALSE_ALARMS))


def nearest(rival, truth):
    """The rival's covariance that is nearest to the truth in Kullback and Leibler's sense; rival(log parameters)."""
    def distance(p):
        lower = linalg.cho_factor(rival(p), lower=True)
        return np.trace(linalg.cho_solve(lower, truth)) + 2.0 * np.log(np.diag(lower[0])).sum()
    return distance


def random_power(own, added, rivals, draws, rng):
    truth = own + added
    without = linalg.cholesky(own, lower=True) @ rng.standard_normal((len(own), draws))
    with_it = linalg.cholesky(truth, lower=True) @ rng.standard_normal((len(own), draws))
    ratio = lambda y: log_likelihood(truth, y) - log_likelihood(own, y)  # noqa: E731
    detected = ratio(with_it) > np.quantile(ratio(without), 1.0 - FALSE_ALARMS)
    told = detected
    for rival, start in rivals:
        found = optimize.minimize(nearest(rival, truth), start, method="Nelder-Mead",
                                  options={"maxiter": 60, "xatol": 0.05, "fatol": 0.05})
        told = told & (log_likelihood(truth, with_it) > log_likelihood(rival(found.x), with_it))
    return detected.mean(), told.mean()


def repeats_power(rates, probability):
    chance = np.mean(np.diff(rates) == 0.0)
    n = len(rates) - 1
    with_it = probability + (1.0 - probability) * chance
    return stats.binom.sf(stats.binom.isf(FALSE_ALARMS, n, chance), n, with_it)


def power_of(case, parameters, t, own, rates, cluster, draws, rng):
    effect = case["effect"]
    length, interval = cluster
    slow = {"rate_ramp": lambda p: p["slope_dps_per_s"] * t,
            "start_up": lambda p: p["amplitude_dps"] * np.exp(-t / p["settling_time_s"]),
            "sinusoidal": lambda p: p["amplitude_dps"] * np.sin(2.0 * np.pi * p["frequency_hz"] * t)
            * np.sinc(p["frequency_hz"] * length * interval)}
    if effect in slow:
        curve = slow[effect](parameters)
        power = curve_power(t, own, curve, draws, rng)(curve.std())
        return power, power
    if effect == "stale_samples":
        power = repeats_power(rates, parameters["probability"])
        return power, power
    as_flicker = lambda p: own + flicker(t, np.exp(p[0]), 16.0 * interval)  # noqa: E731
    as_decaying = lambda p: own + decaying(t, np.exp(p[0]), np.exp(p[1]))  # noqa: E731
    if effect == "bias_instability":
        c = parameters["coefficient_dps"]
        return random_power(own, flicker(t, c, 16.0 * interval), [(as_decaying, np.log([c, t[-1] / 10.0]))], draws, rng)
    if effect == "gauss_markov":
        std, time_s = parameters["std_dps"], parameters["correlation_time_s"]
        return random_power(own, decaying(t, std, time_s), [(as_flicker, np.log([std]))], draws, rng)
    if effect == "telegraph":
        added = decaying(t, parameters["amplitude_dps"], 0.5 * parameters["mean_dwell_s"])
        detected, _ = random_power(own, added, [], draws, rng)
        return detected, detected
    return None


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("check", type=Path)
    options.add_argument("--draws", type=int, default=400)
    told = options.parse_args()
    check = json.loads(told.check.read_text())
    rng = np.random.default_rng(1)
    print(f"{'scenario':12} {'effect':18} {'strength':8} {'detected':>9} {'told':>6}   by file and axis (told)")
    for name, scenario in check["scenarios"].items():
        noise = scenario["noise"]
        sensors = []
        for file in noise["files"]:
            for axis in noise["axes"]:
                path = told.check.parent / noise["folder"] / file
                times, rates = gyro(path, axis, noise.get("duration_s", 1e9))
                t, means, length, interval = cluster_means(times, rates)
                own, parameters = fitted_noise(t, means)
                print(f"# {name} {file[:18]} {axis}: {len(t)} means of {length * interval:.3g} s, white {parameters[0]:.3g} dps, "
                      f"walk {parameters[1]:.3g} dps/√s, decaying {parameters[2]:.3g} dps over {parameters[3]:.3g} s", flush=True)
                sensors.append((t, own, rates, (length, interval)))
        for case in (c for c in check["cases"] if c["scenario"] == name):
            for strength in ("strong", "medium"):
                if strength not in case:
                    continue
                powers = [power_of(case, case[strength], t, own, rates, cluster, told.draws, rng)
                          for t, own, rates, cluster in sensors]
                if powers[0] is None:
                    continue
                detected, named = np.array(powers).mean(axis=0)
                each = " ".join(f"{p[1]:.2f}" for p in powers)
                print(f"{name:12} {case['effect']:18} {strength:8} {detected:9.2f} {named:6.2f}   {each}", flush=True)


if __name__ == "__main__":
    main()
