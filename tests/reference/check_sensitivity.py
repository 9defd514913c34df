#!/usr/bin/env python3
"""Compares `gyrostat sensitivity` with an independent derivation and with OpenTURNS.

Usage: check_sensitivity.py GYROSTAT_BINARY WORKDIR

A small study with a Saltelli design is run twice. With several trials a point, Sobol' indices free of trial
noise are computed again from the exported outcomes, every square as the mean of all products of two
different trials; they must agree to 1e-9. With one trial a point nothing is taken out, and the indices are
held against OpenTURNS' Martinez estimator (python3-openturns), the correlation about each sample's own mean
where ours is about the common one: they differ by the order of 1/rows, and 5/rows are allowed.

A surrogate of as many parameters is computed from its JSON by NumPy's Legendre polynomials; it must foretell means at points of another design to within twice the error
of OpenTURNS' sparse chaos (LARS, corrected leave-one-out) of the same points.
"""
import csv
import json
import os
import shutil
import subprocess
import sys

import numpy as np

ROWS, PARAMETERS = 64, 3
STUDY = {
    "seed": 11,
    "cells": [{
        "name": "design",
        "trials": 6,
        "parameters_from": "truth",
        "scenario": {"duration_s": 2, "rate_hz": 100},
        "filters": ["kf", "stf"],
        "design": {
            "kind": "saltelli",
            "rows": ROWS,
            "parameters": {
                "scenario.random_error.phi": {"from": 0.1, "to": 0.9},
                "scenario.random_error.delta1_dps": {"from": 0.0003, "to": 0.01, "scale": "log"},
                "scenario.random_error.measurement_noise_std_dps": {"from": 0.005, "to": 0.05}
            }
        }
    }]
}


def call(binary, folder, *arguments):
    run = subprocess.run([binary, *arguments], cwd=folder, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"gyrostat {' '.join(arguments)}: {run.stderr.strip()}")
    return run.stdout


def outputs_of(binary, folder, name, trials):
    """bias_rmse of each method, by row, place in the row (A, B, AB_1, ...) and trial."""
    values = {}
    for row in csv.DictReader(call(binary, folder, "export", f"runs/{name}").splitlines()):
        values.setdefault(row["method"], []).append(float(row["bias_rmse"]))
    return {method: np.array(column).reshape(ROWS, PARAMETERS + 2, trials)
            for method, column in values.items()}


def indices_of(binary, folder, name):
    """First-order and total indices of each method, as the program prints them."""
    tables = json.loads(call(binary, folder, "sensitivity", f"runs/{name}", "--format", "json"))
    table = tables[0] if isinstance(tables, list) else tables["tables"][0]
    names = [column["name"] for column in table["columns"]]
    first, total = names.index("first order"), names.index("total")
    indices = {}
    for row in table["rows"]:
        if row[1] != "trial noise":
            indices.setdefault(row[0], []).append((row[first], row[total]))
    return {method: np.array(pairs) for method, pairs in indices.items()}


def mean_product(a, b):
    """The mean over all pairs of different trials of a_t b_s; of a single trial its own product."""
    trials = len(a)
    if trials == 1:
        return a[0] * b[0]
    return np.mean([a[t] * b[s] for t in range(trials) for s in range(trials) if s != t])


def derived(outputs):
    """First-order and total indices of one method by the definition."""
    centred = outputs - outputs.mean(axis=(0, 1))
    pairs = []
    for p in range(PARAMETERS):
        index = []
        for other in (1, 0):  # B for the first order, A for the total
            squares = np.mean([mean_product(r[other] - r[2 + p], r[other] - r[2 + p]) for r in centred])
            variance = np.mean([mean_product(r[other], r[other]) + mean_product(r[2 + p], r[2 + p])
                                for r in centred])
            index.append(squares / variance)
        pairs.append((1.0 - index[0], index[1]))
    return np.array(pairs)


def by_openturns(outputs):
    import openturns as ot
    columns = outputs[:, :, 0].T  # A, B, AB_1, ...: OpenTURNS stacks them in this order
    sample = ot.Sample([[y] for y in columns.reshape(-1)])
    design = ot.Sample(len(sample), PARAMETERS)  # only the outputs matter
    martinez = ot.MartinezSensitivityAlgorithm(design, sample, ROWS)
    return np.column_stack([martinez.getFirstOrderIndices(), martinez.getTotalOrderIndices()])


def compare(what, ours, theirs, tolerance):
    worst = np.max(np.abs(ours - theirs))
    good = bool(worst <= tolerance)
    print(f"{'ok  ' if good else 'FAIL'} {what}: largest difference {worst:.2e}, allowed {tolerance:.2e}")
    return good


