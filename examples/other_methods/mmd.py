"""Misspecification by maximum mean discrepancy [Schmitt, Bürkner, Köthe and Radev 2024, Detecting model misspecification
in amortized Bayesian inference with neural networks, section 3.3]: how far the summaries of a recording lie from those of
replicas, against how far replicas lie from one another. Their summary network is replaced by numbers chosen by hand."""
import numpy as np

from recording import Baseline
from summaries import summary

REPLICAS = 100
LEVEL = 0.01


def kernel(a, b, scales):
    """Sum of Gaussian kernels of several widths."""
    squares = np.sum((a[:, None, :] - b[None, :, :]) ** 2, axis=2)
    return sum(np.exp(-squares / (2 * scale)) for scale in scales)


def discrepancy(one, many, scales, among):
    """MMD² of one point to a sample, of which `among` is the mean kernel."""
    return kernel(one, one, scales)[0, 0] + among - 2 * kernel(one, many, scales).mean()


def answer(columns, random):
    baseline = Baseline(columns)
    # Each replica has parameters of its own, as far as the recording leaves them open.
    replicas = np.array([summary(Baseline(baseline.replica(random)).replica(random)) for _ in range(2 * REPLICAS)])
    spread = replicas.std(axis=0) + 1e-12
    replicas, observed = replicas / spread, summary(columns)[None, :] / spread
    many, others = replicas[:REPLICAS], replicas[REPLICAS:]
    squares = np.sum((many[:, None, :] - many[None, :, :]) ** 2, axis=2)
    scales = np.median(squares) * np.array([0.25, 1.0, 4.0])
    among = kernel(many, many, scales).mean()
    null = [discrepancy(other[None, :], many, scales, among) for other in others]
    p = (1 + np.sum(null >= discrepancy(observed, many, scales, among))) / (1 + REPLICAS)
    return {"verdict": "unknown" if p <= LEVEL else "none", "p": float(p)}
