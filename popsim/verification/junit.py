"""The verdict as JUnit XML, which CI systems show beside the tests of a project."""

import re
from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from popsim.verification.verdict import Finding, Measure, Verdict

FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML cannot hold, not even escaped."""


def to_junit(verdict: Verdict, name: str) -> str:
    """One test case per aspect and per comparison with the closed forms; `name` is that of the design.

    What could not be judged is skipped with the reason; the design fails by another aspect then. Where theory and
    simulation contradict each other, the type of the failure is "hole", else "refused". There are no times and
    no host in it: the same design gives the same text.
    """
    cases = [_aspect(finding) for finding in verdict.findings] + [_comparison(each) for each in verdict.agreement]
    for case in cases:
        case.set("classname", _legal(name))
    counts = {
        "tests": len(cases),
        "failures": sum(case.find("failure") is not None for case in cases),
        "errors": 0,
        "skipped": sum(case.find("skipped") is not None for case in cases),
    }
    totals = {key: str(count) for key, count in counts.items()}
    suites = Element("testsuites", {"name": "popsim verify", **totals})
    suite = SubElement(suites, "testsuite", {"name": _legal(name), **totals})
    suite.extend(cases)
    if verdict.notes:
        SubElement(suite, "system-out").text = _legal("\n".join(verdict.notes))
    indent(suites)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(suites, encoding="unicode") + "\n"


def _aspect(finding: Finding) -> Element:
    case = Element("testcase", {"name": finding.aspect})
    if finding.unjudged:
        SubElement(case, "skipped", {"message": _legal(finding.unjudged)})
    elif not finding.simulation:
        broken = [measure for measure in finding.measures if not measure.holds]
        broken.sort(key=lambda measure: measure is not finding.worst)
        stated = [
            f"{condition.subject}: {condition.name}: margin {condition.margin:.4g} mm"
            for condition in finding.conditions or ()
            if not condition.holds
        ]
        _fail(case, finding.disagreement or "refused", [*map(_sentence, broken), *stated])
    return case


def _comparison(measure: Measure) -> Element:
    case = Element("testcase", {"name": measure.name})
    if not measure.holds:
        _fail(case, "hole", [_sentence(measure)])
    return case


def _fail(case: Element, kind: str, lines: Sequence[str]) -> None:
    """Mark `case` as failed; the first line is the message, all lines are the text."""
    failure = SubElement(case, "failure", {"type": kind, "message": _legal(lines[0])})
    failure.text = _legal("\n".join(lines))


def _sentence(measure: Measure) -> str:
    where = f", {measure.where}" if measure.where else ""
    return f"{measure.name} {measure.found}, at most {measure.allowed}{where}"


def _legal(text: str) -> str:
    return FORBIDDEN.sub("?", text)
