"""The rules of the format that a schema cannot say. Each breach names the field."""

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath, PureWindowsPath
from typing import TYPE_CHECKING

import numpy as np

from popsim.design.model import BACKDROP_ID, GROUND_ID, Card, Design, Hinge, Patch
from popsim.errors import DesignError, GeometryError
from popsim.geometry.plane import line_distance

if TYPE_CHECKING:
    from shapely import Polygon

PLANAR = 0.01
"""mm; how far points of a patch or ends of a hinge may lie off its plane: room for hand-written decimals."""

SHORTEST = 0.01
"""mm; a hinge or an edge below this is no line."""

LARGEST = 1e6
"""mm; no coordinate is beyond a kilometre, where nanometres would be lost."""

SMALLEST = 1e-4
"""mm^2; an outline below this is no patch."""

TOUCHING = 0.05
"""mm; how far a hinge may lie beside the outline of its patch."""

COPLANAR = 1e-6
"""1 - |cos| below which two patches lie in one plane (0.08 degrees)."""


def check_rules(design: Design) -> None:
    """Raise DesignError at the first rule that `design` breaks."""
    _unique("patches", (patch.id for patch in design.patches))
    _unique("hinges", (hinge.id for hinge in design.hinges))
    _unique("mechanisms", (mechanism.id for mechanism in design.mechanisms))
    if not design.card.x[0] < design.card.x[1]:
        raise DesignError(f"card.x: the first number must be below the second, not {list(design.card.x)}")
    _check_size(design)
    polygons = {
        patch.id: _checked_polygon(f"patches[{index}] ({patch.id})", patch)
        for index, patch in enumerate(design.patches)
    }
    _check_pages(design)
    for index, hinge in enumerate(design.hinges):
        _check_hinge(f"hinges[{index}] ({hinge.id})", hinge, design, polygons)
    _check_repeats(design.hinges)
    _check_mechanisms(design)
    _check_order(design)
    _check_reachable(design)


def coplanar(first: Patch, second: Patch) -> bool:
    """Whether two patches that share a hinge lie in one plane in the open pose."""
    return 1 - abs(float(first.plane.normal @ second.plane.normal)) < COPLANAR


def _unique(field: str, ids: Iterable[str]) -> None:
    repeated = [name for name, count in Counter(ids).items() if count > 1]
    if repeated:
        raise DesignError(f"{field}: the id {repeated[0]!r} is used more than once; ids must be unique")


def _check_size(design: Design) -> None:
    lengths = {"card": np.array([*design.card.x, design.card.depth, design.card.thickness])}
    for index, patch in enumerate(design.patches):
        lengths[f"patches[{index}] ({patch.id})"] = np.concatenate([patch.points, *patch.hole_points])
    for index, hinge in enumerate(design.hinges):
        lengths[f"hinges[{index}] ({hinge.id})"] = hinge.points
    for field, numbers in lengths.items():
        largest = float(np.abs(numbers).max())
        if largest > LARGEST:
            raise DesignError(f"{field}: {largest:.3g} mm is beyond the {LARGEST:g} mm that a design may reach")


def _checked_polygon(field: str, patch: Patch) -> "Polygon":
    """The patch in flat coordinates, once its outline, holes and texture have been found in order."""
    from shapely import is_valid_reason

    if len(patch.points) > 1 and (np.ptp(patch.points, axis=0).max() < SHORTEST):
        raise DesignError(f"{field}.outline: encloses no area; give at least three points not on one line")
    try:
        plane = patch.plane
    except GeometryError as error:
        raise DesignError(f"{field}.outline: {error}") from None
    for name, ring in [("outline", patch.points), *((f"holes[{k}]", h) for k, h in enumerate(patch.hole_points))]:
        off = float(np.abs(plane.distance(ring)).max())
        if off > PLANAR:
            raise DesignError(f"{field}.{name}: not planar, a point is {off:.3g} mm off; patches are flat")
    outline = plane.polygon(patch.points)
    if not outline.is_valid:
        raise DesignError(f"{field}.outline: not a simple polygon ({is_valid_reason(outline)})")
    if outline.area < SMALLEST:
        raise DesignError(f"{field}.outline: encloses {outline.area:.2g} mm^2; at least {SMALLEST:g} is needed")
    polygon = plane.polygon(patch.points, patch.hole_points)
    if not polygon.is_valid:
        raise DesignError(f"{field}.holes: {is_valid_reason(polygon)}; holes lie inside the outline, apart")
    _check_texture(field, patch.texture)
    return polygon


