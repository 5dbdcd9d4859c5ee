"""Primitive geoms and bodies as MJCF elements, from what a task says of its objects. Positions become world frame."""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree.ElementTree import Element

import numpy as np

from robot_adapters.robosuite.frames import BASE
from robot_adapters.tasks.base import ObjectSpec, Part, Vector

Attribute = str | float | Iterable[float]

FELT, SEEN = "0", "1"
"""robosuite's geom groups: what collides and has mass, and what cameras draw."""

NO_CONTACT = {"contype": "0", "conaffinity": "0"}


def geom(shape: str, at: Vector, size: Iterable[float], colour: Iterable[float], **attributes: Attribute) -> Element:
    """A geom that is seen and felt; `at` from its body's origin, m, `colour` RGB or RGBA."""
    rgba = [*colour, 1.0][:4]
    return _element("geom", type=shape, pos=at, size=size, rgba=rgba, **attributes)


def part(of: Part, **attributes: Attribute) -> Element:
    """The geom of a `Part`; a disc or ring becomes a cylinder."""
    rgba = [*of.colour, of.opacity]
    if of.shape == "box":
        return geom("box", of.centre, of.half, rgba, **attributes)
    return geom("cylinder", of.centre, (of.half[0], of.half[2]), rgba, **attributes)


def unseen(element: Element) -> Element:
    """The same geom, only felt."""
    element.set("group", FELT)
    return element


def untouchable(element: Element) -> Element:
    """The same geom, only seen."""
    for name, value in ({"group": SEEN} | NO_CONTACT).items():
        element.set(name, value)
    return element


def thing(spec: ObjectSpec, geoms: Iterable[Element]) -> Element:
    """A movable body called like the object; a reset puts it where the layout says."""
    found = _element("body", name=spec.name)
    found.append(_element("freejoint", name=f"{spec.name}_free"))
    _dress(found, geoms)
    return found


def fixture(spec: ObjectSpec, geoms: Iterable[Element]) -> Element:
    """A body that never moves, at the object's `fixed`."""
    found = _element("body", name=spec.name, pos=np.array(spec.fixed) + BASE)
    _dress(found, geoms)
    return found


def slider(spec: ObjectSpec, geoms: Iterable[Element], travel: float, **joint: Attribute) -> Element:
    """A body that slides along x; its joint, called like the object, is how far it is drawn towards the robot, m."""
    found = fixture(spec, ())
    found.append(
        _element(
            "joint", name=spec.name, type="slide", axis=(-1.0, 0.0, 0.0), range=(0.0, travel), limited="true", **joint
        )
    )
    _dress(found, geoms)
    return found


def _dress(body: Element, geoms: Iterable[Element]) -> None:
    """Add the geoms to the body; one that is both seen and felt becomes two, as robosuite has it."""
    for i, given in enumerate(geoms):
        name = f"{body.get('name')}_{i}"
        if given.get("group") is not None:
            given.set("name", name)
            body.append(given)
            continue
        shape = {k: v for k, v in given.items() if k in {"type", "pos", "size", "euler", "quat", "rgba"}}
        body.append(Element("geom", {**given.attrib, "name": name, "group": FELT}))
        body.append(Element("geom", {**shape, "name": f"{name}_vis", "group": SEEN, **NO_CONTACT, "mass": "0"}))


def _element(tag: str, **attributes: Attribute) -> Element:
    found = Element(tag)
    for name, value in attributes.items():
        text = value if isinstance(value, str) else " ".join(f"{v:.6g}" for v in np.atleast_1d(np.asarray(value)))
        found.set(name, text)
    return found
