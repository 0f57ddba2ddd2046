"""The packages that an export needs, which stride itself does not."""

from __future__ import annotations

import importlib
from typing import Any

_OF_THE_EXTRA = ("foxglove_schemas_protobuf", "google", "lz4", "mcap", "mcap_protobuf", "zstandard")


def package(name: str) -> Any:
    """A module of one of them. Raises ImportError that says how to have it."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        missing = (error.name or name).partition(".")[0]
        if missing not in _OF_THE_EXTRA:
            raise
        raise ImportError(
            f"an MCAP file needs the Python module '{missing}', which is not installed\n"
            "  hint: pip install 'stride-cosim[mcap]'",
            name=missing,
        ) from error
