#!/usr/bin/env python3
"""Quantiles behind rankings and stop rules, from SciPy (Debian: python3-scipy).

Usage: ranking_reference.py

The studentised range for infinitely many degrees of freedom, Friedman's test with ties, and how often
a standardised mean stays within the bounds of tests/analysis/sequential_test.cpp at all of its looks,
by the multivariate normal distribution. The numbers printed stand in tests/analysis.
"""
import numpy as np
from scipy import stats

print("studentised range, 0.95:")
for k in (2, 3, 5, 10, 20):
    print(f"  {k}: {stats.studentized_range.ppf(0.95, k, np.inf):.8f}")

table = np.array([[1.0, 2.0, 3.0, 3.0], [2.0, 1.0, 4.0, 4.0], [1.0, 1.0, 2.0, 5.0], [3.0, 2.0, 4.0, 6.0], [1.0, 5.0, 6.0, 7.0]])
print("friedman:", repr(stats.friedmanchisquare(*table.T).pvalue))
print("mean ranks:", np.mean([stats.rankdata(row) for row in table], axis=0))

alpha = 0.05
counts = [100, 140, 200, 280, 400]


def stays(bounds):
    n = np.array(counts[: len(bounds)], float)
    covariance = np.sqrt(np.minimum.outer(n, n) / np.maximum.outer(n, n))
    normal = stats.multivariate_normal(np.zeros(len(n)), covariance, seed=1)
    return normal.cdf(np.array(bounds), lower_limit=-np.array(bounds))


bounds = [stats.norm.isf(alpha / 4)]
for k in range(1, len(counts)):
    wanted = 1 - alpha * (1 - 1 / (k + 2))
    low, high = 1.5, 5.0
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if stays(bounds + [middle]) < wanted else (low, middle)
    bounds.append((low + high) / 2)
print("bounds:", [round(b, 4) for b in bounds])
