"""Filters and effects that are written in Python."""
from __future__ import annotations

import hashlib
import inspect
import math
from typing import Any, Callable, Iterator, NamedTuple, Sequence

import numpy as np

from . import _library


class Sample(NamedTuple):
    """What a filter is given at one sample; NaN where there is no value."""

    t_s: float
    gyro_dps: float
    temperature_C: float
    heading_deg: float  #: NaN too where the compass may not be used


class Parameter(NamedTuple):
    """The unit, range and meaning of a parameter, as its annotation: `gain: Parameter("1", 0, 1) = 0.01`."""

    unit: str = "1"
    least: float = -math.inf
    greatest: float = math.inf
    meaning: str = ""


def _parameters(function: Callable[..., Any]) -> list[tuple[str, float, str, float, float, str]]:
    """Those that are told by keyword alone; each has a default."""
    found = []
    for parameter in inspect.signature(function, eval_str=True).parameters.values():
        if parameter.kind is not inspect.Parameter.KEYWORD_ONLY:
            continue
        if not isinstance(parameter.default, (int, float)):
            raise _library.Error(f"{function.__name__}.{parameter.name}: a parameter has a number as its default")
        told = parameter.annotation if isinstance(parameter.annotation, Parameter) else Parameter()
        found.append((parameter.name, float(parameter.default), told.unit, float(told.least), float(told.greatest),
                      told.meaning))
    return found


def _code(function: Callable[..., Any]) -> str:
    """Tells this code from another under the same name: a store keeps outcomes of one code."""
    try:
        text = inspect.getsource(function)
    except (OSError, TypeError):
        text = repr((function.__code__.co_code, function.__code__.co_consts, function.__code__.co_names))
    return "python:" + hashlib.sha256(text.encode()).hexdigest()[:16]


def _title(function: Callable[..., Any], title: str) -> str:
    return title or (inspect.getdoc(function) or function.__name__).splitlines()[0]


_no_value = math.nan


def _step_by_step(function: Callable[..., Iterator[Any]]) -> Callable[..., tuple[np.ndarray, ...]]:
    """A generator's answers as columns. It is asked for an answer before it is given the next sample, so it cannot look
    ahead."""

    def columns(samples: int, channels: Sequence[Any], told: dict[str, float]) -> tuple[np.ndarray, ...]:
        given = 0

        def in_turn() -> Iterator[Sample]:
            nonlocal given
            blank = np.full(samples, _no_value)
            for sample in map(Sample._make, zip(*[(blank if c is None else c).tolist() for c in channels])):
                given += 1
                yield sample

        steps = np.full((4, samples), _no_value)
        answered = 0
        for answer in function(in_turn(), **told):
            if answered >= given:
                raise ValueError(f"answer {answered + 1} came before sample {answered + 1} was looked at")
            if given > answered + 1:
                raise ValueError(f"looks at sample {given} before it has answered sample {answered + 1}")
            if isinstance(answer, tuple):
                steps[:len(answer), answered] = answer
            else:
                steps[0, answered] = answer
            answered += 1
        if answered != samples:
            raise ValueError(f"{answered} answers came back for {samples} samples")
        return tuple(steps)

    return columns


def filter(function: Callable[..., Any] | None = None, *, name: str = "", title: str = "", needs: Sequence[str] = (),
           corrects: str = "random_error") -> Any:
    """Makes a filter of a function; it then stands in studies, `apply` and tables under the function's name.

        @gyrostat.filter
        def exponential(samples, *, gain: gyrostat.Parameter("1", 0, 1) = 0.01):
            "a running mean that forgets"
            estimate = 0.0
            for sample in samples:
                if sample.gyro_dps == sample.gyro_dps:  # not missing
                    estimate += gain * (sample.gyro_dps - estimate)
                yield estimate

    A generator is given one `Sample` after another and yields an answer to each: its estimate of the gyro's error in dps,
    or (estimate, its variance in dps^2, innovation in dps, its variance in dps^2), as far as it knows them. It cannot
    look ahead. A function that returns instead is called once, with arrays t_s, gyro_dps, temperature_C and heading_deg
    (None where there is no such channel), and returns an array of estimates or a tuple of such arrays; that it does not
    look ahead is its own affair. Either starts afresh in each trial.

    Parameters are keyword-only with a number as default; a study sets them, and calibration those that have the names
    of gyrostat's own (`gyrostat list filters`), as `measurement_noise_std_dps`. needs: channels that it cannot do
    without, of temperature_C and heading_deg. corrects: "random_error" or "thermal_drift".

    It must be a function of what it is given alone: then the results are the same bytes on repetition and for any
    number of threads. What it raises is its outcome in that trial, counted and kept in quarantine. A filter of the same
    name is replaced. Runs in one thread at a time, as Python does.
    """
    if function is None:
        return lambda late: filter(late, name=name, title=title, needs=needs, corrects=corrects)
    if corrects not in ("random_error", "thermal_drift"):
        raise _library.Error(f"corrects: '{corrects}'; allowed: random_error, thermal_drift")
    parameters = _parameters(function)
    names = [parameter[0] for parameter in parameters]
    by_steps = _step_by_step(function) if inspect.isgeneratorfunction(function) else None

    def called(t_s: Any, gyro_dps: Any, temperature_C: Any, heading_deg: Any, values: tuple[float, ...]) -> tuple:
        told = dict(zip(names, values))
        if by_steps:
            return by_steps(len(t_s), (t_s, gyro_dps, temperature_C, heading_deg), told)
        answer = function(t_s, gyro_dps, temperature_C, heading_deg, **told)
        return answer if isinstance(answer, tuple) else (answer,)

    _library.add_filter(name or function.__name__, _title(function, title), list(needs), corrects == "thermal_drift",
                        parameters, _code(function), called)
    return function


def effect(function: Callable[..., Any] | None = None, *, stage: str = "electronics", name: str = "", title: str = "",
           needs: Sequence[str] = ()) -> Any:
    """Makes a sensor effect of a function; it then stands in scenarios under the function's name.

        @gyrostat.effect(stage="electronics")
        def popcorn(signal, noise, *, amplitude_dps: gyrostat.Parameter("dps", 0, 10) = 0.02):
            "a level that jumps"
            return signal["gyro_dps"] + amplitude_dps * (np.cumsum(noise("jumps") > 2.5) % 2)

    signal: the channels so far, by name, as arrays (None: no such channel). noise: `noise(stream)` is a standard normal
    deviate a sample, addressed by seed, trial, effect and stream, so that it moves no other draw. It returns the channel
    of its stage: `thermal_bias_dps` of "sensing", `gyro_dps` of "noise", "electronics", "conversion" and "transport",
    `heading_deg` of "compass"; of "environment", before any gyro, a dict of what it changes of `temperature_C` and
    `rate_ref_dps`. needs: channels without which it changes nothing, beside that one. The rest is as for
    `filter`: parameters, repetition, exceptions, which are the outcome of all methods of the trial.
    """
    if function is None:
        return lambda late: effect(late, stage=stage, name=name, title=title, needs=needs)
    parameters = _parameters(function)
    names = [parameter[0] for parameter in parameters]

    def called(signal: dict[str, Any], noise: Any, values: tuple[float, ...]) -> Any:
        return function(signal, noise, **dict(zip(names, values)))

    _library.add_effect(name or function.__name__, _title(function, title), stage, list(needs), parameters,
                        _code(function), called)
    return function
