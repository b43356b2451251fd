# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors with a code for programs; garmentfit/error.h lists the codes."""
from __future__ import annotations

from ._core import InvalidInput


def invalid_input(code: str, line: str) -> InvalidInput:
    error = InvalidInput(line)
    error.code = code
    return error
