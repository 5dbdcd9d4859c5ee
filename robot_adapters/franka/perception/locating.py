"""Where tagged objects are: by triangulation where two cameras see a tag, else by its ray and the plane it lies in.

Never by the pose of a single tag, which is several times less exact (docs/franka-cameras.md has all of them in mm).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from robot_adapters.base import Array
from robot_adapters.franka.perception.rays import View, meeting, on_plane
from robot_adapters.franka.perception.tagging import FACES, Tagged, TagOn
from robot_adapters.franka.perception.tags import Tag, square

APART = 0.006
"""m between two cameras' rays to the same tag beyond which one of them must be wrong."""
FITS = 0.15
"""Share by which a tag may look larger or smaller than it is on the plane that it is thought to lie in."""


@dataclass(frozen=True)
class Found:
    """An object as it was measured. position: (3,) m, base frame, of its origin. yaw: rad. tilt: rad from upright.

    cameras: how many saw it. tilt is None where one camera alone can't tell.
    """

    position: Array
    yaw: float
    cameras: int
    tilt: float | None = None


@dataclass(frozen=True)
class _Placed:
    """A tag in space. centre: (3,) m. right: (2,) unit vector, level, along the tag's own x. normal: (3,) or None."""

    on: TagOn
    centre: Array
    right: Array
    cameras: int
    normal: Array | None = None


Seen = Mapping[str, tuple[View, Mapping[int, Tag]]]
"""Camera -> where it is, and the tags in its picture by number."""


def locate(what: Tagged, seen: Seen, table: float, last: Array | None = None) -> Found | None:
    """Where an upright object is, robot base frame; None if no tag of it says so.

    Args:
        what: its tags, and the heights at which it may rest.
        seen: the tags in the newest pictures.
        table: z of the table, m, base frame.
        last: (3,) m where it was before: of several heights that fit, the nearest is taken.
    """
    placed = list(_triangulated(what, seen)) or list(_on_planes(what, seen, table, last))
    if not placed:
        return None
    turned = sum((_turn(p) for p in placed), np.zeros(2))
    yaw = float(np.arctan2(turned[1], turned[0]))
    if len(placed) > 1:
        yaw = _yaw_between(placed) if _span(placed) > 2 * max(p.on.size for p in placed) else yaw
    rotation = _about_z(yaw)
    position = np.mean([p.centre - rotation @ np.array(p.on.at) for p in placed], axis=0)
    tilts = [
        float(np.arccos(np.clip(p.normal @ (rotation @ FACES[p.on.faces][:, 2]), -1.0, 1.0)))
        for p in placed
        if p.normal is not None
    ]
    return Found(position, yaw, max(p.cameras for p in placed), float(np.median(tilts)) if tilts else None)


def _triangulated(what: Tagged, seen: Seen) -> Iterator[_Placed]:
    """Tags that two cameras see, and agree about."""
    for on in what.tags:
        views = [(view, tags[on.number]) for view, tags in seen.values() if on.number in tags]
        if len(views) < 2:
            continue
        met = meeting([v.eye for v, _ in views], [v.rays(tag.centre)[0] for v, tag in views])
        if met is None or met[1] > APART / 2:
            continue
        corners = _corners(views)
        if corners is None or np.abs(_sides(corners) / on.size - 1).max() > FITS:
            continue
        across = (corners[1] - corners[0] + corners[2] - corners[3]) / 2
        upwards = (corners[3] - corners[0] + corners[2] - corners[1]) / 2
        normal = np.cross(across, upwards)
        right = across[:2] / max(float(np.linalg.norm(across[:2])), 1e-9)
        yield _Placed(on, met[0], right, len(views), normal / np.linalg.norm(normal))


def _on_planes(what: Tagged, seen: Seen, table: float, last: Array | None) -> Iterator[_Placed]:
    """Tags that one camera sees, each on the plane of the height at which the object rests."""
    heights = sorted(what.rests, key=lambda h: abs(table + h - last[2])) if last is not None else what.rests
    for height in heights:
        found = [
            placed
            for on in what.tags
            for view, tags in seen.values()
            if on.number in tags and (placed := _on_plane(on, view, tags[on.number], table + height)) is not None
        ]
        if found:
            yield from found
            return


def _on_plane(on: TagOn, view: View, tag: Tag, origin_height: float) -> _Placed | None:
    """The tag, if it looks as large as it is where the object's origin is this high (m, base frame)."""
    height = origin_height + on.at[2]
    centre = on_plane(view.eye, view.rays(tag.centre), height)
    if centre is None:
        return None
    if on.faces == "up":
        corners = on_plane(view.eye, view.rays(tag.corners), height)
        if corners is None or np.abs(_sides(corners) / on.size - 1).max() > FITS:
            return None
        across = (corners[1] - corners[0] + corners[2] - corners[3]) / 2
    else:
        # upright: only the middles of its left and right edge are at the height of its centre
        edges = np.stack([(tag.corners[0] + tag.corners[3]) / 2, (tag.corners[1] + tag.corners[2]) / 2])
        ends = on_plane(view.eye, view.rays(edges), height)
        if ends is None or abs(float(np.linalg.norm(ends[1] - ends[0])) / on.size - 1) > FITS:
            return None
        across = ends[1] - ends[0]
    return _Placed(on, centre[0], across[:2] / np.linalg.norm(across[:2]), 1)


def _corners(views: Sequence[tuple[View, Tag]]) -> Array | None:
    """(4, 3) m, each corner where the cameras' rays to it meet."""
    met = [meeting([v.eye for v, _ in views], [v.rays(t.corners[i])[0] for v, t in views]) for i in range(4)]
    return None if any(m is None for m in met) else np.array([m[0] for m in met if m is not None])


def _sides(corners: Array) -> Array:
    """(4,) m, lengths of the sides."""
    lengths: Array = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    return lengths


def _turn(placed: _Placed) -> Array:
    """(2,) cosine and sine of the object's yaw, as this tag shows it."""
    own = FACES[placed.on.faces][:2, 0]
    return np.array([own @ placed.right, own[0] * placed.right[1] - own[1] * placed.right[0]])


def _span(placed: Sequence[_Placed]) -> float:
    """M between the two tags that are farthest from each other, level."""
    at = np.array([p.on.at[:2] for p in placed])
    return float(np.linalg.norm(at[:, None] - at[None], axis=2).max())


def _yaw_between(placed: Sequence[_Placed]) -> float:
    """The yaw that brings the tags' places on the object to where they are: a longer lever than one tag's edge."""
    own, there = np.array([p.on.at[:2] for p in placed]), np.array([p.centre[:2] for p in placed])
    own, there = own - own.mean(axis=0), there - there.mean(axis=0)
    sine = float(np.sum(own[:, 0] * there[:, 1] - own[:, 1] * there[:, 0]))
    return float(np.arctan2(sine, np.sum(own * there)))


def _about_z(yaw: float) -> Array:
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def places(what: Tagged, position: Array, yaw: float) -> Mapping[int, Array]:
    """Number -> (4, 3) m, base frame: corners of the tags of an upright object that is there."""
    rotation = _about_z(yaw)
    return {
        on.number: position + (np.array(on.at) + square(on.size) @ FACES[on.faces].T) @ rotation.T for on in what.tags
    }
