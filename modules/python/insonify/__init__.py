# SPDX-License-Identifier: BSD-3-Clause
"""Simulates imaging sonar on captured scenes.

A scene and a head in an environment give pings: complex pressure of beams x range bins, soundings, and what every pixel
shows. Lengths are metres, times seconds, pressures pascals, levels dB re 1 uPa; angles of poses and of keys that end in
_deg are degrees, those of arrays radians. World axes have z up.
"""

from ._insonify import (ArgumentError, Environment, Error, Ping, Pings, PingSimulator, Scene, Sonar, __version__,
                        draw_fan, load_scene, make_scene, sonar, sonars)

from .editing import add as _add
from .missions import Mission, load_mission
from .pictures import png_of_ping as _png_of_ping
from .views import View, views as _views

__all__ = ["ArgumentError", "Environment", "Error", "Mission", "Ping", "PingSimulator", "Pings", "Scene", "Sonar", "View", "__version__",
           "draw_fan", "load_mission", "load_scene", "make_scene", "sonar", "sonars"]

PingSimulator.views = _views
Scene.add = _add
Ping._repr_png_ = _png_of_ping
load_mission.__module__ = __name__
for _type in (Environment, Mission, Ping, PingSimulator, Pings, Scene, Sonar, View):
    _type.__module__ = __name__
