#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes insonify/__init__.pyi: stub_template.pyi, in which <sonar> and the like are the keywords of the tables.

    PYTHONPATH=build/dev/python python3 modules/python/stubs/make_stubs.py
"""
from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

import insonify as iy

folder = Path(__file__).parent
types = (("one of", "str"), ("a whole number", "int | np.integer[Any]"), ("an integer", "int | np.integer[Any] | str"),
         ("a number", "_Number"), ("true or false", "bool | np.bool_"), ("a list, each a number", "_Numbers"),
         ("three numbers", "_Numbers"), ("a list, each one of", "str | Sequence[str]"),
         ("a list of texts", "str | Sequence[str]"), ("text", "_Text"), ("a list of tables", "Any"))
units = ("", "_m", "_hz", "_s", "_m_s")
of_each = {name: "ArrayLike" for name in ("time", "draw", "velocity", "turn_rate")}


def rules_of(docs: str) -> dict[str, str]:
    """The rule of each keyword that the docs list, by its full name."""
    listed = re.findall(r"^    (\w+)(?: \[[^]]*\])?: (.*)$", docs.split("\n\nKeywords:\n")[1], re.MULTILINE)
    return {name + "_" * (name == "with"): rule for name, rule in listed}


def type_of(name: str, rules: dict[str, str]) -> str:
    """The type of a keyword, which may be the end of a full name, without its unit."""
    full = next(full for full in rules if any(full == name + unit or full.endswith(f"_{name}{unit}") for unit in units))
    if "as text or as a list" in rules[full]:
        return "str | _Numbers"
    return next(kind for begin, kind in types if rules[full].startswith(begin))


def keywords(function: Callable[..., Any], known: dict[str, str] | None = None, but: tuple[str, ...] = ()) -> str:
    """The keywords of a function as arguments of a stub, but for those that the template has."""
    docs = inspect.getdoc(getattr(function, "__init__", function) if inspect.isclass(function) else function) or ""
    rules = rules_of(docs)
    names = [name for name, parameter in inspect.signature(function).parameters.items()
             if parameter.kind == inspect.Parameter.KEYWORD_ONLY and name not in but]
    return ", ".join(f"{name}: {(known or {}).get(name) or type_of(name, rules)} | None = None" for name in names)


def stub() -> str:
    """The whole stub."""
    lists = {"sonar": keywords(iy.sonar), "environment": keywords(iy.Environment), "scene": keywords(iy.load_scene, but=("seed",)),
             "simulator": keywords(iy.PingSimulator), "ping": keywords(iy.PingSimulator.ping),
             "pings": keywords(iy.PingSimulator.pings, of_each)}
    lists["scene without material"] = ", ".join(one for one in lists["scene"].split(", ") if not one.startswith("material:"))
    lists["views"] = ", ".join(one for one in lists["pings"].split(", ")
                               if not one.startswith(("keep", "display", "contributors")))
    text = (folder / "stub_template.pyi").read_text()
    for name, listed in lists.items():
        whole = ", ".join(one.replace(" ", "\xa0") for one in listed.split(", "))  # lines end behind arguments
        filled = textwrap.fill(whole, 116, initial_indent=" " * 12, subsequent_indent=" " * 12).replace("\xa0", " ")
        text = text.replace(f"            <{name}>", filled)
    return text


if __name__ == "__main__":
    (folder.parent / "insonify" / "__init__.pyi").write_text(stub())
