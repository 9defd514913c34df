#!/usr/bin/env python3
"""Overlapping Allan deviation of the 1000-point test set of NIST SP 1065, from its definition.

Usage: allan_reference.py

Every cluster mean is an exact fraction of the generator's integers, averaged without a running
sum, so that agreement with the phase-based estimator is agreement between two derivations. The
numbers printed stand in tests/analysis/allan_test.cpp.
"""
from fractions import Fraction
from math import sqrt

MODULUS = 2147483647


def test_set(count=1000, n=1234567890):
    for _ in range(count):
        yield n
        n = 16807 * n % MODULUS


def allan_variance(rate, m):
    """Half the mean square difference of neighbouring means of m samples."""
    starts = range(len(rate) - 2 * m + 1)
    total = sum((sum(rate[i + m : i + 2 * m]) - sum(rate[i : i + m])) ** 2 for i in starts)
    return Fraction(total, 2 * m * m * len(starts) * MODULUS**2)


if __name__ == "__main__":
    rate = list(test_set())
    for m in (1, 2, 7, 10, 100, 250):
        print(f"{{{m}, {sqrt(allan_variance(rate, m)):.16e}}},")
