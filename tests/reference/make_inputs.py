#!/usr/bin/env python3
"""Writes the input and the configurations of the reference comparison.

Usage: make_inputs.py DIR

input.csv: 600 s at 5 Hz of a slowly turning gyro with the signal of METHODS.md
section 1 (ARIMA(1,1,1) error, white noise, a bias not linear in temperature), a
compass that crosses the +-180 degree wrap, a magnetic disturbance and missing cells.
"""
import csv
import json
import os
import sys

import numpy as np

ROWS, RATE_HZ = 3001, 5
DISTURBED_S = (250.0, 310.0)
# Row 500 ends a 10 s interval (and starts the next one); the others fall inside one.
MISSING_GYRO = (0, 123, 500, 501, 502, 1733, 2204)
# Rows that are epochs of the 10 s filters, of the others, and of none.
MISSING_HEADING = (850, 851, 1750, 2340, 2640, 2705)


def arima(rng, count, phi, delta1, delta2):
    """x_k = (1+phi) x_{k-1} - phi x_{k-2} + delta1 a_k - delta2 a_{k-1}."""
    a = rng.standard_normal(count)
    x = np.zeros(count)
    for k in range(2, count):
        x[k] = (1 + phi) * x[k - 1] - phi * x[k - 2] + delta1 * a[k] - delta2 * a[k - 1]
    return x


def make_table():
    rng = np.random.default_rng(20)
    t = np.array([i / RATE_HZ for i in range(ROWS)])
    temperature = np.interp(t, [0, 30, 240, 300, 560, 600], [23, 23, 57, 57, 25, 25])
    temperature = temperature + 0.02 * rng.standard_normal(ROWS)
    smooth = np.interp(t, [0, 30, 240, 300, 560, 600], [23, 23, 57, 57, 25, 25])
    bias = 0.01 + 0.0012 * (smooth - 23) - 4e-5 * (smooth - 40) ** 2 \
        + 0.08 * np.gradient(smooth, t)
    true_heading = 175 + 12 * np.sin(2 * np.pi * t / 150)
    true_rate = np.diff(true_heading, prepend=true_heading[0]) * RATE_HZ
    gyro = true_rate + bias + arima(rng, ROWS, 0.3, 0.0006, 0.0003) \
        + 0.02 * rng.standard_normal(ROWS)
    heading = true_heading + 0.1 * rng.standard_normal(ROWS)
    disturbed = (t >= DISTURBED_S[0]) & (t < DISTURBED_S[1])
    heading[disturbed] += rng.uniform(-180, 180, disturbed.sum())
    heading = (heading + 180) % 360 - 180
    rows = []
    for i in range(ROWS):
        rows.append([repr(i / RATE_HZ),
                     "" if i in MISSING_GYRO else repr(float(gyro[i])),
                     repr(float(temperature[i])),
                     "" if i in MISSING_HEADING else repr(float(heading[i])),
                     "0" if disturbed[i] else "1"])
    return rows


LINEAR = dict(phi=0.3, delta1_dps=0.01, delta2_dps=0.004, measurement_noise_std_dps=0.02,
              initial_x_dps=0.5, initial_x_previous_dps=0.45,
              initial_x_std_dps=0.03, initial_x_previous_std_dps=0.02)
FADING = dict(adaptive=1, fading_factor=1.0, forgetting=0.95, softening=1.0)
UNSCENTED = dict(LINEAR, initial_phi_std=0.2, initial_delta1_std_dps=0.002,
                 initial_delta2_std_dps=0.001, alpha=1.0, beta=2.0, kappa=0.0)
RISK = dict(mu_x=50.0, mu_x_previous=20.0, mu_phi=0.03, mu_delta1=5.0, mu_delta2=4.0,
            mu_a=0.05, mu_a_previous=0.04)
THERMAL = dict(update_interval_s=10.0, a_dps_per_C=0.001, b_dps_s_per_C=0.05, c_dps=-0.02,
               initial_a_std_dps_per_C=0.002, initial_b_std_dps_s_per_C=0.1,
               initial_c_std_dps=0.05, bias_measurement_std_dps=0.015)
