"""Writes a RealSense recording (.db3) of given pictures, through the SDK's own software device and recorder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyrealsense2 as rs
from numpy.typing import NDArray

from robot_adapters.franka.perception.camera import Lens

RATE = 15
PATIENCE = 60_000
"""ms for the recorder to write one picture down: a busy machine may be long about it."""
UNITS = 0.001
"""m, of the depth stream."""


def record(
    path: Path, lens: Lens, colours: Sequence[NDArray[np.uint8]], depths: Sequence[NDArray[np.float32]] = ()
) -> str:
    """Record pictures (h, w, 3) RGB, and depths (h, w) m if given; the path as a camera's source."""
    device = rs.software_device()
    sensor = device.add_sensor("RGB Camera")
    colour = sensor.add_video_stream(_stream(rs.stream.color, 1, rs.format.rgb8, 3, lens))
    depth = None
    if depths:
        sensor.add_read_only_option(rs.option.depth_units, UNITS)
        depth = sensor.add_video_stream(_stream(rs.stream.depth, 2, rs.format.z16, 2, lens))
        depth.register_extrinsics_to(colour, _same_place())
    recorder = rs.recorder(str(path), device)
    recorded = recorder.query_sensors()[0]
    queue = rs.frame_queue(200, keep_frames=True)
    recorded.open(recorded.get_stream_profiles())
    recorded.start(queue)
    for number, picture in enumerate(colours):
        sensor.on_video_frame(_frame(colour, picture, 3, number))
        queue.wait_for_frame(PATIENCE)  # one after the other: the recorder drops what it can't keep up with
        if depth is not None:
            steps = np.round(depths[number] / UNITS).astype(np.uint16)
            sensor.on_video_frame(_frame(depth, steps, 2, number))
            queue.wait_for_frame(PATIENCE)
    recorded.stop()
    recorded.close()
    return str(path)


def _stream(kind: object, uid: int, form: object, size: int, lens: Lens) -> rs.video_stream:
    stream = rs.video_stream()
    stream.type, stream.index, stream.uid, stream.fmt, stream.bpp = kind, 0, uid, form, size
    stream.width, stream.height, stream.fps = lens.width, lens.height, RATE
    seen = rs.intrinsics()
    seen.width, seen.height = lens.width, lens.height
    seen.fx, seen.fy, seen.ppx, seen.ppy = (float(lens.matrix[i]) for i in ((0, 0), (1, 1), (0, 2), (1, 2)))
    seen.model = rs.distortion.brown_conrady if lens.distortion.any() else rs.distortion.none
    seen.coeffs = [float(c) for c in lens.distortion]
    stream.intrinsics = seen
    return stream


def _frame(profile: rs.stream_profile, pixels: NDArray[np.generic], size: int, number: int) -> rs.software_video_frame:
    frame = rs.software_video_frame()
    frame.pixels = np.ascontiguousarray(pixels)
    frame.stride, frame.bpp = pixels.shape[1] * size, size
    frame.timestamp = number * 1000.0 / RATE
    frame.domain = rs.timestamp_domain.system_time
    frame.frame_number = number + 1
    frame.profile = profile.as_video_stream_profile()
    if size == 2:
        frame.depth_units = UNITS
    return frame


def _same_place() -> rs.extrinsics:
    extrinsics = rs.extrinsics()
    extrinsics.rotation = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    extrinsics.translation = [0.0, 0.0, 0.0]
    return extrinsics
