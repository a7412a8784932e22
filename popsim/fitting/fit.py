"""The abstraction of a model."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from popsim.design import Card
from popsim.errors import GeometryError, MeshError
from popsim.fitting.appearance import Likeness
from popsim.fitting.candidate import Candidate, build
from popsim.fitting.mapping import error_cover, mappings
from popsim.fitting.outset import Outset
from popsim.fitting.scale import scaled_node
from popsim.fitting.search import search
from popsim.fitting.settings import FitSettings
from popsim.fitting.subject import Subject
from popsim.garbage import seldom_collected
from popsim.mechanisms import Depths, Mechanism, Primitive


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
    begun:
        What the search went out from (:class:`popsim.fitting.manners.Manner`), or "kept".
    """

    candidate: Candidate
    likeness: Likeness
    closed_gap: float
    begun: str

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """All mechanisms, bases before what stands on them."""
        return self.candidate.mechanisms

    @property
    def depths(self) -> Depths:
        """Factors on the depths of plates, by patch id."""
        return self.candidate.depths

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
        return replace(self, candidate=candidate, closed_gap=self.closed_gap * factor)


def fit(subject: Subject, settings: FitSettings | None = None) -> Fit:
    """Abstract a model into prisms with their mechanisms; see :func:`fit_best`."""
    return fit_best([subject], settings)[1]


@seldom_collected()
def fit_best(subjects: Sequence[Subject], settings: FitSettings | None = None) -> tuple[int, Fit]:
    """Abstract a model that may stand over the fold in several ways, the one that shows most of it.

    Returns
    -------
    tuple
        Which subject that is, and how it is abstracted.

    Raises
    ------
    MeshError
        No prism is worth a mechanism.
    InputError
        What the user keeps does not fold, or has more patches than are allowed.
    """
    settings = settings or FitSettings()
    outsets = [Outset.of(subject, settings) for subject in subjects]
    start = outsets[0].start
    if start.nodes and not settings.wishes.add:
        return 0, _shown(outsets[0], outsets[0].deepened(start), 0.0, "kept")
    found = search(outsets)
    if found is None:
        raise MeshError("no part of the model is solid enough for a mechanism; try --detail 1 or another --up")
    outset = outsets[found.outset]
    gap = 2 * found.manner.closed * outset.subject.volume.cell
    return found.outset, _shown(outset, outset.polished(found.candidate), gap, found.manner.name)


def _shown(outset: Outset, candidate: Candidate, gap: float, begun: str) -> Fit:
    """A fit and how it looks with more pixels."""
    return Fit(candidate, outset.fine.likeness(candidate.mechanisms, candidate.depths), gap, begun)


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
