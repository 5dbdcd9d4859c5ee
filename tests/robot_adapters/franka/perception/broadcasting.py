"""A lab with live cameras: what two of them see of a Deoxys arm without physics, rendered, and sent as MJPEG streams.

The production code opens the streams as it opens any device of OpenCV's.
"""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Mapping
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import cv2
import numpy as np

from robot_adapters.base import Array
from robot_adapters.franka.perception import calibration
from robot_adapters.franka.perception.calibration import Calibration
from robot_adapters.franka.perception.rays import View
from robot_adapters.tasks.base import Part
from tests.robot_adapters.franka.perception.conftest import board_solid, tagged
from tests.robot_adapters.franka.perception.poses import BOARD_FROM_MIDDLE, HAND_FROM_BOARD
from tests.robot_adapters.franka.perception.rendering import EYES, TABLE, Solid, Stage, view
from tests.simulators.deoxys_peer import HOME, DeoxysPeer
from tests.simulators.franka import free_host
from tests.simulators.session import UNHURRIED

AGAIN = 0.4
"""s after which a stream sends the same picture again: cameras never pause, and a slow reader keeps up with it."""
SILENCE = 10.0
"""s without a picture that these cameras may take, because what draws them shares the machine with who looks."""
HALVES = {"block_a": 0.02, "block_b": 0.025}
REACH = 0.03
"""m from the grip site at which closing fingers take a block."""
GREY, DARK = (0.75, 0.76, 0.78), (0.2, 0.2, 0.22)
HAND = Solid((
    Part((0.0, 0.0, -0.064), (0.032, 0.102, 0.033), GREY),
    Part((0.0, 0.0, -0.16), (0.044, 0.044, 0.063), GREY, "disc"),
    Part((-0.05, 0.0, -0.29), (0.055, 0.055, 0.07), GREY, "disc"),
))  # fmt: skip
"""Palm, wrist and elbow of the hand, in its frame: z points down, out of the fingers; the grip site is its origin."""
FINGER = Solid((Part((0.0, 0.0, -0.012), (0.010, 0.007, 0.022), DARK),))


class Arm(DeoxysPeer):
    """Takes a block along that its fingers closed on, and lets it down where they open. `turned`: (3, 3) if guided."""

    def __init__(self, host: str, pc: str, blocks: Mapping[str, Array]) -> None:
        self.blocks = {name: np.array(at) for name, at in blocks.items()}
        self.held: str | None = None
        self.turned: Array | None = None
        super().__init__(host, pc, block=2 * HALVES["block_a"])

    def rotation(self) -> Array:
        return super().rotation() if self.turned is None else self.turned

    def _move(self) -> None:
        before = self.position.copy()
        super()._move()
        if self.held is not None:
            self.blocks[self.held] += self.position - before
            if self.width > self.block + 0.01:
                self._settle(self.held)
                self.held = None
        elif self.width <= self.block + 0.001:
            near = [n for n, at in self.blocks.items() if np.linalg.norm(at - self.position) < REACH]
            self.held = near[0] if near else None

    def _settle(self, name: str) -> None:
        """Let it down onto the table, or onto what is below it."""
        at = self.blocks[name]
        below = [
            other[2] + HALVES[n]
            for n, other in self.blocks.items()
            if n != name and float(np.linalg.norm(other[:2] - at[:2])) < HALVES[n]
        ]
        at[2] = max(below, default=TABLE) + HALVES[name]


