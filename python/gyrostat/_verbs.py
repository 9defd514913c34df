"""What is asked of a recording."""
from __future__ import annotations

import json
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from . import _library
from ._frames import frame_of
from ._progress import shown
from ._recordings import _plain, as_recording, study_json
from ._results import Picture, Result

if TYPE_CHECKING:
    import pandas


def allan(data: Any, *, rate_hz: float = 0.0, name: str = "the recording") -> Result:
    """Overlapping Allan deviation in dps over tau in seconds, with 95 % intervals; then Q, N, B, K and R (IEEE 952), with
    N in deg/sqrt(h), B in deg/h and K in deg/h/sqrt(h).

    data: a recording, its path, or rates in dps as an array, which is read where it lies, with `rate_hz`.
    """
    if isinstance(data, np.ndarray) and data.dtype.names is None:
        if not rate_hz > 0:
            raise _library.Error("rate_hz: samples a second are needed with an array")
        return Result(*_library.allan_of_array(data, rate_hz, name))
    return Result(*_library.allan(as_recording(data, rate_hz)._handle))


class Fit(Result):
    """Parameters with intervals, then coefficients. `converged`: whether one of the fits came to an end."""

    converged: bool = False

    @property
    def parameters(self) -> dict[str, float]:
        """phi, delta1_dps, delta2_dps, measurement_noise_std_dps by the first method, and a, b, c of the drift."""
        table = self.tables[0]
        first = table["fit"][0]
        rows = zip(table["fit"], table["parameter"], table["value"])
        return {name: value for fit, name, value in rows if fit in (first, "least squares")}


def fit(data: Any, methods: Sequence[str] = ("likelihood", "moments"), *, rate_hz: float = 0.0) -> Fit:
    """Fits the random error (phi, delta1, delta2, R in dps), and where there is temperature the thermal drift (a in
    dps/degC, b in dps s/degC, c in dps), with 95 % intervals.

    methods: "likelihood" (efficient), "moments" (robust), or both.
    """
    tables, converged = _library.fit(as_recording(data, rate_hz)._handle, list(methods))
    result = Fit(tables)
    result.converged = converged
    return result


class Application(Result):
    """Methods as they ran over one recording: their errors, then Allan deviations."""

    def __init__(self, applied: "_library.Applied") -> None:
        super().__init__(applied.tables, notes=applied.notes)
        self._applied = applied

    @property
    def judged_from_s(self) -> float:
        """Seconds from the first sample; what lies before was calibrated on."""
        return self._applied.judged_from_s

    @property
    def series(self) -> dict[str, Any]:
        """`t_s`, `raw_dps`, and per method `<id>_estimate_dps` (of the gyro's error), `<id>_innovation_dps`,
        `<id>_innovation_variance` (dps^2) and `<id>_status`; arrays over the result's own memory."""
        return self._applied.series()

    @property
    def series_frame(self) -> "pandas.DataFrame":
        return frame_of(self.series)


def apply(data: Any, filters: Sequence[Any] | None = None, *, calibration: float = 0.25, fit: str = "likelihood",
          rate_hz: float = 0.0) -> Application:
    """Runs filters over a recording: raw against compensated.

    filters: names or objects as in a study; None: all whose channels the recording has. calibration: the share of the
    recording, from its start, that they are fitted to; 0: none, their parameters are those given and defaults.
    """
    told = "" if filters is None else json.dumps({"filters": list(filters)}, default=_plain)
    return Application(_library.apply(as_recording(data, rate_hz)._handle, told, calibration, fit))


class Diagnosis(Result):
    """Where a recording leaves the simulator, which effects cause it, and how far the gap closes with them."""

    def __init__(self, diagnosed: "_library.Diagnosed") -> None:
        super().__init__(diagnosed.tables(), notes=diagnosed.notes)
        self._diagnosed = diagnosed

    @property
    def answer(self) -> str:
        """What came out, in one sentence."""
        return self._diagnosed.answer()

    @property
    def json(self) -> dict[str, Any]:
        """All of it, as `gyrostat diagnose --json` writes it."""
        return json.loads(self._diagnosed.json())

    @property
    def study(self) -> dict[str, Any]:
        """A study whose scenario has the effects that were found, ready for `run`."""
        return json.loads(self._diagnosed.scenario())

    @property
    def pictures(self) -> list[Picture]:
        return [Picture(*picture) for picture in self._diagnosed.pictures()]

    def write(self, path: str | PathLike[str]) -> None:
        """As one page of HTML."""
        Path(path).write_text(self._diagnosed.page(), encoding="utf-8")

    def _words(self) -> list[str]:
        return [*self.notes, *self._diagnosed.words().splitlines()]


def diagnose(data: Any, *, seed: int = 1, without: Sequence[str] = (), claim: Any = None, progress: Any = True,
             rate_hz: float = 0.0) -> Diagnosis:
    """Finds where a recording (at rest, or with `rate_ref_dps`) leaves the simulator, and which effects cause it.

    seed: of all simulated noise. without: effects that are left out of the catalogue. claim: a study (a dict or a file)
    whose effects are judged instead. progress: True, False, or a function of (what is being done, share).
    """
    handle = as_recording(data, rate_hz)._handle
    claimed = "" if claim is None else study_json(claim, "claim")[0]
    with shown(progress, "diagnose") as tell:
        return Diagnosis(_library.diagnose(handle, seed, list(without), claimed, tell))
