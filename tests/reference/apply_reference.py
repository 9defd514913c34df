#!/usr/bin/env python3
"""Covariance-form reference of the gyro error filters.

Usage: apply_reference.py INPUT.csv CONFIG.json OUT.csv

The formulae are those of METHODS.md sections 1-3, written with full covariance
matrices and dense inverses (no square-root propagation), so that agreement with
a square-root implementation is agreement between two derivations.
"""
import csv
import json
import math
import sys

import numpy as np

NAN = float("nan")
OK, NO_MEASUREMENT, RISK_BREAKDOWN = "ok", "no_measurement", "risk_breakdown"
INPUT_COLUMNS = ("t_s", "gyro_dps", "temperature_C", "heading_deg", "mag_valid")
RESULT_COLUMNS = ("estimate_dps", "innovation_dps", "innovation_variance", "status")


def symmetric(matrix):
    return 0.5 * (matrix + matrix.T)


def wrap180(angle_deg):
    return math.remainder(angle_deg, 360.0)


def condition(x, P, innovation, H, R):
    """Kalman measurement update in Joseph form; returns x, P and S = H P H' + R."""
    S = symmetric(H @ P @ H.T + R)
    K = np.linalg.solve(S, H @ P).T
    A = np.eye(len(x)) - K @ H
    return x + K @ innovation, symmetric(A @ P @ A.T + K @ R @ K.T), S


class FadingFactor:
    """Factor on the prior covariance, METHODS.md section 2, paragraph STF."""

    def __init__(self, p):
        self.adaptive = bool(p["adaptive"])
        self.minimum = p["fading_factor"]
        self.rho = p["forgetting"]
        self.beta = p["softening"]
        self.V = None

    def at_measurement(self, innovation, M, HQH, R):
        """V_k, N = V - H Q H' - beta R, factor = max(minimum, tr N / tr M)."""
        if not self.adaptive:
            return self.minimum
        square = np.outer(innovation, innovation)
        self.V = square if self.V is None else (self.rho * self.V + square) / (1.0 + self.rho)
        N = self.V - HQH - self.beta * R
        trace_M = np.trace(M)
        return max(self.minimum, np.trace(N) / trace_M) if trace_M > 0.0 else self.minimum


# Random-error filters on linear models (METHODS.md section 2, model L and its
# three-state extension that carries a_k).

def run_linear(gyro, x, P, F, Q, r, fading=None, mu=None):
    """Kalman filter with H = [1, 0, ...]; P- = factor F P F' + Q, then (P-^-1 - 2 diag(mu))^-1."""
    H = np.eye(1, len(x))
    R = np.array([[r]])
    mu = np.zeros(len(x)) if mu is None else mu
    rows = []
    for z in gyro:
        x = F @ x
        FPF = symmetric(F @ P @ F.T)
        innovation = np.array([z - x[0]])
        missing = math.isnan(z)
        factor = 1.0
        if fading is not None and not missing:
            factor = fading.at_measurement(innovation, H @ FPF @ H.T, H @ Q @ H.T, R)
        P = factor * FPF + Q
        inflated = risk_update(P, mu)
        broken = inflated is None
        if not broken:
            P = inflated
        S = np.array([[NAN]])
        status = NO_MEASUREMENT
        if not missing:
            x, P, S = condition(x, P, innovation, H, R)
            status = OK
        rows.append((x[0], innovation[0], S[0, 0], RISK_BREAKDOWN if broken else status))
    return rows


def initial_pair(p):
    mean = [p["initial_x_dps"], p["initial_x_previous_dps"]]
    variance = [p["initial_x_std_dps"] ** 2, p["initial_x_previous_std_dps"] ** 2]
    return mean, variance