WALK = dict(process_a_std_dps_per_C=1e-4, process_b_std_dps_s_per_C=5e-3, process_c_std_dps=2e-3)

# A second set, different in every value.
LINEAR_2 = dict(phi=-0.2, delta1_dps=0.015, delta2_dps=-0.003, measurement_noise_std_dps=0.03,
                initial_x_dps=0.4, initial_x_previous_dps=0.3,
                initial_x_std_dps=0.02, initial_x_previous_std_dps=0.03)
FIXED_2 = dict(adaptive=0, fading_factor=1.05, forgetting=0.9, softening=2.0)
ADAPTIVE_2 = dict(adaptive=1, fading_factor=1.02, forgetting=0.8, softening=2.0)
UNSCENTED_2 = dict(LINEAR_2, initial_phi_std=0.4, initial_delta1_std_dps=0.003,
                   initial_delta2_std_dps=0.002, alpha=0.5, beta=1.5, kappa=-1.0)
RISK_2 = dict(mu_x=10.0, mu_x_previous=0.0, mu_phi=0.01, mu_delta1=0.0, mu_delta2=3.0,
              mu_a=0.1, mu_a_previous=0.0)
THERMAL_2 = dict(update_interval_s=7.1, a_dps_per_C=-0.0005, b_dps_s_per_C=0.0, c_dps=0.03,
                 initial_a_std_dps_per_C=0.001, initial_b_std_dps_s_per_C=0.2,
                 initial_c_std_dps=0.02, bias_measurement_std_dps=0.03)
WALK_2 = dict(process_a_std_dps_per_C=2e-4, process_b_std_dps_s_per_C=1e-2, process_c_std_dps=1e-3)

PARAMETER_WALK = dict(walk_phi_std=0.005, walk_delta1_std_dps=1e-4, walk_delta2_std_dps=5e-5)
PARAMETER_WALK_2 = dict(walk_phi_std=0.01, walk_delta1_std_dps=5e-5, walk_delta2_std_dps=2e-4)
COMPASS = dict(compass_noise_std_deg=0.1)

SMALL_ALPHA = dict(alpha=0.01)
KNOWN_PARAMETERS = dict(initial_phi_std=0.0, initial_delta1_std_dps=0.0, initial_delta2_std_dps=0.0)
NO_RISK = {name: 0.0 for name in RISK}


def entry(kind, *parameter_sets, name=None):
    """One filter of a configuration; without a name its id is left to the default."""
    filter_entry = {} if name is None else {"id": name}
    filter_entry["filter"] = kind
    filter_entry["parameters"] = {key: value for part in parameter_sets
                                  for key, value in part.items()}
    return filter_entry