def _check_texture(field: str, texture: str | None) -> None:
    if texture is None:
        return
    if "\0" in texture or not PurePosixPath(texture).name:
        raise DesignError(
            f"{field}.texture: {texture!r} names no file; give a path within the design's folder or null"
        )
    for path in (PurePosixPath(texture), PureWindowsPath(texture)):
        if path.is_absolute() or path.drive or ".." in path.parts:
            raise DesignError(
                f"{field}.texture: {texture!r} leads out of the design's folder; give a path within it"
            )


def _check_pages(design: Design) -> None:
    for page, sign in ((GROUND_ID, 1), (BACKDROP_ID, -1)):
        patch = design.patch_by_id.get(page)
        if patch is None:
            raise DesignError(f'patches: there is no patch with the id "{page}"; ground and backdrop are required')
        if np.abs(patch.points[:, 2]).max() > PLANAR or (patch.points[:, 1] * sign).min() < -PLANAR:
            half = "y >= 0" if sign > 0 else "y <= 0"
            raise DesignError(f"patches ({page}).outline: must lie in the half plane z = 0, {half} (open pose)")
        _check_within_card(patch, design.card)
    pages = {GROUND_ID, BACKDROP_ID}
    central = [hinge for hinge in design.hinges if set(hinge.patches) == pages]
    if len(central) != 1:
        raise DesignError(f"hinges: ground and backdrop need exactly one central fold, found {len(central)}")
    if np.abs(central[0].points[:, 1:]).max() > PLANAR:
        raise DesignError(f"hinges ({central[0].id}).axis: the central fold lies on the x axis (y = z = 0)")
    wrong = [hinge.id for hinge in design.hinges if (hinge.kind == "central") != (set(hinge.patches) == pages)]
    if wrong:
        raise DesignError(f'hinges ({wrong[0]}).kind: "central" is for the fold between "G" and "B" only')


def _check_within_card(page: Patch, card: Card) -> None:
    """A page may be cut smaller than the card, but not reach out of it."""
    along = max(card.x[0] - page.points[:, 0].min(), page.points[:, 0].max() - card.x[1])
    away = np.abs(page.points[:, 1]).max() - card.depth
    for field, beyond in (("x", along), ("depth", away)):
        if beyond > PLANAR:
            raise DesignError(
                f"card.{field}: the outline of {page.id} reaches {beyond:.3g} mm out of the card; both pages lie "
                "within card.x, and reach from the fold at most to card.depth"
            )


def _check_hinge(field: str, hinge: Hinge, design: Design, polygons: Mapping[str, "Polygon"]) -> None:
    if hinge.patches[0] == hinge.patches[1]:
        raise DesignError(f"{field}.patches: joins {hinge.patches[0]!r} to itself; name two patches")
    for name in hinge.patches:
        if name not in design.patch_by_id:
            raise DesignError(f"{field}.patches: there is no patch {name!r}")
    if hinge.length < SHORTEST:
        raise DesignError(f"{field}.axis: its ends are {hinge.length:.3g} mm apart; give two different points")
    first, second = (design.patch_by_id[name] for name in hinge.patches)
    for patch in (first, second):
        off = float(np.abs(patch.plane.distance(hinge.points)).max())
        if off > PLANAR:
            raise DesignError(
                f"{field}.axis: lies {off:.3g} mm off the plane of {patch.id}; hinges lie in both patches"
            )
        if not _touches(hinge, patch, polygons[patch.id]):
            raise DesignError(
                f"{field}.axis: runs beside {patch.id} without touching it; hinges lie on both patches"
            )
    _check_crease(field, hinge, first, second)


def _touches(hinge: Hinge, patch: Patch, polygon: "Polygon") -> bool:
    """Whether some of the axis lies within TOUCHING of the patch; asked of its middle first, which is quick."""
    from shapely import LineString

    axis = LineString(patch.plane.flat(hinge.points))
    if polygon.distance(axis.centroid) <= TOUCHING / 2:
        return True
    return bool(polygon.buffer(TOUCHING).intersection(axis).length > SHORTEST)


