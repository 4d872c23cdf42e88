# SPDX-License-Identifier: BSD-3-Clause
"""The package: what it loads, its docs and stubs, its examples."""
from __future__ import annotations

import ast
import importlib.util
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import insonify as iy
import pytest

root = Path(__file__).parents[2]
package = Path(iy.__file__).parent
examples = sorted((root / "apps").glob("*.py"))


def run(*arguments, **options):
    return subprocess.run([sys.executable, *arguments], check=True, text=True, capture_output=True, **options).stdout


def test_neither_pcl_nor_vtk_is_loaded_before_it_is_needed(folder):
    program = """
import insonify as iy, numpy as np
def libraries(): return {word for word in ("libvtk", "libpcl", "libgdal") if word in open("/proc/self/maps").read()}
grid = np.stack(np.meshgrid(np.arange(5.0), np.arange(5.0), [0.0]), -1).reshape(-1, 3)
scene = iy.Scene(grid, normals=np.tile((0, 0, 1), (25, 1)), areas=np.ones(25))
sim = iy.PingSimulator(iy.sonar("p900-45", beams=4, max_range=5), iy.Environment(temperature_c=4))
for ping in sim.pings(scene, [(0, 0, 2, 0, 45, 0)], keep="contributors"): ping.soundings, ping.material_image
print(sorted(libraries()))
iy.load_scene("harbour.ply")
print(sorted(libraries())[:2])
"""
    before, after = run("-c", program, cwd=folder).splitlines()
    assert before == "[]" or before == "['libgdal']"
    assert "libpcl" in after and "libvtk" in run("-c", program.replace("[:2]", ""), cwd=folder).splitlines()[1]


def public_things():
    for name in iy.__all__:
        thing = getattr(iy, name)
        yield name, thing
        if inspect.isclass(thing) and thing.__module__ == "insonify":
            yield from ((f"{name}.{member}", value) for member, value in vars(thing).items() if member[0] != "_")


def test_all_that_is_public_has_docs():
    for name, thing in public_things():
        if name != "__version__":
            assert thing.__doc__ and len(thing.__doc__.split("\n\n", 1)[-1]) >= 3, name


def test_docs_name_all_keywords():
    for thing, words in ((iy.sonar, ("min_range_m [m]", "azimuths_deg [deg]", "shading")),
                         (iy.Environment.__init__, ("temperature_c [deg C]", "surface_height_m [m]", "wind_speed_m_s")),
                         (iy.PingSimulator.__init__, ("accuracy_db", "noise", "looks_range", "seed", "without")),
                         (iy.load_scene, ("unit", "viewpoint", "mesh_spacing")), (iy.Scene.__init__, ("points", "areas")),
                         (iy.PingSimulator.ping, ("position", "deg", "turn_rate", "keep", "number", "velocity", "seed"))):
        for word in words:
            assert f"{word}" in thing.__doc__, (thing, word)


def test_stubs_have_all_that_is_public_and_nothing_else():
    names = set()
    for node in ast.parse((package / "__init__.pyi").read_text()).body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            names.add(node.name)
            for member in node.body if isinstance(node, ast.ClassDef) else []:
                name = member.name if isinstance(member, ast.FunctionDef) else ast.unparse(getattr(member, "target", member))
                if name[0] not in "_." and hasattr(iy, node.name):
                    names.add(f"{node.name}.{name}")
    public = {name for name, _ in public_things() if name != "__version__"}
    assert names == public
    assert (package / "py.typed").exists()


def test_stubs_are_made_from_the_tables():
    spec = importlib.util.spec_from_file_location("make_stubs", root / "modules/python/stubs/make_stubs.py")
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    assert made.stub() == (root / "modules/python/insonify/__init__.pyi").read_text(), f"run {made.__doc__}"


