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
            centre_frequency_hz: _Number | None = None, bandwidth_hz: _Number | None = None,
            range_resolution_m: _Number | None = None, source_level_db: _Number | None = None,
            beams: int | np.integer[Any] | None = None, field_of_view_deg: _Number | None = None,
            beam_width_deg: _Number | None = None, azimuths_deg: _Numbers | None = None,
            elevations_deg: _Numbers | None = None, column_beam_width_deg: _Number | None = None,
            array: str | None = None, array_radius_m: _Number | None = None, side_lobe_db: _Number | None = None,
            shading: str | None = None, transmit_width_deg: _Number | None = None,
            elevation_width_deg: _Number | None = None, elevation_deg: _Number | None = None,
            elevation_shape: str | None = None, min_range_m: _Number | None = None,
            max_range_m: _Number | None = None, bin_size_m: _Number | None = None, pulse: str | None = None,
            pulse_length_s: _Number | None = None, replica_window: str | None = None,
            mounting_deg: _Numbers | None = None, centre_frequency: _Number | None = None,
            bandwidth: _Number | None = None, range_resolution: _Number | None = None,
            array_radius: _Number | None = None, min_range: _Number | None = None, max_range: _Number | None = None,
            bin_size: _Number | None = None, pulse_length: _Number | None = None) -> Sonar: ...
def sonars() -> list[str]: ...

class Environment:
    toml: Final[str]
    def __init__(self, path: _Path | None = None, *,
            temperature_c: _Number | None = None, salinity_psu: _Number | None = None,
            depth_m: _Number | None = None, level_m: _Number | None = None, ph: _Number | None = None,
            latitude_deg: _Number | None = None, sound_speed_formula: str | None = None,
            absorption_formula: str | None = None, surface_height_m: _Number | None = None,
            surface_rms_height_m: _Number | None = None, surface_scattering_db: _Number | None = None,
            bottom_height_m: _Number | None = None, bottom_density_ratio: _Number | None = None,
            density_ratio: _Number | None = None, bottom_sound_speed_ratio: _Number | None = None,
            sound_speed_ratio: _Number | None = None, bottom_loss: _Number | None = None,
            loss: _Number | None = None, bottom_rms_height_m: _Number | None = None,
            bottom_lambert_mu_db: _Number | None = None, lambert_mu_db: _Number | None = None,
            volume_scattering_db: _Number | None = None, wind_speed_m_s: _Number | None = None,
            speed_m_s: _Number | None = None, noise_self_db: _Number | None = None, self_db: _Number | None = None,
            tank_size_m: _Numbers | None = None, size_m: _Numbers | None = None,
            tank_corner_m: _Numbers | None = None, corner_m: _Numbers | None = None,
            tank_reflection: _Number | None = None, reflection: _Number | None = None,
            tank_rms_height_m: _Number | None = None, mirror: Any | None = None,
            profile_depth_m: _Numbers | None = None, profile_sound_speed: _Numbers | None = None,
            sound_speed: _Numbers | None = None, depth: _Number | None = None, level: _Number | None = None,
            surface_height: _Number | None = None, surface_rms_height: _Number | None = None,
            bottom_height: _Number | None = None, bottom_rms_height: _Number | None = None,
            wind_speed: _Number | None = None, speed: _Number | None = None, tank_size: _Numbers | None = None,
            size: _Numbers | None = None, tank_corner: _Numbers | None = None, corner: _Numbers | None = None,
            tank_rms_height: _Number | None = None, profile_depth: _Numbers | None = None) -> None: ...

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
            viewpoint: str | _Numbers | None = None, materials: _Text | None = None,
            material_field: _Text | None = None, unit: _Text | None = None, z: _Text | None = None,
            up: _Text | None = None, band: _Text | None = None, nodata: _Text | None = None,
            classes: _Text | None = None, mesh_spacing: _Number | None = None,
            scan_noise: str | _Numbers | None = None, keep_strays: bool | np.bool_ | None = None) -> None: ...
    def __len__(self) -> int: ...
    def add(self, body: _Path | Scene | ArrayLike | tuple[ArrayLike, ArrayLike], *, name: str | None = None,
            class_: str | None = None, material: ArrayLike | str | None = None, pose: ArrayLike = ...,
            velocity: ArrayLike | None = None, turn_rate: ArrayLike | None = None, spacing: float = 0,
            viewpoint: str | _Numbers | None = None, materials: _Text | None = None,
            material_field: _Text | None = None, unit: _Text | None = None, z: _Text | None = None,
            up: _Text | None = None, band: _Text | None = None, nodata: _Text | None = None,
            classes: _Text | None = None, mesh_spacing: _Number | None = None,
            scan_noise: str | _Numbers | None = None, keep_strays: bool | np.bool_ | None = None) -> int: ...
    def move(self, id: int, pose: ArrayLike, *, velocity: ArrayLike | None = None,
            turn_rate: ArrayLike | None = None) -> None: ...
    def remove(self, id: int) -> None: ...

