# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of pings and views as PNG, which notebooks show."""
from __future__ import annotations

import struct
import tempfile
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ._insonify import Ping, draw_fan


def png_of_grey(image: NDArray[np.uint8]) -> bytes:
    """A PNG of 8 bits a pixel."""
    height, width = image.shape
    rows = np.zeros((height, width + 1), np.uint8)  # each row begins with its filter, 0: none
    rows[:, 1:] = image

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes()))
            + chunk(b"IEND", b""))


def png_of_ping(ping: Ping) -> bytes:
    """The fan of a ping as a PNG, as draw_fan draws it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "fan.png")
        draw_fan(ping, path)
        return path.read_bytes()
