"""Orthographic maps: exact depth, texture registration, holes, slabs, borders, shading."""

import numpy as np
import pytest
from rendering_surfaces import box, joined, quad, sphere, surface, upright

from popsim.errors import InputError
from popsim.geometry.surface import Surface
from popsim.rendering.light import LINE
from popsim.rendering.maps import render_maps
from popsim.rendering.ray_scene import RayScene
from popsim.rendering.view import View

NOISE = np.random.default_rng(5)


def top(low=(0.0, 0.0), size=(10.0, 10.0), ppu=1.0, z=20.0):
    """Look down along -z, x to the right, depth 0 at height z."""
    return View(
        np.array([0, 0, 1.0]), np.array([0, 1.0, 0]), np.array([0, 0, z]), np.array(low), np.array(size), ppu
    )


def image(rows, columns):
    pixels = NOISE.integers(0, 256, (rows, columns, 4), dtype=np.uint8)
    pixels[..., 3] = 255
    return pixels


def test_depth_of_a_slanted_plane_is_exact():
    view = top(ppu=12.0)
    maps = render_maps(quad([[-1, -1, 0], [11, -1, 6], [11, 11, 9], [-1, 11, 3]]), view)
    x, y = np.moveaxis(view.pixel_centres(), -1, 0)
    height = 0.5 * (x + 1) + 0.25 * (y + 1)
    assert maps.mask.all()
    assert maps.depth.dtype == np.float64
    np.testing.assert_allclose(maps.depth, 20.0 - height, rtol=0, atol=1e-12)


def test_normals_are_unit_and_turned_to_the_eye():
    slope = np.array([-0.5, -0.25, 1.0])
    corners = [[-1, -1, 0], [11, -1, 6], [11, 11, 9], [-1, 11, 3]]
    for order in (corners, corners[::-1]):
        maps = render_maps(quad(order), top())
        assert maps.normal.dtype == np.float32
        np.testing.assert_allclose(maps.normal[3, 4], slope / np.linalg.norm(slope), atol=1e-7)


def test_nothing_seen():
    maps = render_maps(upright(), top(low=(100.0, 100.0)))
    assert not maps.mask.any()
    assert np.isposinf(maps.depth).all()
    assert (maps.face == -1).all()
    assert not maps.normal.any()
    assert not maps.colour.any()


def test_a_pixel_is_covered_if_its_centre_is():
    # the right border lies a quarter of a pixel beyond the centre of column 4, the upper one just short of row 2's
    maps = render_maps(upright(low=(1.0, 1.0), high=(4.75, 7.4)), top())
    covered = np.zeros((10, 10), dtype=bool)
    covered[3:9, 1:5] = True
    np.testing.assert_array_equal(maps.mask, covered)


def test_texel_for_pixel():
    texture = image(7, 5)
    maps = render_maps(upright(high=(5.0, 7.0), texture=texture), top(size=(5.0, 7.0)), shading="flat")
    np.testing.assert_array_equal(maps.colour, texture)


def test_texture_keeps_its_place_in_every_direction_of_view():
    texture = image(4, 4)
    wall = quad([[3, 0, 0], [3, 4, 0], [3, 4, 4], [3, 0, 4]], texture=texture)
    side = {"origin": np.zeros(3), "low": np.zeros(2), "size": np.full(2, 4.0), "pixels_per_unit": 1.0}
    front = View(eye=np.array([1.0, 0, 0]), up=np.array([0, 0, 1.0]), **side)
    np.testing.assert_array_equal(render_maps(wall, front).colour, texture)
    side["low"] = np.array([-4.0, 0.0])
    back = View(eye=np.array([-1.0, 0, 0]), up=np.array([0, 0, 1.0]), **side)
    np.testing.assert_array_equal(render_maps(wall, back).colour, texture[:, ::-1])


def test_texture_repeats():
    texture = image(2, 3)
    maps = render_maps(upright(high=(6.0, 4.0), texture=texture, repeat=2), top(size=(6.0, 4.0)))
    np.testing.assert_array_equal(maps.colour, np.tile(texture, (2, 2, 1)))