def test_signatures_have_every_keyword():
    for function, words in ((iy.sonar, ("name", "beams", "min_range_m", "min_range", "mounting_deg")),
                            (iy.Environment, ("path", "temperature_c", "surface_height", "wind_speed_m_s", "speed")),
                            (iy.Scene, ("points", "normals", "triangles", "viewpoint", "unit")),
                            (iy.Scene.add, ("self", "body", "class_", "pose")), (iy.Scene.move, ("self", "id", "pose")),
                            (iy.load_scene, ("path", "seed", "mesh_spacing")), (iy.make_scene, ("name", "points", "seed")),
                            (iy.PingSimulator, ("sonar", "environment", "noise", "with_", "without", "accuracy_db")),
                            (iy.PingSimulator.ping, ("self", "scene", "position", "yaw", "keep", "turn_rate", "draw")),
                            (iy.PingSimulator.pings, ("self", "scene", "poses", "threads", "velocity", "time")),
                            (iy.PingSimulator.views, ("self", "poses", "geometry")), (iy.draw_fan, ("ping", "path", "dark")),
                            (iy.Ping.save, ("self", "path", "force")), (iy.Ping.level_db, ("self", "floor_db"))):
        parameters = inspect.signature(function).parameters
        assert set(words) <= set(parameters), function
        assert not (function.__doc__ or "").startswith(f"{function.__name__}(")
    bound = iy.PingSimulator(iy.sonar("p900-45", beams=4)).ping
    assert next(iter(inspect.signature(bound).parameters)) == "scene"
    for name in inspect.signature(iy.sonar).parameters:
        if name != "name":
            iy.sonar("p900-45", **{name: None})  # is known


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_mypy_finds_keywords_that_do_not_exist(tmp_path):
    program = tmp_path / "program.py"
    right = ["import insonify as iy", 'iy.sonar("p900-45", max_range=3, azimuths_deg=[1, 2], shading="hann", min_range_m=0.5)',
             'iy.Environment(temperature_c=8, surface_height=0)', 'scene = iy.load_scene("a.ply", unit="mm", viewpoint=(0, 0, 5))',
             'sim = iy.PingSimulator(iy.sonar("p900-45"), noise=True, with_="detail", without=["noise"])',
             "sim.ping(scene, (0, 0, 0), velocity=(1, 0, 0), display=600, keep=None)", "scene.add('a.ply', pose=(0,) * 6)",
             "sim.pings(scene, [(0,) * 6], velocity=[(1, 0, 0)], draw=[3])"]
    wrong = {'iy.sonar("p900-45", max_rnge=3)': "max_rnge", "iy.Environment(temperature=8)": "temperature",
             "iy.PingSimulator(iy.sonar('p900-45'), acuracy_db=1)": "acuracy_db", "sim.ping(scene, (0, 0, 0), sed=1)": "sed",
             "sim.views(scene, [(0,) * 6], with_=1)": "with_", "scene.add('a.ply', nme='a')": "nme",
             "iy.sonar('p900-45', beams='many')": "beams"}
    program.write_text("\n".join([*right, *wrong]) + "\n")
    made = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(program)], text=True,
                          capture_output=True, env={**os.environ, "MYPYPATH": str(package.parent)})
    lines = [line for line in made.stdout.splitlines() if ": error: " in line]
    assert len(lines) == len(wrong), made.stdout
    for number, (line, word) in enumerate(zip(lines, wrong.values()), len(right) + 1):
        assert line.startswith(f"{program}:{number}: error") and f'"{word}"' in line, line


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
@pytest.mark.parametrize("example", examples, ids=lambda path: path.name)
def test_examples_pass_mypy(example, tmp_path):
    run("-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(example), env={**os.environ, "MYPYPATH": str(package.parent)})


def size_of_picture(path):
    head = path.read_bytes()[:24]
    assert head[1:4] == b"PNG"
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


def test_the_data_set_example(tmp_path):
    lines = run(str(root / "apps/05_dataset.py"), str(tmp_path / "sheet.png")).splitlines()
    assert len(lines) == 7 and lines[-1].endswith("True")
    boxes = [int(re.search(r"(\d+) boxes", line)[1]) for line in lines[:-1]]
    assert min(boxes) >= 1 and all("classes [0, 1, 3, 4]" in line for line in lines[:-1])
    assert size_of_picture(tmp_path / "sheet.png") == (960, 640)


def test_the_reconstruction_example_brings_the_shape_back(tmp_path):
    """Its surface is off by less than a voxel of 25 mm, of which the cells of the images have 20 mm."""
    out = run(str(root / "apps/07_reconstruction.py"), str(tmp_path / "body.png"))
    off, missed, tenths = (int(x) for x in re.search(r"off by (\d+) mm, .* by (\d+) mm .* by (\d+) mm", out).groups())
    assert off <= 25 and missed <= 30 and tenths <= 60
    assert size_of_picture(tmp_path / "body.png")[0] > 200


def test_the_synthetic_aperture_focuses_points_as_theory_has_it(tmp_path):
    lines = run(str(root / "apps/08_synthetic_aperture.py"), str(tmp_path / "reef.png")).splitlines()
    along, across = (float(x) for x in re.search(r"theory: (.*) mm along, (.*) mm across", lines[0]).groups())
    assert len(lines) == 4
    for line in lines[1:]:
        found = [float(x) for x in re.search(r"focused (\S+) mm and (\S+) mm .*, (\S+) mm along, (\S+) mm across; real beam"
                                             r" (\S+) mm", line).groups()]
        assert abs(found[0]) <= 2 and abs(found[1]) <= 1  # the places where the image was asked for are 1 and 0.5 mm apart
        assert found[2] == pytest.approx(along, rel=0.05) and found[3] == pytest.approx(across, rel=0.05)
        assert found[4] > 3 * along
    assert size_of_picture(tmp_path / "reef.png") == (2000, 480)


def test_the_sweep_example(tmp_path):
    out = run(str(root / "apps/06_sweep.py"), str(tmp_path / "sweep.png"))
    assert out.count("dB re 1 uPa") == 4
    if importlib.util.find_spec("matplotlib"):
        assert (tmp_path / "sweep.png").read_bytes()[1:4] == b"PNG"
    else:
        assert "no chart" in out
