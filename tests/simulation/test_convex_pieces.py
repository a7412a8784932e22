"""Convex pieces cover a patch and nothing else."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import Point, Polygon
from shapely.ops import unary_union

from popsim.design import Patch
from popsim.simulation.pieces import convex_pieces

STAIRS = [(0, 0), (6, 0), (6, 1), (4, 1), (4, 2), (2, 2), (2, 3), (0, 3)]
WINDOW = [(0.5, 0.5), (1.5, 0.5), (1.5, 1.5), (0.5, 1.5)]


def patch(outline, *holes) -> Patch:
    return Patch(
        id="P",
        outline=tuple((float(x), 1.0, float(z)) for x, z in outline),
        holes=tuple(tuple((float(x), 1.0, float(z)) for x, z in hole) for hole in holes),
    )


def flat(piece) -> Polygon:
    return Polygon(piece[:, [0, 2]])


@pytest.mark.parametrize("shape", [patch(STAIRS), patch(STAIRS, WINDOW), patch([*STAIRS[:3], (0, 1)])])
def test_pieces_are_convex_and_cover_the_patch(shape):
    pieces = [flat(piece) for piece in convex_pieces(shape)]
    assert all(piece.equals(piece.convex_hull) for piece in pieces)
    whole = Polygon(shape.points[:, [0, 2]], [hole[:, [0, 2]] for hole in shape.hole_points])
    assert unary_union(pieces).symmetric_difference(whole).area < 1e-9


def test_a_convex_patch_is_one_piece():
    assert len(convex_pieces(patch([(0, 0), (4, 0), (4, 3), (0, 3)]))) == 1


def test_inner_edges_lie_inside_some_piece():
    """Else a plate that cuts exactly along one would touch two pieces and cross none."""
    shape = patch(STAIRS, WINDOW)
    pieces = [flat(piece) for piece in convex_pieces(shape)]
    whole = Polygon(shape.points[:, [0, 2]], [hole[:, [0, 2]] for hole in shape.hole_points])
    for piece in pieces:
        ring = np.array(piece.exterior.coords)
        for start, end in pairwise(ring):
            middle = Point((start + end) / 2)
            if whole.boundary.distance(middle) > 1e-6:
                assert any(other.contains(middle) for other in pieces)


@given(st.lists(st.floats(1, 10), min_size=5, max_size=24))
def test_stars_of_any_shape(radii):
    angles = np.linspace(0, 2 * np.pi, len(radii), endpoint=False)
    star = patch([(r * np.cos(a), r * np.sin(a)) for r, a in zip(radii, angles, strict=True)])
    pieces = [flat(piece) for piece in convex_pieces(star)]
    assert unary_union(pieces).symmetric_difference(Polygon(star.points[:, [0, 2]])).area < 1e-6
