"""Executing an order that somebody else has made."""

from collections.abc import Sequence

from popsim import wording
from popsim.assembly.bundle import Bundle
from popsim.assembly.holding import Holding
from popsim.assembly.kit import Kit
from popsim.assembly.proof import Proof, Refusal
from popsim.assembly.stack import Stack
from popsim.assembly.trial import Trial


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
    refusal = Refusal(names, wording.BURIED)
    for now in (bundle, bundle.folded):
        trial = Trial(now, stack, number)
        ways = [trial.cut(cut) for cut in trial.cuts if set(cut.taken) == set(names)]
        if len(names) == 1:
            holding = Holding(now, names[0])
            ways += [holding.closed(), holding.brought(), holding.pressed(), holding.tucked(stack)]
        for way in ways:
            if isinstance(way, Proof):
                return way
            refusal = way
    return refusal
