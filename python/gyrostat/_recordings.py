"""Recordings: from files, from arrays and DataFrames, from the simulator."""
from __future__ import annotations

import json
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from . import _library
from ._frames import frame_of

if TYPE_CHECKING:
    import pandas


class Recording:
    """A sampled gyro signal on an even clock, and what was recorded beside it.

    Its channels are NumPy arrays that look at the recording's own memory and cannot be written to, by name
    (`recording["gyro_dps"]`): `t_s`, `gyro_dps`, and where they are there `temperature_C`, `heading_deg` (within 180),
    `mag_valid` (1 where the compass may be used), `rate_ref_dps` (true rate), `acc_x_mps2`, `acc_y_mps2`, `acc_z_mps2`,
    `cross_rate_1_dps`, `cross_rate_2_dps`, and of simulated ones the truth: `thermal_bias_dps`, `random_error_dps`. A
    missing sample is NaN.
    """

    def __init__(self, handle: "_library.Recording") -> None:
        self._handle = handle

    @property
    def name(self) -> str:
        return self._handle.name

    @property
    def notes(self) -> list[str]:
        """As what it was read, and what was chosen, repaired or left out."""
        return self._handle.notes

    @property
    def rate_hz(self) -> float:
        """Mean sampling rate."""
        return self._handle.rate_hz

    @property
    def duration_s(self) -> float:
        return self._handle.duration_s

    @property
    def channels(self) -> dict[str, np.ndarray]:
        return self._handle.channels()

    def __len__(self) -> int:
        return len(self._handle)

    def __getitem__(self, channel: str) -> np.ndarray:
        channels = self.channels
        if channel not in channels:
            raise KeyError(f"{self.name} has no channel '{channel}'; it has {', '.join(channels)}")
        return channels[channel]

    @property
    def frame(self) -> "pandas.DataFrame":
        """The channels as a DataFrame over the same memory."""
        return frame_of(self.channels)

    def between(self, from_s: float = 0.0, to_s: float = 1e12) -> "Recording":
        """The samples from `from_s` until before `to_s`, both in seconds from the first one."""
        return Recording(self._handle.between(from_s, to_s))

    def write(self, path: str | PathLike[str]) -> None:
        """As CSV, CSV.gz or MATLAB file, by the name's end; `read` gives back the same bits."""
        self._handle.write(fspath(path))

    def __repr__(self) -> str:
        return (f"<Recording {self.name}: {len(self)} samples, {self.duration_s:.6g} s at {self.rate_hz:.6g} Hz; "
                f"{', '.join(self.channels)}>")


def read(file: str | PathLike[str], axis: str = "", *, columns: Mapping[str, str] = {}, units: Mapping[str, str] = {},
         preset: str = "", topic: str = "", rate_hz: float = 0.0, resample_hz: float = 0.0) -> Recording:
    """A recording from a file in any format of `gyrostat list formats`, known by its content.

    axis: "x", "y" or "z" where there are several. columns: channel to column, {"t": "Time[ms]", "gyro": "GyrZ"}.
    units: channel to unit, {"gyro": "rad/s"}. rate_hz: samples a second of a file without times. resample_hz: puts
    samples whose rate changes on an even clock.
    """
    return Recording(_library.read(fspath(file), axis, dict(columns), dict(units), preset, topic, rate_hz, resample_hz))


def _numbers(values: Any) -> np.ndarray | None:
    """A column as numbers; times of the calendar as seconds. None for text and the like."""
    values = np.asarray(values)
    if np.issubdtype(values.dtype, np.datetime64):
        return values.astype("datetime64[ns]").astype(np.int64) / 1e9
    return values if np.issubdtype(values.dtype, np.number) or values.dtype == bool else None


def recording(data: Any, axis: str = "", *, columns: Mapping[str, str] = {}, units: Mapping[str, str] = {},
              rate_hz: float = 0.0, resample_hz: float = 0.0, name: str = "the recording") -> Recording:
    """A recording from what is in memory: a DataFrame, a mapping of arrays, a structured array, or the gyro alone as an
    array (dps) with `rate_hz`.

    Columns have the names and units of the CSV files (`t_s`, `gyro_dps`, ...), or others that `columns` and `units` say
    as for `read`. Each is copied once; `allan` takes an array where it lies.
    """
    if isinstance(data, Recording):
        return data
    if isinstance(data, np.ndarray) and data.dtype.names is None:
        data = {"gyro_dps": data}
    elif isinstance(data, np.ndarray):
        data = {column: data[column] for column in data.dtype.names}
    elif not hasattr(data, "items"):
        raise TypeError(f"a {type(data).__name__} is no recording; a DataFrame, a mapping of arrays, or an array")
    numbers = [(str(column), _numbers(values)) for column, values in data.items()]
    return Recording(_library.of_columns([(column, values) for column, values in numbers if values is not None], name,
                                         axis, dict(columns), dict(units), rate_hz, resample_hz))


def as_recording(data: Any, rate_hz: float = 0.0) -> Recording:
    """What calls take for a recording: one, the path of one, or what `recording` takes."""
    if isinstance(data, (str, PathLike)):
        return read(data, rate_hz=rate_hz)
    return recording(data, rate_hz=rate_hz)


def _plain(value: Any) -> Any:
    """NumPy's numbers and arrays as JSON has them."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} cannot stand in a study")


def study_json(study: Any, name: str) -> tuple[str, str]:
    """(JSON, path) of a study: a dict, or a file whose name is then the study's own."""
    if isinstance(study, (str, PathLike)):
        path = fspath(study)
        try:
            with open(path, encoding="utf-8") as file:
                return json.dumps(json.load(file)), path
        except (OSError, ValueError) as mistake:
            raise _library.Error(f"{path}: {mistake}") from None
    return json.dumps(study, default=_plain), f"{name}.json"


def simulate(study: Any, trial: int = 0, *, cell: str = "", name: str = "study") -> Recording:
    """The signal of one trial of a study (a dict or a file) with its truth, as every filter of it sees it.

    cell: its name; the first where it is empty.
    """
    text, path = study_json(study, name)
    return Recording(_library.simulate(text, path, cell, trial))
