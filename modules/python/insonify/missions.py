# SPDX-License-Identifier: BSD-3-Clause
"""Missions: the pings of `insonify survey` one after another, load_mission."""
from __future__ import annotations

import os
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from ._insonify import ArgumentError, Ping, Pings


def _each(made: Pings, progress: Callable[[int, int], object] | None) -> Iterator[Ping]:
    total = len(made)
    try:
        for done, ping in enumerate(made, 1):
            if progress is not None:
                progress(done, total)
            yield ping
    finally:
        del made  # ends the work of its threads, though a traceback may hold this frame


class Mission:
    """A mission file with its heads and its scene; made by load_mission(). Its length is the number of its pings."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        from . import _insonify_io as io
        self._loaded = io.Mission(path)

    def __len__(self) -> int:
        return len(self._loaded.times())

    @property
    def heads(self) -> list[str]:
        """Name of the head of each ping: all pings of the first head in the order of time, then those of the next."""
        return self._loaded.heads()  # type: ignore[no-any-return]

    @property
    def times(self) -> NDArray[np.float64]:
        """float64 (n,) [s], of transmission of each ping."""
        return np.array(self._loaded.times(), np.float64)

    @property
    def poses(self) -> NDArray[np.float64]:
        """float64 (n, 4, 4) [m]: world_from_head of each ping, without errors of navigation and installation."""
        return self._loaded.poses()  # type: ignore[no-any-return]

    def pings(self, *, first: int = 0, count: int | None = None, threads: int = 0,
              progress: Callable[[int, int], object] | None = None) -> Iterator[Ping]:
        """An iterator over pings, with the bytes of `insonify survey`: one on each core at a time, without the GIL.

        At most two pings for each core are in memory. Ctrl-C, an exception, and an iterator that is dropped end the work.
        A ping that fails raises its error, which names it; pings have the pose that navigation and installation report.

        first, count: int, begin and number of the pings; None: all from the first
        threads: int; 0: all cores. The pings do not depend on it
        progress: is called as progress(done, total) before each ping is given, in the thread that asks for it
        """
        if progress is not None and not callable(progress):
            raise ArgumentError(f"pings: progress = {progress!r}, must be a function of two numbers, or None")
        return _each(self._loaded.pings(first, count, threads), progress)


def load_mission(path: str | os.PathLike[str]) -> Mission:
    """Loads a mission file (.toml), its heads, and its scene: a cloud, mesh, raster, tiles or a scene of parts."""
    return Mission(path)
