"""The abstraction of a model: several greedy runs, the best of them refitted."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from popsim.design import Card
from popsim.errors import GeometryError, InputError, MeshError
from popsim.fitting.appearance import Appearance, Likeness
from popsim.fitting.candidate import Candidate, build
from popsim.fitting.greedy import Grower, Taste
from popsim.fitting.kept import first_candidate
from popsim.fitting.mapping import error_cover, mappings
from popsim.fitting.refit import Climber
from popsim.fitting.scale import scaled_node
from popsim.fitting.snap import Planes
from popsim.fitting.volume import Volume
from popsim.fitting.wishes import Wishes
from popsim.geometry.arrays import FloatArray
from popsim.mechanisms import Mechanism, Primitive

if TYPE_CHECKING:
    from popsim.rendering.ray_scene import RayScene

DEAREST, CHEAPEST = 0.03, 0.0008
"""Price of a patch as a share of the solid cells, at detail 0 and 1."""

UNLIKE, LIKE = 0.015, 0.00015
"""Likeness that a patch must bring, at detail 0 and 1."""

TASTES = ((1.0, 0.8, 0.6, 0), (0.4, 0.8, 0.6, 0), (0.5, 1.2, 0.9, 0), (0.4, 0.8, 0.3, 5))
"""Greedy runs: factor on the price of patches, price of empty cells, trust in what follows, and by how many cells
gaps are closed first: what a lattice or open arches enclose then counts as solid. The first runs twice: once with
any prism to start with, and, as the others do, with one that carries others."""

SECOND = (0.1, 0.8, 0.3)
"""The same for prisms that are added after refitting, where only the likeness decides."""

THINNEST = 0.03
"""Least extent of a prism or a step, as a share of the model's longest side: 4.5 mm on 150, for scissors."""

BUDGET = 70
"""Evaluations that refitting may use."""


@dataclass(frozen=True)
class FitSettings:
    """What the user may say about fitting.

    Attributes
    ----------
    detail:
        0 (few patches) to 1 (many).
    most_patches:
        No prism is placed that would lead to more, ground and backdrop not counted.
    wishes:
        What is kept, and what may not be.
    """

    detail: float = 0.5
    most_patches: int = 120
    wishes: Wishes = field(default_factory=Wishes)

    def __post_init__(self) -> None:
        if not 0 <= self.detail <= 1:
            raise InputError(f"detail must lie between 0 (few patches) and 1 (many), not {self.detail:g}")
        if self.most_patches < 2:
            raise InputError(f"no pop-up has fewer than 2 patches; most patches is {self.most_patches}")

    def taste(self, factor: float, empty: float, trust: float, *, founded: bool = False) -> Taste:
        """What a greedy run values: `factor` on the price of patches, price of empty cells, trust, and so on."""
        price = float(DEAREST * (CHEAPEST / DEAREST) ** self.detail)
        return Taste(factor * price, empty, trust, self.most_patches, founded)

    @property
    def patch_likeness(self) -> float:
        """Likeness that a patch must bring."""
        return float(UNLIKE * (LIKE / UNLIKE) ** self.detail)


