"""Instants, exactly."""

from __future__ import annotations

SECOND = 10**12  # in picoseconds


class Time(float):
    """An instant in seconds, a float, which knows itself exactly: `ps` are the picoseconds since the start.

    It is compared to the picosecond, so that `now >= 0.1 + 0.2` is true at 0.3 s.
    """

    __slots__ = ("ps",)
    ps: int

    def __new__(cls, seconds: float) -> Time:
        return seconds if type(seconds) is cls else cls.from_ps(round(seconds * SECOND))

    @classmethod
    def from_ps(cls, ps: int) -> Time:
        time = float.__new__(cls, ps / SECOND)
        time.ps = ps
        return time

    def _after(self, other: float) -> float:
        """By how many picoseconds."""
        return self.ps - (other.ps if type(other) is Time else (other + 0.0) * SECOND)

    def __lt__(self, other: float) -> bool:
        return self._after(other) <= -0.5

    def __le__(self, other: float) -> bool:
        return self._after(other) < 0.5

    def __gt__(self, other: float) -> bool:
        return self._after(other) >= 0.5

    def __ge__(self, other: float) -> bool:
        return self._after(other) > -0.5

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (int, float)) and abs(self._after(other)) < 0.5

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None  # type: ignore[assignment]  # equal ones would have different numbers
