"""Selection among sums of processes by wavelet variance: the generalised method of wavelet moments [Guerrier, Skaloud,
Stebler and Victoria-Feser 2013, JASA 108] with the wavelet information criterion [Guerrier, Molinari and Skaloud 2015;
Zhang, Guerrier et al. 2023]. Its processes have names of the catalogue; a sine as in Voirol et al. 2023."""
import itertools

import numpy as np
from scipy.optimize import minimize

from recording import ar1, error_of, wavelet_variance

BOOTSTRAP = 60
WITHIN = -20.0, 14.0  # logarithms of parameters: times up to a million samples
VANISHED = 0.01  # share of the wavelet variance at its best scale
SLOW = 4.0  # samples: an AR(1) that forgets sooner is a filter of the white noise


def quantization(size, q):
    return 1.5 * q**2 / size**2


def white(size, std):
    return 0.5 * std**2 / size


def walk(size, step):
    return step**2 * (2 * size**2 + 1) / (12 * size)


def ramp(size, slope):
    return 0.25 * slope**2 * size**2


def first_order(size, std, time):
    phi = np.exp(-1.0 / time)
    left = 1 - phi**size
    own = size * (1 + phi) / (1 - phi) - 2 * phi * left / (1 - phi) ** 2
    return 0.5 * std**2 * (own - phi * left**2 / (1 - phi) ** 2) / size**2


def sine(size, amplitude, period):
    half = np.pi / period
    return 0.5 * amplitude**2 * np.sin(size * half) ** 4 / (size * np.sin(half)) ** 2


class Model:
    """A sum of processes whose parameters are fitted on the logarithmic scale."""

    def __init__(self, processes, starts):
        self.processes, self.starts = processes, np.log(starts)

    def parts(self, logs=None):
        """Each process with its parameters."""
        values, at = np.exp(np.clip(self.logs if logs is None else logs, *WITHIN)), 0
        for process in self.processes:
            count = process.__code__.co_argcount - 1
            yield process, values[at:at + count]
            at += count

    def variance(self, size, logs):
        return sum(process(size, *values) for process, values in self.parts(logs))

    def fit(self, size, observed, weights):
        def misfit(logs):
            return np.sum(weights * (observed - self.variance(size, logs)) ** 2)
        found = minimize(misfit, self.starts, method="Nelder-Mead",
                         options={"maxiter": 400 * len(self.starts), "xatol": 1e-4, "fatol": 1e-6})
        self.logs, self.misfit = np.clip(found.x, *WITHIN), found.fun
        return self

    def criterion(self, size, weights, covariance):
        """WIC: the misfit and twice the optimism tr cov(ν̂, ν(θ̂)) Ω, of the fit linearised."""
        steps = 1e-4 * np.eye(len(self.logs))
        slopes = np.column_stack([(self.variance(size, self.logs + s) - self.variance(size, self.logs - s)) / 2e-4
                                  for s in steps])
        omega = np.diag(weights)
        hat = slopes @ np.linalg.pinv(slopes.T @ omega @ slopes) @ slopes.T @ omega
        return self.misfit + 2 * np.trace(covariance @ omega @ hat)


def models(size, observed):
    """White noise and a random walk, beside every choice of the others."""
    std, last = np.sqrt(2 * observed[0]), np.sqrt(observed[-1])
    period = 4.0 * size[1 + np.argmax(observed[1:-1] / np.sqrt(observed[:-2] * observed[2:]))]
    choices = [
        [[], [(quantization, [0.3 * std])]],
        [[], [(ramp, [last / size[-1]])]],
        [[], [(first_order, [std / 4, 100.0])], [(first_order, [std / 4, 2.0])],
         [(first_order, [std / 4, 30.0]), (first_order, [std / 4, 1000.0])]],
        [[], [(sine, [std / 4, period])]],
    ]
    for choice in itertools.product(*choices):
        extra = [part for parts in choice for part in parts]
        processes = [white, walk] + [process for process, _ in extra]
        yield Model(processes, [std, last / np.sqrt(size[-1])] + [s for _, starts in extra for s in starts])


def names_of(model, size):
    """Of the processes that are there: a fit lets one vanish that it does not need."""
    names, slow = [], 0
    total = model.variance(size, model.logs)
    for process, values in model.parts():
        if np.max(process(size, *values) / total) < VANISHED:
            continue
        if process is quantization:
            names.append("angle_quantization")
        elif process is ramp:
            names.append("rate_ramp")
        elif process is sine:
            names.append("sinusoidal")
        elif process is first_order and values[1] < SLOW:
            names.append("noise_bandwidth")
        elif process is first_order:
            slow += 1
    if slow:
        names.append("gauss_markov" if slow == 1 else "bias_instability")
    return tuple(sorted(set(names)))


def replica(model, count, random):
    total = np.zeros(count)
    for process, values in model.parts():
        if process is quantization:
            total += np.diff(values[0] * random.standard_normal(count + 1))
        elif process is white:
            total += values[0] * random.standard_normal(count)
        elif process is walk:
            total += np.cumsum(values[0] * random.standard_normal(count))
        elif process is first_order:
            total += ar1(np.exp(-1.0 / values[1]), values[0], count, random)
    return total


def answer(columns, random):
    error = error_of(columns)
    observed = wavelet_variance(error)
    size = 2.0 ** np.arange(len(observed))
    weights = len(error) / size / observed**2
    plain = Model([white, walk, first_order, first_order],
                  [np.sqrt(2 * observed[0]), 1e-4 * np.sqrt(observed[0]), np.sqrt(observed[0]) / 4, 3.0,
                   np.sqrt(observed[0]) / 4, 300.0]).fit(size, observed, weights)
    covariance = np.cov(np.array([wavelet_variance(replica(plain, len(error), random))
                                  for _ in range(BOOTSTRAP)]).T)
    weights = 1.0 / np.diag(covariance)
    criteria = {}  # of each set of names the least
    for model in models(size, observed):
        names = names_of(model.fit(size, observed, weights), size)
        criteria[names] = min(model.criterion(size, weights, covariance), criteria.get(names, np.inf))
    least = min(criteria.values())
    shares = {names: np.exp(-0.5 * (criterion - least)) for names, criterion in criteria.items()}
    best = min(criteria, key=criteria.get)
    inclusion = {name: sum(share for names, share in shares.items() if name in names) / sum(shares.values())
                 for name in best}
    ranked = sorted(best, key=lambda name: -inclusion[name])
    return {"verdict": ranked[0] if ranked else "none",
            "effects": [{"effect": name, "inclusion": float(inclusion[name])} for name in ranked]}
