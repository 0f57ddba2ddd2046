"""What is wrong with a unit."""


class UnitError(Exception):
    """A mistake in a unit's class, or in what it does; the text says how to mend it."""
