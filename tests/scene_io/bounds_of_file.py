#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the bounds of a scene file and the area of its polygons, read by the definition of its format.

Shares no code with insonify: numbers by struct and split, HDF5 by h5py. Polygons are flat, so that their area is half the
length of the sum of the cross products of their corners. Exit code 77: h5py is not there.
"""
import base64, json, math, re, struct, sys

TYPES = dict(char="b", uchar="B", short="h", ushort="H", int="i", uint="I", float="f", double="d")


def ply(data):
    head, body = data.split(b"end_header\n", 1)
    lines = [line.split() for line in head.decode().split("\n")]
    text = ["format", "ascii", "1.0"] in lines
    words, at = iter(body.split()), 0

    def number(kind):
        nonlocal at
        if text:
            return float(next(words))
        value, = struct.unpack_from("<" + TYPES[kind], body, at)
        at += struct.calcsize(TYPES[kind])
        return value

    points, faces, elements = [], [], []
    for line in lines:
        if line[:1] == ["element"]:
            elements.append((line[1], int(line[2]), []))
        elif line[:1] == ["property"]:
            elements[-1][2].append(line[1:])
    for name, count, properties in elements:
        for _ in range(count):
            row = {}
            for p in properties:
                row[p[-1]] = [number(p[2]) for _ in range(int(number(p[1])))] if p[0] == "list" else number(p[0])
            if name == "vertex":
                points.append((row["x"], row["y"], row["z"]))
            elif name == "face":
                faces.append([int(i) for i in row["vertex_indices"]])
    return points, faces


def pcd(data):
    head, kind, body = re.match(rb"(.*?)DATA (\w+)\n(.*)", data, re.S).groups()
    facts = {line.split()[0]: line.split()[1:] for line in head.decode().split("\n") if line and line[0] != "#"}
    names = facts["FIELDS"]
    letters = {"F4": "f", "F8": "d", "U1": "B", "U2": "H", "U4": "I", "I4": "i"}
    layout = "<" + "".join(letters[t + s] for t, s in zip(facts["TYPE"], facts["SIZE"]))
    if kind == b"ascii":
        words = [[float(word) for word in line.split()] for line in body.decode().split("\n") if line]
        body = b"".join(struct.pack(layout, *[w if c in "fd" else int(w) for w, c in zip(row, layout[1:])])
                        for row in words)
    rows = struct.iter_unpack(layout, body)
    return [tuple(row[names.index(axis)] for axis in "xyz") for row in rows], []


def obj(data):
    lines = [line.split() for line in data.decode().split("\n")]
    points = [tuple(map(float, line[1:4])) for line in lines if line[:1] == ["v"]]
    return points, [[int(corner.split("/")[0]) - 1 for corner in line[1:]] for line in lines if line[:1] == ["f"]]


def stl(data):
    if data.startswith(b"solid"):
        points = [tuple(map(float, corner)) for corner in re.findall(rb"vertex (\S+) (\S+) (\S+)", data)]
    else:
        count, = struct.unpack_from("<I", data, 80)
        points = []
        for t in range(count):
            numbers = struct.unpack_from("<12f", data, 84 + 50 * t)
            points += [numbers[3:6], numbers[6:9], numbers[9:12]]
    return points, [[i, i + 1, i + 2] for i in range(0, len(points), 3)]


def vtk(data):
    words = data.decode().split()
    at = words.index("POINTS")
    count = int(words[at + 1])
    numbers = list(map(float, words[at + 3:at + 3 + 3 * count]))
    at = words.index("POLYGONS")
    cells, faces = list(map(int, words[at + 3:at + 3 + int(words[at + 2])])), []
    while cells:
        faces.append(cells[1:1 + cells[0]])
        cells = cells[1 + cells[0]:]
    return list(zip(numbers[0::3], numbers[1::3], numbers[2::3])), faces


def gltf(data):
    document = json.loads(data)
    buffer = base64.b64decode(document["buffers"][0]["uri"].split(",")[1])

    def numbers(index, columns):
        accessor = document["accessors"][index]
        letter = {5126: "f", 5125: "I", 5123: "H"}[accessor["componentType"]]
        view = document["bufferViews"][accessor["bufferView"]]
        return struct.unpack_from("<%d%s" % (columns * accessor["count"], letter), buffer, view["byteOffset"])

    primitive = document["meshes"][0]["primitives"][0]
    p = numbers(primitive["attributes"]["POSITION"], 3)
    corners = numbers(primitive["indices"], 1)
    return ([(x, -z, y) for x, y, z in zip(p[0::3], p[1::3], p[2::3])],
            [corners[i:i + 3] for i in range(0, len(corners), 3)])


def las(data):
    begin, = struct.unpack_from("<I", data, 96)
    stride, count = struct.unpack_from("<HI", data, 105)
    numbers = struct.unpack_from("<6d", data, 131)
    rows = [struct.unpack_from("<3i", data, begin + i * stride) for i in range(count)]
    return [tuple(n * scale + shift for n, scale, shift in zip(row, numbers[:3], numbers[3:])) for row in rows], []


def xyz(data):
    return [tuple(map(float, line.split()[:3])) for line in data.decode().split("\n") if line], []


def tif(data):
    at, = struct.unpack_from("<I", data, 4)
    tags = {}
    for k in range(struct.unpack_from("<H", data, at)[0]):
        tag, kind, count, where = struct.unpack_from("<HHII", data, at + 2 + 12 * k)
        letter = {2: "s", 3: "H", 4: "I", 12: "d"}[kind]
        layout = "<%d%s" % (count, letter)
        tags[tag] = struct.unpack_from(layout, data, at + 10 + 12 * k if struct.calcsize(layout) <= 4 else where)
    wide, deep = tags[256][0], tags[257][0]
    values = b"".join(data[a:a + n] for a, n in zip(tags[273], tags[279]))
    heights = struct.unpack("<%df" % (wide * deep), values)
    hole, (step_x, step_y), place = float(tags[42113][0].strip(b"\0")), tags[33550][:2], tags[33922]
    return [(place[3] + (i % wide + 0.5) * step_x, place[4] - (i // wide + 0.5) * step_y, z)
            for i, z in enumerate(heights) if z != hole], []


def asc(data):
    lines = [line.split() for line in data.decode().split("\n") if line.strip()]
    facts = {line[0].lower(): float(line[1]) for line in lines if line[0][0].isalpha()}
    rows = [list(map(float, line)) for line in lines if not line[0][0].isalpha()]
    step = facts.get("cellsize") or facts["dx"]
    return [(facts["xllcorner"] + (c + 0.5) * step, facts["yllcorner"] + (len(rows) - r - 0.5) * step, z)
            for r, row in enumerate(rows) for c, z in enumerate(row) if z != facts["nodata_value"]], []


def nc(data):
    """Classic netCDF, whose numbers stand highest byte first."""
    at = 4
    letters = {1: "b", 3: "h", 4: "i", 5: "f", 6: "d"}

    def number(letter="I"):
        nonlocal at
        value, = struct.unpack_from(">" + letter, data, at)
        at += struct.calcsize(letter)
        return value

    def text(count):
        nonlocal at
        found = data[at:at + count]
        at += (count + 3) // 4 * 4
        return found

    def attributes():
        found = {}
        number()
        for _ in range(number()):
            name, kind, count = text(number()), number(), number()
            size = 1 if kind == 2 else struct.calcsize(letters[kind])
            found[name] = text(count * size) if kind == 2 else struct.unpack(">%d%s" % (count, letters[kind]),
                                                                             text(count * size))
        return found

    number(), number()
    dimensions = [(text(number()), number())[1] for _ in range(number())]
    attributes(), number()
    variables = {}
    for _ in range(number()):
        name, shape = text(number()), [dimensions[number()] for _ in range(number())]
        facts, kind, _, begin = attributes(), number(), number(), number("I" if data[3] == 1 else "Q")
        if kind != 2:
            values = struct.unpack_from(">%d%s" % (math.prod(shape), letters[kind]), data, begin)
            variables[name] = (shape, facts, values)
    x, y = variables[b"x"][2], variables[b"y"][2]
    facts, heights = [v[1:] for v in variables.values() if len(v[0]) == 2][0]
    return [(x[i % len(x)], y[i // len(x)], z) for i, z in enumerate(heights) if z != facts[b"_FillValue"][0]], []


def hdf5(path):
    try:
        import h5py
    except ImportError:
        sys.exit(77)
    with h5py.File(path) as f:
        if path.endswith(".tiles"):
            origin, points = f.attrs["origin"], []
            for tile in f["tile"]:
                rows = f["point"][int(tile["first"]):int(tile["first"] + tile["count"])]
                points += [tuple(float(p) + a + b for p, a, b in zip(row, tile["reference"], origin)) for row in rows]
            return points, []
        text = b"".join(f["BAG_root/metadata"][:]).decode()
        low, high = [tuple(map(float, c.split(","))) for c in
                     re.search(r"coordinates[^>]*>([^<]+)<", text).group(1).split()]
        heights, hole = f["BAG_root/elevation"][:], 1000000
        step = [(high[k] - low[k]) / (heights.shape[1 - k] - 1) for k in (0, 1)]
        x = [low[0] + c * step[0] for c in range(heights.shape[1])]
        y = [low[1] + r * step[1] for r in range(heights.shape[0])]
        return [(x[c], y[r], heights[r, c]) for r in range(len(y)) for c in range(len(x)) if heights[r, c] != hole], []


def area(corners):
    total = [0.0, 0.0, 0.0]
    for a, b in zip(corners, corners[1:] + corners[:1]):
        for k in range(3):
            total[k] += a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2]
    return math.hypot(*total) / 2


path = sys.argv[1]
extension = path.rsplit(".", 1)[1]
if extension in ("bag", "tiles"):
    points, faces = hdf5(path)
else:
    points, faces = globals()[extension](open(path, "rb").read())
used = [points[i] for face in faces for i in face] or points
print(*(repr(float(f(p[axis] for p in used))) for f in (min, max) for axis in range(3)), end=" ")
middle = points[0]
print(repr(sum(area([tuple(p - m for p, m in zip(points[i], middle)) for i in face]) for face in faces)))
