# SPDX-License-Identifier: BSD-3-Clause
"""Images of pings with labels, to learn from: PingSimulator.views."""
from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._insonify import ArgumentError, Ping, PingSimulator, Scene
from .pictures import png_of_grey


class View:
    """An image of a ping, with what every pixel of it shows, unless views() has labels=False."""

    def __init__(self, ping: Ping, parts: dict[str, Any]) -> None:
        self._ping, self._parts = ping, parts

    @property
    def ping(self) -> Ping:
        """The ping of the image."""
        return self._ping

    @property
    def image(self) -> NDArray[np.uint8]:
        """uint8 (height, width), from black to white over `window`."""
        return self._parts["image"]  # type: ignore[no-any-return]

    @property
    def mask(self) -> NDArray[np.uint8] | None:
        """uint8 (height, width): class of every pixel, an index into class_names; 0: nothing, 1: shadow; or None."""
        return self._parts["mask"]  # type: ignore[no-any-return]

    @property
    def instances(self) -> NDArray[np.uint16] | None:
        """uint16 (height, width): object of every pixel; 0: none; or None."""
        return self._parts["instances"]  # type: ignore[no-any-return]

    @property
    def elevation(self) -> NDArray[np.float32] | None:
        """float32 (height, width) [rad], from which the surface is heard, positive up; NaN: no surface; or None."""
        return self._parts["elevation"]  # type: ignore[no-any-return]

    @property
    def boxes(self) -> NDArray[np.int32]:
        """int32 (n, 4): left, top, width, height [pixels] of the objects that have a box."""
        return self._parts["boxes"]  # type: ignore[no-any-return]

    @property
    def objects(self) -> list[dict[str, Any]]:
        """Objects: id, class, name, pose, size_m, visible_share, box, contrast_db, boxed, pixels; None: not known."""
        return self._parts["objects"]  # type: ignore[no-any-return]

    @property
    def class_names(self) -> list[str]:
        """Names of the classes, by the numbers of mask."""
        return self._parts["class_names"]  # type: ignore[no-any-return]

    @property
    def window(self) -> tuple[float, float]:
        """Levels of black and white [dB re 1 uPa at 1 m]."""
        return self._parts["window"]  # type: ignore[no-any-return]

    def _repr_png_(self) -> bytes:
        return png_of_grey(self.image)


def views(self: PingSimulator, scene: Scene, poses: ArrayLike, *, width: int | None = None, height: int = 512,
          geometry: Literal["fan", "polar"] = "fan", labels: bool = True, window: tuple[float, float] | None = None,
          min_contrast_db: float = 3, box_dark: bool = False, stuff: Sequence[str] = (), threads: int = 0,
          **keys: Any) -> Iterator[View]:
    """An iterator over images of pings, in the order of their poses, with labels in the same pixels.

    geometry: "fan", in true geometry, in the middle of width x height pixels; a pixel is the mean of the display cells
        that it covers by area, and has the class of most of its energy. "polar": a column for each beam, port first, and
        a row for each display cell, the farthest first; width is the number of beams, or None
    window: levels of black and white [dB]; None: 60 dB below what a pixel in 1000 of the first image exceeds, for all
    min_contrast_db: of an object over the ring around it, for a box; box_dark: objects as far below it have boxes, too
    stuff: classes that have no objects, as the bed
    Other keywords are those of pings().
    """
    if geometry not in ("fan", "polar"):
        raise ArgumentError(f"views: geometry = {geometry!r}, must be 'fan' or 'polar'")
    from . import _insonify_io as io
    fan, beams = geometry == "fan", io.beams_of_view(self)
    width = (800 if fan else beams) if width is None else width
    if not fan and width != beams:
        raise ArgumentError(f"views: width = {width}, must be the number of beams of polar images, {beams}")
    if not 16 <= width <= 8192 or not 1 <= height <= 8192:
        raise ArgumentError(f"views: width, height = {width}, {height}, must be within 16 and 8192, and 1 and 8192")
    if labels:
        keys["keep"] = "labels"
    pings = self.pings(scene, poses, threads, display=io.cells_of_view(self, fan, width, height), **keys)

    def each() -> Iterator[View]:
        levels = window
        for ping in pings:
            parts = io.view_of_ping(ping, fan, width, height, min_contrast_db, box_dark, list(stuff), levels)
            levels = parts["window"]
            parts["boxes"] = np.array(parts["boxes"], np.int32).reshape(-1, 4)
            yield View(ping, parts)

    return each()
