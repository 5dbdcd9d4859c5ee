"""Figures: our curves over the paper's, for the screen (PNG) and for print (SVG). matplotlib without a display."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import numpy as np

from agent.study import paper
from agent.study.algorithms import CONTESTANTS
from agent.study.curves import Curve, study_curve
from agent.study.plan import Axis, Contestant, Measure, Plan, Scenario
from agent.study.records import FIGURES, Folder
from agent.study.results import UNIT, about
from agent.study.statistics import CONFIDENCE, summaries

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = ("#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000", "#999999")
"""Okabe and Ito's, which colour-blind people tell apart."""
OF_ALGORITHM = {"seed": 0, "seed-recommended": 3, "tamer": 2, "maple-aff": 1, "maple": 4, "sac": 6}
"""The same algorithm has the same colour in every figure."""
MARKERS = "osD^vPX*"
LABEL = {Measure.SUCCESS_RATE: "success rate", Measure.SUCCESSES: "successes while training"}
CROWD = 8
"""More curves than this have their legend beside the figure."""
FAR = 4.0
"""How many times further than another a curve may go before the axis is logarithmic."""


def write_figures(folder: Folder, plan: Plan) -> list[str]:
    """Draw each scenario of which anything was measured; the names of the files in the study's folder."""
    import matplotlib as mpl  # noqa: PLC0415  a second to load: only where something is drawn

    mpl.use("Agg")
    from matplotlib import pyplot as plt  # noqa: PLC0415  after the backend was chosen

    target = folder.path / FIGURES
    target.mkdir(exist_ok=True)
    written = []
    with plt.rc_context(
        {"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": plan.name}
    ):
        for scenario in plan.scenarios:
            axes_of = _axes_of(scenario)
            figure, panels = plt.subplots(
                1, len(axes_of), figsize=(5.6 * len(axes_of) + 0.4, 4.9), squeeze=False, layout="constrained"
            )
            drawn = [_draw(panel, folder, plan, scenario, axis) for panel, axis in zip(panels[0], axes_of, strict=True)]
            if any(drawn):
                figure.suptitle(f"{scenario.title}, {plan.adapter}", fontsize=12)
                figure.supxlabel(caption(folder, plan, scenario, 78 * len(axes_of)), fontsize=8, color="#444444")
                for suffix in ("png", "svg"):
                    name = f"{scenario.name}.{suffix}"
                    figure.savefig(target / name, dpi=150, metadata={"Date": None} if suffix == "svg" else None)
                    written.append(name)
            plt.close(figure)
    return written


def caption(folder: Folder, plan: Plan, scenario: Scenario, width: int) -> str:
    """What a figure shows, from what, and where the paper's values are from; in lines of at most `width`."""
    drawn = f"Solid: interquartile mean of the seeds; band: {CONFIDENCE:.0%} bootstrap interval."
    return "\n".join(textwrap.wrap(f"{drawn} {explained(folder, plan, scenario)}", width))


def explained(folder: Folder, plan: Plan, scenario: Scenario) -> str:
    """What holds for a scenario's curves however they are drawn."""
    if plan.claim:
        return about(folder, plan, scenario)
    ends = "A curve ends where its first seed did; seeds far behind the others aren't in it yet."
    text = f"{ends} {about(folder, plan, scenario)}"
    if paper.curves(scenario.name):
        text += f" Dashed, behind: the paper's figure ({paper.note(scenario.name)}), read off by eye, ±3 %."
    return text


def _axes_of(scenario: Scenario) -> tuple[Axis, ...]:
    """What it is drawn over: the paper's axis, and where that is low-level steps also what a trainer pays."""
    return (scenario.axis,) if scenario.axis is Axis.DECISIONS else (scenario.axis, Axis.DECISIONS)


