"""Sheets to print at their true size: the calibration board, and the tags of a task or for what never moves."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path as Outline
from numpy.typing import NDArray

from robot_adapters.base import AdapterError
from robot_adapters.franka.perception import board, tags
from robot_adapters.franka.perception.tagging import Tagging, TagOn

A4 = (210.0, 297.0)
"""mm."""
MARGIN = 14.0
INCH = 25.4
ENDINGS = (".pdf", ".svg", ".png")
RULER = 100.0
"""mm of the line that a reader measures to see whether the printer kept the scale."""
TAG_GAP, LABEL = 4.0, 9.0
"""mm between tags, and for the words under each."""


class BadSheet(AdapterError):
    """A sheet that can't be drawn or written."""


@dataclass(frozen=True)
class _Cut:
    """A tag to cut out: what is written under it, and whether an arrow says where the object's x points."""

    number: int
    size: float
    words: str
    arrow: bool


def board_sheet(path: Path) -> list[Path]:
    """Write the calibration board; the files.

    Raises:
        BadSheet: the ending of `path` is unknown, or it can't be written.
    """
    figure, axes = _page(A4[1], A4[0])
    grid = board.modules()
    module = board.MODULE * 1000
    left, bottom = (A4[1] - grid.shape[1] * module) / 2, (A4[0] - grid.shape[0] * module) / 2 + 3
    _draw(axes, grid, left, bottom, module)
    _ruler(axes, left, 9.0, "Glue it flat on something stiff. A chess square must measure 36.0 mm.")
    return _write(path, [figure])


def tag_sheet(path: Path, tagging: Tagging) -> list[Path]:
    """Write every tag of a task, with where each goes; the files.

    Raises:
        BadSheet: as `board_sheet`.
    """
    if not tagging.objects:
        raise BadSheet("this task has nothing to tag", remedy="print the tags of another, or --fixed 4")
    cuts = [
        _Cut(on.number, on.size * 1000, _place(name, on), on.faces == "up")
        for name, what in tagging.objects.items()
        for on in what.tags
    ]
    return _write(path, list(_tag_pages(cuts)))


def fixed_sheet(path: Path, numbers: Iterable[int], size: float) -> list[Path]:
    """Write tags for what never moves, `size` m wide; the files.

    Raises:
        BadSheet: as `board_sheet`.
    """
    return _write(path, list(_tag_pages([_Cut(n, size * 1000, f"{n}: never moves", False) for n in numbers])))


def _place(name: str, on: TagOn) -> str:
    where = "top" if on.faces == "up" else f"side {on.faces}"
    x, y, z = (round(v * 1000, 1) for v in on.at)
    return f"{on.number}: {name}, {where}\nmiddle at {x:g}, {y:g}, {z:g} mm"


def _tag_pages(cuts: Sequence[_Cut]) -> Iterator[Figure]:
    """The tags in rows, as many pages as that takes."""
    figure, axes = _page(*A4)
    x, top, row = MARGIN, A4[1] - MARGIN, 0.0
    for cut in cuts:
        side = cut.size * 10 / 8  # with the white rim
        width, height = max(side, 34.0) + TAG_GAP, side + LABEL + TAG_GAP
        if side > A4[0] - 2 * MARGIN:
            raise BadSheet(f"tag {cut.number} is wider than the paper", remedy="make it smaller")
        if x + width > A4[0] - MARGIN and row:
            x, top, row = MARGIN, top - row, 0.0
        if top - height < MARGIN + 8:
            yield _finished(figure, axes)
            figure, axes = _page(*A4)
            x, top, row = MARGIN, A4[1] - MARGIN, 0.0
        _tag(axes, cut, x, top - side, side)
        x, row = x + width, max(row, height)
    yield _finished(figure, axes)


def _finished(figure: Figure, axes: Axes) -> Figure:
    words = "Cut along the thin lines: the white rim belongs to the tag. An arrow points along the object's x."
    _ruler(axes, MARGIN, 9.0, words)
    return figure


def _tag(axes: Axes, cut: _Cut, left: float, bottom: float, side: float) -> None:
    module = cut.size / 8
    axes.add_patch(Rectangle((left, bottom), side, side, fill=False, linewidth=0.2, edgecolor="0.6"))
    _draw(axes, tags.modules(cut.number), left + module, bottom + module, module)
    axes.text(left, bottom - 1.2, cut.words, fontsize=5.5, va="top", ha="left", linespacing=1.3)
    if cut.arrow:
        start = (left + side + 0.8, bottom + side / 2)
        axes.annotate("", (start[0] + 2.6, start[1]), start, arrowprops={"arrowstyle": "->", "lw": 0.6})


def _draw(axes: Axes, grid: NDArray[np.bool_], left: float, bottom: float, module: float) -> None:
    """Black modules as one outline, so that no seam shows between them."""
    vertices: list[tuple[float, float]] = []
    codes: list[np.uint8] = []
    for r, line in enumerate(grid):
        y = bottom + (grid.shape[0] - 1 - r) * module
        edges = np.flatnonzero(np.diff(np.concatenate(([False], line, [False]))))
        for first, last in zip(edges[::2], edges[1::2], strict=True):
            a, b = left + first * module, left + last * module
            vertices += [(a, y), (b, y), (b, y + module), (a, y + module), (a, y)]
            codes += [Outline.MOVETO, Outline.LINETO, Outline.LINETO, Outline.LINETO, Outline.CLOSEPOLY]
    axes.add_patch(PathPatch(Outline(vertices, codes), facecolor="black", linewidth=0))


def _ruler(axes: Axes, left: float, bottom: float, words: str) -> None:
    axes.plot([left, left + RULER], [bottom, bottom], color="black", linewidth=0.6, solid_capstyle="butt")
    for x in (left, left + RULER):
        axes.plot([x, x], [bottom - 1.5, bottom + 1.5], color="black", linewidth=0.6)
    axes.text(left + RULER + 3, bottom, "100 mm: print at 100 %, not fitted to the page", fontsize=6, va="center")
    axes.text(left, bottom - 2.5, words, fontsize=6, va="top")


def _page(width: float, height: float) -> tuple[Figure, Axes]:
    """A page in mm, the origin in its lower left corner."""
    figure = Figure(figsize=(width / INCH, height / INCH))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, width), ylim=(0.0, height))
    axes.axis("off")
    return figure, axes


def _write(path: Path, pages: Sequence[Figure]) -> list[Path]:
    if path.suffix not in ENDINGS:
        raise BadSheet(f"{path} has no ending that is known", remedy=f"end its name in one of: {', '.join(ENDINGS)}")
    try:
        if path.suffix == ".pdf":
            with PdfPages(path) as document:
                for page in pages:
                    document.savefig(page)
            return [path]
        names = [path if i == 0 else path.with_stem(f"{path.stem}-{i + 1}") for i in range(len(pages))]
        for name, page in zip(names, pages, strict=True):
            page.savefig(name, dpi=300)
    except OSError as error:
        raise BadSheet(
            f"{path} can't be written: {error.strerror}", remedy="name a folder that you may write to"
        ) from error
    return names
