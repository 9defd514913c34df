"""Studies: run, or opened where one was run."""
from __future__ import annotations

import json
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Sequence

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
