"""What laying out and printing sheets costs with the size of the design."""

from pathlib import Path

from boxes import row_of_boxes
from conftest import Report, cpu_seconds, exponent

from popsim.export import export
from popsim.layout import lay_out

PATCHES = (10, 20, 40, 80)


def test_layout_and_pdf(tmp_path: Path, report: Report) -> None:
    rows, sizes, costs = [], [], []
    for wanted in PATCHES:
        design = row_of_boxes(wanted)
        layout = lay_out(design)

        def print_sheets() -> None:
            export(layout, tmp_path / "sheets.pdf", "pdf", texture_root=tmp_path, force=True)  # noqa: B023  # used at once

        laying = cpu_seconds(lambda design=design: lay_out(design), rounds=1)
        printing = cpu_seconds(print_sheets, rounds=1)
        sizes.append(len(design.patches))
        costs.append(laying + printing)
        rows.append((sizes[-1], layout.sheet_count, laying, printing))
    power = exponent(sizes, costs)
    report(f"sheets, exponent {power:.2f}", ("patches", "sheets", "layout, s", "PDF, s"), rows)