class Lab:
    """The arm, two cameras, and what people do: `hide` a block, `push` a camera, `guide` the arm."""

    def __init__(self, blocks: Mapping[str, Array]) -> None:
        self.host, self.pc = free_host(), free_host()
        self.arm = Arm(self.host, self.pc, blocks)
        self.views: dict[str, View] = {name: view(eye) for name, eye in EYES.items()}
        self.hidden: set[str] = set()
        self.board: Array | None = None
        """base_from_middle (4, 4) of the board while it is in the hand."""
        self._jpegs: dict[str, bytes] = {}
        self._asked, self._drawn = 1, 0
        self._changed = threading.Condition()
        self._closing = threading.Event()
        self._server = ThreadingHTTPServer((self.host, 0), _handler(self))
        self._server.daemon_threads = True
        self._threads = [threading.Thread(target=self._render), threading.Thread(target=self._server.serve_forever)]
        for thread in self._threads:
            thread.start()

    def settings(self, calibration: Path) -> dict[str, object]:
        """Of the Franka adapter, with the folder of the calibrations."""
        cameras = {name: self.source(name) for name in self.views}
        eyes = {"cameras": cameras, "calibration": str(calibration), "lost_after": 2.0, "silence": SILENCE}
        return {
            "backend": "deoxys",
            "host": self.host,
            "deoxys_bind": self.pc,
            "dead_man": UNHURRIED,
            "eyes_settings": eyes,
        }

    @property
    def shown(self) -> bool:
        """Whether the streams show what was done last."""
        return self._drawn >= self._asked

    def source(self, camera: str) -> str:
        """Its stream, as a camera's source."""
        return f"opencv:http://{self.host}:{self._server.server_port}/{camera}"

    def calibrate(self, where: Path) -> None:
        """Store what a perfect calibration would have found."""
        for name, seen in self.views.items():
            colour = cv2.imdecode(np.frombuffer(self.jpeg(name), dtype=np.uint8), cv2.IMREAD_GRAYSCALE)
            made = Calibration(name, self.source(name), seen, 0.001, 15, np.asarray(colour, dtype=np.uint8))
            calibration.save(made, where)

    def hide(self, *names: str) -> None:
        """Cover these blocks, and no others."""
        self.hidden = set(names)
        self._seen_anew()

    def move(self, name: str, at: Array) -> None:
        """Put a block at (3,) m."""
        self.arm.blocks[name] = at
        self._seen_anew()

    def push(self, camera: str, by: Array) -> None:
        """Move a camera by (3,) m."""
        self.views[camera] = view(self.views[camera].eye + by)
        self._seen_anew()

    def guide(self, base_from_hand: Array, told: Array) -> None:
        """Hold the arm there with the board in its hand; it tells that it is at `told`. Both (4, 4)."""
        self.board = np.eye(4) * np.nan  # between two poses no camera sees it, or one would be taken for the other
        self._seen_anew()
        self.jpeg("left")
        self.arm.position, self.arm.turned = told[:3, 3].copy(), told[:3, :3].copy()
        self.board = base_from_hand @ HAND_FROM_BOARD @ BOARD_FROM_MIDDLE
        self._seen_anew()

    def let_go(self) -> None:
        """Take the board away, and bring the arm out of the picture."""
        self.board = self.arm.turned = None
        self.arm.position = HOME.copy()
        self._seen_anew()

    def jpeg(self, camera: str) -> bytes:
        """The newest picture; waits for one of what is there now, if that isn't drawn yet."""
        with self._changed:
            self._changed.wait_for(lambda: self.shown and camera in self._jpegs, 60.0)
            return self._jpegs[camera]

    def close(self) -> None:
        """End it."""
        self._closing.set()
        self._server.shutdown()
        self._server.server_close()
        for thread in self._threads:
            thread.join()
        self.arm.close()

    def stream(self, camera: str, send: Callable[[bytes], None]) -> None:
        """Send every new picture, and the last one again, until nobody reads them any more."""
        sent: bytes | None = None
        while not self._closing.is_set():
            with self._changed:
                if self._jpegs.get(camera) is sent:
                    self._changed.wait(AGAIN)
                sent = self._jpegs.get(camera)
            if sent is not None:
                send(sent)

    def _seen_anew(self) -> None:
        with self._changed:
            self._asked += 1

    def _render(self) -> None:
        """Draw what has changed; graphics belong to one thread."""
        stage = Stage(
            {**tagged("stacking"), "board": board_solid(), "hand": HAND, "l": FINGER, "r": FINGER}, self.views
        )
        shown: object = None
        while not self._closing.is_set():
            asked = self._asked
            place = self._place()
            key = tuple(np.round(np.concatenate([np.zeros(0), *(v.ravel() for v in place.values())]), 4)), asked
            if key == shown:
                self._closing.wait(0.02)
                continue
            self._closing.wait(0.05)  # leave some of the machine to who looks at this
            stage.clear()
            for name, pose in place.items():
                stage.place(name, pose[:3, 3], pose[:3, :3])
            jpegs = {}
            for name, seen in self.views.items():
                stage.stand(name, seen)
                jpegs[name] = cv2.imencode(".jpg", stage.draw(name)[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 92])[
                    1
                ].tobytes()
            shown = key
            with self._changed:
                self._jpegs, self._drawn = jpegs, asked
                self._changed.notify_all()
        stage.close()

    def _place(self) -> dict[str, Array]:
        """Of everything that is there: its name -> (4, 4), base frame."""
        hand = np.eye(4)
        hand[:3, :3], hand[:3, 3] = self.arm.rotation(), self.arm.position
        there = {"hand": hand}
        for name, side in (("l", -1.0), ("r", 1.0)):
            aside = np.eye(4)
            aside[1, 3] = side * (self.arm.width / 2 + 0.007)
            there[name] = hand @ aside
        if self.board is not None:
            return {} if np.isnan(self.board).any() else {"board": self.board}  # the hand is behind it
        for name, at in self.arm.blocks.items():
            if name not in self.hidden:
                there[f"stacking/{name}"] = np.eye(4)
                there[f"stacking/{name}"][:3, 3] = at
        return there


def _handler(lab: Lab) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        """Answers `/left` and `/right` by a stream without end."""

        def do_GET(self) -> None:
            camera = self.path.strip("/")
            if camera not in lab.views:
                self.send_error(404)
                return
            self.send_response(200)
            self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=picture")
            self.end_headers()

            def send(jpeg: bytes) -> None:
                head = f"--picture\r\nContent-Type: image/jpeg\r\nContent-Length: {len(jpeg)}\r\n\r\n"
                self.wfile.write(head.encode() + jpeg + b"\r\n")

            with contextlib.suppress(OSError):
                lab.stream(camera, send)

        def log_message(self, format: str, *args: object) -> None:
            """Say nothing."""

    return Handler
