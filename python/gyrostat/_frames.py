"""pandas, where it is there: everything but `.frame` does without."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping

if TYPE_CHECKING:
    import pandas


def frame_of(columns: Mapping[str, Any]) -> "pandas.DataFrame":
    """Columns as a DataFrame that uses their memory."""
    try:
        import pandas
    except ImportError:
        raise ImportError("DataFrames need pandas (Debian: python3-pandas)") from None
    return pandas.DataFrame(dict(columns), copy=False)
