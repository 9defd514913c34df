"""A classifier two-sample test [Lopez-Paz and Oquab 2017, Revisiting classifier two-sample tests, section 3]: pieces of
the recording against pieces of a replica; a network of one hidden layer that tells more than half of the held-out ones
shows that they differ. Under the null its accuracy is N(1/2, 1/(4 n))."""
import math

import numpy as np

from recording import Baseline
from summaries import pieces

PIECES = 100
HIDDEN, EPOCHS, RATE, DECAY = 20, 200, 0.01, 1e-3
LEVEL = 0.01


def train(x, y, random):
    """Adam [Kingma and Ba 2015] on the logistic loss; the network's odds as a function."""
    weights = [random.standard_normal((x.shape[1], HIDDEN)) / math.sqrt(x.shape[1]), np.zeros(HIDDEN),
               random.standard_normal(HIDDEN) / math.sqrt(HIDDEN), np.zeros(())]
    first, second = [np.zeros_like(w) for w in weights], [np.zeros_like(w) for w in weights]
    for step in range(1, EPOCHS + 1):
        hidden = np.maximum(x @ weights[0] + weights[1], 0.0)
        error = (1 / (1 + np.exp(-(hidden @ weights[2] + weights[3]))) - y) / len(y)
        back = np.outer(error, weights[2]) * (hidden > 0)
        slopes = [x.T @ back, back.sum(axis=0), hidden.T @ error, error.sum()]
        for k, slope in enumerate(slopes):
            slope = slope + DECAY * weights[k]
            first[k] = 0.9 * first[k] + 0.1 * slope
            second[k] = 0.999 * second[k] + 0.001 * slope**2
            move = first[k] / (1 - 0.9**step) / (np.sqrt(second[k] / (1 - 0.999**step)) + 1e-8)
            weights[k] = weights[k] - RATE * move
    return lambda at: np.maximum(at @ weights[0] + weights[1], 0.0) @ weights[2] + weights[3]


def answer(columns, random):
    sample = pieces(columns, PIECES)
    replica = pieces(Baseline(columns).replica(random), PIECES)
    x, y = np.vstack([sample, replica]), np.repeat([1.0, 0.0], PIECES)
    x = (x - x.mean(axis=0)) / (x.std(axis=0) + 1e-12)
    order = random.permutation(len(x))
    learnt, held = order[: len(x) // 2], order[len(x) // 2:]
    odds = train(x[learnt], y[learnt], random)
    accuracy = np.mean((odds(x[held]) > 0) == (y[held] > 0.5))
    p = 0.5 * math.erfc((accuracy - 0.5) * math.sqrt(4 * len(held)) / math.sqrt(2))
    return {"verdict": "unknown" if p <= LEVEL else "none", "p": p}
