"""Pictures: coverage, light, shadows, background, and agreement of the backends."""

import numpy as np
import pytest
from rendering_surfaces import box, joined, quad, sphere, upright

from popsim.errors import InputError
from popsim.rendering import opengl
from popsim.rendering.camera import Camera
from popsim.rendering.picture import render_picture

SIZE = (160, 120)


def above(height=12.0, **options):
    """Look straight down, parallel rays, x to the right."""
    return Camera(np.array([5, 5, 50.0]), np.array([5, 5, 0.0]), np.array([0, 1.0, 0]), height, False, **options)


def model():
    rng = np.random.default_rng(4)
    texture = np.kron(rng.integers(0, 256, (8, 8, 4)), np.ones((16, 16, 1))).astype(np.uint8)
    texture[..., 3] = 255
    texture[50:90, 50:90, 3] = 0
    tile = quad([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]], texture=texture)
    return joined(
        tile, box([2, 2, 0.5], [5, 5, 4], colour=[0.9, 0.3, 0.2, 1]), sphere(1.5, colour=[0.2, 0.4, 0.9, 1])
    )


def test_a_face_towards_the_eye_almost_keeps_its_colour():
    pixels = render_picture(upright(colour=[0.8, 0.4, 0.2, 1]), above(), SIZE).pixels
    np.testing.assert_allclose(pixels[60, 80, :3], [204, 102, 51], rtol=0.12)


def test_borders_are_smooth_and_cover_the_right_area():
    square = upright(low=(1.03, 1.03), high=(9.03, 9.03), colour=[0.5, 0.5, 1, 1])
    pixels = render_picture(square, above(), SIZE, background=None, samples=4).pixels
    area = (pixels[..., 3] / 255).sum() * (12 / 120) ** 2
    assert area == pytest.approx(64, rel=0.005)
    assert len(np.unique(pixels[..., 3])) > 2


def test_background():
    corner = {name: render_picture(upright(), above(), SIZE, background=b).pixels[0, 0].tolist()
              for name, b in {"none": None, "rgb": (10, 20, 30), "rgba": (10, 20, 30, 128)}.items()}  # fmt: skip
    assert corner == {"none": [0, 0, 0, 0], "rgb": [10, 20, 30, 255], "rgba": [10, 20, 30, 128]}


def test_a_plate_throws_a_shadow_on_the_plate_below():
    plates = joined(upright(), upright(3.0, low=(3, 3), high=(7, 7), colour=[1, 0, 0, 1]))
    lit, shadowed = (render_picture(plates, above(), SIZE, shadows=s).pixels.astype(int) for s in (False, True))
    change = (lit - shadowed)[..., 1]
    below, beside = change[75, 105], change[20, 30]  # the light comes from the upper left
    assert below > 40
    assert beside < 15


def test_holes_let_light_through():
    ground = upright(colour=[0.3, 0.8, 0.5, 1])
    glass = joined(ground, upright(3.0, low=(3, 3), high=(7, 7), colour=[1, 0, 0, 0.2]))
    one, two = (render_picture(s, above(), SIZE).pixels.astype(int) for s in (glass, ground))
    assert np.abs(one - two).max() <= 2  # the tolerances follow the size of the scene


def test_either_side_of_a_face_is_lit_alike():
    front, back = upright(), quad([[0, 10, 0], [10, 10, 0], [10, 0, 0], [0, 0, 0]])
    np.testing.assert_array_equal(*(render_picture(s, above(), SIZE).pixels for s in (front, back)))


def test_lines_darken_borders_only():
    plain, lined = (render_picture(upright(), above(), SIZE, lines=x).pixels.astype(int) for x in (False, True))
    darker = (plain - lined)[..., 0] > 30
    assert darker[:, 80].nonzero()[0].tolist() == [10, 109]


def test_a_picture_is_the_same_every_time():
    camera = Camera.looking_at(model().bounds)
    one, two = (render_picture(model(), camera, SIZE, lines=True).pixels.tobytes() for _ in range(2))
    assert one == two


def test_perspective_makes_near_things_larger():
    camera = Camera(np.array([0, 0, 10.0]), np.zeros(3), np.array([0, 1.0, 0]), 10.0)
    near = render_picture(upright(5.0, low=(-1, -1), high=(1, 1)), camera, SIZE, background=None).pixels
    assert near[60, :, 3].astype(bool).sum() == pytest.approx(2 * 2 * 12, abs=1)


def test_refusals(monkeypatch):
    with pytest.raises(InputError, match="auto, rays, opengl"):
        render_picture(upright(), above(), SIZE, backend="magic")
    with pytest.raises(InputError, match="positive"):
        render_picture(upright(), above(), (0, 5))
    monkeypatch.setattr(opengl, "opengl_missing", lambda: "no driver")
    with pytest.raises(InputError, match="no driver"):
        render_picture(upright(), above(), SIZE, backend="opengl")
    assert render_picture(upright(), above(), SIZE, backend="auto").backend == "rays"


@pytest.mark.parametrize("field", [0.0, 30.0])
@pytest.mark.parametrize(("shadows", "lines"), [(False, False), (True, True)])
def test_opengl_agrees_with_rays(field, shadows, lines):
    missing = opengl.opengl_missing()
    if missing:
        pytest.skip(f"OpenGL is not here: {missing}")
    camera = Camera.looking_at(model().bounds, 30, 40, field)
    looks = {"background": None, "shadows": shadows, "lines": lines}
    rays, gl = (render_picture(model(), camera, (320, 240), backend=b, **looks) for b in ("rays", "auto"))
    assert (rays.backend, gl.backend) == ("rays", "opengl")
    one, two = rays.pixels[..., 3] > 127, gl.pixels[..., 3] > 127
    assert (one & two).sum() / (one | two).sum() > 0.99
    apart = np.abs(rays.pixels.astype(int) - gl.pixels)[one & two]
    assert apart.mean() < 3.0
    flipped = np.abs(rays.pixels.astype(int) - gl.pixels[:, ::-1])[one & two[:, ::-1]]
    assert flipped.mean() > 20.0  # the measure can tell pictures apart


def test_shadows_fade_without_bands():
    plates = joined(upright(), upright(2.0, low=(-5, 3), high=(15, 20)))
    pixels = render_picture(plates, above(10.0), (400, 300)).pixels.astype(float)
    profile = pixels[215:, 200, 1]  # from under the plate into the light
    assert np.ptp(profile) > 40
    assert len(np.unique(profile)) > 25
    assert (np.diff(profile) >= -1).all() and np.diff(profile).max() <= 8


def test_a_floor_shows_shadows_and_nothing_else():
    plate = upright(3.0, low=(3, 3), high=(7, 7), colour=[1, 0, 0, 1])
    bare, floored = (
        render_picture(plate, above(24.0), SIZE, background=None, floor=z).pixels.astype(int) for z in (None, 0.0)
    )
    plate_seen = bare[..., 3] == 255
    assert np.abs(bare - floored)[plate_seen].max() <= 1
    caught = floored[..., 3][~plate_seen & (bare[..., 3] == 0)]
    assert caught.max() > 60
    assert floored[2, 2, 3] < 12
    assert (floored[..., :3][(bare[..., 3] == 0) & (floored[..., 3] > 0)] == 0).all()


def test_a_floor_behind_the_eye_is_not_seen():
    pixels = render_picture(upright(low=(2, 2), high=(8, 8)), above(), SIZE, background=None, floor=60.0).pixels
    assert (pixels[:5, :, 3] == 0).all()