def held_out(folder, binary, name):
    """Coordinates in [-1, 1] and means of kf over trials at the points of a design."""
    rows = call(binary, folder, "sensitivity", f"runs/{name}", "--points", "--method", "kf", "--format", "csv")
    lines = [line for line in rows.splitlines() if line.startswith(("row_", "point_"))]
    values = np.array([[float(v) for v in line.split(",")[1:5]] for line in lines])
    x = values[:, :3].copy()
    spans = STUDY["cells"][0]["design"]["parameters"].values()
    for p, span in enumerate(spans):
        scale = np.log if span.get("scale") == "log" else (lambda v: v)
        low, high = scale(span["from"]), scale(span["to"])
        x[:, p] = 2.0 * (scale(x[:, p]) - low) / (high - low) - 1.0
    return x, values[:, 3]


def by_terms(surrogate, x):
    """The surrogate of the JSON, by NumPy."""
    from numpy.polynomial.legendre import legval
    y = np.zeros(len(x))
    for term in surrogate["terms"]:
        product = np.full(len(x), term["coefficient"])
        for p, degree in enumerate(term["degrees"]):
            product *= np.sqrt(2.0 * degree + 1.0) * legval(x[:, p], [0.0] * degree + [1.0])
        y += product
    return y


def chaos_of_openturns(x, y):
    import openturns as ot
    law = ot.ComposedDistribution([ot.Uniform(-1.0, 1.0)] * PARAMETERS)
    enumeration = ot.HyperbolicAnisotropicEnumerateFunction(PARAMETERS, 0.75)
    basis = ot.OrthogonalProductPolynomialFactory([ot.LegendreFactory()] * PARAMETERS, enumeration)
    size = enumeration.getBasisSizeFromTotalDegree(8)
    sparse = ot.LeastSquaresMetaModelSelectionFactory(ot.LARS(), ot.CorrectedLeaveOneOut())
    algorithm = ot.FunctionalChaosAlgorithm(ot.Sample(x.tolist()), ot.Sample([[v] for v in y]), law,
                                            ot.FixedStrategy(basis, size), ot.LeastSquaresStrategy(sparse))
    algorithm.run()
    model = algorithm.getResult().getMetaModel()
    return lambda points: np.array(model(ot.Sample(points.tolist()))).ravel()


def check_surrogate(binary, folder):
    cell = STUDY["cells"][0]
    verdicts, designs = [], {}
    cell["trials"] = 6
    for name, kind, size in (("tenth", "surrogate", {"rows": 30}), ("others", "latin_hypercube", {"points": 100})):
        cell["design"] = {"kind": kind, **size, "parameters": cell["design"]["parameters"]}
        with open(os.path.join(folder, f"{name}.json"), "w") as file:
            json.dump(STUDY, file)
        call(binary, folder, "run", f"{name}.json")
        designs[name] = held_out(folder, binary, name)
    call(binary, folder, "sensitivity", "runs/tenth", "--method", "kf", "--json", "function.json")
    with open(os.path.join(folder, "function.json")) as file:
        surrogate = json.load(file)["surrogates"][0]
    x, y = designs["others"]
    error = np.mean((by_terms(surrogate, x) - y) ** 2) / np.var(y)
    told = surrogate["unexplained"]["value"] + surrogate["trial_noise"]["value"]
    print(f"surrogate: {len(surrogate['terms'])} terms, trusted {surrogate['trusted']}, error {error:.2e} at new points, "
          f"{told:.2e} told")
    verdicts.append(bool(surrogate["trusted"]) and error < 0.05)
    try:
        theirs = np.mean((chaos_of_openturns(*designs["tenth"])(x) - y) ** 2) / np.var(y)
        good = bool(error <= 2.0 * theirs)
        print(f"{'ok  ' if good else 'FAIL'} surrogate against OpenTURNS: {error:.2e} and {theirs:.2e} at new points")
        verdicts.append(good)
    except ImportError:
        pass
    return verdicts


def main(binary, folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    verdicts = []
    for name, trials in (("noisy", 6), ("single", 1)):
        STUDY["cells"][0]["trials"] = trials
        with open(os.path.join(folder, f"{name}.json"), "w") as file:
            json.dump(STUDY, file)
        call(binary, folder, "run", f"{name}.json")
        outputs, indices = outputs_of(binary, folder, name, trials), indices_of(binary, folder, name)
        for method, values in outputs.items():
            verdicts.append(compare(f"{name} {method} against its definition", indices[method],
                                    derived(values), 1e-9))
    verdicts += check_surrogate(binary, folder)
    try:
        for method, values in outputs.items():
            verdicts.append(compare(f"single {method} against OpenTURNS", indices[method],
                                    by_openturns(values), 5.0 / ROWS))
    except ImportError:
        print("SKIPPED: python3-openturns is not installed" if all(verdicts) else "FAIL")
    return 0 if verdicts and all(verdicts) else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
