"""Studies: run, or opened where one was run."""
from __future__ import annotations

import json
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Sequence

import numpy as np

from . import _library
from ._frames import frame_of
from ._progress import shown
from ._recordings import study_json
from ._results import Picture, Result

if TYPE_CHECKING:
    import pandas


class Run(Result):
    """A study in its folder. `run` gives one; `Run(folder)` opens one that is there, whoever made it.

    What a Run says is read from the folder's store when it is asked for, also while another process still writes.
    `stopped` says why it ended before all trials were run (nothing where they were), `failed` in how many trials a
    method threw or broke down, `over_budget` whether these were more than the study allows.
    """

    stopped: str = ""
    failed: int = 0
    over_budget: bool = False

    def __init__(self, folder: str | PathLike[str], tables: Sequence[Any] = (), notes: Sequence[str] = ()) -> None:
        self.folder = Path(folder)
        super().__init__(tables or _library.rank(fspath(folder), "", "")[0], notes=notes)

    @property
    def study(self) -> dict[str, Any]:
        return json.loads(_library.source(fspath(self.folder)))

    def outcomes(self) -> dict[str, np.ndarray]:
        """Every finished trial: a row a trial and method, with `cell`, `trial`, `method`, every metric in the unit that
        `gyrostat list metrics` says, the steps of each status, and `diverged`."""
        stored = _library.outcomes(fspath(self.folder))
        cells = np.array([name for name, _ in stored["cells"]], dtype=object)
        most = max((len(methods) for _, methods in stored["cells"]), default=0)
        ids = np.array([[*methods, *[""] * (most - len(methods))] for _, methods in stored["cells"]], dtype=object)
        cell, method = stored["cell"], stored["method"]
        columns = {"cell": cells[cell], "trial": stored["trial"], "method": ids[cell, method]}
        return columns | {name: stored["numbers"][:, i] for i, name in enumerate(stored["columns"])}

    @property
    def frame(self) -> "pandas.DataFrame":
        """`outcomes` as a DataFrame."""
        return frame_of(self.outcomes())

    @property
    def failures(self) -> list[tuple[str, int, str, str]]:
        """(cell, trial, method, why) of what threw or broke down."""
        return _library.failures(fspath(self.folder))

    @property
    def pictures(self) -> list[Picture]:
        """The report's, of the cells that it shows in full, without those over time: see `pictures_of`."""
        return self.pictures_of(replay=0)

    def pictures_of(self, *cells: str, replay: int | None = None) -> list[Picture]:
        """The report's pictures of these cells; none named: of those that it shows in full. replay: trials that are
        simulated again for pictures over time; None: 2 to 64, by their length."""
        found = _library.pictures(fspath(self.folder), list(cells), replay)
        many = len(found) > 1
        return [Picture(id_, f"{cell}: {title}" if many else title, svg) for cell, drawn in found
                for id_, title, svg in drawn]

    def report(self, path: str | PathLike[str] | None = None, *cells: str, replay: int | None = None) -> Path:
        """Writes the report, a page to open in a browser, by default as report.html in the folder; its path."""
        path = self.folder / "report.html" if path is None else Path(path)
        _library.report(fspath(self.folder), fspath(path), list(cells), replay)
        return path


def run(study: Any, folder: str | PathLike[str] | None = None, *, name: str = "study", trials: int = 0, threads: int = 0,
        stop: Any = None, until: str = "", failure_budget: float | None = None, mismatch: str = "refuse",
        progress: Any = True) -> Run:
    """Runs a study, or goes on with it where it ended: every finished trial is in the folder within a moment, whatever
    ends the run, Ctrl-C included.

    study: a dict, or a file. folder: where it is kept; runs/<name> where there is none. name: what a dict is called.
    trials: of every cell, instead of the study's. threads: 0 for all; the results are the same bytes. stop: a rule, as
    {"half_width_below": 0.001}, or "none". until: an hour of the day, "07:00". failure_budget: share of the trials that
    may fail. mismatch: what to do with a folder of a changed study or another build: "refuse", "mix" or "set_aside".
    progress: True, False, or a function of (what is being done, share).
    """
    text, path = study_json(study, name)
    folder = Path("runs") / Path(path).stem if folder is None else Path(folder)
    rule = "" if stop is None else stop if isinstance(stop, str) else json.dumps(stop)
    with shown(progress, Path(path).stem) as tell:
        ended = _library.run(text, path, fspath(folder), rule, until, trials, threads,
                             -1.0 if failure_budget is None else failure_budget, mismatch, tell)
    notes = [ended.stopped + ": the tables are of the trials that were done"] if ended.stopped else []
    if ended.failed:
        notes.append(f"{ended.failed} trials failed; .failures says why")
    result = Run(folder, ended.tables, notes)
    result.stopped, result.failed, result.over_budget = ended.stopped, ended.failed, ended.over_budget
    return result