def test_texture_shifted_by_whole_tiles_is_the_same():
    texture = image(4, 4)
    plain = upright(high=(4.0, 4.0), texture=texture)
    shifted = Surface(plain.triangles, plain.uv + np.array([-3, 5]), plain.material, plain.materials)
    view = top(size=(4.0, 4.0), ppu=3.0)
    np.testing.assert_array_equal(render_maps(plain, view).colour, render_maps(shifted, view).colour)


def test_magnified_texture_is_bilinear_and_its_borders_do_not_mix():
    texture = np.zeros((1, 2, 4), dtype=np.uint8)
    texture[..., 3] = 255
    texture[0, 1, :3] = 200
    maps = render_maps(upright(high=(2.0, 1.0), texture=texture), top(size=(2.0, 1.0), ppu=4.0))
    np.testing.assert_array_equal(maps.colour[1, :, 0], [0, 0, 25, 75, 125, 175, 200, 200])


def test_many_texels_on_a_pixel_are_averaged():
    stripes = np.full((64, 64, 4), 255, dtype=np.uint8)
    stripes[:, ::2, :3] = 0
    maps = render_maps(upright(texture=stripes, high=(4.0, 4.0)), top(size=(4.0, 4.0)), shading="flat")
    assert np.ptp(maps.colour[..., 0]) <= 1
    assert abs(int(maps.colour[1, 1, 0]) - 128) <= 1


def test_corner_colours_are_interpolated_and_multiplied():
    colours = np.ones((2, 3, 4))
    colours[..., 0] = [[0, 1, 1], [0, 1, 0]]  # red grows with x
    maps = render_maps(upright(colours=colours, colour=[1, 0.4, 1, 1]), top(), shading="flat")
    np.testing.assert_allclose(maps.colour[4, :, 0], np.rint((np.arange(10) + 0.5) * 25.5), atol=1)
    assert (maps.colour[..., 1] == 102).all()


def test_holes_of_a_texture_show_what_lies_behind():
    fence = image(4, 4)
    fence[1:3, 1, 3] = 0
    scene = joined(
        upright(5.0, high=(4.0, 4.0), texture=fence), upright(2.0, high=(4.0, 4.0), colour=[1, 0, 0, 1])
    )
    maps = render_maps(scene, top(size=(4.0, 4.0)))
    hole = fence[..., 3] == 0
    np.testing.assert_allclose(maps.depth, np.where(hole, 18.0, 15.0))
    np.testing.assert_array_equal(maps.colour[hole], [[255, 0, 0, 255]] * 2)
    np.testing.assert_array_equal(maps.colour[~hole], fence[~hole])
    blind = render_maps(scene, top(size=(4.0, 4.0)), through_holes=False)
    assert np.allclose(blind.depth, 15.0)


def test_holes_are_found_in_the_part_of_the_texture_that_a_face_uses():
    half = image(8, 8)
    half[:, :4, 3] = 0
    whole = upright(high=(8.0, 8.0), texture=half)
    used = Surface(whole.triangles, whole.uv * [0.25, 1] + [0.7, 0], whole.material, whole.materials)
    assert RayScene(whole).paint.holed.all()
    assert not RayScene(used).paint.holed.any()


def test_slab():
    steps = joined(*(upright(float(z), low=(0, 0), high=(10, 10 - 2 * z)) for z in range(4)))
    view = top()
    assert render_maps(steps, view, near=17.5).depth[9, 0] == pytest.approx(18)
    inside = render_maps(steps, view, near=18.0, far=19.0)  # the planes themselves are seen
    assert inside.depth[9, 0] == pytest.approx(18)
    assert inside.depth[2, 0] == pytest.approx(19)
    assert not inside.mask[0].any()
    assert not render_maps(steps, view, near=17.1, far=17.9).mask.any()


def test_depth_may_lie_before_the_plane_of_the_view():
    assert render_maps(upright(5.0), top(z=0.0)).depth[0, 0] == pytest.approx(-5)


