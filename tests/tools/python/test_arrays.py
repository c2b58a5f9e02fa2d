"""Arrays: what is taken, what is refused, what comes out."""
import contextlib
import gc

import numpy as np
import pytest

import quorum
from quorum import ErrorKind


@contextlib.contextmanager
def refused(match, kind=ErrorKind.INPUT):
    """A quorum.Error of this kind, in one line."""
    with pytest.raises(quorum.Error, match=match) as caught:
        yield
    assert caught.value.kind == kind
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "name, value, match",
    [
        ("images", np.zeros((2, 12, 16), np.uint8), "K|R|t|views"),
        ("images", np.zeros((3, 12, 16), np.float32), r"images\[0\]: holds float32; give uint8"),
        ("images", np.full((3, 12, 16), np.nan), r"images\[0\]: holds float64"),
        ("images", np.zeros((3, 16), np.uint8), r"images\[0\]: has shape \(16,\)"),
        ("images", np.zeros((3, 12, 16, 4), np.uint8), r"images\[0\]: has shape \(12, 16, 4\)"),
        ("images", np.zeros((3, 0, 16), np.uint8), "16 x 0 pixels"),
        ("images", [np.zeros((12, 16), np.uint8)] * 2 + [None], r"images\[2\]: holds object"),
        ("images", 5, "images: is no sequence"),
        ("K", np.eye(4), r"K: has shape \(4, 4\); give"),
        ("K", np.full((3, 3), np.nan), "view0001"),
        ("K", "wide", "K: is no array of numbers"),
        ("R", np.eye(3), r"R: has shape \(3, 3\)"),
        ("R", np.full((3, 3, 3), np.inf), "view0001"),
        ("R", np.zeros((3, 3, 3)), "view0001"),
        ("t", np.full((3, 3), np.nan), "view0001"),
        ("t", [[0, 0, 3]] * 2, r"t: has shape \(2, 3\)"),
        ("masks", [None, None], "masks: has 2 items; give 3"),
        ("masks", [np.ones((11, 16), bool)] * 3, "its mask is 16 x 11"),
        ("masks", [np.ones((12, 16), np.int32)] * 3, r"masks\[0\]: holds int32"),
        ("points", [[0, 0, np.nan]] * 4, "point 0: its position is not finite"),
        ("points", [[0, 0]], r"points: has shape \(1, 2\)"),
        ("point_views", [[0]], "point_views: needs points"),
        ("bounds", [0, 1, 2], "bounds: give x0"),
        ("bounds", [np.nan] * 6, "bounds"),
        ("depth_ranges", [3, 2], "depths go from 3 to 2"),
        ("depth_ranges", [np.nan, 2], "depths go from"),
        ("neighbor_lists", [[7], [], []], "neighbor 7 is no other view"),
        ("neighbor_lists", [["a"], [], []], r"neighbor_lists\[0\]"),
        ("names", ["a", "a", "b"], "a"),
        ("names", [1, 2, 3], r"names\[0\]: is no str"),
        ("names", ["a\n", "c", "b"], "control characters"),
    ],
)
def test_bad_arrays_are_named(flat, name, value, match):
    with refused(match):
        quorum.Scene.from_arrays(**{**flat, name: value})


def test_points_tell_the_views_that_see_them(flat):
    points = np.zeros((4, 3))
    assert len(quorum.Scene.from_arrays(**flat, points=points, point_views=[np.array([0, 1])] * 4)) == 3
    with refused("its views are not all from 0 to 2"):
        quorum.Scene.from_arrays(**flat, points=points, point_views=[[0, 3]] * 4)
    with refused("point_views: has 3 items; give 4"):
        quorum.Scene.from_arrays(**flat, points=points, point_views=[[0]] * 3)


def test_options_are_checked(flat):
    with refused("did you mean max-image-size", ErrorKind.USAGE):
        quorum.Scene.from_arrays(**flat, max_image_sise=100)
    with refused("neighbors 99", ErrorKind.USAGE):
        quorum.reconstruct(quorum.Scene.from_arrays(**flat), neighbors=99)
    with refused("format", ErrorKind.USAGE):
        quorum.Scene.from_arrays(**flat, format="colmap")
    with refused("no such", ErrorKind.NO_DEVICE):
        quorum.choose_device("no such")
    with pytest.raises(TypeError, match="neighbors"):
        quorum.reconstruct(quorum.Scene.from_arrays(**flat), neighbors={})
    names = {option.name for option in quorum.options()}
    assert {"voxel_size", "neighbors", "bounds", "fill_holes"} <= names
    assert quorum.devices()[0].option == "cpu"


def test_a_scene_is_what_was_given(flat):
    arrays = {**flat, "t": flat["t"][:, :, None].astype(np.float32), "names": ["x/a.png", "b.png", "c.png"]}
    scene = quorum.Scene.from_arrays(**arrays)
    assert len(scene) == len(scene.views) == 3
    view = scene.views[1]
    assert (view.image_name, view.width, view.height) == ("b.png", 16, 12)
    assert np.array_equal(view.K, flat["K"]) and np.array_equal(view.R, np.eye(3))
    assert np.allclose(view.t, flat["t"][1]) and view.t.shape == (3,)
    assert np.array_equal(scene.bounds, [[-1, -1, -1], [1, 1, 1]])


