"""How often a fleet's law holds the next unit: 90 % prediction intervals, mean + t sqrt(spread^2 + error of the mean^2).

    fleet_coverage.py

Units are normal with standard deviation `spread`, each known with an error that is uniform in a range; 4000 fleets of each
kind, standard error .005. Independent of the program: Paule and Mandel's spread by bisection, the mean's error after Hartung
and Knapp (decision D199).
"""
import numpy as np

STUDENT = {2: 6.313752, 3: 2.919986, 5: 2.131847, 10: 1.833113}  # t(n - 1) with .95 below
FLEETS = 4000


def law(values, errors):
    """Mean and scale of the next unit."""
    degrees = len(values) - 1

    def at(variance):
        weights = 1 / (errors**2 + variance)
        mean = (weights * values).sum() / weights.sum()
        return (weights * (values - mean) ** 2).sum(), mean, weights.sum()

    low, high = 0.0, 1e4
    if at(0.0)[0] <= degrees:
        high = 0.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if at(middle)[0] > degrees else (low, middle)
    q, mean, weight = at(high)
    return mean, np.sqrt(high + max(1.0, q / degrees) / weight)


random = np.random.default_rng(1)
print("units  spread  errors      held")
for units, t in STUDENT.items():
    for spread, least, most in [(1, 0.1, 0.3), (1, 0.5, 1.5), (0.3, 0.5, 1.5)]:
        held = 0
        for _ in range(FLEETS):
            errors = random.uniform(least, most, units)
            values = spread * random.standard_normal(units) + errors * random.standard_normal(units)
            mean, scale = law(values, errors)
            held += abs(spread * random.standard_normal() - mean) < t * scale
        print(f"{units:5}  {spread:6}  {least} to {most}  {held / FLEETS:.3f}")