def run_kf(data, p, fading=None, mu=None):
    """Model L: F = [[1+phi, -phi], [1, 0]], G = [[delta1, -delta2], [0, 0]]."""
    phi = p["phi"]
    F = np.array([[1.0 + phi, -phi], [1.0, 0.0]])
    G = np.array([[p["delta1_dps"], -p["delta2_dps"]], [0.0, 0.0]])
    mean, variance = initial_pair(p)
    return run_linear(data["gyro_dps"], np.array(mean), np.diag(variance), F, G @ G.T,
                      p["measurement_noise_std_dps"] ** 2, fading, mu)


def run_stf(data, p):
    return run_kf(data, p, FadingFactor(p))


def run_rskf(data, p):
    return run_kf(data, p, mu=np.array([p["mu_x"], p["mu_x_previous"]]))


def run_kf_ma(data, p):
    """State [x_k, x_{k-1}, a_k]: the ARIMA(1,1,1) recursion of METHODS.md section 1, exact."""
    phi = p["phi"]
    F = np.array([[1.0 + phi, -phi, -p["delta2_dps"]], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    g = np.array([p["delta1_dps"], 0.0, 1.0])
    mean, variance = initial_pair(p)
    return run_linear(data["gyro_dps"], np.array(mean + [0.0]), np.diag(variance + [1.0]), F,
                      np.outer(g, g), p["measurement_noise_std_dps"] ** 2)


# Unscented filters on the augmented model NL (METHODS.md section 2, SR-UKF and
# SR-RSUKF), state [x_k, x_{k-1}, phi, delta1, delta2, a_k, a_{k-1}].

X, X_PREVIOUS, PHI, DELTA1, DELTA2, A, A_PREVIOUS = range(7)
WALK_NAMES = ("walk_phi_std", "walk_delta1_std_dps", "walk_delta2_std_dps")
MU_NAMES = ("mu_x", "mu_x_previous", "mu_phi", "mu_delta1", "mu_delta2", "mu_a", "mu_a_previous")


def lower_cholesky(P):
    """Lower Cholesky factor; states of exactly zero variance get zero rows and columns."""
    varies = np.flatnonzero(np.diag(P) > 0.0)
    S = np.zeros_like(P)
    S[np.ix_(varies, varies)] = np.linalg.cholesky(P[np.ix_(varies, varies)])
    return S


def transition(s):
    moved = s.copy()
    moved[X_PREVIOUS] = s[X]
    moved[X] = ((1.0 + s[PHI]) * s[X] - s[PHI] * s[X_PREVIOUS]
                + s[DELTA1] * s[A] - s[DELTA2] * s[A_PREVIOUS])
    return moved


def transition_jacobian(s):
    J = np.eye(7)
    J[X] = [1.0 + s[PHI], -s[PHI], s[X] - s[X_PREVIOUS], s[A], -s[A_PREVIOUS],
            s[DELTA1], -s[DELTA2]]
    J[X_PREVIOUS] = np.eye(7)[X]
    return J


def transition_second_order(d):
    """q(d) with transition(s + d) = transition(s) + J(s) d + q(d), exactly."""
    q = np.zeros(7)
    q[X] = d[PHI] * (d[X] - d[X_PREVIOUS]) + d[DELTA1] * d[A] - d[DELTA2] * d[A_PREVIOUS]
    return q


def unscented_time_update(mean, P, alpha, beta, kappa):
    """Weighted moments of the sigma points mean, mean +- gamma S through the transition.

    The transition is quadratic, so the point at +-gamma s_i lands at
    f(mean) +- gamma J s_i + gamma^2 q(s_i). Put into the weighted sums of METHODS.md
    section 2 (W0m = lambda/gamma^2, W0c = W0m + 1 - alpha^2 + beta, Wi = 1/(2 gamma^2))
    the terms of order n/gamma^2 cancel and leave, with shift = sum q(s_i),
        mean = f(mean) + shift
        P = J S S' J' + gamma^2 sum q(s_i) q(s_i)' + (beta - alpha^2) shift shift',
    which is well conditioned for every alpha.
    """
    gamma_squared = alpha ** 2 * (len(mean) + kappa)
    S = lower_cholesky(P)
    JS = transition_jacobian(mean) @ S
    q = np.array([transition_second_order(column) for column in S.T]).T
    shift = q.sum(axis=1)
    covariance = (JS @ JS.T + gamma_squared * (q @ q.T)
                  + (beta - alpha ** 2) * np.outer(shift, shift))
    return transition(mean) + shift, symmetric(covariance)


def risk_update(P, mu):
    """P <- (P^-1 - 2 diag(mu))^-1, or None where that is not positive definite.

    States of zero variance stay as they are: the limit of the same formula.
    """
    if not np.any(mu):
        return P
    varies = np.flatnonzero(np.diag(P) > 0.0)
    block = np.ix_(varies, varies)
    # Congruence by the standard deviations, so that units do not spoil the inverse.
    std = np.sqrt(np.diag(P)[varies])
    information = symmetric(np.linalg.inv(P[block] / np.outer(std, std)))
    information -= np.diag(2.0 * mu[varies] * std ** 2)
    if np.linalg.eigvalsh(information)[0] <= 0.0:
        return None
    inflated = np.zeros_like(P)
    inflated[block] = symmetric(np.linalg.inv(information)) * np.outer(std, std)
    return inflated


def reset_noise(mean, P):
    """Noise states to zero mean and identity covariance, cross-covariances dropped."""
    mean, reset = mean.copy(), np.eye(7)
    mean[[A, A_PREVIOUS]] = 0.0
    reset[:A, :A] = P[:A, :A]
    return mean, reset


def run_unscented(data, p, mu, walk_std=(0.0, 0.0, 0.0)):
    r = p["measurement_noise_std_dps"] ** 2
    pair, pair_variance = initial_pair(p)
    parameter_std = [p["initial_phi_std"], p["initial_delta1_std_dps"], p["initial_delta2_std_dps"]]
    mean = np.array(pair + [p["phi"], p["delta1_dps"], p["delta2_dps"], 0.0, 0.0])
    P = np.diag(pair_variance + [s ** 2 for s in parameter_std] + [1.0, 1.0])
    walk = np.zeros((7, 7))
    walk[PHI:A, PHI:A] = np.diag(np.square(walk_std))
    rows = []
    for z in data["gyro_dps"]:
        P = P + walk
        mean, P = unscented_time_update(mean, P, p["alpha"], p["beta"], p["kappa"])
        inflated = risk_update(P, mu)
        broken = inflated is None
        if not broken:
            P = inflated
        innovation = variance = NAN
        status = NO_MEASUREMENT
        if not math.isnan(z):
            # z = x + v is linear: sigma points redrawn from (mean, P) give exactly
            # S_z = P_00 + R and P_xz = P's first column.
            innovation, variance, status = z - mean[X], P[X, X] + r, OK
            mean, P, _ = condition(mean, P, np.array([innovation]), np.eye(1, 7), np.array([[r]]))
        mean, P = reset_noise(mean, P)
        rows.append((mean[X], innovation, variance, RISK_BREAKDOWN if broken else status))
    return rows


def run_sr_ukf(data, p):
    return run_unscented(data, p, np.zeros(7))


def run_sr_rsukf(data, p):
    return run_unscented(data, p, np.array([p[name] for name in MU_NAMES]))


def run_sr_rsukf_scalar(data, p):
    return run_unscented(data, p, np.full(7, p["mu_scalar"]))


def run_sr_ukf_walk(data, p):
    return run_unscented(data, p, np.zeros(7), [p[name] for name in WALK_NAMES])


# Thermal-drift filters on X = [a, b, c] (METHODS.md section 3). Each keeps the
# coefficients X; update() gets the epochs so far as (M or None, h = [T, T', 1])
# and returns (innovation, variance), or None where no update took place.

class ThermalRegression:
    """thermal_mlr: coefficients constant."""

    def __init__(self, p):
        self.X = np.array([p["a_dps_per_C"], p["b_dps_s_per_C"], p["c_dps"]])
        self.P = np.diag([p["initial_a_std_dps_per_C"] ** 2, p["initial_b_std_dps_s_per_C"] ** 2,
                          p["initial_c_std_dps"] ** 2])
        self.r = p["bias_measurement_std_dps"] ** 2

    def newest(self, epochs):
        M, h = epochs[-1]
        return None if M is None else (M - h @ self.X, self.r + h @ self.P @ h)

    def update(self, epochs):
        return self.newest(epochs)


class ThermalLeastSquares(ThermalRegression):
    """thermal_lsm: regularised least squares refitted to the newest valid points.

    argmin sum (M_j - h_j X)^2 / r + (X - X0)' P0^-1 (X - X0), in its dual form
    X = X0 + P0 H' (H P0 H' + r I)^-1 (M - H X0).
    """

    def __init__(self, p):
        super().__init__(p)
        self.X0, self.P0 = self.X, self.P
        self.window_points = int(p["window_points"])

    def update(self, epochs):
        result = self.newest(epochs)
        if result is not None:
            points = [(M, h) for M, h in epochs if M is not None][-self.window_points:]
            M = np.array([point[0] for point in points])
            H = np.array([point[1] for point in points])
            self.X, self.P, _ = condition(self.X0, self.P0, M - H @ self.X0, H,
                                          self.r * np.eye(len(points)))
        return result


class ThermalKalman(ThermalRegression):
    """thermal_kf and thermal_stf: y = [M_k, M_{k-1}, M_{k-2}], X a random walk."""

    def __init__(self, p, fading=None):
        super().__init__(p)
        self.Q = np.diag([p["process_a_std_dps_per_C"] ** 2, p["process_b_std_dps_s_per_C"] ** 2,
                          p["process_c_std_dps"] ** 2])
        self.fading = fading

    def update(self, epochs):
        newest_three = epochs[:-4:-1]
        if len(newest_three) < 3 or any(M is None for M, _ in newest_three):
            self.P = self.P + self.Q
            return None
        H = np.array([h for _, h in newest_three])
        innovation = np.array([M for M, _ in newest_three]) - H @ self.X
        R = self.r * np.eye(3)
        factor = 1.0
        if self.fading is not None:
            factor = self.fading.at_measurement(innovation, H @ self.P @ H.T, H @ self.Q @ H.T, R)
        self.X, self.P, S = condition(self.X, factor * self.P + self.Q, innovation, H, R)
        return innovation[0], S[0, 0]


class ThermalSharedNoise(ThermalRegression):
    """thermal_stf_ma: M_k = h X - n_k + n_{k-1} + w_k, each M once, X a random walk.

    The state is [X, n_{k-1}]; the new n_k is noise of this measurement and state of the next, so
    its posterior comes from the correlation of process and measurement noise. Where the factor
    exceeds 1 the variance of h X alone is raised by it.
    """

    def __init__(self, p):
        super().__init__(p)
        self.Q = np.diag([p["process_a_std_dps_per_C"] ** 2, p["process_b_std_dps_s_per_C"] ** 2,
                          p["process_c_std_dps"] ** 2])
        self.q = (p["compass_noise_std_deg"] / p["update_interval_s"]) ** 2
        self.w = max(self.r - 2.0 * self.q, 0.01 * self.r)
        self.fading = FadingFactor(p)
        self.forget_noise()

    def forget_noise(self):
        """n of a compass reading that nothing was measured with."""
        self.n, self.Pn, self.Pxn = 0.0, self.q, np.zeros(3)

    def update(self, epochs):
        M, h = epochs[-1]
        if M is None:
            self.P = self.P + self.Q
            self.forget_noise()
            return None
        innovation = M - h @ self.X - self.n
        hPh = h @ self.P @ h
        process, noise = h @ self.Q @ h + 2.0 * h @ self.Pxn, self.Pn + self.q + self.w
        factor = self.fading.at_measurement(np.array([innovation]), np.array([[hPh]]),
                                            np.array([[process]]), np.array([[noise]]))
        Ph = self.P @ h
        P = self.P + self.Q + (factor - 1.0) * np.outer(Ph, Ph) / hPh
        S = factor * hPh + process + noise
        K = (P @ h + self.Pxn) / S
        self.X = self.X + K * innovation
        self.P = symmetric(P - S * np.outer(K, K))
        self.n, self.Pn = -self.q / S * innovation, self.q - self.q ** 2 / S
        self.Pxn = K * self.q
        return innovation, S


def run_thermal(data, p, estimator):
    """Epochs, the measurement M_k = B_{k-1} - wrap180(change of A_c - A_g) / Dt, held bias B."""
    t, gyro, temperature = data["t_s"], data["gyro_dps"], data["temperature_C"]
    heading = np.where(data["mag_valid"] == 1.0, data["heading_deg"], NAN)
    bias = np.array([temperature[0], 0.0, 1.0]) @ estimator.X
    rows = [(bias, NAN, NAN, NO_MEASUREMENT)]
    epochs, start, integrated = [], 0, 0.0
    for i in range(1, len(t)):
        integrated += (gyro[i] - bias) * (t[i] - t[i - 1])
        duration = t[i] - t[start]
        result = None
        if duration >= p["update_interval_s"] - 1e-6:
            slope = (temperature[i] - temperature[start]) / duration
            h = np.array([temperature[i], slope, 1.0])
            turned = heading[i] - heading[start] - integrated
            M = None if math.isnan(turned) else bias - wrap180(turned) / duration
            epochs.append((M, h))
            result = estimator.update(epochs)
            bias = h @ estimator.X
            start, integrated = i, 0.0
        rows.append((bias, NAN, NAN, NO_MEASUREMENT) if result is None else (bias, *result, OK))
    return rows


def run_none(data, p):
    return [(0.0, NAN, NAN, OK)] * len(data["t_s"])


FILTERS = {
    "kf": run_kf,
    "stf": run_stf,
    "kf_ma": run_kf_ma,
    "rskf": run_rskf,
    "sr_ukf": run_sr_ukf,
    "sr_rsukf": run_sr_rsukf,
    "sr_rsukf_scalar": run_sr_rsukf_scalar,
    "sr_ukf_walk": run_sr_ukf_walk,
    "thermal_mlr": lambda data, p: run_thermal(data, p, ThermalRegression(p)),
    "thermal_kf": lambda data, p: run_thermal(data, p, ThermalKalman(p)),
    "thermal_lsm": lambda data, p: run_thermal(data, p, ThermalLeastSquares(p)),
    "thermal_stf": lambda data, p: run_thermal(data, p, ThermalKalman(p, FadingFactor(p))),
    "thermal_stf_ma": lambda data, p: run_thermal(data, p, ThermalSharedNoise(p)),
    "none": run_none,
}


def read_input(path):
    """Columns as float arrays, a blank cell as NaN."""
    with open(path, newline="") as file:
        table = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) if row[name].strip() else NAN for row in table])
            for name in INPUT_COLUMNS}


def apply(data, config):
    """Runs every configured filter; returns [(id, rows)] in config order."""
    return [(entry.get("id", entry["filter"]),
             FILTERS[entry["filter"]](data, entry.get("parameters", {})))
            for entry in config["filters"]]


def cell(value):
    if isinstance(value, str):
        return value
    return "" if math.isnan(value) else "%.17g" % value


def main(input_path, config_path, output_path):
    data = read_input(input_path)
    with open(config_path) as file:
        results = apply(data, json.load(file))
    with open(output_path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t_s", "raw_dps"] + [f"{name}_{column}" for name, _ in results
                                              for column in RESULT_COLUMNS])
        for i, (t, raw) in enumerate(zip(data["t_s"], data["gyro_dps"])):
            values = [t, raw] + [value for _, rows in results for value in rows[i]]
            writer.writerow([cell(value) for value in values])


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
