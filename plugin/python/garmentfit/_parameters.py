# SPDX-License-Identifier: GPL-3.0-or-later
"""The parameters of the filters as keyword arguments: names, types, defaults and help from the schema."""
from __future__ import annotations

import inspect
from typing import Any, Callable, TypeVar

from . import _core

Function = TypeVar("Function", bound=Callable[..., Any])


def with_keywords(signature: inspect.Signature, filter_: str) -> inspect.Signature:
    """Replaces `**parameters` by the filter's parameters."""
    keywords = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=type_)
                for name, default, type_, *_ in _core.parameters_of(filter_)]
    named = [given for given in signature.parameters.values() if given.kind != inspect.Parameter.VAR_KEYWORD]
    return signature.replace(parameters=named + keywords)


def lines_on(filter_: str) -> str:
    """One line on each parameter, for a docstring."""
    lines = [f"    {name} = {default!r}: {help_} ({range_})"
             for name, default, _, range_, help_ in _core.parameters_of(filter_)]
    return "\n\n    Parameters:\n" + "\n".join(lines)


def takes_parameters_of(filter_: str) -> Callable[[Function], Function]:
    """Decorates a function with `**parameters`: help() lists the parameters of the filter."""
    def named(function: Function) -> Function:
        raises = ("\n\n    Raises InvalidInput, SolverFailure, TimeLimitReached, Cancelled (when progress returns "
                  "False), KeyboardInterrupt.")
        setattr(function, "__signature__", with_keywords(inspect.signature(function), filter_))
        function.__doc__ = (function.__doc__ or "").rstrip() + lines_on(filter_) + raises
        return function
    return named
