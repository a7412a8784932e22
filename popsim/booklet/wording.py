"""All words of the booklet but the steps' own sentences, in one place."""

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
TIPS = (
    "Measure the 5 cm bar on a sheet. If it is not 5 cm long, print again at 100 %.",
    "Score every fold before you cut, and bend every fold once before you glue.",
    "Use little glue. Press each flap and count to twenty.",
)

CHECKS = "What to check"


def counted(number: int, noun: tuple[str, str]) -> str:
    """1 sheet, 2 sheets."""
    return f"{number} {noun[number != 1]}"