def _folder(of: Run | str | PathLike[str]) -> str:
    return fspath(of.folder if isinstance(of, Run) else of)


def rank(of: Run | str | PathLike[str], *, metric: str = "", cell: str = "") -> Result:
    """Which filter wins each cell of a run (or of its folder), and how sure that is: a table a cell, best first, in the
    metric's unit; the notes of each say it in words. metric: by default the one that methods are judged by."""
    return Result(*_library.rank(_folder(of), metric, cell))


def sensitivity(of: Run | str | PathLike[str], *, metric: str = "", method: str = "", points: bool = False) -> Result:
    """Which parameter of a study's design matters: elasticities, Morris' mu* and sigma, or Sobol' indices, with 95 %
    intervals. points: the mean at every point of the design instead."""
    return Result(_library.sensitivity(_folder(of), metric, method, points))


class Tuning(Result):
    """The best parameters of methods, judged on trials that no search has seen: a table a cell of what each method
    gains in the metric's unit, then for each method its parameters with 95 % intervals in their own units."""

    def __init__(self, tuned: "_library.Tuned") -> None:
        super().__init__(tuned.tables())
        self._tuned = tuned

    @property
    def answer(self) -> str:
        """What tuning gains, and which method is then best."""
        return self._tuned.words()

    @property
    def json(self) -> dict[str, Any]:
        """All of it, as `gyrostat tune --json` writes it."""
        return json.loads(self._tuned.json())

    @property
    def study(self) -> dict[str, Any]:
        """The study with the values that fresh trials tell are better, as `gyrostat tune --out` writes it; ready for
        `run`. Files that it names are relative to where the study was."""
        return json.loads(self._tuned.study())

    def _words(self) -> list[str]:
        return [*self.notes, *self.answer.splitlines()]


def tune(study: Any, *, metric: str = "bias_rmse", by: str = "mean", above: float | None = None,
         methods: Sequence[str] = (), cell: str = "", ranges: Mapping[str, tuple[float, float]] | None = None,
         budget: int = 8000, fresh: int = 400, threads: int = 0, name: str = "study", progress: Any = True) -> Tuning:
    """Searches the best parameters of each method of a study, and judges them on fresh trials: `gyrostat tune`.

    study: a dict or a file, without a design. metric: the error that is to be small, in its own unit. by: its "mean" over
    trials, or "cvar95", that of the worst 5 %. above: instead, the probability of an error above this, in the metric's
    unit. methods: ids of those that are tuned; none: those with a "tune", or every filter. cell: this one alone; empty:
    all. ranges: (low, high) of parameters by name, in their units, instead of the study's or the default ones. budget:
    runs of a method over one trial for its search, 400 or more. fresh: trials that judge, 50 or more. threads: 0 for all;
    the results are the same bytes. name: what a dict is called. progress: True, False, or a function of (what is being
    done, share). Ctrl-C ends it with nothing found.
    """
    text, path = study_json(study, name)
    written = [f"{parameter}={float(low)!r}:{float(high)!r}" for parameter, (low, high) in (ranges or {}).items()]
    with shown(progress, "tune") as tell:
        return Tuning(_library.tune(text, path, metric, by, above, cell, list(methods), written, budget, fresh, threads,
                                    tell))