def _draw(panel: Axes, folder: Folder, plan: Plan, scenario: Scenario, axis: Axis) -> bool:
    """Draw one panel; whether there was anything of ours."""
    papers = paper.curves(scenario.name) if axis is scenario.axis else ()
    ours: dict[str, Curve] = {}
    for contestant in plan.contestants:
        found = study_curve(folder, plan, scenario.name, contestant.name, axis=axis, measure=scenario.measure)
        if found is not None:
            ours[contestant.name] = found
    ends = [end for curve in ours.values() if (end := float(curve.x[-1])) > 0]
    ends += [max(curve.x[-1] for curve in papers)] if papers else []
    farthest = max(ends, default=1.0)
    logarithmic = farthest > FAR * min(ends, default=1.0)
    named: set[str] = set()
    for theirs in papers:
        label = None if theirs.algorithm in named else f"{CONTESTANTS[theirs.algorithm].title}, paper"
        named.add(theirs.algorithm)
        colour = _colour(plan, theirs.algorithm)
        panel.plot(theirs.x, theirs.y, "--", color=colour, alpha=0.5, lw=1.6, marker=".", ms=7, zorder=1, label=label)
    for contestant in plan.contestants:
        if contestant.name in ours:
            seeds, planned = ours[contestant.name].seeds, len(plan.of(scenario.name, contestant.name))
            label = f"{contestant.title} (n = {seeds}{f' of {planned}' if seeds < planned else ''})"
            _draw_ours(panel, plan, contestant, ours[contestant.name], label, logarithmic=logarithmic)
    if logarithmic:
        panel.set_xscale("log")
    else:
        panel.set_xlim(0, farthest * 1.02)
        panel.xaxis.set_major_formatter("{x:,.0f}")
    panel.set_xlabel("feedbacks (decisions)" if axis is Axis.DECISIONS else UNIT[axis])
    panel.set_ylabel(LABEL[scenario.measure])
    if scenario.measure is Measure.SUCCESS_RATE:
        panel.set_ylim(-0.03, 1.03)
    else:
        panel.set_ylim(bottom=min(-0.5, -0.03 * panel.get_ylim()[1]))
    panel.grid(color="#dddddd", lw=0.6)
    if len(ours) > CROWD:
        panel.legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    elif ours:
        panel.legend(frameon=False, fontsize=8, loc="best")
    hidden = [each.title for each in plan.contestants if each.name in ours and not ours[each.name].x.any()]
    if hidden:
        panel.set_title(f"at 0, a seed having executed nothing: {', '.join(hidden)}", fontsize=8, color="#444444")
    return bool(ours)


def _draw_ours(panel: Axes, plan: Plan, contestant: Contestant, curve: Curve, label: str, *, logarithmic: bool) -> None:
    shown = curve.x > 0 if logarithmic else np.ones(len(curve.x), dtype=bool)
    if not shown.any():
        return
    x, told = curve.x[shown], summaries(curve.values[:, shown])
    index = _index(plan, contestant.name)
    colour = COLOURS[index % len(COLOURS)]
    marker = MARKERS[(index + index // len(COLOURS)) % len(MARKERS)]  # no two have both in common
    middle, every = [t.iqm for t in told], max(1, len(x) // 8)
    marked = (index % every, every)  # where curves lie on each other their markers don't
    panel.plot(x, middle, color=colour, lw=2, marker=marker, ms=5, markevery=marked, zorder=3, label=label)
    ends = np.array([(t.low, t.high) for t in told], dtype=np.float64)  # nan where one seed has no interval
    panel.fill_between(x, ends[:, 0], ends[:, 1], color=colour, alpha=0.18, lw=0, zorder=2)


def _index(plan: Plan, name: str) -> int:
    if name in OF_ALGORITHM:
        return OF_ALGORITHM[name]
    names = [contestant.name for contestant in plan.contestants]
    return names.index(name) if name in names else len(COLOURS) - 1


def _colour(plan: Plan, name: str) -> str:
    return COLOURS[_index(plan, name) % len(COLOURS)]
