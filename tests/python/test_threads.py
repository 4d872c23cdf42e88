# SPDX-License-Identifier: BSD-3-Clause
"""Threads that ping, draw, save and load at once, in a process of its own: it must neither crash nor hang."""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path


def test_eight_threads_do_what_one_does(tmp_path, tool):
    tool("make-scene", "poles", "--points", "2000", "-o", "poles.ply", folder=tmp_path)
    tool("prepare", "poles.ply", "-o", "poles.tiles", folder=tmp_path)
    program = [sys.executable, str(Path(__file__).with_name("mixed_calls.py")), str(tmp_path), "6"]
    ended = subprocess.run(program, capture_output=True, text=True, timeout=300)
    assert ended.returncode == 0 and ended.stdout == "48 calls, 0 wrong\n", ended.stdout + ended.stderr


def test_files_are_read_beside_busy_threads(tmp_path):
    seeds = Path(__file__).parents[1] / "fuzz" / "make_seeds.sh"
    subprocess.run([seeds, os.environ["INSONIFY_TOOL"], tmp_path / "seeds"], check=True)
    program = [sys.executable, str(Path(__file__).with_name("busy_readings.py")), str(tmp_path / "seeds"), "10"]
    ended = subprocess.run(program, capture_output=True, text=True, timeout=300)
    assert ended.returncode == 0 and ended.stdout == "200 files read, 0 wrong\n", ended.stdout + ended.stderr