def load_scene(path: _Path, *, seed: int | None = None,
            viewpoint: str | _Numbers | None = None, materials: _Text | None = None,
            material_field: _Text | None = None, material: _Text | None = None, unit: _Text | None = None,
            z: _Text | None = None, up: _Text | None = None, band: _Text | None = None, nodata: _Text | None = None,
            classes: _Text | None = None, mesh_spacing: _Number | None = None,
            scan_noise: str | _Numbers | None = None, keep_strays: bool | np.bool_ | None = None) -> Scene: ...
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
            seed: int | np.integer[Any] | str | None = None, tolerance: _Number | None = None,
            method: str | None = None, accuracy_db: _Number | None = None, sampling: str | None = None,
            scatterers_per_cell: _Number | None = None, detail_width: _Number | None = None,
            detail_spacing: _Number | None = None, rays_per_beam: int | np.integer[Any] | None = None,
            amplitude: str | None = None, noise: bool | np.bool_ | None = None,
            multipath: bool | np.bool_ | None = None, double_echoes: _Number | None = None,
            keep: str | Sequence[str] | None = None, contributors: int | np.integer[Any] | None = None,
            keep_bits: int | np.integer[Any] | None = None, layers: bool | np.bool_ | None = None,
            split: bool | np.bool_ | None = None, display: int | np.integer[Any] | None = None,
            looks_range: int | np.integer[Any] | None = None, looks_pings: int | np.integer[Any] | None = None,
            absorption_order: int | np.integer[Any] | None = None, threshold_db: _Number | None = None,
            false_alarm_rate: _Number | None = None, all_bins_above: str | _Numbers | None = None,
            memory_limit_gib: _Number | None = None, with_: str | Sequence[str] | None = None,
            without: str | Sequence[str] | None = None) -> None: ...
    def ping(self, scene: Scene, position: ArrayLike, yaw: float = 0, pitch: float = 0, roll: float = 0, *,
            seed: int | np.integer[Any] | str | None = None, time: _Number | None = None,
            ping: int | np.integer[Any] | None = None, draw: int | np.integer[Any] | None = None,
            keep: str | Sequence[str] | None = None, contributors: int | np.integer[Any] | None = None,
            display: int | np.integer[Any] | None = None, velocity: str | _Numbers | None = None,
            turn_rate: str | _Numbers | None = None) -> Ping: ...
    def pings(self, scene: Scene, poses: ArrayLike, threads: int = 0, *,
            seed: int | np.integer[Any] | str | None = None, time: ArrayLike | None = None,
            ping: int | np.integer[Any] | None = None, draw: ArrayLike | None = None,
            keep: str | Sequence[str] | None = None, contributors: int | np.integer[Any] | None = None,
            display: int | np.integer[Any] | None = None, velocity: ArrayLike | None = None,
            turn_rate: ArrayLike | None = None) -> Pings: ...
    def views(self, scene: Scene, poses: ArrayLike, *, width: int | None = None, height: int = 512,
            geometry: Literal["fan", "polar"] = "fan", labels: bool = True,
            window: tuple[float, float] | None = None, min_contrast_db: float = 3, box_dark: bool = False,
            stuff: Sequence[str] = (), threads: int = 0,
            seed: int | np.integer[Any] | str | None = None, time: ArrayLike | None = None,
            ping: int | np.integer[Any] | None = None, draw: ArrayLike | None = None,
            velocity: ArrayLike | None = None, turn_rate: ArrayLike | None = None) -> Iterator[View]: ...
    def plan(self, scene: Scene, position: ArrayLike, yaw: float = 0, pitch: float = 0, roll: float = 0, *,
            seed: int | np.integer[Any] | str | None = None, time: _Number | None = None,
            ping: int | np.integer[Any] | None = None, draw: int | np.integer[Any] | None = None,
            keep: str | Sequence[str] | None = None, contributors: int | np.integer[Any] | None = None,
            display: int | np.integer[Any] | None = None, velocity: str | _Numbers | None = None,
            turn_rate: str | _Numbers | None = None) -> list[dict[str, Any]]: ...

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
