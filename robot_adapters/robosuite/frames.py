"""Where robosuite's world and the robot's base are to each other."""

from __future__ import annotations

import numpy as np

BASE = np.array([-0.56, 0.0, 0.912])
"""(3,) the robot's base, m, robosuite world frame; the axes are parallel."""

TABLE = 0.8
"""z of the table, m, robosuite world frame."""
