"""A ball on a turntable, photographed by a camera that stands still: arrays in, arrays out.

    python3 turntable.py [OUT]        OUT/mesh.npz and OUT/depth.npz take what comes out
"""
import sys
from pathlib import Path

import numpy as np

import quorum

VIEWS = 8
WIDTH, HEIGHT = 160, 120  # pixels
FOCAL = 200.0  # pixels
DISTANCE = 4.0  # from the camera to the middle of the ball, whose radius is 1
STEP = 0.2  # radians from a photograph to the next

K = np.array([[FOCAL, 0, WIDTH / 2], [0, FOCAL, HEIGHT / 2], [0, 0, 1]])


def noise(points, frequency):
    """Smooth noise at points (n, 3), 0 to 1: the texture of the ball."""
    scaled = points * frequency
    cell = np.floor(scaled).astype(np.int64)
    part = scaled - cell
    total = np.zeros(len(points))
    for corner in np.ndindex(2, 2, 2):
        x, y, z = ((cell + corner) & 0xFFFF).T
        mixed = (x * 73856093 ^ y * 19349663 ^ z * 83492791) & 0xFFFFFFFF
        mixed = ((mixed ^ mixed >> 13) * 1274126177) & 0xFFFFFFFF
        weight = np.prod(np.where(corner, part, 1 - part), axis=1)
        total += weight * (mixed >> 8 & 0xFFFF) / 65535
    return total


def photograph(rotation):
    """The ball, turned: an image (HEIGHT, WIDTH) and a mask of where the ball is."""
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    rays = np.stack([(x - WIDTH / 2) / FOCAL, (y - HEIGHT / 2) / FOCAL, np.ones(x.shape)], axis=-1)
    norm = (rays**2).sum(axis=-1)
    root = DISTANCE**2 - norm * (DISTANCE**2 - 1)
    mask = root >= 0
    depth = (DISTANCE - np.sqrt(root[mask])) / norm[mask]
    on_ball = (rays[mask] * depth[:, None] - [0, 0, DISTANCE]) @ rotation  # in the frame of the ball
    image = np.zeros((HEIGHT, WIDTH), np.uint8)
    image[mask] = 255 * (0.5 * noise(on_ball, 7) + 0.5 * noise(on_ball, 15))
    return image, mask


def turned(angle):
    """Camera from world, where the world is the ball's."""
    return np.array([[np.cos(angle), 0, -np.sin(angle)], [0, 1, 0], [np.sin(angle), 0, np.cos(angle)]])


def arrays():
    """images, K, R, t and masks of the turntable."""
    rotations = [turned(STEP * i) for i in range(VIEWS)]
    images, masks = zip(*(photograph(rotation) for rotation in rotations))
    return images, K, np.array(rotations), np.tile([0, 0, DISTANCE], (VIEWS, 1)), masks


def main():
    images, intrinsics, rotations, translations, masks = arrays()
    box = [[-1.1, -1.1, -1.1], [1.1, 1.1, 1.1]]
    scene = quorum.Scene.from_arrays(images, intrinsics, rotations, translations, masks=masks, bounds=box)
    results = quorum.reconstruct(scene, neighbors=4, min_component=0, on_note=print)

    map_of_view = results.depth_map(3)
    found = map_of_view.depth > 0
    print(f"view 3: {found.sum()} of {masks[3].sum()} pixels of the ball have a depth")
    print(f"depth in the middle {map_of_view.depth[HEIGHT // 2, WIDTH // 2]:.3f}; the truth is 3")

    mesh = results.mesh()
    off = np.abs(np.linalg.norm(mesh.vertices, axis=1) - 1)
    print(f"{len(mesh.faces)} triangles; vertices are {off.mean():.4f} off the ball of radius 1 in the mean")
    if len(sys.argv) > 1:
        out = Path(sys.argv[1])
        out.mkdir(parents=True, exist_ok=True)
        np.savez(out / "mesh.npz", vertices=mesh.vertices, faces=mesh.faces, colors=mesh.colors)
        np.savez(out / "depth.npz", depth=map_of_view.depth, normal=map_of_view.normal, certainty=map_of_view.certainty)


if __name__ == "__main__":
    main()
