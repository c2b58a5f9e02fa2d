"""What the tests of the Python module share: a ball as arrays and as files, and readers of what the program writes."""
import importlib.util
import os
import struct
import subprocess
import zlib
from pathlib import Path

import numpy as np
import pytest

import quorum

ROOT = Path(__file__).resolve().parents[3]
BOX = [-1.1, -1.1, -1.1, 1.1, 1.1, 1.1]
# The ball is small: all of its surface is kept.
OPTIONS = {"device": "cpu", "neighbors": 3, "maps": "all", "min_component": 0, "min_confidence": 0}


def example(name):
    """A file of docs/examples as a module."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / "examples" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Ball:
    """Six photographs of the turntable."""

    def __init__(self):
        images, self.K, rotations, translations, masks = example("turntable").arrays()
        self.images = np.stack(images[:6])
        self.R, self.t, self.masks = rotations[:6], translations[:6].astype(float), masks[:6]

    def scene(self, **options):
        return quorum.Scene.from_arrays(self.images, self.K, self.R, self.t, bounds=BOX, **options)


@pytest.fixture(scope="session")
def ball():
    return Ball()


@pytest.fixture(scope="session")
def results(ball):
    """A run of the ball, kept in memory."""
    return quorum.reconstruct(ball.scene(masks=ball.masks), **OPTIONS)


@pytest.fixture
def flat():
    """Three gray photographs that any check of arrays takes, as keyword arguments."""
    return {
        "images": np.full((3, 12, 16), 100, np.uint8),
        "K": np.array([[20.0, 0, 8], [0, 20, 6], [0, 0, 1]]),
        "R": np.tile(np.eye(3), (3, 1, 1)),
        "t": np.array([[-0.2 * i, 0, 3] for i in range(3)]),
        "bounds": [-1, -1, -1, 1, 1, 1],
    }


def program(*words):
    """Runs the program quorum."""
    done = subprocess.run([os.environ["QUORUM_PROGRAM"], *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def write_png(path, image):
    """A gray image (height, width) as a file."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", image.shape[1], image.shape[0], 8, 0, 0, 0, 0)
    rows = np.pad(image, ((0, 0), (1, 0)))  # each begins with its filter: none
    chunks = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunks)


def write_scene(folder, ball):
    """The ball in Middlebury's format, with masks in a folder beside it."""
    masks = folder.parent / "masks"
    for made in (folder, masks):
        made.mkdir()
    lines = [str(len(ball.images))]
    for i, image in enumerate(ball.images):
        name = f"ball{i}.png"
        write_png(folder / name, image)
        write_png(masks / name, np.where(ball.masks[i], 255, 0).astype(np.uint8))
        numbers = np.concatenate([ball.K.ravel(), ball.R[i].ravel(), ball.t[i]])
        lines.append(" ".join([name, *(repr(float(number)) for number in numbers)]))
    (folder / "ball_par.txt").write_text("\n".join(lines) + "\n")
    return masks


def read_pfm(path):
    """The values of a PFM file, row by row from the top."""
    kind, size, scale, values = path.read_bytes().split(b"\n", 3)
    assert float(scale) < 0
    width, height = map(int, size.split())
    shape = (height, width, 3) if kind == b"PF" else (height, width)
    return np.frombuffer(values, "<f4").reshape(shape)[::-1]


def read_ply(path):
    """The vertices, as a structured array, and the faces of a mesh of the program."""
    header, values = path.read_bytes().split(b"end_header\n", 1)
    types = {"float": "<f4", "double": "<f8", "uchar": "u1"}
    fields, counts = [], {}
    for line in header.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            fields.append((words[2], types[words[1]]))
    vertices = np.frombuffer(values, np.dtype(fields), counts["vertex"])
    face = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
    return vertices, np.frombuffer(values, face, counts["face"], vertices.nbytes)["corners"]
