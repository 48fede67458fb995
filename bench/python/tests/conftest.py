"""What the package is held against: the program ``epas``, built from the same tree."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
from typing import Any, Callable

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
Ask = Callable[[str, list[dict[str, Any]]], list[dict[str, Any]]]


@pytest.fixture(scope="session")
def program() -> str:
    """Path of the program."""
    path = os.environ.get("EPAS", str(ROOT / "target" / "release" / "epas"))
    if not os.path.exists(path):
        pytest.skip(f"{path} is not built: cargo build --release -p epas")
    return path


@pytest.fixture(scope="session")
def ask(program: str) -> Ask:
    """Answers of ``eval`` to requests of one model."""

    def asked(model: str, requests: list[dict[str, Any]]) -> list[dict[str, Any]]:
        lines = "".join(json.dumps({"id": 0, "model": model, **fields}) + "\n" for fields in requests)
        done = subprocess.run([program, "eval"], input=lines, capture_output=True, text=True)
        return [json.loads(line) for line in done.stdout.splitlines()]

    return asked