def _check_crease(field: str, hinge: Hinge, first: Patch, second: Patch) -> None:
    flat = coplanar(first, second)
    if hinge.crease is None:
        if flat and hinge.kind != "central":
            raise DesignError(
                f"{field}.crease: {first.id} and {second.id} lie in one plane; say to which side the crease bulges"
            )
        return
    if not flat:
        raise DesignError(f"{field}.crease: must be null, {first.id} and {second.id} do not lie in one plane")
    crease = np.array(hinge.crease)
    if abs(np.linalg.norm(crease) - 1) > 1e-3 or 1 - abs(crease @ first.plane.normal) > 1e-3:
        raise DesignError(f"{field}.crease: must be a unit normal of the two patches, not {list(hinge.crease)}")


def _check_repeats(hinges: tuple[Hinge, ...]) -> None:
    seen: dict[frozenset[str], list[Hinge]] = {}
    for hinge in hinges:
        key = frozenset(hinge.patches)
        for known in seen.setdefault(key, []):
            if line_distance(hinge.points, known.points).max() > PLANAR:
                raise DesignError(
                    f"hinges ({known.id}, {hinge.id}).axis: {' and '.join(hinge.patches)} share two different "
                    "lines; two rigid patches turn about one line"
                )
            along = (known.points - known.points[0]) @ (known.points[1] - known.points[0]) / known.length
            other = (hinge.points - known.points[0]) @ (known.points[1] - known.points[0]) / known.length
            if min(along.max(), other.max()) - max(along.min(), other.min()) > SHORTEST:
                raise DesignError(f"hinges ({known.id}, {hinge.id}): the same hinge is listed twice")
        seen[key].append(hinge)


def _check_mechanisms(design: Design) -> None:
    owner: dict[str, str] = {}
    for index, mechanism in enumerate(design.mechanisms):
        field = f"mechanisms[{index}] ({mechanism.id})"
        for kind in ("base", "patches"):
            for patch in getattr(mechanism, kind):
                if patch not in design.patch_by_id:
                    raise DesignError(f"{field}.{kind}: there is no patch {patch!r}")
        if mechanism.base[0] == mechanism.base[1]:
            raise DesignError(
                f"{field}.base: names {mechanism.base[0]!r} twice; a mechanism stands on two patches"
            )
        for patch in mechanism.patches:
            if patch in owner or patch in (GROUND_ID, BACKDROP_ID):
                raise DesignError(f"{field}.patches: {patch!r} belongs to {owner.get(patch, 'the card')} already")
            owner[patch] = mechanism.id
        if set(mechanism.base) & set(mechanism.patches):
            raise DesignError(f"{field}.base: a mechanism cannot stand on its own patches")
        if mechanism.closing_range and not mechanism.closing_range[0] <= mechanism.closing_range[1]:
            raise DesignError(f"{field}.closing_range: the first number must not exceed the second")
    for position, piece in enumerate(design.patches):
        if piece.mechanism is not None and owner and owner.get(piece.id) != piece.mechanism:
            raise DesignError(
                f"patches[{position}] ({piece.id}).mechanism: {piece.mechanism!r} does not list it under patches"
            )


def _check_order(design: Design) -> None:
    """No mechanism stands on itself by way of others."""
    stands_on = {m.id: {design.owner[base] for base in m.base if base in design.owner} for m in design.mechanisms}
    settled: set[str] = set()
    while free := [name for name, hosts in stands_on.items() if name not in settled and hosts <= settled]:
        settled.update(free)
    for index, mechanism in enumerate(design.mechanisms):
        if mechanism.id not in settled:
            raise DesignError(
                f"mechanisms[{index}] ({mechanism.id}).base: it stands on itself by way of "
                f"{', '.join(sorted(stands_on[mechanism.id]))}; let each stand on the card or on an earlier one"
            )


def _check_reachable(design: Design) -> None:
    reached, frontier = {GROUND_ID, BACKDROP_ID}, [GROUND_ID, BACKDROP_ID]
    while frontier:
        for hinge in design.hinges_by_patch[frontier.pop()]:
            for name in hinge.patches:
                if name not in reached:
                    reached.add(name)
                    frontier.append(name)
    for index, patch in enumerate(design.patches):
        if patch.id not in reached:
            raise DesignError(
                f"patches[{index}] ({patch.id}): no hinges lead to it from ground or backdrop; join or remove it"
            )
