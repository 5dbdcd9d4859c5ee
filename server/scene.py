"""A task's scene as the wire tells it: what stands on the table, and where the state vector has its place."""

from __future__ import annotations

from robot_adapters.base import workspace
from robot_adapters.tasks import table
from robot_adapters.tasks.base import ObjectSpec, Task
from server.schemas_catalogue import SceneInfo, SceneObject, Solid, Vector


def scene_info(task: Task) -> SceneInfo:
    """Enough to draw the scene from a state.

    A field `NAME_position` (m) tells the place of the object NAME, and `NAME_opening` how far a slider is from closed;
    an object without one, that isn't fixed, has no place.
    """
    places, at = {}, 0
    for field in task.state_fields:
        places[field.name] = (at, field.size)
        at += field.size
    gripper = places.get("gripper_position")
    return SceneInfo(
        table_height=task.table_height,
        table_centre=table.CENTRE,
        workspace=_corners(task),
        objects=[_object(spec, places) for spec in task.objects],
        gripper_at=gripper[0] if gripper else None,
    )


def _object(spec: ObjectSpec, places: dict[str, tuple[int, int]]) -> SceneObject:
    told = places.get(f"{spec.name}_position")
    slides = places.get(f"{spec.name}_opening") if spec.shape == "slider" else None
    size = (spec.half_size,) * 3
    whole: Vector = (size[0], size[1], size[2])
    round_ = spec.shape == "area"
    parts = [
        Solid(shape=part.shape, centre=part.centre, half=part.half, colour=part.colour, opacity=part.opacity)
        for part in spec.parts
    ] or [
        Solid(
            shape="sphere" if round_ else "box",
            centre=(0.0, 0.0, 0.0),
            half=whole,
            colour=spec.colour,
            opacity=0.35 if round_ else 1.0,
        )
    ]
    return SceneObject(
        name=spec.name,
        parts=parts,
        fixed=spec.fixed,
        state_at=told[0] if told else None,
        state_size=told[1] if told else 3,
        slides_at=slides[0] if slides else None,
        rests=-min(part.centre[2] - part.half[2] for part in parts),
    )


def _corners(task: Task) -> tuple[Vector, Vector] | None:
    room = workspace(task.skills)
    if room is None:
        return None
    low, high = ((float(x), float(y), float(z)) for x, y, z in room)
    return low, high
