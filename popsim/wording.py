"""All that is said to the maker of a pop-up, in one place: booklet, steps, and why a step cannot be done."""

TITLE = "How to build it"
FACTS = "{pieces}, {sheets} of {paper}, {steps}"
PIECES, SHEETS, STEPS = ("piece", "pieces"), ("sheet", "sheets"), ("step", "steps")

STEP = "Step {number}"
PIECE = "{name}, sheet {sheet}"
SHEET = "sheet {sheet}"
PAGE = "page {page} of {pages}"

NEEDED = "You need"
TOOLS = (
    "the printed sheets, on thick paper or thin card",
    "scissors, or a craft knife and a cutting mat; ask a grown-up before using a knife",
    "a ruler and an empty ballpoint pen, to score the folds",
    "paper glue that dries slowly, or thin double-sided tape",
    "tweezers for small flaps, and a toothpick for glue where fingers do not fit",
)

LEGEND = "What the pictures say"
NEW = "What you add or move in this step. The strong colour is the printed side, the pale colour the back."
OLD = "Already there: white is the printed side, grey the back."
CARD = "The card that everything stands on."
GLUE = "Put glue here, or press here."
GLUE_BEHIND = "The same on the side that you do not see."
NUMBER = "Flap 7 goes where the same number is printed."
NUMBER_BEHIND = "In brackets: on the back of the paper, behind this number."
ARROW = "Move it this way."
GLASS = "A closer look at a small spot."
MOUNTAIN = "Mountain fold: bend it away from you."
VALLEY = "Valley fold: bend it towards you."
HIDDEN = "An edge that is behind something."

ADVICE = "Before you start"
FOLD_FIRST = "Fold each new piece along all its lines before you glue."
TIPS = (
    FOLD_FIRST,
    "Measure the 5 cm bar on a sheet. If it is not 5 cm long, print again at 100 %.",
    "Use little glue. Press each flap and count to twenty.",
    "Where paper stands in a picture, open it that far and hold it so.",
)

CHECKS = "What to check"

ASSEMBLY = "Assembly"


CUTTING = (
    "Score {creases} with a ruler and an empty pen, then cut out {pieces} from {sheets} along the solid lines."
)
"""First step."""

CLOSING = "Let the glue dry, then close the card slowly, helping each crease in its direction, and open it again."
"""Last step."""

CREASES = ("crease", "creases")

LAID = "glue {what}"
SLID = "slide it in and glue {what}"
FOLDED = "fold it over and glue {what}"
CLOSED = "open the paper as shown, glue {what} and fold all flat"
TUCKED = "tuck in with tweezers and glue {what}"
HELD = "open the paper as shown, glue {what} and press with two fingers"
BROUGHT = CLOSED
UNPROVED = "bending the paper gently (no way was found in simulation: {reason}), glue {what}"
"""One step each, by the way in which it is done; the first letter is made a capital where nothing comes before."""

FLAT_BEFORE = "fold {pieces} flat as shown, then {rest}"
"""What lay open is folded over first; the picture shows how it lies then."""

PIECE_NAMED = "piece {name}"
FLAPS = ("flap {numbers} of piece {name}", "flaps {numbers} of piece {name}")
ON = "on piece {name}"
ON_ITSELF = "of the same piece"
SEAM = "piece {name} edge to edge over {flaps}"
ONTO = ("{flaps} to place {numbers} {where}", "{flaps} to places {numbers} {where}")
BEHIND = "{flaps} behind {numbers} {where}"
BEHIND_NUMBER = "({number})"
SEVERAL = "flaps {numbers} to the same numbers"
"""What is glued: several flaps of different pieces, or to different ones, are told by their numbers alone."""

WAY_LAID = "laid from above and pressed down flat"
WAY_SLID = "slid in along the plane in which it lies; its flaps are folded onto it and pressed down flat"
WAY_FOLDED = "folded over and pressed down flat"
WAY_CLOSED = "glued open, then folded as in the finished pop-up and pressed down flat"
WAY_TUCKED = "tucked in between layers, out of sight, and pressed down flat"
WAY_HELD = "held open and pressed between two fingers"
WAY_BROUGHT = "brought to its place held open, then folded as in the finished pop-up and pressed down flat"
"""The same for reports."""

BURIED = "it lies under other paper"
NOT_GUIDED = "nothing else guides it to its place"
NO_GLUE = "no glue gets there: it is shut in"
NO_FINGER = "no finger reaches the flap of {carrier} on {target}"
NO_SIDE_HELD = "held at {degrees:.0f} degrees it runs into paper from every side"
NO_SIDE_OPEN = "held open it runs into paper from every side"
NOT_TAKEN_AWAY = "it cannot be taken away from its place"
NO_MOUTH = "the layers on {target} are joined where the flap would go in"
SHUT_IN = "the flap of {carrier} is shut in"
ONE_PIECE = "it is one piece of paper"
WIPED_OFF = "slid in, glue would be wiped off on {other}"
NOT_SLID = "it cannot be slid in from any side"
NOT_LEVEL = "{carrier} and {target} do not lie flat on each other"
LAID_INTO = "laid from above it runs into {other}"
FOLDED_INTO = "folded over it runs into {other}"
NOT_BETWEEN = "the flap of {carrier} cannot get between {target} and {other}"
NEVER_FLAT = "the finished pop-up does not fold flat"
NOT_REACHED = "what comes before it cannot be made"
OPENS = "what is glued then does not fold flat: a joint opens by {gap:.1f} mm"
STANDS_UP = "what is glued then does not fold flat: {thickness:.1f} mm stand up"
CROSSES = "what is glued then does not fold flat: {through} by {depth:.1f} mm"
THROUGH = "{one} through {other}"
"""Why something cannot be done."""

FOLDS_FLAT = (
    "what hangs together after a step is folded on its own in MuJoCo, with its own joints only: one hinge is led "
    "by hand for each free motion it has, to the angles of the finished pop-up as that closes; the rest follows; "
    "in the end all is let go and pressed flat"
)
"""What a report means by folding flat in the middle of the assembly."""

DIVIDED = "printed in parts that are glued together again, for the sake of the sheets: {patches}"
"""Which patches are divided."""

EASE = (
    "{steps} steps, {joints} joints ({standing} standing, {blind} blind), {turns} turns, "
    "about {minutes:.0f} minutes"
)


def counted(number: int, noun: tuple[str, str]) -> str:
    """1 sheet, 2 sheets."""
    return f"{number} {noun[number != 1]}"


def listed(words: list[str]) -> str:
    """1; 1 and 2; 1, 2 and 3."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def sentence(text: str) -> str:
    """With a capital and a full stop."""
    return f"{text[0].upper()}{text[1:]}."
