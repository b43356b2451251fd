# SPDX-License-Identifier: GPL-3.0-or-later
"""The documentation site: `scripts/build-docs` builds it into build/docs/html."""

import os
import pathlib
import re
import sys
import types

ROOT = pathlib.Path(__file__).resolve().parent.parent

project = "GarmentFit"
author = "The GarmentFit authors"
copyright = author
release = re.search(r"project\(GarmentFit VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
version = release

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["meshlab"]
suppress_warnings = [
    "myst.header",  # the text of CC0 goes from its title to the third level
    "duplicate_declaration.cpp",  # every header opens the namespace again
]

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 4

html_theme = "furo"
html_title = f"GarmentFit {release}"
html_static_path = []

breathe_projects = {"GarmentFit": os.environ.get("GARMENTFIT_DOXYGEN_XML", str(ROOT / "build/docs/doxygen/xml"))}
breathe_default_project = "GarmentFit"
breathe_show_include = False
cpp_id_attributes = ["GARMENTFIT_API"]
highlight_language = "none"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True


def _stand_in_for_core():
    """The Python package without its compiled half: enough to read signatures and docstrings."""
    core = types.ModuleType("garmentfit._core")
    core.__version__ = release
    core.InvalidInput = type("InvalidInput", (ValueError,), {"__doc__": "Something given is wrong; the message says what to do."})
    core.SolverFailure = type("SolverFailure", (RuntimeError,), {"__doc__": "No answer was found."})
    core.TimeLimitReached = type("TimeLimitReached", (core.SolverFailure,), {"__doc__": "`time_limit` was reached."})
    core.Cancelled = type("Cancelled", (Exception,), {"__doc__": "`progress` returned False."})
    for error in (core.InvalidInput, core.SolverFailure, core.TimeLimitReached, core.Cancelled):
        error.__module__ = "garmentfit"
    core.parameters_of = lambda filter_: []
    core.__getattr__ = lambda name: type(name, (), {"__module__": "garmentfit._core"})
    return core


sys.path.insert(0, str(ROOT / "plugin/python"))
sys.modules["garmentfit._core"] = _stand_in_for_core()
