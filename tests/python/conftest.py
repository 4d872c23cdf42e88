# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: a scene on disk, a head, the tool."""
from __future__ import annotations

import os
import subprocess
from pathlib import Path

import insonify as iy
import pytest


@pytest.fixture(scope="session")
def tool():
    """Runs the tool in a folder."""
    def run(*arguments, folder):
        subprocess.run([os.environ["INSONIFY_TOOL"], *arguments, "-q"], cwd=folder, check=True)
    return run


@pytest.fixture(scope="session")
def folder(tmp_path_factory, tool) -> Path:
    """A folder with harbour.ply."""
    path = tmp_path_factory.mktemp("scene")
    tool("make-scene", "harbour", "--points", "30000", "-o", "harbour.ply", folder=path)
    return path


@pytest.fixture(scope="session")
def scene(folder) -> iy.Scene:
    return iy.load_scene(folder / "harbour.ply")


@pytest.fixture(scope="session")
def head() -> iy.Sonar:
    return iy.sonar("p900-45", beams=32, min_range=1, max_range=12)


@pytest.fixture(scope="session")
def simulator(head) -> iy.PingSimulator:
    return iy.PingSimulator(head)
