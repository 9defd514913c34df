"""What calls answer: tables and pictures."""
from __future__ import annotations

import base64
import html
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, NamedTuple, Sequence

import numpy as np

from ._frames import frame_of

if TYPE_CHECKING:
    import pandas

    from . import _library


class Table:
    """Columns with units, and notes to be read with them.

    `table["mean"]` is a column: floats (NaN where there is nothing to say), or text.
    """

    def __init__(self, table: "_library.Table") -> None:
        self._table = table

    @property
    def title(self) -> str:
        return self._table.title

    @property
    def notes(self) -> list[str]:
        return self._table.notes

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column; empty for text and plain counts."""
        return dict(self._table.columns)

    @property
    def rows(self) -> list[tuple[Any, ...]]:
        return self._table.rows

    def __len__(self) -> int:
        return len(self._table.rows)

    def __getitem__(self, column: str) -> np.ndarray:
        names = list(self.units)
        if column not in names:
            raise KeyError(f"{self.title} has no column '{column}'; it has {', '.join(names)}")
        values = [row[names.index(column)] for row in self.rows]
        if any(isinstance(value, str) for value in values):
            return np.array(values, dtype=object)
        if values and all(isinstance(value, int) for value in values):
            return np.array(values, dtype=np.int64)
        return np.array([np.nan if value is None else value for value in values], dtype=float)

    @property
    def frame(self) -> "pandas.DataFrame":
        """The table as a DataFrame; its `attrs` have title, units and notes."""
        frame = frame_of({name: self[name] for name in self.units})
        frame.attrs.update(title=self.title, units=self.units, notes=self.notes)
        return frame

    def __repr__(self) -> str:
        return self._table.text()

    def _repr_html_(self) -> str:
        return self._table.html()


class Picture(NamedTuple):
    """A picture as SVG that stands alone."""

    id: str
    title: str
    svg: str

    def write(self, path: str | Path) -> None:
        """As a file, for a paper or a page."""
        Path(path).write_text(self.svg, encoding="utf-8")

    def _repr_html_(self) -> str:
        # As an image, so that its style reaches nothing else on the page.
        data = base64.b64encode(self.svg.encode()).decode()
        return f'<img alt="{html.escape(self.title)}" src="data:image/svg+xml;base64,{data}">'


class Result:
    """Tables, pictures where there are any, and notes on how they came about.

    A notebook shows them; `result[0]`, or `for table in result`, is a `Table`.
    """

    def __init__(self, tables: Sequence[Any], pictures: Sequence[tuple[str, str, str]] = (),
                 notes: Sequence[str] = ()) -> None:
        self.tables = [Table(table) for table in tables]
        self.notes = list(notes)
        self._pictures = [Picture(*picture) for picture in pictures]

    @property
    def pictures(self) -> list[Picture]:
        return self._pictures

    def __len__(self) -> int:
        return len(self.tables)

    def __iter__(self) -> Iterator[Table]:
        return iter(self.tables)

    def __getitem__(self, place: int) -> Table:
        return self.tables[place]

    @property
    def frame(self) -> "pandas.DataFrame":
        """The first table as a DataFrame."""
        return self.tables[0].frame

    def _words(self) -> list[str]:
        return self.notes

    def __repr__(self) -> str:
        return "\n".join([*self._words(), *map(repr, self.tables)])

    def _repr_html_(self) -> str:
        words = "".join(f"<p>{html.escape(line)}</p>\n" for line in self._words())
        shown = [*self.pictures, *self.tables]
        return words + "\n".join(one._repr_html_() for one in shown)
