#!/usr/bin/env python3
"""How long an Allan deviation takes beside its definition in NumPy, in turns in one process.

    PYTHONPATH=build/release/python experiments/benchmarks/allan.py [--samples 10000000] [--rounds 5]

The definition is what allantools' oadev does: second differences of the phase, over all places, a cluster at a time.
gyrostat's time is that of the whole answer: points at eight taus a decade with intervals, and the five coefficients.
"""
import argparse
import resource
import time

import numpy as np

import gyrostat


def by_definition(rate, rate_hz, clusters):
    phase = np.concatenate([[0.0], np.cumsum(rate - rate.mean())]) / rate_hz
    deviations = []
    for m in clusters:
        differences = phase[2 * m:] - 2 * phase[m:-m] + phase[:-2 * m]
        deviations.append(np.sqrt(np.mean(differences**2) / 2) * rate_hz / m)
    return np.array(deviations)


def taken(work):
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def peak_mb():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--samples", type=int, default=10_000_000)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    rate_hz = 100.0
    rate = np.random.default_rng(1).normal(size=options.samples)
    before_mb = peak_mb()
    ours, theirs = [], []
    for k in range(options.rounds):
        seconds, answer = taken(lambda: gyrostat.allan(rate, rate_hz=rate_hz))
        ours.append(seconds)
        if k == 0:
            more_mb = peak_mb() - before_mb
            points = answer.tables[0]
            clusters = [round(tau * rate_hz) for tau in points["tau"]]
        seconds, deviations = taken(lambda: by_definition(rate, rate_hz, clusters))
        theirs.append(seconds)
    from_the_error = (points["upper 95 %"] - points["deviation"]) / 1.96
    apart = np.max(np.abs(np.array(points["deviation"]) - deviations) / from_the_error)
    print(f"{options.samples} samples, {len(clusters)} taus: gyrostat {min(ours):.3f} s, by definition {min(theirs):.3f} s, "
          f"{min(theirs) / min(ours):.1f} times; {more_mb:.0f} MB beside the samples' {rate.nbytes / 1e6:.0f}; "
          f"deviations differ by at most {apart:.2g} standard errors")


if __name__ == "__main__":
    main()
