# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Callable, Iterator, Sequence
from os import PathLike
from typing import Any, Final, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Path: TypeAlias = str | PathLike[str]
_Number: TypeAlias = float | np.floating[Any] | np.integer[Any]
_Numbers: TypeAlias = _Number | Sequence[_Number] | NDArray[Any]
_Text: TypeAlias = _Path | _Numbers

class Error(Exception): ...
class ArgumentError(Error, ValueError): ...

class Sonar:
    name: Final[str]
    toml: Final[str]

def sonar(name: _Path, *,
            <sonar>) -> Sonar: ...
def sonars() -> list[str]: ...

class Environment:
    toml: Final[str]
    def __init__(self, path: _Path | None = None, *,
            <environment>) -> None: ...

class Scene:
    origin: Final[NDArray[np.float64]]
    material_names: Final[list[str]]
    given_instances: Final[dict[int, int]]
    notes: Final[list[str]]
    points: Final[NDArray[np.float64]]
    normals: Final[NDArray[np.float32]]
    areas: Final[NDArray[np.float32]]
    materials: Final[NDArray[np.uint16]]
    parts: Final[list[dict[str, Any]]]
    def __init__(self, points: ArrayLike, *, normals: ArrayLike | None = None, areas: ArrayLike | None = None,
            material: ArrayLike | str | None = None, instance: ArrayLike | None = None,
            triangles: ArrayLike | None = None,
            <scene without material>) -> None: ...
    def __len__(self) -> int: ...
    def add(self, body: _Path | Scene | ArrayLike | tuple[ArrayLike, ArrayLike], *, name: str | None = None,
            class_: str | None = None, material: ArrayLike | str | None = None, pose: ArrayLike = ...,
            velocity: ArrayLike | None = None, turn_rate: ArrayLike | None = None, spacing: float = 0,
            <scene without material>) -> int: ...
    def move(self, id: int, pose: ArrayLike, *, velocity: ArrayLike | None = None,
            turn_rate: ArrayLike | None = None) -> None: ...
    def remove(self, id: int) -> None: ...

def load_scene(path: _Path, *, seed: int | None = None,
            <scene>) -> Scene: ...
def make_scene(name: str, points: int = 200000, seed: int = 1) -> Scene: ...

class Ping:
    pressure: Final[NDArray[np.complex64]]
    layers: Final[dict[str, NDArray[np.complex64]]]
    intensity: Final[NDArray[np.float32] | None]
    display_cells: Final[bool]
    unknown: Final[NDArray[np.uint8] | None]
    material_image: Final[NDArray[np.uint16]]
    instance_image: Final[NDArray[np.uint32]]
    label_share: Final[NDArray[np.float32]]
    label_elevation: Final[NDArray[np.float32] | None]
    second_image: Final[NDArray[np.uint16] | None]
    second_share: Final[NDArray[np.float32] | None]
    class_names: Final[list[str]]
    part_names: Final[list[str]]
    parts: Final[list[dict[str, Any]]]
    part_poses: Final[dict[str, NDArray[np.float64]]]
    contributors: Final[dict[str, NDArray[Any]] | None]
    elements: Final[dict[str, Any] | None]
    range: Final[NDArray[np.float64]]
    azimuth: Final[NDArray[np.float64]]
    elevation: Final[NDArray[np.float64]]
    soundings: Final[NDArray[np.void]]
    world_from_head: Final[NDArray[np.float64]]
    head: Final[str]
    number: Final[int]
    time: Final[float]
    seed: Final[int]
    sound_speed: Final[float]
    absorption_db_per_m: Final[float]
    notes: Final[list[str]]
    def level_db(self, floor_db: float = -200) -> NDArray[np.float32]: ...
    def save(self, path: _Path, force: bool = False, picture: bool = True) -> None: ...
    def _repr_png_(self) -> bytes: ...

class View:
    image: Final[NDArray[np.uint8]]
    mask: Final[NDArray[np.uint8] | None]
    instances: Final[NDArray[np.uint16] | None]
    elevation: Final[NDArray[np.float32] | None]
    boxes: Final[NDArray[np.int32]]
    objects: Final[list[dict[str, Any]]]
    class_names: Final[list[str]]
    window: Final[tuple[float, float]]
    ping: Final[Ping]
    def _repr_png_(self) -> bytes: ...

class Pings(Iterator[Ping]):
    def __next__(self) -> Ping: ...
    def __len__(self) -> int: ...

class PingSimulator:
    def __init__(self, sonar: Sonar, environment: Environment = ..., *,
            <simulator>) -> None: ...
    def ping(self, scene: Scene, position: ArrayLike, yaw: float = 0, pitch: float = 0, roll: float = 0, *,
            <ping>) -> Ping: ...
    def pings(self, scene: Scene, poses: ArrayLike, threads: int = 0, *,
            <pings>) -> Pings: ...
    def views(self, scene: Scene, poses: ArrayLike, *, width: int | None = None, height: int = 512,
            geometry: Literal["fan", "polar"] = "fan", labels: bool = True,
            window: tuple[float, float] | None = None, min_contrast_db: float = 3, box_dark: bool = False,
            stuff: Sequence[str] = (), threads: int = 0,
            <views>) -> Iterator[View]: ...
    def plan(self, scene: Scene, position: ArrayLike, yaw: float = 0, pitch: float = 0, roll: float = 0, *,
            <ping>) -> list[dict[str, Any]]: ...

class Mission:
    heads: Final[list[str]]
    times: Final[NDArray[np.float64]]
    poses: Final[NDArray[np.float64]]
    def __init__(self, path: _Path) -> None: ...
    def __len__(self) -> int: ...
    def pings(self, *, first: int = 0, count: int | None = None, threads: int = 0,
            progress: Callable[[int, int], object] | None = None) -> Iterator[Ping]: ...

def load_mission(path: _Path) -> Mission: ...

def draw_fan(ping: Ping, path: _Path, *, width: int = 1400, height: int = 1050, title: str | None = None,
             colour_map: str = "bronze", min_db: float = ..., max_db: float = ..., dark: bool = False) -> None: ...
