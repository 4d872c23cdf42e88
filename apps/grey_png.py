# SPDX-License-Identifier: BSD-3-Clause
"""Grey pictures for the examples, by Python's own modules."""
from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


def save_grey(path: str | Path, grey: NDArray[Any]) -> None:
    """Writes values from 0 to 255, the first row on top, as a PNG of 8 bits."""
    rows = np.clip(np.rint(grey), 0, 255).astype(np.uint8)
    lines = b"".join(b"\0" + row.tobytes() for row in rows)
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", rows.shape[1], rows.shape[0], 8, 0, 0, 0, 0)),
              (b"IDAT", zlib.compress(lines)), (b"IEND", b""))
    packed = (struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
              for kind, body in chunks)
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(packed))
