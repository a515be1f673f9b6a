"""docs/thesis.md lists every equation, table and figure of the thesis, and what it cites exists."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "docs" / "thesis.md").read_text(encoding="utf-8")
CITED = sorted(set(re.findall(r"`([\w./-]+\.(?:rs|py))(?:::([\w:]+))?`", TEXT)))

EQUATIONS = {2: 46, 3: 4, 4: 1, 5: 6, 6: 10}
FIGURES = {2: 16, 3: 7, 4: 8, 5: 16, 6: 8}
"""How many numbered equations and figures each chapter of the thesis has."""


def defines(source: str, name: str) -> bool:
    """Whether a Rust or Python file defines ``name``: a function, a type, a constant, a test of a macro."""
    keywords = r"(?:fn|struct|enum|trait|type|const|static|mod|def|class)"
    return re.search(rf"\b{keywords}\s+{name}\b|^{name}\b[^=\n]*=", source, re.MULTILINE) is not None


@pytest.mark.parametrize(("path", "symbol"), CITED, ids=["::".join(filter(None, cited)) for cited in CITED])
def test_cited_names_exist(path: str, symbol: str) -> None:
    file = ROOT / path
    assert file.is_file(), f"docs/thesis.md cites {path}, which does not exist"
    source = file.read_text(encoding="utf-8")
    for name in filter(None, symbol.split("::")):
        assert defines(source, name), f"docs/thesis.md cites {name} in {path}, which does not define it"


def test_everything_numbered_is_listed_once_and_in_order() -> None:
    tables = TEXT.split("## Corrections")[0]
    listed = re.findall(r"^\| (\(\d\.\d+\)|Fig\. \d\.\d+|Table \d\.\d+) \|", tables, re.MULTILINE)
    equations = [f"({chapter}.{n})" for chapter, last in EQUATIONS.items() for n in range(1, last + 1)]
    figures = [f"Fig. {chapter}.{n}" for chapter, last in FIGURES.items() for n in range(1, last + 1)]
    assert [name for name in listed if name.startswith("(")] == equations
    assert [name for name in listed if name.startswith("Fig")] == figures
    assert [name for name in listed if name.startswith("Table")] == ["Table 2.1"]


def test_what_is_computed_is_proved() -> None:
    rows = [line.strip("| ").split(" | ") for line in TEXT.splitlines() if re.match(r"\| [(FT§]", line)]
    unproved = [row[0] for row in rows if len(row) == 4 and row[2] != "—" and "/tests/" not in row[3]]
    assert unproved == []


def test_every_section_of_future_work_is_listed() -> None:
    assert {"7.1", "7.2", "7.3"} == set(re.findall(r"^\| § (7\.\d) \|", TEXT, re.MULTILINE))