@dataclass(frozen=True)
class Placement:
    """A primitive, the mechanism that represents it, and what else could have.

    Attributes
    ----------
    primitive, mechanism:
        The primitive and its mechanism.
    error_cover:
        Eq. 2.
    alternatives:
        Other mechanisms that could represent it: type and error_cover.
    """

    primitive: Primitive
    mechanism: Mechanism
    error_cover: float
    alternatives: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Fit:
    """The abstraction of a model.

    Attributes
    ----------
    candidate:
        Primitives and mechanisms; each stands on the card or on an earlier one.
    likeness:
        How much it looks like the model before contours are cut.
    closed_gap:
        Gaps up to this were taken as solid to find the shape, mm; 0 where none were.
    """

    candidate: Candidate
    likeness: Likeness
    closed_gap: float

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """All mechanisms, bases before what stands on them."""
        return self.candidate.mechanisms

    @property
    def placements(self) -> tuple[Placement, ...]:
        """Primitives with their mechanisms, and what else could have represented them."""
        return tuple(_placement(self.candidate, index) for index in range(len(self.candidate.nodes)))

    def without(self, names: Sequence[str]) -> "Fit | None":
        """The fit without some mechanisms and what stands on them, but for kept ones; None where none is left."""
        candidate: Candidate | None = self.candidate
        for index in reversed(range(len(self.mechanisms))):
            kept = self.candidate.nodes[index].kept is not None
            if self.mechanisms[index].id in names and candidate is not None and not kept:
                candidate = candidate.without(index)
        return None if candidate is None or not candidate.nodes else replace(self, candidate=candidate)

    def scaled(self, factor: float) -> "Fit":
        """The same fit `factor` times as large.

        Raises
        ------
        GeometryError
            Nothing is left at that size, or a mechanism is kept as it is.
        """
        if self.candidate.wishes.kept:
            raise GeometryError("a fit with mechanisms that are kept as they are cannot be scaled")
        nodes = [scaled_node(node, factor) for node in self.candidate.nodes]
        old = self.candidate.card
        card = Card(x=(old.x[0] * factor, old.x[1] * factor), depth=old.depth * factor)
        wishes = self.candidate.wishes.scaled(factor)
        candidate = build(card, nodes, self.candidate.least * factor * (1 - 1e-9), wishes)
        if candidate is None:
            raise GeometryError(f"the fit cannot be made {factor:g} times as large")
        return Fit(candidate, self.likeness, self.closed_gap * factor)


@dataclass(frozen=True, eq=False)
class Subject:
    """What is to be abstracted.

    Attributes
    ----------
    scene:
        The model in the card frame, mm, without transparency.
    bounds:
        What counts of it, rows low and high, shape (2, 3).
    volume, planes:
        Its solid cells, and where its surfaces lie.
    """

    scene: "RayScene"
    bounds: FloatArray
    volume: Volume
    planes: Planes


def fit(subject: Subject, settings: FitSettings | None = None) -> Fit:
    """Abstract a model into prisms with their mechanisms.

    Raises
    ------
    MeshError
        No prism is worth a mechanism.
    InputError
        What the user keeps does not fold, or has more patches than are allowed.
    """
    settings = settings or FitSettings()
    appearance = Appearance(subject.scene, subject.bounds)

    def value(candidate: Candidate) -> float:
        if candidate.patches > settings.most_patches:
            return -1.0
        return appearance.likeness(candidate.mechanisms).overall - settings.patch_likeness * candidate.patches

    volume = subject.volume
    size = subject.bounds[1] - subject.bounds[0]
    far = 20 * float(size.max())
    card, least = Card(x=(-far, far), depth=far), THINNEST * float(size.max())
    empty = first_candidate(card, least, settings.wishes, settings.most_patches)
    if empty.nodes and not settings.wishes.add:
        return Fit(empty, appearance.likeness(empty.mechanisms), 0.0)
    found: list[tuple[float, int, Candidate, int]] = []
    for founded, (*taste, radius) in [(False, TASTES[0]), *((True, taste) for taste in TASTES)]:
        filled = volume.closed(radius) if radius else volume
        state = Grower(filled, subject.planes, settings.taste(*taste, founded=founded)).grow(empty)
        if state.nodes:
            found.append((value(state), -len(found), state, radius))
    if not found:
        raise MeshError("no part of the model is solid enough for a mechanism; try --detail 1 or another --up")
    _, _, start, closed = max(found, key=lambda entry: entry[:2])
    climber = Climber(value, Grower(volume, subject.planes, settings.taste(*SECOND)))
    best = climber.climb(start, BUDGET)
    return Fit(best, appearance.likeness(best.mechanisms), 2 * closed * volume.cell)


def _placement(candidate: Candidate, index: int) -> Placement:
    node, mechanism = candidate.nodes[index], candidate.mechanisms[index]
    mapped = mappings(node.primitive, node.pair, mechanism.id, candidate.wishes.allows)
    others = [other for other in mapped if other.mechanism != mechanism]
    return Placement(
        node.primitive,
        mechanism,
        error_cover(mechanism, node.primitive),
        tuple((other.mechanism.type, other.error_cover) for other in others),
    )
