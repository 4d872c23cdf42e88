# SPDX-License-Identifier: BSD-3-Clause
"""Parts of scenes that are added between pings: Scene.add."""
from __future__ import annotations

import os
from typing import Any

from numpy.typing import ArrayLike

from ._insonify import ArgumentError, Scene, load_scene


def add(self: Scene, body: Any, *, name: str | None = None, class_: str | None = None, material: Any = None,
        pose: ArrayLike = (0, 0, 0, 0, 0, 0), velocity: ArrayLike | None = None, turn_rate: ArrayLike | None = None,
        spacing: float = 0, **keys: Any) -> int:
    """Adds a part; returns its id, the number of its pixels in Ping.instance_image and View.instances.

    It costs the time of the part's own surfels; the first edit of a scene costs that of preparing it once more. Ids and
    classes stay when other parts are moved and removed. A name that was removed gets its id again.

    body: path of a cloud or mesh, a Scene, points (n, 3), or corners and triangles: a tuple of (n, 3) and (m, 3)
    name: of the part, unique in the scene; it selects its speckle; None: "part 2" for id 2
    class_: of its pixels; None: its name; "": its materials, and no object of its own
    material: as of Scene; of a Scene its own
    pose: of the axes of the body: x, y, z [m], yaw, pitch, roll [deg], or float (4, 4)
    velocity, turn_rate: float (3,) [m/s] and [deg/s], world axes; None: at rest
    spacing: of the surfels of a mesh [m]; 0: 1/50 of its diagonal, within 2 and 50 mm
    Other keywords are those of load_scene(), or of Scene.
    """
    from . import _insonify_io as io
    if isinstance(body, Scene):
        if keys or material is not None:
            raise ArgumentError(f"add: {next(iter(keys), 'material')}: the body is a Scene, which was loaded already")
    elif isinstance(body, (str, os.PathLike)):
        body = load_scene(body, material=material, **keys)
    elif isinstance(body, tuple) and len(body) == 2:
        body = Scene(body[0], triangles=body[1], material=material, **keys)
    else:
        body = Scene(body, material=material, **keys)
    return int(io.add(self, body, name, class_, pose, velocity, turn_rate, spacing))
