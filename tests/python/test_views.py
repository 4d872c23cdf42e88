# SPDX-License-Identifier: BSD-3-Clause
"""Images with labels from PingSimulator.views, against the pings that they show and against geometry."""
from __future__ import annotations

import insonify as iy
import numpy as np
import pytest

text = """schema = 1
[[part]]
file = "bed.ply"
[[part]]
name = "north"
file = "ball.ply"
position_m = [6, 1, 0.3]
rest = "none"
[[part]]
name = "south"
file = "ball.ply"
position_m = [8, -2, 0.3]
rest = "none"
"""
balls = {"north": (6, 1, 0.3), "south": (8, -2, 0.3)}
radius = 0.4
poses = np.array([(0, 0, 2, 0, 12, 0), (0.5, 0.3, 2, 4, 12, 0), (1, -0.5, 2.2, -5, 14, 0)])


@pytest.fixture(scope="module")
def field(tmp_path_factory, tool) -> iy.Scene:
    """A bed with two balls at known places."""
    folder = tmp_path_factory.mktemp("field")
    tool("make-scene", "plane", "--size", "16,12", "--points", "40000", "-o", "bed.ply", folder=folder)
    tool("make-object", "sphere", "--set", f"diameter_m={2 * radius}", "-o", "ball.ply", folder=folder)
    (folder / "field.toml").write_text(text)
    return iy.load_scene(folder / "field.toml")


@pytest.fixture(scope="module")
def simulator() -> iy.PingSimulator:
    return iy.PingSimulator(iy.sonar("p900-45", beams=128, min_range=2, max_range=12), noise=True)


def seen_from(ping: iy.Ping, place: tuple[float, float, float]) -> tuple[float, float]:
    """Range and azimuth of the beam that hears a place."""
    pose = np.asarray(ping.world_from_head)
    x, y, z = pose[:3, :3].T @ (np.array(place) - pose[:3, 3])
    away = np.sqrt(x * x + y * y + z * z)
    return away, np.arcsin(y / away)


def test_fans_have_labels_of_the_same_pixels(simulator, field):
    views = list(simulator.views(field, poses, width=320, height=400, stuff=["plane"]))
    assert len(views) == 3 and len({view.window for view in views}) == 1
    for view in views:
        assert view.image.dtype == np.uint8
        for picture in (view.image, view.mask, view.instances, view.elevation):
            assert picture.shape == (400, 320)
        assert view.mask.max() < len(view.class_names) and view.class_names[:2] == ["nothing", "shadow"]
        found = {seen["name"]: seen for seen in view.objects}
        assert set(found) == set(balls)
        for name, seen in found.items():
            left, top, width, height = seen["box"]
            rows, columns = np.nonzero(view.instances == seen["id"])
            assert (left, top) == (columns.min(), rows.min())
            assert (left + width - 1, top + height - 1) == (columns.max(), rows.max())
            assert np.allclose(seen["pose"][:3, 3], balls[name], atol=0.01) and seen["visible_share"] > 0.5
            elevation = view.elevation[view.instances == seen["id"]]
            assert np.isfinite(elevation).mean() > 0.95 and np.nanmax(np.abs(elevation)) < 0.5
            assert np.isnan(view.elevation[view.mask < 2]).all()
            assert seen["boxed"] == (seen["contrast_db"] >= 3)
            # The head is below the middle of a fan of even bearings, which is as wide as the image.
            away, azimuth = seen_from(view.ping, balls[name])
            pixel = 2 * 12 * np.sin(np.max(view.ping.azimuth) + 0.5 * np.ptp(view.ping.azimuth) / 127) / 320
            across = 160 - away * np.sin(azimuth) / pixel
            assert left - 3 <= across <= left + width + 3
        boxed = [seen["box"] for seen in view.objects if seen["boxed"]]
        assert view.boxes.dtype == np.int32 and np.array_equal(view.boxes, np.array(boxed).reshape(-1, 4))


def test_polar_views_are_the_cells_of_the_ping(simulator, field):
    (view,) = simulator.views(field, poses[:1], height=100, geometry="polar")
    ping = view.ping
    assert view.image.shape == (100, 128) and ping.display_cells
    expected = ping.material_image.astype(int) + 2
    expected[ping.material_image == 65535], expected[ping.material_image == 65534] = 0, 1
    from_port = np.argsort(-ping.azimuth)
    assert np.array_equal(view.mask, expected[from_port].T[::-1])
    level = (ping.level_db() + 40 * np.log10(ping.range))[from_port]
    grey = view.image.T[:, ::-1].astype(float)
    # Absorption is the same in all beams: a grey value is 60 / 255 dB.
    shown = np.where((grey > 0) & (grey < 255), level - grey * 60 / 255, np.nan)
    assert np.isfinite(shown).mean() > 0.5
    full = np.isfinite(shown).any(axis=0)
    spread = np.nanmax(shown[:, full], axis=0) - np.nanmin(shown[:, full], axis=0)
    assert spread.max() < 60 / 255 + 1e-3
    for seen in (seen for seen in view.objects if seen["name"]):
        left, top, width, height = seen["box"]
        away, azimuth = seen_from(ping, balls[seen["name"]])
        row = 99 - (away - radius - 2) / 0.1
        assert top - 3 <= row <= top + height + 3
        column = np.argmin(np.abs(ping.azimuth[from_port] - azimuth))
        assert left - 2 <= column <= left + width + 2


def test_views_do_not_depend_on_threads_nor_on_their_number(simulator, field):
    one, two = (list(simulator.views(field, poses[:2], width=64, height=64, threads=n)) for n in (1, 2))
    for a, b in zip(one, two):
        assert np.array_equal(a.image, b.image) and np.array_equal(a.mask, b.mask) and np.array_equal(a.boxes, b.boxes)
    (alone,) = simulator.views(field, poses[:1], width=64, height=64)
    assert np.array_equal(alone.image, one[0].image)
    (plain,) = simulator.views(field, poses[:1], width=64, height=64, labels=False)
    assert plain.mask is None and plain.objects == [] and np.array_equal(plain.image, alone.image)


def test_views_say_what_is_wrong(simulator, field):
    with pytest.raises(iy.ArgumentError, match="stuff = bad is no class of the scene; it has nothing, shadow, plane"):
        next(simulator.views(field, poses[:1], width=64, height=64, stuff=["bad"]))
    for keys, said in (({"geometry": "round"}, "'fan' or 'polar'"), ({"geometry": "polar", "width": 7}, "128"),
                       ({"width": 3}, "16 and 8192"), ({"sead": 3}, "unknown keyword 'sead'")):
        with pytest.raises(iy.ArgumentError, match=said):
            simulator.views(field, poses, **keys)
