"""An order found backwards: what can be taken off last goes on first.

Every joint that is undone leaves more freedom: whatever can be undone with others in place can be undone without
them as well. So it does not matter for success what is undone first, and nothing that was undone is regretted.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from popsim.assembly.bundle import Bundle
from popsim.assembly.cut import Cut, cuts, ranks
from popsim.assembly.holding import Holding
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof, Refusal
from popsim.assembly.stack import Stack
from popsim.assembly.trial import Trial

AT_ONCE = 6
"""Joints that are glued by one motion at most: glue dries."""


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
        return Order((), left, dict.fromkeys(left, "the finished pop-up does not fold flat"))
    unmaking = Unmaking(kit)
    while unmaking.step():
        pass
    return unmaking.order()


def check_order(kit: Kit, order: Sequence[tuple[str, ...]]) -> Refusal | None:
    """Execute an order that somebody else has made; why it cannot be done, or None where it can.

    Parameters
    ----------
    order:
        Ids of the glue joints that are made in each step, from the first to the last.
    """
    stack, bundles = Stack(kit), [Bundle.whole(kit)]
    for number, names in enumerate(reversed(order)):
        bundle = next(one for one in bundles if names[0] in one.joints)
        found = _undoing(bundle, stack, names, number)
        if isinstance(found, Refusal):
            return found
        bundles = [one for one in bundles if one is not bundle] + list(found.apart)
    return None


def _undoing(bundle: Bundle, stack: Stack, names: tuple[str, ...], number: int) -> Proof | Refusal:
    """How just these joints are undone, as things lie or folded up again; or the last reason against it."""
    refusal = Refusal(names, "it lies under other paper")
    for now in (bundle, bundle.folded()):
        trial = Trial(now, stack)
        exact = [cut for cut in cuts(now, stack) if set(cut.taken) == set(names)]
        ways = [trial.cut(cut, number) for cut in exact]
        if len(names) == 1:
            holding = Holding(now, names[0])
            ways += [holding.closed(), holding.pressed(), holding.tucked(stack)]
        for way in ways:
            if isinstance(way, Proof):
                return way
            refusal = way
    return refusal


class Unmaking:
    """A pop-up that is being taken apart."""

    def __init__(self, kit: Kit) -> None:
        self.kit, self.stack, self.ranks = kit, Stack(kit), ranks(kit.layout)
        self.proofs: list[Proof] = []
        self.waiting = [Bundle.whole(kit)]
        self.stuck: list[Bundle] = []
        self.refusals: dict[str, str] = {}

    def step(self) -> bool:
        """Undo something; False where nothing is left to undo."""
        while self.waiting and not self.waiting[-1].glued:
            self.waiting.pop()
        if not self.waiting:
            return False
        bundle = self.waiting.pop()
        proof = self._undone(bundle)
        if proof is None:
            self.stuck.append(bundle)
        else:
            self.proofs.append(proof)
            self.waiting += proof.apart
        return True

    def order(self) -> Order:
        """What was found, forwards."""
        left = tuple(name for bundle in self.stuck for name in bundle.glued)
        return Order(tuple(reversed(self.proofs)), left, self.refusals)

    def _undone(self, bundle: Bundle) -> Proof | None:
        best: Proof | None = None
        for result in self._ways(bundle):
            if isinstance(result, Refusal):
                for name in result.joints:
                    self.refusals[name] = result.reason
            elif result.is_easy:
                return result
            elif best is None or result.effort < best.effort:
                best = result
        return best

    def _ways(self, bundle: Bundle) -> Iterator[Proof | Refusal]:
        """What could be undone, the easiest first."""
        trial, number = Trial(bundle, self.stack), len(self.proofs)
        found = list(cuts(bundle, self.stack))
        refusals = []
        for cut in self._few(found):
            result = trial.cut(cut, number)
            yield result
            if isinstance(result, Refusal):
                refusals.append(result)
        swings = [cut for cut in found if not cut.taken]
        for cut in self._helpful(swings, refusals):
            yield trial.cut(cut, number)
        for piece in self.kit.layout.pieces:
            moved = frozenset(piece.motions) & bundle.parts
            if moved and moved != bundle.parts and len(bundle.groups(bundle.parts - moved)) == 1:
                yield trial.slid(moved)
        for cut in swings:
            yield trial.cut(cut, number)
        yield from self._begun_anew(bundle.folded(), number)
        singles = sorted(bundle.glued, key=lambda name: self.ranks[name])
        for name in singles:
            yield Holding(bundle, name).closed()
        for cut in sorted(found, key=self._key):
            if len(cut.taken) > AT_ONCE:
                yield trial.cut(cut, number)
        for name in singles:
            yield Holding(bundle, name).pressed()
        for name in singles:
            yield Holding(bundle, name).tucked(self.stack)

    def _begun_anew(self, bundle: Bundle, number: int) -> Iterator[Proof | Refusal]:
        """With all folded up again: what can be undone at once, or after swinging one thing aside."""
        trial = Trial(bundle, self.stack)
        every = list(cuts(bundle, self.stack))
        yield from (trial.cut(cut, number) for cut in self._few(every))
        for swing in every:
            if not swing.taken and isinstance(proof := trial.cut(swing, number), Proof):
                after = Trial(proof.apart[0], self.stack)
                found = self._few(cuts(after.bundle, self.stack))
                if any(isinstance(after.cut(cut, number + 1), Proof) for cut in found):
                    yield proof

    def _few(self, found: Iterable[Cut]) -> list[Cut]:
        """Those that undo something, but not too much at once, the best first."""
        return sorted((cut for cut in found if 0 < len(cut.taken) <= AT_ONCE), key=self._key)

    def _helpful(self, swings: list[Cut], refusals: list[Refusal]) -> Iterator[Cut]:
        """What can be swung aside so that something that was refused comes free."""
        for refusal in refusals:
            kept = {part for name in refusal.joints for part in self.kit.joints[name].parts}
            for cut in swings:
                if not cut.moved.isdisjoint(refusal.blockers) and not kept <= cut.moved:
                    yield cut

    def _key(self, cut: Cut) -> tuple[int, ...]:
        """The least comes first: what is undone early, many joints at once, at few parts, with all that moves."""
        ends = {part for name in cut.taken for part in self.kit.joints[name].parts}
        rank = max((self.ranks[name] for name in cut.taken), default=0)
        return rank, -len(cut.taken), len(ends), -len(cut.moved)