@pytest.mark.parametrize(
    "changed",
    [
        lambda images: images[:, ::-1, ::-1].copy()[:, ::-1, ::-1],  # both strides below zero
        lambda images: np.repeat(images, 2, axis=2)[:, :, ::2],  # pixels that do not lie together
        lambda images: np.asfortranarray(images),
        lambda images: np.repeat(images[..., None], 3, axis=3),  # gray as color
        lambda images: np.pad(images, ((0, 0), (0, 0), (0, 7)))[:, :, :160],  # rows with a margin
        list,
    ],
)
def test_any_layout_of_pixels_gives_the_same(ball, results, changed):
    again = quorum.Scene.from_arrays(changed(ball.images), ball.K, ball.R, ball.t, bounds=results.scene.bounds)
    found = quorum.reconstruct(again, mesh=False, device="cpu", neighbors=2, quality="draft").depth_map(2).depth
    expected = first_depth(ball)
    assert found.tobytes() == expected.tobytes()


def first_depth(ball, kept=[]):
    """View 2 of the ball as it is, with the options of the test above."""
    if not kept:
        kept.append(quorum.reconstruct(ball.scene(), mesh=False, device="cpu", neighbors=2, quality="draft"))
    return kept[0].depth_map(2).depth


def test_colors_come_in_both_orders(ball):
    color = np.stack([ball.images, np.roll(ball.images, 3, axis=2), 255 - ball.images], axis=3)
    run = {"device": "cpu", "neighbors": 2, "quality": "draft", "min_component": 0, "min_confidence": 0}
    rest = (ball.K, ball.R, ball.t)
    rgb = quorum.reconstruct(quorum.Scene.from_arrays(color, *rest, bounds=[-1.1] * 3 + [1.1] * 3), **run).mesh()
    bgr = quorum.Scene.from_arrays(color[..., ::-1], *rest, bounds=[-1.1] * 3 + [1.1] * 3, bgr=True)
    bgr = quorum.reconstruct(bgr, **run).mesh()
    assert np.array_equal(rgb.colors, bgr.colors) and np.array_equal(rgb.vertices, bgr.vertices)
    assert not np.array_equal(rgb.colors[:, 0], rgb.colors[:, 2])


def test_results_have_shapes_and_keep_their_owner(results):
    maps = results.depth_map(-1)
    assert (maps.width, maps.height) == (160, 120)
    shapes = {"depth": (120, 160), "normal": (120, 160, 3), "confidence": (120, 160), "certainty": (120, 160)}
    for name, shape in shapes.items():
        array = getattr(maps, name)
        assert array.shape == shape and array.dtype == np.float32
        assert array.base is maps and not array.flags.owndata  # no copy
    depth = maps.depth
    assert depth.ctypes.data == maps.depth.ctypes.data
    before = depth.copy()
    del maps, array
    gc.collect()
    assert np.array_equal(depth, before)
    found = depth > 0
    assert np.all(np.abs(np.linalg.norm(results.depth_map(5).normal[found], axis=1) - 1) < 1e-3)
    mesh = results.mesh()
    count = len(mesh.vertices)
    assert mesh.vertices.shape == mesh.normals.shape == mesh.colors.shape == (count, 3)
    assert mesh.confidence.shape == (count,) and mesh.faces.max() < count and mesh.faces.dtype == np.uint32
    assert mesh.colors.dtype == np.uint8 and np.array_equal(mesh.offset, np.zeros(3))
    assert np.abs(np.linalg.norm(mesh.vertices, axis=1) - 1).mean() < 0.01
    vertices = mesh.vertices
    assert vertices.base is mesh


def test_views_are_found_by_place_and_name(results):
    assert np.array_equal(results.depth_map("view0002").depth, results.depth_map(1).depth)
    assert results.has_depth_map(0) and results.has_depth_map("view0006")
    for wrong in (6, -7, 2**40):
        with pytest.raises(IndexError, match="the scene has 6"):
            results.depth_map(wrong)
    with pytest.raises(KeyError, match="view0009"):
        results.depth_map("view0009")


def test_arguments_of_another_type_are_type_errors(flat, results):
    scene = quorum.Scene.from_arrays(**flat)
    for call in (
        lambda: results.depth_map(1.5),
        lambda: results.has_depth_map(None),
        lambda: quorum.reconstruct(5),
        lambda: quorum.reconstruct(scene, neighbors=2**70),
        lambda: quorum.reconstruct(scene, tile=["wide", 3]),
        lambda: quorum.reconstruct(scene, "out", "mesh"),
        lambda: quorum.Scene.from_arrays(flat["images"]),
    ):
        with pytest.raises(TypeError):
            call()


def test_maps_that_were_not_written_are_none(ball):
    run = {"device": "cpu", "neighbors": 2, "quality": "draft", "maps": "least"}
    maps = quorum.reconstruct(ball.scene(), mesh=False, confirm=False, **run).depth_map(0)
    assert maps.depth is not None and maps.correlation is None and maps.certainty is None
