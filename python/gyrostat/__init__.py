"""Which filter should compensate my MEMS gyro, with which parameters, and how sure is that?

    import gyrostat

    recording = gyrostat.read("REC.csv", axis="z")
    gyrostat.allan(recording)          # N, B, K with intervals, and the curve
    gyrostat.fit(recording)            # phi, delta1, delta2, R and a, b, c with 95 % intervals
    gyrostat.apply(recording)          # every method, raw against compensated
    gyrostat.diagnose(recording)       # what the simulator lacks

    run = gyrostat.run(study)          # a study as a dict or a file; goes on where it ended
    gyrostat.rank(run)
    gyrostat.tune(study)               # the best parameters of each method

Rates are in dps, temperatures in degrees Celsius, angles in degrees, times in seconds. Numbers come back as NumPy
arrays; `.frame` of whatever has one is a pandas DataFrame, for which alone pandas is needed. What cannot be done raises
`gyrostat.Error`, one line as the program says it. Ctrl-C ends every call within moments.
"""
from ._library import Error, version as __version__
from ._plugins import Parameter, Sample, effect, filter
from ._recordings import Recording, read, recording, simulate
from ._results import Picture, Result, Table
from ._runs import Run, Tuning, rank, run, sensitivity, tune
from ._verbs import Application, Diagnosis, allan, apply, diagnose, fit

__all__ = ["Application", "Diagnosis", "Error", "Parameter", "Picture", "Recording", "Result", "Run", "Sample", "Table",
           "Tuning", "allan", "apply", "diagnose", "effect", "filter", "fit", "rank", "read", "recording", "run",
           "sensitivity", "simulate", "tune"]
