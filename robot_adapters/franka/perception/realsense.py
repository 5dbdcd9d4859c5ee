"""Intel RealSense cameras, and recordings of them (.db3 of SDK 2.58 and newer, .bag of older ones)."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from robot_adapters.base import Unavailable
from robot_adapters.franka.perception.camera import HEIGHT, WIDTH, CameraLost, Lens, Picture

RATE = 15  # pictures a second; the most that a D415 gives of colour at this size over USB 2
PATIENCE = 5000  # ms without a picture until a device counts as gone; the first one takes a second or two
STEP = 1000  # ms, likewise of a recording, whose player is then asked whether it is over
PATIENCE_AT_PLAY = 30_000  # ms that a recording which isn't over may take for its next picture


class RealSense:
    """Colour with the depth aligned to it, from a device or a recording (`Camera`)."""

    def __init__(self, rs: Any, config: Any, source: str, *, live: bool) -> None:
        """Start it.

        Raises:
            Unavailable: it doesn't start.
        """
        self.live = live
        self._rs = rs
        self._source = source
        self._pipeline = rs.pipeline()
        self._playback: Any = None
        try:
            if not live:
                # the reader sets the pace, from the very start: what plays at its own is missed
                device = config.resolve(rs.pipeline_wrapper(self._pipeline)).get_device()
                self._playback = device.as_playback()
                self._playback.set_real_time(False)
            profile = self._pipeline.start(config)
            streams = {s.stream_type(): s.as_video_stream_profile() for s in profile.get_streams()}
        except RuntimeError as error:
            raise Unavailable(
                f"{source} doesn't start: {error}",
                remedy="check the cable (USB 3), and that no other program uses the camera"
                if live
                else "record it anew; is it a RealSense recording?",
            ) from error
        if rs.stream.color not in streams:
            self._pipeline.stop()
            raise Unavailable(f"{source} has no colour pictures", remedy="record the colour stream too")
        self.lens = _lens(rs, streams[rs.stream.color].get_intrinsics())
        self._align = rs.align(rs.stream.color) if rs.stream.depth in streams else None

    def read(self) -> Picture:
        """See `Camera`."""
        there, frames = self._pipeline.try_wait_for_frames(PATIENCE if self.live else STEP)
        waited = STEP
        while not there and self._plays() and waited < PATIENCE_AT_PLAY:  # a busy machine takes its time
            there, frames = self._pipeline.try_wait_for_frames(STEP)
            waited += STEP
        if not there:
            what = "gives no pictures any more" if self.live else "has come to its end"
            raise CameraLost(f"{self._source} {what}", remedy="check its cable, then resume")
        if self._align is not None:
            frames = self._align.process(frames)
        frame, depth = frames.get_color_frame(), frames.get_depth_frame() if self._align is not None else None
        # copies: what belongs to the driver is used again for a later picture
        colour = np.asanyarray(frame.get_data()).reshape(frame.get_height(), frame.get_width(), 3).copy()
        if frame.get_profile().format() == self._rs.format.bgr8:
            colour = np.ascontiguousarray(colour[..., ::-1])
        metres = np.asanyarray(depth.get_data()).astype(np.float32) * depth.get_units() if depth else None
        return Picture(colour, self._taken_at(frame), metres)

    def close(self) -> None:
        """See `Camera`."""
        self._pipeline.stop()

    def _plays(self) -> bool:
        """Whether a recording has more to give, as far as its player knows."""
        return bool(self._playback is not None and self._playback.current_status() == self._rs.playback_status.playing)

    def _taken_at(self, frame: Any) -> float:
        """Seconds since the epoch: the camera's own stamp where that is a time of day, otherwise now."""
        now = time.time()
        if self.live and frame.get_frame_timestamp_domain() != self._rs.timestamp_domain.hardware_clock:
            return min(float(frame.get_timestamp()) / 1000, now)
        return now


def open_device(serial: str) -> RealSense:
    """The RealSense with this serial number; without one, the first.

    Raises:
        Unavailable: the package, its library or the camera can't be had.
    """
    rs = _package()
    config = rs.config()
    if serial:
        config.enable_device(serial)
    config.enable_stream(rs.stream.color, WIDTH, HEIGHT, rs.format.rgb8, RATE)
    config.enable_stream(rs.stream.depth, WIDTH, HEIGHT, rs.format.z16, RATE)
    known = serials()
    if not known or (serial and serial not in known):
        raise Unavailable(
            f"no RealSense {serial}".rstrip() + " is connected",
            remedy=f"connected are: {', '.join(known)}" if known else "plug it into a USB 3 port",
        )
    return RealSense(rs, config, f"realsense:{serial or known[0]}", live=True)


def open_recording(path: str) -> RealSense:
    """A recording, read from its beginning as fast as its reader asks.

    Raises:
        Unavailable: the package can't be had, or the file isn't a recording.
    """
    rs = _package()
    config = rs.config()
    try:
        config.enable_device_from_file(path, repeat_playback=False)
    except RuntimeError as error:
        raise Unavailable(f"{path} is no RealSense recording: {error}", remedy="record it anew") from error
    return RealSense(rs, config, path, live=False)


def serials() -> tuple[str, ...]:
    """Serial numbers of the RealSense cameras that are connected.

    Raises:
        Unavailable: the package can't be had.
    """
    rs = _package()
    return tuple(str(d.get_info(rs.camera_info.serial_number)) for d in rs.context().query_devices())


def _package() -> Any:
    try:
        import pyrealsense2  # noqa: PLC0415  a rig of other cameras doesn't need it
    except ImportError as error:
        raise Unavailable(
            f"pyrealsense2 can't be imported: {error}",
            remedy="pip install 'seed-robot[realsense]' and apt-get install libusb-1.0-0",
        ) from error
    return pyrealsense2


def _lens(rs: Any, seen: Any) -> Lens | None:
    """What the device says of its lens, where that is in OpenCV's terms; otherwise the board has to show it."""
    coefficients = np.array(seen.coeffs, dtype=np.float64)
    if seen.model not in {rs.distortion.none, rs.distortion.brown_conrady} and coefficients.any():
        return None
    matrix = np.array([[seen.fx, 0.0, seen.ppx], [0.0, seen.fy, seen.ppy], [0.0, 0.0, 1.0]])
    return Lens(seen.width, seen.height, matrix, coefficients)