def make_configs():
    plausible = [
        entry("none"),
        entry("kf", LINEAR),
        entry("stf", LINEAR, FADING),
        entry("kf_ma", LINEAR),
        entry("sr_ukf", UNSCENTED),
        entry("sr_rsukf", UNSCENTED, RISK),
        entry("thermal_mlr", THERMAL),
        entry("thermal_kf", THERMAL, WALK),
        entry("thermal_lsm", THERMAL, dict(window_points=20)),
        entry("thermal_stf", THERMAL, WALK, FADING, dict(softening=2.0)),
    ]
    varied = [
        entry("thermal_lsm", THERMAL_2, dict(window_points=3), name="lsm_short"),
        entry("thermal_lsm", THERMAL_2, dict(window_points=1000), name="lsm_long"),
        entry("thermal_stf", THERMAL_2, WALK_2, FIXED_2, name="thermal_stf_fixed"),
        entry("thermal_stf", THERMAL_2, WALK_2, ADAPTIVE_2, dict(bias_measurement_std_dps=0.015),
              name="thermal_stf_soft"),
        entry("thermal_kf", THERMAL_2, WALK_2, name="thermal_kf_a"),
        entry("thermal_mlr", THERMAL_2, name="thermal_mlr_a"),
        entry("kf", LINEAR_2, name="kf_a"),
        entry("kf", LINEAR, dict(phi=0.0, delta2_dps=0.0), name="kf_b"),
        entry("stf", LINEAR_2, FIXED_2, name="stf_fixed"),
        entry("stf", LINEAR_2, ADAPTIVE_2, name="stf_soft"),
        entry("kf_ma", LINEAR_2, name="kf_ma_a"),
        entry("sr_ukf", UNSCENTED_2, name="ukf_a"),
        entry("sr_rsukf", UNSCENTED_2, RISK_2, name="rsukf_a"),
        entry("none", name="raw"),
    ]
    small_alpha = [
        entry("sr_ukf", UNSCENTED, SMALL_ALPHA, name="ukf_small_alpha"),
        entry("sr_ukf", UNSCENTED_2, SMALL_ALPHA, KNOWN_PARAMETERS, name="ukf_known_parameters"),
        entry("sr_rsukf", UNSCENTED, SMALL_ALPHA, RISK, name="rsukf_small_alpha"),
        entry("sr_rsukf", UNSCENTED, SMALL_ALPHA, NO_RISK, name="rsukf_no_risk"),
        entry("sr_rsukf", UNSCENTED_2, SMALL_ALPHA, RISK_2, KNOWN_PARAMETERS,
              name="rsukf_known_parameters"),
        # Breaks down at rows 756 and 757, when phi has been little observed for a while.
        entry("sr_rsukf", UNSCENTED, SMALL_ALPHA, NO_RISK, dict(mu_phi=0.055),
              name="rsukf_breakdown_phi"),
        # Breaks down at the start and when consecutive measurements are missing.
        entry("sr_rsukf", UNSCENTED, SMALL_ALPHA, NO_RISK, dict(mu_x=600.0),
              name="rsukf_breakdown_gap"),
        # delta1 is never observed: 1/0.002^2 - 2 * 497 k turns negative at row 251, for good.
        entry("sr_rsukf", UNSCENTED, SMALL_ALPHA, NO_RISK, dict(mu_delta1=497.0),
              name="rsukf_breakdown_delta1"),
        entry("thermal_kf", THERMAL, WALK, dict(update_interval_s=4.3), name="thermal_kf_often"),
    ]
    beyond = [
        entry("rskf", LINEAR, dict(mu_x=60.0, mu_x_previous=20.0)),
        # Breaks down when consecutive measurements are missing.
        entry("rskf", LINEAR_2, dict(mu_x=300.0, mu_x_previous=0.0), name="rskf_breakdown"),
        entry("sr_rsukf_scalar", UNSCENTED, dict(mu_scalar=0.03)),
        # Breaks down at every step: the noise states have variance 1.
        entry("sr_rsukf_scalar", UNSCENTED_2, dict(mu_scalar=0.5), name="scalar_breakdown"),
        entry("sr_ukf_walk", UNSCENTED, PARAMETER_WALK),
        entry("sr_ukf_walk", UNSCENTED_2, SMALL_ALPHA, KNOWN_PARAMETERS, PARAMETER_WALK_2,
              name="walk_from_known"),
        entry("thermal_stf_ma", THERMAL, WALK, FADING, COMPASS),
        entry("thermal_stf_ma", THERMAL_2, WALK_2, FIXED_2, COMPASS, name="stf_ma_fixed"),
        # The compass claims more noise than M has.
        entry("thermal_stf_ma", THERMAL_2, WALK_2, ADAPTIVE_2, dict(compass_noise_std_deg=0.3),
              name="stf_ma_loud"),
        entry("thermal_stf_ma", THERMAL, WALK, FADING, dict(compass_noise_std_deg=0.0),
              name="stf_ma_quiet"),
    ]
    return {"plausible": plausible, "varied": varied, "small_alpha": small_alpha, "beyond": beyond}


def main(directory):
    os.makedirs(directory, exist_ok=True)
    with open(os.path.join(directory, "input.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t_s", "gyro_dps", "temperature_C", "heading_deg", "mag_valid"])
        writer.writerows(make_table())
    for name, filters in make_configs().items():
        with open(os.path.join(directory, f"config_{name}.json"), "w") as file:
            json.dump({"filters": filters}, file, indent=2)
            file.write("\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
