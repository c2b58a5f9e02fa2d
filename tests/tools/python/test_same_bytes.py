"""Runs by the module give what the program gives."""
import numpy as np
import pytest
from conftest import BOX, OPTIONS, program, read_pfm, read_ply, write_scene

import quorum


@pytest.fixture(scope="module")
def made_by_program(ball, tmp_path_factory):
    """The folders of the scene, its masks, and the program's results."""
    folder = tmp_path_factory.mktemp("program")
    masks = write_scene(folder / "scene", ball)
    flags = [word for name, value in OPTIONS.items() for word in ("--" + name.replace("_", "-"), value)]
    program("reconstruct", folder / "scene", "-o", folder / "out", "--masks", masks, "--bounds", *BOX, *flags)
    return folder / "scene", masks, folder / "out"


def assert_same(results, out):
    for view in results.scene.views:
        maps = results.depth_map(view.name)
        assert (maps.depth > 0).sum() > 1000
        for name in ("depth", "normal", "confidence", "certainty", "correlation"):
            # All bytes, so that signs of zeros count, too.
            expected = read_pfm(out / "depth" / f"{view.name}.{name}.pfm")
            assert getattr(maps, name).tobytes() == expected.tobytes(), (view.name, name)
    mesh = results.mesh()
    vertices, faces = read_ply(out / "mesh.ply")
    assert len(faces) > 1000
    assert np.array_equal(mesh.faces, faces)
    assert np.array_equal(mesh.confidence, vertices["confidence"])
    for array, names in ((mesh.vertices, "x y z"), (mesh.normals, "nx ny nz"), (mesh.colors, "red green blue")):
        for column, name in enumerate(names.split()):
            assert np.array_equal(array[:, column], vertices[name]), name


def test_arrays_give_the_bytes_of_the_program(ball, results, made_by_program):
    named = ball.scene(masks=ball.masks, names=[f"ball{i}.png" for i in range(6)])
    assert [view.name for view in named.views] == [f"ball{i}" for i in range(6)]
    assert_same(quorum.reconstruct(named, **OPTIONS), made_by_program[2])


def test_files_give_the_bytes_of_the_program(made_by_program, tmp_path):
    folder, masks, out = made_by_program
    results = quorum.reconstruct(folder, tmp_path / "kept", masks=masks, bounds=BOX, **OPTIONS)
    assert results.folder == tmp_path / "kept"
    assert (tmp_path / "kept" / "mesh.ply").read_bytes() == (out / "mesh.ply").read_bytes()
    assert_same(results, out)
    assert results.report()["options"]["neighbors"] == 3


def test_what_the_program_left_is_opened(made_by_program, ball):
    folder, masks, out = made_by_program
    scene = quorum.Scene.read(str(folder), masks=masks, bounds=BOX)
    assert_same(quorum.Results.open(scene, out), out)
    with pytest.raises(quorum.Error, match="no such folder") as caught:
        quorum.Results.open(scene, out / "absent")
    assert caught.value.kind == quorum.ErrorKind.INPUT
