"""How far long work is: a line on a terminal, a bar in a notebook."""
from __future__ import annotations

import contextlib
import html
import sys
from typing import Any, Callable, Iterator

Tell = Callable[[str, float], None]


def _in_notebook() -> bool:
    try:
        from IPython import get_ipython
    except ImportError:
        return False
    return getattr(get_ipython(), "kernel", None) is not None


@contextlib.contextmanager
def shown(progress: Any, name: str) -> Iterator[Tell | None]:
    """What the work may tell itself to: `progress` itself where it can be called, else what suits the place. Nothing is
    left of a bar once the work has ended."""
    if callable(progress):
        yield progress
    elif progress and _in_notebook():
        from IPython.display import HTML, display

        bar = display(HTML(""), display_id=True)
        try:
            yield lambda what, share: bar.update(
                HTML(f"<progress value='{share:.4f}'></progress> {html.escape(what)}"))
        finally:
            bar.update(HTML(""))
    elif progress and sys.stderr is not None and sys.stderr.isatty():
        try:
            yield lambda what, share: print(f"\r{name} {100 * share:3.0f} % {what[:60]:60}", end="", file=sys.stderr,
                                            flush=True)
        finally:
            print("\r" + " " * 80 + "\r", end="", file=sys.stderr, flush=True)
    else:
        yield None