def test_a_scene_prepared_once_gives_the_same_bytes_as_the_surface():
    ball, view = sphere(4.0), top(low=(-5.0, -5.0), ppu=40.0)
    scene = RayScene(ball)
    render_maps(scene, top(ppu=3.0))
    for _ in range(2):
        one, two = render_maps(scene, view), render_maps(ball, view)
        for name in ("mask", "depth", "normal", "face", "colour"):
            assert getattr(one, name).tobytes() == getattr(two, name).tobytes()


def test_depth_of_a_sphere():
    view = top(low=(-5.0, -5.0), ppu=20.0)
    maps = render_maps(sphere(4.0, steps=100), view)
    x, y = np.moveaxis(view.pixel_centres(), -1, 0)
    inside = np.hypot(x, y) < 3.9
    np.testing.assert_allclose(maps.depth[inside], 20 - np.sqrt(16 - (x**2 + y**2)[inside]), atol=1e-2)
    np.testing.assert_allclose(maps.mask.mean(), np.pi * 16 / 100, rtol=4e-3)


def test_faces_are_indices_into_the_surface():
    maps = render_maps(box([0, 0, 0], [10, 10, 5]), top())
    assert set(np.unique(maps.face)) == {2, 3}  # the two triangles of the top
    assert maps.face.dtype == np.int32


def test_auto_shades_only_what_has_no_colours():
    view = top(low=(-1.0, -1.0), size=(12.0, 12.0), ppu=20.0)
    plain = box([0, 0, 0], [10, 10, 5])
    assert len(np.unique(render_maps(plain, view).colour[..., 0])) > 2
    assert set(np.unique(render_maps(plain, view, shading="flat").colour[..., 0])) == {0, 255}
    two = joined(box([0, 0, 0], [4, 4, 4], colour=[0, 1, 0, 1]), box([5, 5, 0], [9, 9, 4]))
    assert set(np.unique(render_maps(two, view).colour[..., 0])) == {0, 255}


def test_feature_lines_on_outline_step_and_crease_but_not_on_flat_joints():
    stairs = joined(box([0, 0, 0], [10, 10, 2]), box([5, 0, 0], [10, 10, 4]))
    maps = render_maps(stairs, top(low=(-1.0, -1.0), size=(12.0, 12.0), ppu=10.0))
    row = maps.colour[60, :, 0].astype(float)
    dark = np.flatnonzero((row < row.max() * (LINE + 0.1)) & maps.mask[60])
    np.testing.assert_array_equal(dark, [10, 59, 109])  # the step is drawn on its left pixel


def test_neutral_plain_models_become_warm_paper_and_coloured_ones_keep_their_hue():
    grey = render_maps(sphere(4.0, colour=[0.4, 0.4, 0.4, 1]), top(low=(-5.0, -5.0), ppu=10.0)).colour[50, 50]
    assert grey[0] > grey[2] > 180
    red = render_maps(sphere(4.0, colour=[0.8, 0.1, 0.1, 1]), top(low=(-5.0, -5.0), ppu=10.0)).colour[50, 50]
    assert red[0] > 4 * red[1]


def test_arrays_are_read_only():
    maps = render_maps(upright(), top())
    with pytest.raises(ValueError, match="read-only"):
        maps.depth[0, 0] = 1


def test_refusals():
    with pytest.raises(InputError, match="auto, flat, shaded"):
        render_maps(upright(), top(), shading="toon")
    with pytest.raises(InputError, match="swap"):
        render_maps(upright(), top(), near=3, far=2)


def test_a_real_model(shared_meshes):
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.load(shared_meshes / "bunny" / "bunny.obj", force="mesh")
    scene = RayScene(surface(mesh.triangles))
    view = View.framing(mesh.vertices, eye=(0, 0, 1), up=(0, 1, 0), pixels_per_unit=150)
    maps = render_maps(scene, view)
    origins = view.to_space(np.dstack([view.pixel_centres(), np.full(view.shape, -9.0)]).reshape(-1, 3))
    volume = scene.thickness(origins, -view.eye[None]).sum() * view.pixel**2
    assert volume == pytest.approx(mesh.volume, rel=1e-3)
    assert maps.mask.any(axis=0).all()
