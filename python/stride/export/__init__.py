"""A run as a file of another tool: MCAP, for Foxglove, PlotJuggler and Rerun."""

from ._mcap import Epoch, McapFile, export_mcap

__all__ = ["Epoch", "McapFile", "export_mcap"]
