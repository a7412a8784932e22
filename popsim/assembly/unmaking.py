"""An order found backwards: what can be taken off last goes on first.

Every joint that is undone leaves more freedom, so what was undone is rarely regretted, and nothing is tried twice.
Two things may be regretted nevertheless. What was swung aside may lie in the way later: then all is folded up
again, and a search swings several things aside in other orders. And what the rest would have guided to its place
may be left hanging on nothing else: then it is brought there by hand.

Of what can be undone the least comes first, by these terms one after the other: what is held open, what is out of
sight; its rank (:func:`popsim.assembly.cut.ranks`), so that sub-assemblies come first in the end and lie flat for
long; whether it mirrors what was undone last, so that the same is done twice in a row; how many joints it undoes
at once; whether all in hand must be turned over for it; at how few parts it is.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial

from popsim import wording
from popsim.assembly.aside import Chain, swung_aside
from popsim.assembly.at_once import AT_ONCE
from popsim.assembly.bundle import Bundle
from popsim.assembly.cut import Cut, ranks
from popsim.assembly.faces import Faces
from popsim.assembly.holding import Holding
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof, Refusal
from popsim.assembly.stack import Stack
from popsim.assembly.trial import Trial, Trials


@dataclass(frozen=True, eq=False)
class Order:
    """An order that was executed.

    Attributes
    ----------
    proofs:
        One per step, from the first to the last.
    left:
        Ids of the joints that could not be undone; none where the order is feasible.
    refusals:
        Why not, by joint id.
    """

    proofs: tuple[Proof, ...]
    left: tuple[str, ...]
    refusals: dict[str, str]


def find_order(kit: Kit) -> Order:
    """The order of least effort, executed; nothing can be executed of what does not fold flat."""
    if not kit.reference.folds_flat:
        left = tuple(kit.flaps_of)
        return Order((), left, dict.fromkeys(left, wording.NEVER_FLAT))
    unmaking = Unmaking(kit)
    while unmaking.step():
        pass
    return unmaking.order()


class Unmaking:
    """A pop-up that is being taken apart."""

    def __init__(self, kit: Kit) -> None:
        self.kit, self.stack, self.ranks = kit, Stack(kit), ranks(kit.layout)
        self.proofs: list[Proof] = []
        self.waiting = [Bundle.whole(kit)]
        self.stuck: list[Bundle] = []
        self.refusals: dict[str, str] = {}
        self.faces = Faces(kit)
        self._mirrored: frozenset[str] = frozenset()
        self._begun: set[frozenset[str]] = set()
        self._trials = Trials(self.stack)

    def step(self) -> bool:
        """Undo something; False where nothing is left to undo."""
        while self.waiting and not self.waiting[-1].glued:
            self.waiting.pop()
        if not self.waiting:
            return False
        bundle = self.waiting.pop(self._next())
        self._trials = Trials(self.stack)
        chain = self._undone(bundle)
        if chain:
            self.proofs += chain
            self.faces.note(chain[-1])
            self._mirrored = frozenset(twin for name in chain[-1].joints for twin in self.kit.twins[name])
            self.waiting += chain[-1].apart
        else:
            self.stuck.append(bundle)
        return True

    def _next(self) -> int:
        """The place of the bundle to go on with: one with mirror images of what was undone, else the last."""
        places = range(len(self.waiting) - 1, -1, -1)
        return next((k for k in places if not self._mirrored.isdisjoint(self.waiting[k].joints)), places[0])

    def order(self) -> Order:
        """What was found, forwards."""
        left = tuple(name for bundle in self.stuck for name in bundle.glued)
        return Order(tuple(reversed(self.proofs)), left, self.refusals)

    def _undone(self, bundle: Bundle) -> Chain:
        """The way of least effort: lying and in sight, else held open in sight, else out of sight; or none.

        What is held open is seen and pressed by two fingers; what is out of sight is found by feel, with tweezers.
        """
        blind: list[Chain] = []
        for ways in (self._lying, self._opened_up, self._standing):
            for chain in ways(bundle):
                if not chain[-1].blind:
                    return chain
                blind.append(chain)
        return min(blind, key=lambda chain: len(chain[-1].blind), default=())

    def _lying(self, bundle: Bundle) -> Iterator[Chain]:
        """What can be undone lying, the easiest first."""
        trial = self._trials.of(bundle, len(self.proofs))
        yield from self._proved(self._taken_off(trial))
        yield from self._proved(self._begun_anew(trial))
        yield from self._proved(self._guided(trial))

    def _begun_anew(self, trial: Trial) -> Iterator[Proof | Refusal]:
        """With all folded up again: what can be undone at once, or after swinging one thing aside.

        The swing comes alone: more may come off in sight after it. It is made once for what is joined, so that
        nothing goes to and fro for ever.
        """
        if any(trial.bundle.sheets.values()):
            trial = self._trials.of(trial.bundle.folded, trial.number)
            yield from (trial.cut(cut) for cut in self._few(trial))
        joined = frozenset(trial.bundle.joints)
        for swing in trial.cuts if joined not in self._begun else ():
            if not swing.taken and isinstance(proof := trial.cut(swing), Proof):
                after = self._trials.of(proof.apart[0], trial.number + 1)
                if any(isinstance(after.cut(cut), Proof) for cut in self._few(after)):
                    self._begun.add(joined)
                    yield proof

    def _opened_up(self, bundle: Bundle) -> Iterator[Chain]:
        """What can be undone lying after several things were swung aside."""
        chain = swung_aside(bundle, self._trials, len(self.proofs), self._few)
        if chain:
            yield chain

    def _taken_off(self, trial: Trial) -> Iterator[Proof | Refusal]:
        """What could be taken off as all lies, or after what is in the way was swung aside."""
        bundle, refusals = trial.bundle, []
        for cut in self._few(trial):
            result = trial.cut(cut)
            yield result
            if isinstance(result, Refusal):
                refusals.append(result)
        yield from (trial.cut(cut) for cut in self._helpful(trial.cuts, refusals))
        for piece in self.kit.layout.pieces:
            moved = frozenset(piece.motions) & bundle.parts
            if moved and moved != bundle.parts and len(bundle.groups(bundle.parts - moved)) == 1:
                yield trial.slid(moved)
        yield from (trial.cut(cut) for cut in trial.cuts if not cut.taken)

    def _guided(self, trial: Trial) -> Iterator[Proof | Refusal]:
        """What could be undone where the rest guides it, and what glues much at once."""
        singles = self._singles(trial.bundle)
        yield from (Holding(trial.bundle, name).closed() for name in singles)
        yield from (
            trial.cut(cut)
            for cut in sorted(trial.cuts, key=partial(self._key, trial.bundle))
            if len(cut.taken) > AT_ONCE
        )
        yield from (Holding(trial.bundle, name).tucked(self.stack) for name in singles)

    def _standing(self, bundle: Bundle) -> Iterator[Chain]:
        """What can be undone with things held open by hand."""
        singles = self._singles(bundle)
        yield from self._proved(Holding(bundle, name).pressed() for name in singles)
        yield from self._proved(Holding(bundle, name).brought() for name in singles)

    def _proved(self, results: Iterable[Proof | Refusal]) -> Iterator[Chain]:
        """Those that can be done; of the others the reasons are noted."""
        for result in results:
            if isinstance(result, Proof):
                yield (result,)
            else:
                self.refusals |= dict.fromkeys(result.joints, result.reason)

    def _singles(self, bundle: Bundle) -> list[str]:
        """The glue joints, what is undone early first."""
        return sorted(bundle.glued, key=lambda name: self.ranks[name])

    def _few(self, trial: Trial) -> list[Cut]:
        """Cuts that undo something, but not too much at once, the best first."""
        found = (cut for cut in trial.cuts if 0 < len(cut.taken) <= AT_ONCE)
        return sorted(found, key=partial(self._key, trial.bundle))

    def _helpful(self, found: Iterable[Cut], refusals: list[Refusal]) -> Iterator[Cut]:
        """What can be swung aside so that something that was refused comes free."""
        swings = [cut for cut in found if not cut.taken]
        for refusal in refusals:
            kept = {part for name in refusal.joints for part in self.kit.joints[name].parts}
            for cut in swings:
                if not cut.moved.isdisjoint(refusal.blockers) and not kept <= cut.moved:
                    yield cut

    def _key(self, bundle: Bundle, cut: Cut) -> tuple[int, ...]:
        """The least comes first.

        What is undone early; what mirrors what was undone last; many joints at once; with nothing turned over; at
        few parts, with all that moves.
        """
        ends = {part for name in cut.taken for part in self.kit.joints[name].parts}
        rank = max((self.ranks[name] for name in cut.taken), default=0)
        apart, turned = self._mirrored.isdisjoint(cut.taken), self.faces.is_turned(bundle, cut)
        return rank, apart, -len(cut.taken), turned, len(ends), -len(cut.moved)
